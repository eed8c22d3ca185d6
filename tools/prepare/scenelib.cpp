#include "shared/config/calibration.hpp"
#include "shared/config/config.hpp"
#include "tools/prepare/image_list.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight {
namespace {

constexpr Stamp kFirstStamp = 1000 * kNanosecondsPerSecond;

/// SceneLib's axes are x left, y up, z ahead; W has x ahead, y left, z up.
Eigen::Vector3d to_W(const Eigen::Vector3d& p_scenelib) {
  return {p_scenelib.z(), p_scenelib.x(), p_scenelib.y()};
}

}  // namespace

RealSequence read_scenelib(const std::filesystem::path& folder) {
  RealSequence sequence;
  sequence.robot_camera = load_camera_model(folder / "calib.yaml", "cam0");
  const ConfigFile calibration = ConfigFile::load(folder / "calib.yaml");
  const double rate_hz = calibration.root().section("cam0").number("rate_hz", 30.0, 1.0, 1000.0);
  // The start pose that comes with the sequence: unturned, 60 cm before the target.
  const Pose T_WS{forward_looking_camera(), to_W({0.0, 0.0, -0.60})};
  const Eigen::MatrixXd corners =
      calibration.root().matrix("known_target_corners_m", Eigen::MatrixXd::Zero(4, 3));
  for (int i = 0; i < corners.rows(); ++i) {
    const Eigen::Vector3d p_W = to_W(corners.row(i).transpose());
    sequence.known_points.push_back({p_W, sequence.robot_camera.project(T_WS.inverse() * p_W)});
  }
  const auto images = images_in(folder / "cam0");
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Stamp stamp = kFirstStamp + from_seconds(static_cast<double>(i) / rate_hz);
    sequence.robot_images.push_back({stamp, images[i], std::nullopt});
  }
  sequence.notes.emplace_back(
      "no truth; the target's pixels are projected from the given start pose, good to 3 px");
  return sequence;
}

}  // namespace cosight
