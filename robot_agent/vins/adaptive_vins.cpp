#include "robot_agent/vins/adaptive_vins.hpp"

#include <utility>

namespace cosight::vins {

const char* to_string(VinsStatus status) {
  switch (status) {
    case VinsStatus::kWaitingForImu:
      return "waiting for IMU";
    case VinsStatus::kInitialising:
      return "initialising";
    case VinsStatus::kTracking:
      return "tracking";
    case VinsStatus::kFailed:
      break;
  }
  return "failed";
}

VinsEstimate AdaptiveVins::process(const FeatureFrame& frame) {
  const bool first = !tracking_ && waiting_.empty();
  const Stamp from = first ? frame.stamp : last_frame_;
  if (!imu_.covers(from, frame.stamp) || (!first && frame.stamp <= from)) {
    return {.stamp = frame.stamp, .status = VinsStatus::kWaitingForImu, .restarts = restarts_};
  }
  VinsEstimate estimate = tracking_ ? track(frame) : initialise_with(frame);
  estimate.stamp = frame.stamp;
  estimate.restarts = restarts_;
  imu_.drop_before(last_frame_);
  return estimate;
}

VinsEstimate AdaptiveVins::initialise_with(const FeatureFrame& frame) {
  // Frames on both sides of a gap are not connected: those before it are worth nothing any more.
  if (!waiting_.empty() && imu_.longest_gap(last_frame_, frame.stamp) > options_.failure.max_imu_gap) {
    waiting_.clear();
    rest_.reset();
    last_outcome_ = InitialisationOutcome::kTooFewFrames;
  }
  VinsEstimate estimate{.status = VinsStatus::kInitialising, .initialisation = last_outcome_};
  UnplacedFrame next{frame, std::nullopt};
  if (!waiting_.empty()) {
    // A frame too soon after the last one is left out; the IMU samples stay for the next.
    if (to_seconds(frame.stamp - last_frame_) < 0.99 * options_.initialisation_interval) return estimate;
    next.imu.emplace(imu_.between(last_frame_, frame.stamp), ImuBias(), options_.noise);
  }
  last_frame_ = frame.stamp;
  waiting_.push_back(std::move(next));
  hold_enough_frames();
  const bool from_rest = rest_ && rest_->stamp == waiting_.front().features.stamp;
  Initialisation started = initialise({waiting_.begin(), waiting_.end()}, T_BS_, options_.initialisation,
                                      options_.window, from_rest ? rest_ : std::nullopt);
  estimate.initialisation = last_outcome_ = started.outcome;
  if (started.window) {
    odometry_.start(std::move(*started.window), from_rest);
    tracking_ = true;
    last_seeing_ = frame.stamp;
    waiting_.clear();
    rest_.reset();
    estimate.status = VinsStatus::kTracking;
    estimate.report = odometry_.report_of_start();
  }
  return estimate;
}

/// The newest frames; and, some seconds back, the last one at rest.
void AdaptiveVins::hold_enough_frames() {
  const InitialisationOptions& options = options_.initialisation;
  if (rest_ && to_seconds(last_frame_ - rest_->stamp) > options.rest.max_age) rest_.reset();
  if (waiting_.size() > options.frames) {
    const bool keeps_first = rest_ && rest_->stamp == waiting_.front().features.stamp;
    if (keeps_first) {
      waiting_[1].imu->append(*waiting_[2].imu);
      waiting_[2].imu = std::move(waiting_[1].imu);
      waiting_.erase(waiting_.begin() + 1);
    } else {
      waiting_.pop_front();
      waiting_.front().imu.reset();
    }
  }
  if (waiting_.size() < options.frames) return;
  if (const auto rest = find_rest(waiting_, options.rest)) rest_ = rest;
}

VinsEstimate AdaptiveVins::track(const FeatureFrame& frame) {
  VinsEstimate estimate{.status = VinsStatus::kTracking, .initialisation = InitialisationOutcome::kReady};
  if (imu_.longest_gap(last_frame_, frame.stamp) > options_.failure.max_imu_gap) {
    last_frame_ = frame.stamp;
    fail(Failure::kImuGap, estimate);
    return estimate;
  }
  estimate.report = odometry_.process(frame, imu_.between(last_frame_, frame.stamp));
  last_frame_ = frame.stamp;
  Failure failure = detect_failure(*estimate.report, options_.failure);
  if (failure != Failure::kLostTracks) {
    last_seeing_ = frame.stamp;
  } else if (to_seconds(frame.stamp - last_seeing_) < options_.failure.max_blind) {
    failure = Failure::kNone;
  }
  if (failure != Failure::kNone) fail(failure, estimate);
  return estimate;
}

void AdaptiveVins::fail(Failure failure, VinsEstimate& estimate) {
  estimate.failure = failure;
  estimate.status = VinsStatus::kFailed;
  tracking_ = false;
  last_outcome_ = InitialisationOutcome::kTooFewFrames;
  ++restarts_;
}

}  // namespace cosight::vins
