#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/world/scene.hpp"

namespace cosight::sim {

/// A quad that is only its picture (8 bit, one channel), which goes to the scene's textures; to be worn by
/// quads of any place and size.
Quad sheet_of(Scene& scene, const cv::Mat& picture, float shade = 1.0F);

/// `quad` in its place with the picture of `sheet` and its shade times `light`.
Quad wearing(Quad quad, const Quad& sheet, float light = 1.0F);

}  // namespace cosight::sim
