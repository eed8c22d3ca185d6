#pragma once

#include <map>
#include <vector>

#include "experiments/consistency/association.hpp"
#include "experiments/consistency/feature_world.hpp"
#include "robot_agent/ekf/filter.hpp"

namespace cosight::experiments {

/// From which pose a landmark without the wearer's depth is started (equations section 4).
enum class FirstPose { kCloned, kIndependent };

/// As what a match in the free camera is measured.
enum class WearerForm {
  kPoint,  ///< both pixels triangulated, C5
  kPixel,  ///< a pixel of each camera
};

/// Matches that are wrong, by pixels of either camera.
struct WrongMatches {
  double share = 0.0;     ///< of all matches of known landmarks
  bool repeated = false;  ///< all of one frame are off by the same: a repeated pattern; else each by its own
  double min_px = 5.0;    ///< off by so much at least …
  double max_px = 40.0;   ///< … and at most
};

struct RunOptions {
  FeatureWorldOptions world;
  ekf::FilterOptions filter;      ///< noises are the world's; every gate is off: association is known
  double claimed_variance = 1.0;  ///< the filter is told so many times the true variance of each measurement
  int map_size = 20;
  int steps = 100;
  int glance_period = 50;       ///< [steps] the wearer looks at the start of each period …
  int glance_steps = 20;        ///< … for so long; all the time when it is the period
  int last_glance = 1'000'000;  ///< [step] from here on the wearer is away: mono
  WearerForm wearer_form = WearerForm::kPixel;
  bool correlated_starts = true;  ///< landmarks of one frame share the error of T_SF
  bool delayed_starts = true;     ///< new landmarks from Cs alone as well
  FirstPose first_pose = FirstPose::kCloned;
  WrongMatches wrong;
  Validation validation = Validation::kNone;
};

/// Sums of normalised innovations of one kind of measurement.
struct NisSum {
  double nis = 0.0;
  double rows = 0.0;
  double mean_per_row() const { return rows > 0.0 ? nis / rows : 0.0; }
};

/// Matches as they were given to the validation and as they were fused.
struct MatchCounts {
  int right = 0, right_fused = 0;
  int wrong = 0, wrong_fused = 0;
  double validation_s = 0.0;  ///< CPU time the validation took [s]
};

/// One frame of one run.
struct StepResult {
  double pose_nees = 0.0;       ///< expected 6
  double position_nees = 0.0;   ///< expected 3
  double position_error = 0.0;  ///< [m]
  double heading_error = 0.0;   ///< whole angle of rotation [rad]
  NisSum pixels;                ///< each measurement by itself
  NisSum points;
  NisSum joint;  ///< all that were fused together
  int landmarks = 0;
  MatchCounts matches;
};

/// The filter in a world, driven as slam drives it: predict, update with pixels and points, new landmarks
/// from the wearer's view, new ones from parallax. Association known, pure in seed and options.
class ConsistencyRun {
 public:
  ConsistencyRun(unsigned seed, const RunOptions& options);

  StepResult step();
  const ekf::Filter& filter() const { return filter_; }

 private:
  /// A point that waits for parallax.
  struct Candidate {
    ekf::FirstSighting first;
    std::optional<ekf::CloneId> clone;
    int born = 0;  ///< step
  };
  using Sightings = std::vector<FeatureWorld::Seen>;

  void start();
  bool wearer_looks() const;
  void measure(const Sightings& seen, StepResult& result);
  std::vector<ekf::Measurement> measurements_of(const Sightings& seen) const;
  /// Spoils a share of the measurements; one entry a measurement, not zero: wrong.
  std::vector<char> spoil(std::vector<ekf::Measurement>& measurements);
  /// Those that pass, with their `is_wrong`.
  void validate(std::vector<ekf::Measurement>& measurements, std::vector<char>& is_wrong,
                MatchCounts& counts);
  void forget_unseen(const Sightings& seen);
  void start_from_wearer(const Sightings& seen);
  void start_delayed(const Sightings& seen);
  std::optional<ekf::LandmarkId> start_from(const Candidate& candidate, const Eigen::Vector2d& pixel);
  bool has_parallax(const Candidate& candidate, const Eigen::Vector2d& pixel) const;
  void find_candidates(const Sightings& seen);
  void drop_unused_clones();
  bool has_depth(const FeatureWorld::Seen& seen) const;
  void compare(StepResult& result) const;

  RunOptions options_;
  FeatureWorld world_;
  ekf::Filter filter_;
  ekf::StereoRig rig_;
  std::map<int, ekf::LandmarkId> map_;  ///< by point
  std::map<int, Candidate> candidates_;
  std::vector<ekf::CloneId> clones_;
  std::mt19937 spoiler_;  ///< of its own: the world is the same with and without wrong matches
  Validator validator_;
  int step_ = 0;
};

}  // namespace cosight::experiments
