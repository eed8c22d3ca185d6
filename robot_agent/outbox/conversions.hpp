#pragma once

#include <span>

#include "robot_agent/frame_estimate.hpp"
#include "shared/transport/samples.hpp"

namespace cosight::outbox {

/// What slam says, as others read it. The velocity turns into the axes of S, its covariance with it.
OdometrySample odometry_of(const FrameEstimate& estimate);
OverlapSample overlap_of(const FrameEstimate& estimate);

/// The health of slam: innovation ratio, test ratio, uncertainty, resets.
DiagnosticSample diagnostic_of(const FrameEstimate& estimate);
PointCloudSample cloud_of(Stamp stamp, std::span<const MapPoint> points);

}  // namespace cosight::outbox
