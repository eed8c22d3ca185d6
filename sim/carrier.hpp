#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "shared/dataset/sample.hpp"
#include "sim/render/camera.hpp"
#include "sim/render/exposure.hpp"
#include "sim/render/film.hpp"
#include "sim/sensors/sensor_clock.hpp"

namespace cosight::sim {

/// A camera and how it is carried.
struct CameraPlan {
  CameraModel lens;
  Pose T_BC;  ///< in the body that carries it (robot B, head H), optical frame
  TimingPlan timing{.rate = 10.0};
  ShutterPlan shutter;
  int jpeg_quality = 90;
  ExposurePlan exposure;
};

/// The pose of an optical frame (x right, y down, z forward) in a body (x forward, y left, z up): at `place`,
/// turned to the left by `yaw` and up by `pitch` [rad].
Pose optical_mount(const Eigen::Vector3d& place, double yaw, double pitch);

/// A camera on its way: what it sees, and when.
struct Carrier {
  const CameraPlan& plan;
  Camera camera;
  Exposure exposure;
  Motion T_WC;
  std::function<std::vector<Quad>(double time)> quads_at;
  std::vector<Tick> ticks;  ///< of its frames

  Film film() const { return {camera, exposure, plan.shutter}; }  ///< one a thread
  GrayImage take(Film& film, std::size_t frame) const {
    return film.take(quads_at(ticks[frame].time), T_WC, ticks[frame].time, frame);
  }
  /// Encoded, and with its stamp and number.
  ImageSample sample(Film& film, std::size_t frame) const;
};

}  // namespace cosight::sim
