#pragma once

#include <cstdint>
#include <vector>

#include "shared/dataset/known_point.hpp"
#include "shared/dataset/sample.hpp"
#include "sim/carrier.hpp"
#include "sim/render/view_overlap.hpp"
#include "sim/scenario.hpp"
#include "sim/world_model.hpp"

namespace cosight::sim {

/// A scenario come to life with one seed: everything that its sensors say, computed when it is asked for.
/// Const functions may be called from several threads.
class SimulatedRun {
 public:
  /// `scenario` has to outlive this. Throws std::invalid_argument for one that cannot be built.
  SimulatedRun(const Scenario& scenario, std::uint64_t seed);
  SimulatedRun(const SimulatedRun&) = delete;
  SimulatedRun& operator=(const SimulatedRun&) = delete;

  const Scenario& scenario() const { return scenario_; }
  const World& world() const { return world_; }
  const Carrier& robot() const { return robot_; }
  const Carrier& wearer() const { return wearer_; }

  std::vector<WearerPoseSample> tracked_poses() const;  ///< one a frame of Cs
  std::vector<AhrsSample> ahrs() const;
  std::vector<LaserScan> front_scans() const;
  std::vector<LaserScan> rear_scans() const;
  std::vector<BiasedImuSample> imu() const;
  std::vector<WheelOdometrySample> odometry() const;

  std::vector<OverlapTruth> overlap() const;  ///< one a frame of Cs
  /// Share of the frames in which Cf sees a useful part of what Cs sees.
  double overlap_ratio() const;

  /// Surveyed points of the first frame of Cs; none when the scenario wants none.
  std::vector<KnownPoint> known_points() const;

  Motion T_WB() const;
  Motion T_WH() const;

 private:
  Carrier carrier(const CameraPlan& plan, const char* agent) const;
  void fit_gaze();

  const Scenario& scenario_;
  std::uint64_t seed_;
  World world_;
  Carrier robot_, wearer_;
};

}  // namespace cosight::sim
