#pragma once

#include "shared/config/config.hpp"
#include "sim/carrier.hpp"
#include "sim/sensors/imu.hpp"

namespace cosight::sim {

/// Sections that several kinds of scenes have. What the section leaves out stays as it is given. All throw
/// ConfigError.
TimingPlan read_timing(const ConfigNode& node, TimingPlan timing);
/// `otherwise_at`: where the camera sits in its body when the section does not say [m].
CameraPlan read_camera(const ConfigNode& node, CameraPlan camera, const Eigen::Vector3d& otherwise_at);
ImuPlan read_imu(const ConfigNode& node);

}  // namespace cosight::sim
