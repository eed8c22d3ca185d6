#include "shared/config/calibration.hpp"
#include "shared/config/config.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "tools/prepare/image_list.hpp"
#include "tools/prepare/prepare_error.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight {
namespace {

/// The sequence's clock starts at zero, which many tools read as "no stamp".
constexpr Stamp kFirstStamp = 1000 * kNanosecondsPerSecond;

void require_one_pose_each(const std::filesystem::path& folder, std::size_t images, std::size_t poses) {
  if (images == poses) return;
  throw PrepareError(folder.string() + ": holds " + std::to_string(images) + " images for " +
                     std::to_string(poses) + " poses; the data is incomplete");
}

}  // namespace

RealSequence read_kitti(const std::filesystem::path& folder) {
  RealSequence sequence;
  sequence.robot_camera = load_camera_model(folder / "calib.yaml", "left");
  sequence.wearer_camera = load_camera_model(folder / "calib.yaml", "right");
  const double baseline =
      ConfigFile::load(folder / "calib.yaml").root().number("baseline_m", 0.5371657, 0.01, 10.0);
  // KITTI's world is the first camera's optical frame. W has z up, and that camera looks along x.
  const Pose T_WK{forward_looking_camera(), Eigen::Vector3d::Zero()};
  const Pose T_SF{Eigen::Quaterniond::Identity(), {baseline, 0.0, 0.0}};
  const Trajectory truth = read_trajectory(folder / "gt_cam0_kitti.txt", folder / "times.txt");
  const auto left = images_in(folder / "left");
  const auto right = images_in(folder / "right");
  require_one_pose_each(folder / "left", left.size(), truth.size());
  require_one_pose_each(folder / "right", right.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose T_WS = T_WK * truth[i].T_WC;
    const Stamp stamp = truth[i].stamp + kFirstStamp;
    sequence.robot_images.push_back({stamp, left[i], T_WS});
    sequence.wearer_images.push_back({stamp, right[i], T_WS * T_SF});
  }
  return sequence;
}

}  // namespace cosight
