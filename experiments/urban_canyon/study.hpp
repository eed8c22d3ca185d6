#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/urban_canyon/canyon.hpp"
#include "experiments/urban_canyon/parallel.hpp"
#include "robot_agent/vins/track_run.hpp"

namespace cosight::experiments {

/// A way to weigh what the window sees.
struct Method {
  std::string name;
  vins::TrustOptions trust;
};

/// The paper's four methods and the guarded one, as `options` says otherwise.
std::vector<Method> modes(const vins::TrustOptions& options);

/// The fixed mode first, then every reading of V26 and V30 that the paper's text allows.
std::vector<Method> readings(const vins::TrustOptions& options);

/// Several drives, each with every method, all from the same measurements. The first method is the one that
/// the others are measured against.
struct MethodStudy {
  std::vector<std::string> names;
  std::vector<std::vector<vins::TrackMetrics>> metrics;  ///< [method][drive]
  std::vector<double> moving_percent;                    ///< of the sightings, a drive; empty: not known
};

/// What a canyon's window is told: the IMU's noise as it is, and the pixels' as a calibration by day or night
/// would give it.
vins::TrackRunOptions window_for(const CanyonOptions& canyon);

/// One drive with one method.
vins::TrackRun run(const vins::TrackSequence& sequence, vins::TrackRunOptions window, const Method& method);

/// Drives of seeds `first_seed`, `first_seed` + 1, ….
MethodStudy study_canyon(const CanyonOptions& canyon, const vins::TrackRunOptions& window,
                         const std::vector<Method>& methods, unsigned first_seed, int drives,
                         const Workers& workers);

/// One recorded drive.
MethodStudy study_tracks(const vins::TrackSequence& sequence, const vins::TrackRunOptions& window,
                         const std::vector<Method>& methods, const Workers& workers);

/// One method over all drives.
struct MethodSummary {
  double rpe_mean = 0.0;             ///< over one second; average over the drives [m]
  double rpe_std = 0.0;              ///< within a drive; average over the drives [m]
  double rpe_max = 0.0;              ///< largest of all drives [m]
  double rpe_frame_mean = 0.0;       ///< between neighbouring frames [m]
  double drift_percent = 0.0;        ///< V32, average
  double outlier_percent = 0.0;      ///< average
  double improvement_percent = 0.0;  ///< of rpe_mean against the fixed mode
  double improvement_sigma = 0.0;    ///< standard error of it over the drives; zero with one drive
  double worst_max_ratio = 0.0;      ///< largest error over that of the fixed mode, in the worst drive
};
std::vector<MethodSummary> summarise(const MethodStudy& study);

/// Beside the paper's Table 2 or 3 where `paper_table` is 2 or 3.
std::string table(const std::string& title, const MethodStudy& study, int paper_table);

/// {"rpe_m_mean": …} of one method, for the summary.
std::vector<std::pair<std::string, double>> named(const MethodSummary& summary);

}  // namespace cosight::experiments
