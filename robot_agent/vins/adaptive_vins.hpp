#pragma once

#include <deque>
#include <optional>

#include "robot_agent/vins/failure.hpp"
#include "robot_agent/vins/initialisation.hpp"
#include "robot_agent/vins/window_odometry.hpp"

namespace cosight::vins {

struct VinsOptions {
  WindowOptions window;
  ImuNoise noise;
  InitialisationOptions initialisation;
  FailureOptions failure;
  double initialisation_interval = 0.1;  ///< [s] between the frames that initialisation takes
};

enum class VinsStatus {
  kWaitingForImu,  ///< the IMU's samples do not reach around this frame: it was left out
  kInitialising,   ///< see `initialisation`
  kTracking,
  kFailed,  ///< see `failure`; initialisation begins anew with the next frame
};
const char* to_string(VinsStatus status);

struct VinsEstimate {
  Stamp stamp = 0;
  VinsStatus status = VinsStatus::kInitialising;
  InitialisationOutcome initialisation = InitialisationOutcome::kTooFewFrames;
  Failure failure = Failure::kNone;
  std::optional<WindowReport> report = std::nullopt;  ///< of tracking
  int restarts = 0;                                   ///< failures so far
};

/// Monocular visual-inertial odometry from a cold start: initialises by itself, tracks, notices when it has
/// failed, and initialises again (W then starts anew). A gap in the IMU's samples is a failure as well. A
/// pure function of its samples and frames.
class AdaptiveVins {
 public:
  AdaptiveVins(const VinsOptions& options, const Pose& T_BS)
      : options_(options), T_BS_(T_BS), odometry_(options.window, options.noise, T_BS) {}

  /// False when the sample was refused: not newer than the last, or not finite.
  bool add_imu(const ImuSample& sample) { return imu_.push(sample); }

  /// The next frame; give first the IMU samples up to and just after its stamp.
  VinsEstimate process(const FeatureFrame& frame);

  const WindowOdometry& odometry() const { return odometry_; }

 private:
  VinsEstimate initialise_with(const FeatureFrame& frame);
  void hold_enough_frames();
  VinsEstimate track(const FeatureFrame& frame);
  void fail(Failure failure, VinsEstimate& estimate);

  VinsOptions options_;
  Pose T_BS_;
  ImuBuffer imu_;
  WindowOdometry odometry_;
  bool tracking_ = false;
  std::deque<UnplacedFrame> waiting_;
  std::optional<Rest> rest_;  ///< the last one, while its frame is in waiting_
  InitialisationOutcome last_outcome_ = InitialisationOutcome::kTooFewFrames;  ///< why it is not tracking yet
  Stamp last_frame_ = 0;
  Stamp last_seeing_ = 0;  ///< the last frame with tracks enough
  int restarts_ = 0;
};

}  // namespace cosight::vins
