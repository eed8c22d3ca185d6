#pragma once

#include <filesystem>
#include <memory>

#include "shared/dataset/laser_mounting.hpp"
#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// `stamp_ns` and then as many ranges [m] as the laser has points, in the order of its angles; `inf` or `nan`
/// where nothing came back. Throws DatasetError.
std::unique_ptr<SampleSource> open_laser_csv(const std::filesystem::path& csv, const LaserMounting& laser);

/// `stamp_ns,wx,wy,wz,ax,ay,az`: rates [rad/s] and specific force [m/s^2] in I. Throws DatasetError.
std::unique_ptr<SampleSource> open_imu_csv(const std::filesystem::path& csv);

/// `stamp_ns,x_m,y_m,yaw_rad,speed_mps,turn_rate_radps`. Throws DatasetError.
std::unique_ptr<SampleSource> open_odometry_csv(const std::filesystem::path& csv);

}  // namespace cosight
