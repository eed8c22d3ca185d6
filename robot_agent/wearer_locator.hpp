#pragma once

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/wearer/wearer_tracker.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::robot {

/// The wearer's tracker for samples that come from several threads. What a scan says depends on stamps alone,
/// as long as nothing is later than it is waited for: a scan is used once the odometry, the AHRS and the
/// other lasers have come as far, and what slam made of a frame is used for scans from a fixed time after
/// that frame on.
class WearerLocator {
 public:
  /// What the scans of one stamp said: T_SF at that stamp, or nothing while the wearer is not known. Called
  /// by whoever adds a sample, one call at a time; it must not call back.
  using Found = std::function<void(Stamp, const std::optional<WearerPoseSample>&)>;

  /// `yaw_WA`: from the AHRS's north to the map's x axis, as far as it is known at the start.
  WearerLocator(const wearer::WearerOptions& options, const wearer::UncertainAngle& yaw_WA, Found found);

  void add(const WheelOdometrySample& sample);
  void add(const AhrsSample& sample);
  void add(LaserScanSample scan);

  /// Where slam sees the robot. Joins the AHRS's world with the lasers', for scans that are at least
  /// `kEstimateDelay` newer.
  void add(const FrameEstimate& estimate);
  static constexpr Stamp kEstimateDelay = kNanosecondsPerSecond / 5;

  /// No more samples will come: uses the scans that still wait.
  void finish();

  wearer::WearerCounters counters() const;
  /// Estimates that came after a scan that should have been used with them.
  std::uint64_t estimates_late() const;

 private:
  /// What an estimate says of the robot's heading and of the AHRS's.
  struct Heading {
    Stamp stamp = 0;
    Eigen::Quaterniond q_WS = Eigen::Quaterniond::Identity();
    double yaw_sigma = 0.0;         ///< of q_WS [rad]
    wearer::UncertainAngle yaw_WA;  ///< sigma 0: not known
  };

  void use_ready_scans();
  bool is_ready(const LaserScanSample& scan) const;
  void use_first_stamp();
  void use(const Heading& heading);

  mutable std::mutex mutex_;
  wearer::WearerTracker tracker_;
  wearer::UncertainAngle yaw_WA_;  ///< as configured; slam may know better
  Found found_;
  std::deque<LaserScanSample> waiting_;  ///< by stamp, of one stamp by laser
  std::deque<Heading> headings_;         ///< by stamp, not yet due
  std::optional<Stamp> odometry_stamp_;
  std::optional<Stamp> ahrs_stamp_;
  std::optional<Stamp> used_scan_;
  std::map<std::string, Stamp> laser_stamps_;  ///< the newest of each
  Stamp newest_scan_ = 0;
  std::uint64_t estimates_late_ = 0;
};

}  // namespace cosight::robot
