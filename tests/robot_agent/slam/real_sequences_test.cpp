#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>

#include "robot_agent/slam/collaborative_slam.hpp"
#include "shared/evaluation/trajectory_errors.hpp"
#include "shared/image/image_codec.hpp"
#include "tools/prepare/pose_noise.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight::slam {
namespace {

std::filesystem::path data_folder() {
  const char* given = std::getenv("COSIGHT_DATA");
  return given != nullptr ? given : std::filesystem::path(COSIGHT_SOURCE_DIR) / ".." / "shared" / "data";
}

FrameBundle bundle_of(const RecordedImage& recorded, std::uint64_t sequence) {
  FrameBundle bundle;
  bundle.stamp = recorded.stamp;
  bundle.sequence = sequence;
  bundle.image = std::make_shared<GrayImage>(read_image(recorded.file));
  return bundle;
}

TEST(RealSequences, TagboxFromSurveyedCornersStaysWithinACentimetre) {
  const auto folder = data_folder() / "tagbox";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real data: " << folder << " does not exist";
  const RealSequence sequence = read_tagbox(folder);
  SlamOptions options;
  options.mode = Mode::kMono;
  CollaborativeSlam slam(sequence.robot_camera, options, sequence.known_points);
  std::vector<PosePair> pairs;
  for (const RecordedImage& recorded : sequence.robot_images) {
    const FrameEstimate estimate = slam.process(bundle_of(recorded, pairs.size()));
    EXPECT_EQ(estimate.tracking, Tracking::kTracking) << pairs.size();
    pairs.push_back({recorded.stamp, estimate.T_WS.T, *recorded.T_WC});
  }
  EXPECT_EQ(pairs.size(), 210U);
  const double ate = statistics_of(position_errors(pairs)).rmse;
  RecordProperty("ate_m", std::to_string(ate));
  EXPECT_LE(ate, 0.01);
}

TEST(RealSequences, Kitti00HoldsItsScaleFromTheFirstOverlap) {
  const auto folder = data_folder() / "kitti00";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real data: " << folder << " does not exist";
  const RealSequence sequence = read_kitti(folder);
  PoseNoise noise;
  noise.position_sigma.setConstant(0.01);
  noise.rotation_sigma.setConstant(0.05 * std::numbers::pi / 180.0);
  PoseNoiseSource tracker(noise, 1);
  CollaborativeSlam slam(sequence.robot_camera, SlamOptions{});
  constexpr std::size_t kFirst = 15;  // KITTI's own poses are wrong by 1.3 m before it
  constexpr std::size_t kLast = 40;
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i <= kLast; ++i) {
    const RecordedImage& robot = sequence.robot_images[i];
    const RecordedImage& worn = sequence.wearer_images[i];
    FrameBundle bundle = bundle_of(robot, i);
    WearerView& wearer = bundle.wearer.emplace();
    wearer.stamp = worn.stamp;
    wearer.image = std::make_shared<GrayImage>(read_image(worn.file));
    wearer.camera = sequence.wearer_camera;
    wearer.T_SF = tracker.observe(robot.T_WC->inverse() * *worn.T_WC);
    const FrameEstimate estimate = slam.process(bundle);
    EXPECT_EQ(estimate.tracking, Tracking::kTracking) << i;
    if (i >= kFirst) pairs.push_back({robot.stamp, estimate.T_WS.T, *robot.T_WC});
  }
  const auto scale = estimated_scale(pairs);
  ASSERT_TRUE(scale);
  RecordProperty("scale", std::to_string(*scale));
  EXPECT_NEAR(*scale, 1.0, 0.04);
}

}  // namespace
}  // namespace cosight::slam
