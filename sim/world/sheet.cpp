#include "sim/world/sheet.hpp"

#include <utility>

namespace cosight::sim {

Quad sheet_of(Scene& scene, const cv::Mat& picture, float shade) {
  GrayImage image{picture.cols, picture.rows, {}};
  image.data.assign(picture.datastart, picture.dataend);
  Quad quad;
  quad.texture = scene.add_texture(std::move(image));
  quad.u1 = static_cast<float>(picture.cols);
  quad.v1 = static_cast<float>(picture.rows);
  quad.shade = shade;
  return quad;
}

Quad wearing(Quad quad, const Quad& sheet, float light) {
  quad.texture = sheet.texture;
  quad.u0 = sheet.u0;
  quad.v0 = sheet.v0;
  quad.u1 = sheet.u1;
  quad.v1 = sheet.v1;
  quad.shade = sheet.shade * light;
  return quad;
}

}  // namespace cosight::sim
