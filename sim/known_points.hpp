#pragma once

#include <vector>

#include "shared/image/gray_image.hpp"
#include "sim/dataset_writer.hpp"
#include "sim/render/camera.hpp"

namespace cosight::sim {

/// Surveys up to `count` corners of the building that the first picture shows: found in the picture, spread
/// over it, and measured along their rays. Not on the border of two surfaces.
std::vector<KnownPoint> survey(const GrayImage& picture, const Camera& camera, const Pose& T_WC,
                               std::span<const Quad> quads, std::size_t building_quads, int count);

}  // namespace cosight::sim
