#include "robot_agent/vins/vins_thread.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

constexpr int kSize = 64;

CameraModel small_camera() {
  CameraModel camera;
  camera.width = camera.height = kSize;
  camera.fx = camera.fy = 50.0;
  camera.cx = camera.cy = 0.5 * kSize;
  return camera;
}

std::shared_ptr<const GrayImage> plain_image() {
  return std::make_shared<GrayImage>(GrayImage{kSize, kSize, std::vector<std::uint8_t>(kSize * kSize, 128)});
}

std::shared_ptr<const GrayImage> broken_image() {
  return nullptr;
}

void push_imu(VinsThread& thread, SyntheticDrive& drive, double from, double to) {
  for (const ImuSample& sample : drive.imu(from, to))
    thread.push_imu(sample);
}

TEST(VinsThread, ProcessesEveryImageInOrderWhenItMayWait) {
  SyntheticDrive drive(1);
  VinsThreadOptions options;
  options.never_drop = true;
  options.max_images = 2;
  std::vector<VinsEstimate> estimates;
  VinsThread thread(options, small_camera(), drive.T_BS(),
                    [&](const VinsEstimate& estimate, const Window&) { estimates.push_back(estimate); });
  push_imu(thread, drive, 0.0, 3.0);
  for (int i = 0; i < 20; ++i)
    thread.push_image(drive.stamp(0.1 + 0.1 * i), plain_image);
  thread.finish();
  ASSERT_EQ(estimates.size(), 20U);
  EXPECT_TRUE(std::is_sorted(estimates.begin(), estimates.end(),
                             [](const auto& a, const auto& b) { return a.stamp < b.stamp; }));
  EXPECT_EQ(thread.counters().images_dropped, 0U);
}

TEST(VinsThread, DropsTheOldestImagesAndCountsThemWhenNoImuComes) {
  SyntheticDrive drive(1);
  VinsThreadOptions options;
  options.max_images = 3;
  options.never_drop = true;  // what waits in vain must not block the sensors
  VinsThread thread(options, small_camera(), drive.T_BS(), {});
  for (int i = 0; i < 8; ++i)
    thread.push_image(drive.stamp(0.1 * i), plain_image);
  thread.finish();
  EXPECT_EQ(thread.counters().images, 8U);
  EXPECT_EQ(thread.counters().images_dropped, 5U);
  EXPECT_EQ(thread.counters().images_without_imu, 3U);
}

TEST(VinsThread, CountsImagesThatCannotBeReadAndGoesOn) {
  SyntheticDrive drive(1);
  int estimates = 0;
  VinsThread thread({}, small_camera(), drive.T_BS(),
                    [&](const VinsEstimate&, const Window&) { ++estimates; });
  push_imu(thread, drive, 0.0, 1.0);
  thread.push_image(drive.stamp(0.1), plain_image);
  thread.push_image(drive.stamp(0.2), broken_image);
  thread.push_image(drive.stamp(0.3), plain_image);
  thread.finish();
  EXPECT_EQ(thread.counters().images_undecodable, 1U);
  EXPECT_EQ(estimates, 2);
}

TEST(VinsThread, CountsImagesThatComeInTheWrongOrder) {
  SyntheticDrive drive(1);
  VinsThread thread({}, small_camera(), drive.T_BS(), {});
  thread.push_image(drive.stamp(1.0), plain_image);
  thread.push_image(drive.stamp(0.9), plain_image);
  thread.finish();
  EXPECT_EQ(thread.counters().images_out_of_order, 1U);
}

TEST(VinsThread, ForgetsImuSamplesThatNoImageTakes) {
  SyntheticDrive drive(1);
  VinsThreadOptions options;
  options.max_imu_samples = 100;
  VinsThread thread(options, small_camera(), drive.T_BS(), {});
  push_imu(thread, drive, 0.0, 1.0);
  thread.finish();
  EXPECT_EQ(thread.counters().imu_samples, 201U);
  EXPECT_EQ(thread.counters().imu_refused, 200U);
}

}  // namespace
}  // namespace cosight::vins
