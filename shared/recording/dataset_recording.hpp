#pragma once

#include <cstdint>
#include <filesystem>

namespace cosight::recording {

struct RecordedDataset {
  std::uint64_t messages = 0;
  std::uint64_t lost = 0;  ///< samples that could not be used
};

/// Makes a recording of a Cosight dataset folder: both agents' samples in the order of their stamps, each
/// camera's calibration before them. Throws DatasetError, ConfigError or RecordingError.
RecordedDataset record_dataset(const std::filesystem::path& folder, const std::filesystem::path& recording);

}  // namespace cosight::recording
