#pragma once

#include <vector>

#include "shared/image/gray_image.hpp"

namespace cosight::sim {

/// How far the texture moves [texels] under one pixel's step to the right and one down.
struct Footprint {
  float du_dx = 1.0F, dv_dx = 0.0F;
  float du_dy = 0.0F, dv_dy = 1.0F;
};

/// A gray picture with its pyramid of halved copies, so that a far or slanted surface is averaged, not
/// sampled: without it a texture flickers, and flicker looks like motion to a feature tracker.
class Texture {
 public:
  explicit Texture(GrayImage picture);

  /// Brightness 0 … 255 at (u, v) [texels], (0, 0) the outer corner of the first texel, averaged over the
  /// footprint: as many taps along its long axis (up to 8) as its short axis calls for.
  float sample(float u, float v, const Footprint& footprint) const;

  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }

 private:
  std::vector<GrayImage> levels_;
};

}  // namespace cosight::sim
