#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <optional>

#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/wearer/wearer_tracker.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::robot {

/// The wearer's tracker for samples that come from several threads: each scan is used once the odometry has
/// come as far, so that both lasers and the wheels are used in the order of their stamps.
class WearerLocator {
 public:
  /// What a scan said: T_SF at its stamp, or nothing while the wearer is not known. Called by whoever adds a
  /// sample, one call at a time; it must not call back.
  using Found = std::function<void(Stamp, const std::optional<WearerPoseSample>&)>;

  /// `yaw_WA`: from the AHRS's north to the map's x axis, as far as it is known at the start.
  WearerLocator(const wearer::WearerOptions& options, const wearer::UncertainAngle& yaw_WA, Found found);

  void add(const WheelOdometrySample& sample);
  void add(const AhrsSample& sample);
  void add(LaserScanSample scan);

  /// Where slam sees the robot. Joins the AHRS's world with the lasers'.
  void add(const FrameEstimate& estimate);

  /// No more samples will come: uses the scans that still wait.
  void finish();

  wearer::WearerCounters counters() const;

 private:
  void use_ready_scans();
  bool is_ready(const LaserScanSample& scan) const;
  void use_first();

  mutable std::mutex mutex_;
  wearer::WearerTracker tracker_;
  wearer::UncertainAngle yaw_WA_;  ///< as configured; slam may know better
  Found found_;
  std::deque<LaserScanSample> waiting_;  ///< by stamp
  std::optional<Stamp> odometry_stamp_;
  Stamp newest_scan_ = 0;
};

}  // namespace cosight::robot
