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

  /// How to average over a footprint: as many taps along its long axis as its short axis calls for. Good for
  /// several neighbouring pixels.
  struct Filter {
    int level = 0;
    int taps = 1;
    float u_scale = 1.0F, v_scale = 1.0F;  ///< places in the level, in parts of a texel, per texel
    int u_first = 0, v_first = 0;          ///< from the place to the first tap
    int u_step = 0, v_step = 0;            ///< from tap to tap
    float weight = 1.0F;                   ///< of a tap
  };
  Filter filter_for(const Footprint& footprint) const;

  /// Brightness 0 … 255 at (u, v) [texels], (0, 0) the outer corner of the first texel.
  float sample(float u, float v, const Filter& filter) const;

  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }

 private:
  std::vector<GrayImage> levels_;
};

}  // namespace cosight::sim
