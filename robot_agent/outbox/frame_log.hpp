#pragma once

#include <string>

#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"

namespace cosight::outbox {

/// frames.csv: one row a robot frame, units in the column names, empty where there is nothing to say.
std::string frame_log_header();
std::string frame_log_row(const FrameBundle& bundle, const FrameEstimate& estimate);

/// One line of a trajectory: `t px py pz qx qy qz qw` of T_WS, t in seconds to the nanosecond.
std::string trajectory_line(Stamp stamp, const Pose& T_WS);

/// Wall time of the frame, decoding included [ms]. Slam may have counted the decoding in already.
double frame_ms(const FrameBundle& bundle, const FrameEstimate& estimate);

/// Standard deviation of the position, all axes together: sqrt(trace) [m]; of the orientation likewise [rad].
double position_sigma(const UncertainPose& pose);
double orientation_sigma(const UncertainPose& pose);

}  // namespace cosight::outbox
