#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/random.hpp"

namespace cosight::sim {

/// The side of a house towards the street: floors with windows above shops. Its lower edge is the ground.
struct HouseFront {
  cv::Mat picture;                ///< as by day (8 bit, one channel)
  std::vector<cv::Rect> windows;  ///< where light may be on inside
};

/// `width` x `height` [m] at `texel` [m] a texel.
HouseFront paint_house_front(double width, double height, double texel, RandomStream random);

/// Light in some of the windows, regardless of the light outside: after that has been put into the picture.
void light_windows(HouseFront& front, double share, RandomStream random);

}  // namespace cosight::sim
