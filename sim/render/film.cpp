#include "sim/render/film.hpp"

namespace cosight::sim {

Film::Film(const Camera& camera, const Exposure& exposure, const ShutterPlan& shutter)
    : exposure_(exposure), shutter_(shutter), renderer_(camera) {}

const Radiance& Film::render_at(std::span<const Quad> quads, const Motion& T_WC, double time) {
  if (shutter_.readout_time <= 0.0) return renderer_.render(quads, T_WC(time));
  const double rows = renderer_.camera().calibration().height - 1;
  return renderer_.render(quads,
                          [&](int row) { return T_WC(time + shutter_.readout_time * (row / rows - 0.5)); });
}

GrayImage Film::take(std::span<const Quad> quads, const Motion& T_WC, double time, std::uint64_t frame) {
  if (shutter_.exposure_time <= 0.0) return exposure_.expose(render_at(quads, T_WC, time), frame);
  const double steps = shutter_.blur_steps;
  for (int k = 0; k < shutter_.blur_steps; ++k) {
    const double offset = shutter_.exposure_time * ((k + 0.5) / steps - 0.5);
    const Radiance& light = render_at(quads, T_WC, time + offset);
    if (k == 0) {
      blurred_ = light;
      continue;
    }
    for (std::size_t i = 0; i < light.brightness.size(); ++i)
      blurred_.brightness[i] += light.brightness[i];
  }
  for (float& brightness : blurred_.brightness)
    brightness /= static_cast<float>(shutter_.blur_steps);
  return exposure_.expose(blurred_, frame);
}

}  // namespace cosight::sim
