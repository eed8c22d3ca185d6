#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "sim/carrier.hpp"
#include "sim/dataset_writer.hpp"

namespace cosight::sim {

/// A camera and the folder of its agent: calibration.yaml, cam0.csv, cam0/.
struct CarrierFolder {
  const Carrier& carrier;
  std::filesystem::path folder;
};

/// Everything but the pictures. Throws DatasetError.
void write_camera(const CarrierFolder& camera);

/// The pictures of all cameras, each one a job of its own: threads share nothing. `stop` ends it early.
/// Throws DatasetError.
void write_frames(const std::vector<CarrierFolder>& cameras, unsigned threads, const std::atomic<bool>& stop);

/// The camera's poses at its frames, with its stamps.
std::vector<TimedPose> truth_of(const Carrier& carrier);

/// The poses of a body 100 times a second, on the true clock: dense enough for any sensor of its.
std::vector<TimedPose> truth_of(const Motion& T_WB, double duration);

}  // namespace cosight::sim
