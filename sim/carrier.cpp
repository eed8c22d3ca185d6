#include "sim/carrier.hpp"

#include "shared/image/image_codec.hpp"

namespace cosight::sim {

Pose optical_mount(const Eigen::Vector3d& place, double yaw, double pitch) {
  Eigen::Matrix3d R_BC;
  R_BC.col(0) = -Eigen::Vector3d::UnitY();  // right
  R_BC.col(1) = -Eigen::Vector3d::UnitZ();  // down
  R_BC.col(2) = Eigen::Vector3d::UnitX();   // forward
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitY()));
  return {(turned * Eigen::Quaterniond(R_BC)).normalized(), place};
}

ImageSample Carrier::sample(Film& film, std::size_t frame) const {
  ImageSample sample{.stamp = ticks[frame].stamp,
                     .sequence = frame,
                     .encoding = ImageEncoding::kJpeg,
                     .width = plan.lens.width,
                     .height = plan.lens.height,
                     .bytes = {}};
  encode_jpeg(take(film, frame), plan.jpeg_quality, sample.bytes);
  return sample;
}

}  // namespace cosight::sim
