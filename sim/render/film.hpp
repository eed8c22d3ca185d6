#pragma once

#include <cstdint>
#include <span>

#include "shared/image/gray_image.hpp"
#include "sim/render/camera.hpp"
#include "sim/render/exposure.hpp"
#include "sim/render/renderer.hpp"
#include "sim/sensors/inertial.hpp"

namespace cosight::sim {

/// How long light falls on the sensor, and how long it takes to read it.
struct ShutterPlan {
  double exposure_time = 0.0;  ///< 0: no motion blur [s]
  double readout_time = 0.0;   ///< from the first to the last row [s]; 0: all rows at once
  int blur_steps = 6;          ///< pictures averaged over the exposure time
};

/// Takes pictures with one camera; one a thread. The time of a picture is the middle of the exposure of its
/// middle row.
class Film {
 public:
  Film(const Camera& camera, const Exposure& exposure, const ShutterPlan& shutter);

  GrayImage take(std::span<const Quad> quads, const Motion& T_WC, double time, std::uint64_t frame);

 private:
  const Radiance& render_at(std::span<const Quad> quads, const Motion& T_WC, double time);

  const Exposure& exposure_;
  ShutterPlan shutter_;
  Renderer renderer_;
  Radiance blurred_;
};

}  // namespace cosight::sim
