#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/urban_canyon/canyon.hpp"
#include "experiments/urban_canyon/parallel.hpp"
#include "robot_agent/vins/window_odometry.hpp"

namespace cosight::experiments {

/// What one window said of its own error at one time.
struct PoseCheck {
  double t = 0.0;              ///< since the start [s]
  double pose_nees = 0.0;      ///< of [dp (W), dtheta (B)]; 6 when the window is right about itself
  double position_nees = 0.0;  ///< 3
  double speed_error = 0.0;    ///< estimated over true speed, less one; nothing sensible at rest
};

struct ConsistencyOptions {
  vins::TrustOptions trust;
  vins::StartUncertainty start;
  int frames = 150;  ///< of each drive, at 10 Hz
  int every = 10;    ///< frames between two checks
};

/// A street without traffic and with features of one quality.
CanyonOptions static_canyon();

/// One drive through it. The first state is drawn around the true one from what the window is told of it. One
/// check every `every` frames.
std::vector<PoseCheck> check_pose(const ConsistencyOptions& options, unsigned seed);

/// Averages over drives with seeds 1 to `runs`: of each check, in order.
std::vector<PoseCheck> monte_carlo(const ConsistencyOptions& options, int runs, const Workers& workers);

/// One mode over all drives and checks.
struct ModeConsistency {
  std::string name;
  double pose_nees = 0.0, position_nees = 0.0;  ///< averages
  double pose_in_band = 0.0;                    ///< share of the checks whose average lies in its 95 % band
  double position_in_band = 0.0;
  std::vector<PoseCheck> course;  ///< averages over the drives, one a check
};
std::vector<ModeConsistency> study_consistency(int runs, const Workers& workers);

std::string table(const std::vector<ModeConsistency>& modes, int runs);
/// A file nees_<mode>.csv for each.
void write_nees(const std::filesystem::path& folder, const std::vector<ModeConsistency>& modes);
std::vector<std::pair<std::string, double>> named(const ModeConsistency& mode);

}  // namespace cosight::experiments
