#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/random.hpp"

namespace cosight::sim {

/// Hangs posters, notice boards, doors, shelves, signs and sockets on a wall and gives it a skirting board:
/// what makes an indoor wall a place that a camera knows again. `picture`: the wall, its lower edge the
/// floor; `density` 0 … 1: how much of it is taken.
void decorate_wall(cv::Mat& picture, double texel, double density, RandomStream random);

/// A printed sheet in `place`: frame, picture or blocks, lines of text.
void draw_poster(cv::Mat& picture, const cv::Rect& place, RandomStream& random);

}  // namespace cosight::sim
