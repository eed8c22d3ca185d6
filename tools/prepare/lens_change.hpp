#pragma once

#include "shared/geometry/camera_model.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight {

/// What a camera with the lens `to` would have seen from the same place and direction as the camera `from`
/// that took `image`: each pixel's ray is looked up in `image` with bilinear interpolation. A ray outside it
/// takes the nearest pixel of the edge, which shows no corner that is not there.
GrayImage with_other_lens(const GrayImage& image, const CameraModel& from, const CameraModel& to);

}  // namespace cosight
