#include "sim/world/house_front.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/world/decorations.hpp"
#include "sim/world/materials.hpp"

namespace cosight::sim {
namespace {

constexpr double kShopHeight = 4.2;  // [m]

/// Draws on one front; lengths in metres, from the left and from the ground.
class Draughtsman {
 public:
  Draughtsman(double width, double height, double texel, RandomStream random)
      : width_(width), height_(height), texel_(texel), random_(random) {
    constexpr std::array kWalls{Material::kConcrete, Material::kPlaster, Material::kBrick};
    const Material wall = kWalls.at(static_cast<std::size_t>(random_.below(kWalls.size())));
    front_.picture = paint_material(wall, width, height, texel, random_);
    front_.picture *= random_.uniform(0.75, 1.25);
  }

  HouseFront draw() {
    draw_shops();
    draw_floors();
    const int signs = random_.below(3);
    for (int k = 0; k < signs; ++k)
      hang_sign();
    return std::move(front_);
  }

 private:
  cv::Rect rect(double x, double bottom, double width, double height) const {
    const auto texels = [this](double metres) { return static_cast<int>(std::lround(metres / texel_)); };
    const cv::Rect wanted(texels(x), front_.picture.rows - texels(bottom + height), texels(width),
                          texels(height));
    return wanted & cv::Rect({}, front_.picture.size());
  }
  void fill(const cv::Rect& place, double gray) {
    if (place.area() > 0) front_.picture(place).setTo(gray);
  }

  void draw_shops() {
    for (double x = random_.uniform(0.3, 0.8); x < width_ - 2.5;) {
      const double shop = std::min(random_.uniform(3.0, 6.0), width_ - 0.3 - x);
      const cv::Rect glass = rect(x, 0.4, shop - 0.5, 2.3);
      fill(glass, random_.uniform(25.0, 70.0));
      front_.windows.push_back(glass);
      if (random_.chance(0.7)) draw_poster(front_.picture, rect(x + 0.3, 0.7, 0.4 * shop, 1.6), random_);
      fill(rect(x + shop - 1.5, 0.0, 0.9, 2.2), random_.uniform(20.0, 200.0));  // the door
      draw_poster(front_.picture, rect(x, 2.8, shop - 0.4, 0.9), random_);
      x += shop;
    }
  }

  void draw_floors() {
    const double storey = random_.uniform(3.0, 3.6);
    const int bays = std::max(2, static_cast<int>(width_ / random_.uniform(2.3, 3.6)));
    const double bay = width_ / bays;
    const double window_width = bay * random_.uniform(0.45, 0.75);
    const double window_height = storey * random_.uniform(0.4, 0.65);
    const double frame = random_.uniform(40.0, 230.0);
    const bool has_ledges = random_.chance(0.5);
    for (double floor = kShopHeight; floor < height_ - 0.8 * storey; floor += storey) {
      if (has_ledges) fill(rect(0.0, floor, width_, 0.2), frame);
      for (int k = 0; k < bays; ++k)
        draw_window((k + 0.5) * bay - 0.5 * window_width, floor + 0.9, window_width, window_height, frame);
    }
  }

  void draw_window(double x, double bottom, double width, double height, double frame) {
    fill(rect(x - 0.1, bottom - 0.1, width + 0.2, height + 0.2), frame);
    const cv::Rect glass = rect(x, bottom, width, height);
    fill(glass, random_.uniform(20.0, 75.0));
    front_.windows.push_back(glass);
    if (random_.chance(0.35)) {  // a curtain
      fill(rect(x, bottom, width * random_.uniform(0.2, 0.6), height), random_.uniform(90.0, 200.0));
    }
    if (random_.chance(0.5)) fill(rect(x + 0.5 * width - 0.04, bottom, 0.08, height), frame);
    if (random_.chance(0.25)) {  // an air conditioner under it
      const double left = x + random_.uniform(0.0, 0.5 * width);
      fill(rect(left, bottom - 0.75, 0.7, 0.5), random_.uniform(150.0, 225.0));
      fill(rect(left + 0.15, bottom - 0.65, 0.3, 0.3), random_.uniform(30.0, 90.0));
    }
  }

  void hang_sign() {
    const double height = random_.uniform(1.5, 4.0);
    const double bottom = random_.uniform(kShopHeight, std::max(kShopHeight + 0.1, height_ - height - 2.0));
    draw_poster(front_.picture,
                rect(random_.uniform(0.0, width_ - 2.0), bottom, random_.uniform(0.8, 2.0), height), random_);
  }

  double width_, height_, texel_;
  RandomStream random_;
  HouseFront front_;
};

}  // namespace

HouseFront paint_house_front(double width, double height, double texel, RandomStream random) {
  return Draughtsman(width, height, texel, random).draw();
}

void light_windows(HouseFront& front, double share, RandomStream random) {
  for (const cv::Rect& window : front.windows) {
    if (window.area() == 0 || !random.chance(share)) continue;
    front.picture(window) += random.uniform(70.0, 170.0);
  }
}

}  // namespace cosight::sim
