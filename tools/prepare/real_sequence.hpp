#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shared/dataset/known_point.hpp"
#include "shared/dataset/stamp.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight {

/// One image of a recorded sequence.
struct RecordedImage {
  Stamp stamp = 0;
  std::filesystem::path file;  ///< absolute
  std::optional<Pose> T_WC;    ///< true pose of the camera in W (z up), where the sequence has one
};

/// A recorded sequence seen as Cosight's two agents would; the wearer may be absent.
struct RealSequence {
  CameraModel robot_camera;
  std::vector<RecordedImage> robot_images;
  CameraModel wearer_camera;
  std::vector<RecordedImage> wearer_images;  ///< stamps are stamps of robot images
  std::vector<KnownPoint> known_points;      ///< in W
  std::vector<std::string> notes;            ///< what was made of the data, for the person who prepares it
};

/// A camera in the usual body frame, looking ahead: R_BC for B with x forward, y left, z up (REP-103).
Eigen::Quaterniond forward_looking_camera();

/// Each reads one folder of real data; all throw a typed error that names file and line.
RealSequence read_kitti(const std::filesystem::path& folder);
RealSequence read_tagbox(const std::filesystem::path& folder);
RealSequence read_scenelib(const std::filesystem::path& folder);
RealSequence read_tello(const std::filesystem::path& folder);

/// EuRoC's flight as the robot's, and other views of the same room as the wearer's. A view of another camera
/// than cam0 is rendered anew with cam0's lens into `rendered_images`, because a worn camera has one
/// calibration.
RealSequence read_euroc(const std::filesystem::path& flight, const std::filesystem::path& views,
                        const std::filesystem::path& rendered_images);

}  // namespace cosight
