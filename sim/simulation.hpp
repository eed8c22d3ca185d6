#pragma once

#include <atomic>
#include <filesystem>

#include "sim/city_run.hpp"
#include "sim/simulated_run.hpp"

namespace cosight::sim {

struct RunOptions {
  std::uint64_t seed = 1;
  unsigned threads = 2;     ///< changes the time it takes, never the result
  bool with_frames = true;  ///< false: everything but the pictures
};

/// What a run made.
struct RunReport {
  std::size_t robot_frames = 0;
  std::size_t wearer_frames = 0;
  std::size_t known_points = 0;
  double duration = 0.0;       ///< of the simulated time [s]
  double overlap_ratio = 0.0;  ///< share of the frames in which Cf sees a fifth of Cs' picture or more
  bool stopped = false;
};

/// Renders the run into a Cosight dataset folder. `stop` ends it early (the folder is then incomplete).
/// Throws DatasetError.
RunReport write_dataset(const SimulatedRun& run, const RunOptions& options,
                        const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// The same for a drive through a city: the car's camera and IMU, and nobody else's.
RunReport write_dataset(const CityRun& run, const RunOptions& options, const std::filesystem::path& folder,
                        const std::atomic<bool>& stop);

/// The same for a scenario; throws std::invalid_argument for one that cannot be built.
RunReport write_dataset(const Scenario& scenario, const RunOptions& options,
                        const std::filesystem::path& folder, const std::atomic<bool>& stop);

}  // namespace cosight::sim
