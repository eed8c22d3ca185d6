#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "shared/config/calibration.hpp"
#include "shared/config/config.hpp"
#include "shared/image/image_codec.hpp"

namespace cosight::wearable {

/// A dataset folder of `frames` worn frames 20 ms apart, with orientations at 200 Hz.
class SmallDataset {
 public:
  static constexpr int kFrames = 10;
  static constexpr int kOrientations = 40;

  SmallDataset() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / "cosight_wearable_test" /
              (std::string(test->test_suite_name()) + "." + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "wearer/cam0");
    std::ofstream frames(folder_ / "wearer/cam0.csv");
    frames << "stamp_ns,file\n";
    for (int i = 0; i < kFrames; ++i) {
      frames << kFirst + 20'000'000 * i << ",cam0/" << i << ".jpg\n";
      write_image(frame(i), {64, 48, std::vector<std::uint8_t>(64 * 48, static_cast<std::uint8_t>(20 * i))});
    }
    std::ofstream orientations(folder_ / "wearer/ahrs.csv");
    orientations << "stamp_ns,qx,qy,qz,qw\n";
    for (int i = 0; i < kOrientations; ++i)
      orientations << kFirst + 5'000'000 * i << ",0,0,0,1\n";
    CameraModel camera;
    camera.width = 64;
    camera.height = 48;
    write_camera_model(folder_ / "wearer/calibration.yaml", camera);
  }
  ~SmallDataset() { std::filesystem::remove_all(folder_); }
  SmallDataset(const SmallDataset&) = delete;
  SmallDataset& operator=(const SmallDataset&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path frame(int i) const { return folder_ / "wearer/cam0" / (std::to_string(i) + ".jpg"); }

 private:
  static constexpr std::int64_t kFirst = 1'000'000'000;

  std::filesystem::path folder_;
};

}  // namespace cosight::wearable
