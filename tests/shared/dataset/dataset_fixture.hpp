#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "shared/dataset/dataset_error.hpp"
#include "shared/dataset/sample_source.hpp"
#include "shared/image/image_codec.hpp"

namespace cosight {

/// A folder of the test's own, empty at its start.
class DatasetFixture : public testing::Test {
 protected:
  DatasetFixture() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / "cosight_dataset_test" /
              (std::string(test->test_suite_name()) + "." + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~DatasetFixture() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  /// An image whose gray tells which one it is.
  std::filesystem::path write_frame(const std::string& name, int gray, int width = 32,
                                    int height = 24) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    const auto pixels = static_cast<std::size_t>(width * height);
    write_image(file, {width, height, std::vector<std::uint8_t>(pixels, static_cast<std::uint8_t>(gray))});
    return file;
  }

  void cut_short(const std::filesystem::path& file) const {
    std::filesystem::resize_file(file, std::filesystem::file_size(file) * 3 / 4);
  }

  std::filesystem::path folder_;
};

inline std::vector<Sample> all_of(SampleSource& source) {
  std::vector<Sample> samples;
  while (auto sample = source.next())
    samples.push_back(std::move(*sample));
  return samples;
}

inline std::vector<Stamp> stamps_of(const std::vector<Sample>& samples) {
  std::vector<Stamp> stamps;
  stamps.reserve(samples.size());
  for (const auto& sample : samples)
    stamps.push_back(stamp_of(sample));
  return stamps;
}

inline std::vector<std::uint64_t> sequences_of(const std::vector<Sample>& samples) {
  std::vector<std::uint64_t> sequences;
  for (const auto& sample : samples) {
    if (const auto* image = std::get_if<ImageSample>(&sample)) sequences.push_back(image->sequence);
  }
  return sequences;
}

/// What an action says when it fails.
template <class Error>
std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace cosight
