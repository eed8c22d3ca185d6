#pragma once

#include <filesystem>

#include "shared/recording/mcap_reader.hpp"

namespace cosight {

/// What was written.
struct Exported {
  std::uint64_t images = 0;
  std::uint64_t rows = 0;      ///< of csv and trajectory files
  std::uint64_t unusable = 0;  ///< messages that are not what their topic says
};

/// EuRoC's folders below `folder`/robot and `folder`/wearer: mav0/cam0 (data, data.csv, sensor.yaml) and
/// mav0/imu0/data.csv. Raw frames become PNG, compressed ones stay as they are. All throw RecordingError.
Exported export_euroc(const recording::McapReader& reader, const std::filesystem::path& folder);

/// robot.tum (T_WS, of the robot agent's odometry) and wearer.tum (T_SF).
Exported export_tum(const recording::McapReader& reader, const std::filesystem::path& folder);

/// The frames alone, `folder`/robot/STAMP.jpg.
Exported export_images(const recording::McapReader& reader, const std::filesystem::path& folder);

}  // namespace cosight
