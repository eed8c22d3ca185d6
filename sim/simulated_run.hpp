#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "shared/dataset/known_point.hpp"
#include "shared/dataset/sample.hpp"
#include "sim/render/camera.hpp"
#include "sim/render/exposure.hpp"
#include "sim/render/film.hpp"
#include "sim/render/view_overlap.hpp"
#include "sim/scenario.hpp"
#include "sim/sensors/sensor_clock.hpp"
#include "sim/world_model.hpp"

namespace cosight::sim {

/// One of the two cameras on its way: what it sees, and when.
struct Carrier {
  const CameraPlan& plan;
  Camera camera;
  Exposure exposure;
  Motion T_WC;
  std::function<std::vector<Quad>(double time)> quads_at;
  std::vector<Tick> ticks;  ///< of its frames

  Film film() const { return {camera, exposure, plan.shutter}; }  ///< one a thread
  GrayImage take(Film& film, std::size_t frame) const {
    return film.take(quads_at(ticks[frame].time), T_WC, ticks[frame].time, frame);
  }
  /// Encoded, and with its stamp and number.
  ImageSample sample(Film& film, std::size_t frame) const;
};

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
