#pragma once

#include <memory>

#include "robot_agent/inbox/options.hpp"
#include "shared/dataset/sample.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::inbox {

struct DecodedFrame {
  std::shared_ptr<const GrayImage> image;  ///< null: not decodable, or of the wrong size
  bool wrong_size = false;
};

/// The pixels of a frame. Its size is read from its header and compared before anything is decoded.
DecodedFrame decode_frame(const ImageSample& frame, const ImageSize& expected);

}  // namespace cosight::inbox
