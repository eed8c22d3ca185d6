#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>

#include "robot_agent/frame_estimate.hpp"

namespace cosight::map {

/// A map file could not be written; the message names the file and the reason.
class MapFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Binary files with the fields x y z [m in W], intensity, sigma [m, worst axis], id, observations. A file of
/// that name is replaced only by a complete one. Throw `MapFileError`.
void write_ply(const std::filesystem::path& path, std::span<const MapPoint> points);
void write_pcd(const std::filesystem::path& path, std::span<const MapPoint> points);

}  // namespace cosight::map
