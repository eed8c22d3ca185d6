#include "sim/world/materials.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace cosight::sim {
namespace {

cv::RNG opencv_random(RandomStream& random) {
  return cv::RNG(random.bits() | 1U);
}

int texels(double metres, double texel) {
  return std::max(1, static_cast<int>(std::lround(metres / texel)));
}

/// Gray base plus the noise, `contrast` in gray levels.
cv::Mat mottled(const cv::Size& size, double gray, double contrast, double coarsest, RandomStream& random) {
  return multi_scale_noise(size, coarsest, random) * contrast + gray;
}

void add_stains(cv::Mat& picture, double texel, RandomStream& random) {
  const double area = texel * texel * picture.rows * picture.cols;  // [m^2]
  for (int k = 0; k < static_cast<int>(area * 14.0); ++k) {
    const cv::Point centre(random.below(picture.cols), random.below(picture.rows));
    const cv::Size axes(texels(random.uniform(0.004, 0.03), texel),
                        texels(random.uniform(0.004, 0.02), texel));
    const double gray = picture.at<float>(centre) + random.uniform(-45.0, 25.0);
    cv::ellipse(picture, centre, axes, random.uniform(0.0, 180.0), 0, 360, gray, cv::FILLED, cv::LINE_8);
  }
  for (int k = 0; k < static_cast<int>(area * 3.0); ++k) {
    const cv::Point start(random.below(picture.cols), random.below(picture.rows));
    const cv::Point end(start.x + texels(random.uniform(0.02, 0.25), texel) * (random.chance(0.5) ? 1 : -1),
                        start.y + texels(random.uniform(0.02, 0.12), texel));
    cv::line(picture, start, end, picture.at<float>(start) + random.uniform(-40.0, 30.0), 1);
  }
}

cv::Mat paint_plaster(const cv::Size& size, double texel, RandomStream& random) {
  cv::Mat picture = mottled(size, random.uniform(135.0, 175.0), 9.0, 0.8 / texel, random);
  add_stains(picture, texel, random);
  return picture;
}

cv::Mat paint_concrete(const cv::Size& size, double texel, RandomStream& random) {
  cv::Mat picture = mottled(size, random.uniform(105.0, 140.0), 24.0, 0.6 / texel, random);
  add_stains(picture, texel, random);
  return picture;
}

/// Rows of blocks with joints between them; `jitter` is how much the blocks differ [gray levels].
void draw_blocks(cv::Mat& picture, const cv::Size& block, int joint, bool shifted, double jitter,
                 RandomStream& random) {
  for (int row = 0; row * block.height < picture.rows; ++row) {
    const int shift = shifted && row % 2 == 1 ? -block.width / 2 : 0;
    for (int x = shift; x < picture.cols; x += block.width) {
      const cv::Rect outer(x, row * block.height, block.width, block.height);
      const cv::Rect inner =
          cv::Rect(outer.x + joint, outer.y + joint, outer.width - joint, outer.height - joint) &
          cv::Rect({}, picture.size());
      if (inner.area() > 0) picture(inner) += random.uniform(-jitter, jitter) + 28.0;
    }
  }
}

cv::Mat paint_brick(const cv::Size& size, double texel, RandomStream& random) {
  cv::Mat picture = mottled(size, 95.0, 10.0, 0.1 / texel, random);
  draw_blocks(picture, {texels(0.25, texel), texels(0.083, texel)}, texels(0.012, texel), true, 26.0, random);
  return picture;
}

cv::Mat paint_tiles(const cv::Size& size, double texel, RandomStream& random) {
  cv::Mat picture = mottled(size, 125.0, 5.0, 0.4 / texel, random);
  const int side = texels(0.3, texel);
  draw_blocks(picture, {side, side}, texels(0.008, texel), false, 9.0, random);
  return picture;
}

cv::Mat paint_wallpaper(const cv::Size& size, double texel, RandomStream& random) {
  const int period = texels(0.24, texel);
  cv::Mat ornament(period, period, CV_32F, cv::Scalar(random.uniform(140.0, 170.0)));
  for (int k = 0; k < 7; ++k) {
    const cv::Point centre(random.below(period), random.below(period));
    const cv::Size axes(1 + random.below(period / 4), 1 + random.below(period / 6));
    cv::ellipse(ornament, centre, axes, random.uniform(0.0, 180.0), 0, 360, random.uniform(70.0, 220.0),
                k % 2 == 0 ? cv::FILLED : 2);
  }
  cv::Mat repeated = cv::repeat(ornament, size.height / period + 1, size.width / period + 1);
  return repeated(cv::Rect({}, size)).clone();
}

cv::Mat paint_carpet(const cv::Size& size, double texel, RandomStream& random) {
  cv::Mat picture = mottled(size, random.uniform(80.0, 110.0), 12.0, 1.2 / texel, random);
  cv::Mat speckle(size, CV_32F);
  opencv_random(random).fill(speckle, cv::RNG::NORMAL, 0.0, 26.0);
  cv::GaussianBlur(speckle, speckle, {3, 3}, 0.7);
  picture += speckle;
  cv::Mat blots = multi_scale_noise(size, 0.05 / texel, random);
  picture += blots * 12.0;
  add_stains(picture, texel, random);
  return picture;
}

cv::Mat paint_wood(const cv::Size& size, double texel, RandomStream& random) {
  // Grain: noise stretched along the plank.
  cv::Mat narrow = multi_scale_noise({std::max(1, size.width / 12), size.height}, 0.03 / texel, random);
  cv::Mat picture;
  cv::resize(narrow, picture, size, 0, 0, cv::INTER_LINEAR);
  picture = picture * 20.0 + 92.0;
  const int height = texels(0.14, texel);
  const int length = texels(1.3, texel);
  for (int row = 0; row * height < size.height; ++row) {
    for (int x = -random.below(length); x < size.width; x += length) {
      const cv::Rect plank = cv::Rect(x + 1, row * height + 1, length - 1, height - 1) & cv::Rect({}, size);
      if (plank.area() > 0) picture(plank) += random.uniform(5.0, 55.0);
    }
  }
  add_stains(picture, texel, random);
  return picture;
}

cv::Mat paint_panels(const cv::Size& size, double texel, RandomStream& random) {
  cv::Mat picture = mottled(size, 170.0, 4.0, 0.4 / texel, random);
  const int side = texels(0.6, texel);
  const int holes = static_cast<int>(160.0 * texel * texel * picture.rows * picture.cols);
  for (int k = 0; k < holes; ++k) {
    const cv::Point hole(random.below(size.width), random.below(size.height));
    cv::circle(picture, hole, texels(random.uniform(0.003, 0.011), texel), random.uniform(95.0, 150.0),
               cv::FILLED);
  }
  for (int y = 0; y < size.height; y += side) {
    for (int x = 0; x < size.width; x += side) {
      const cv::Rect panel = cv::Rect(x, y, side, side) & cv::Rect({}, size);
      if (random.chance(0.08)) picture(panel).setTo(245.0);
      cv::rectangle(picture, panel, 110.0, texels(0.008, texel));
    }
  }
  return picture;
}

cv::Mat paint_fabric(const cv::Size& size, double texel, RandomStream& random) {
  cv::Mat picture = mottled(size, random.uniform(60.0, 150.0), 16.0, 0.15 / texel, random);
  const int stripe = texels(random.uniform(0.03, 0.07), texel);
  if (random.chance(0.6)) {
    for (int y = 0; y < size.height; y += 2 * stripe) {
      picture(cv::Rect(0, y, size.width, stripe) & cv::Rect({}, size)) += random.uniform(25.0, 60.0);
    }
  }
  return picture;
}

cv::Mat paint_float(Material material, const cv::Size& size, double texel, RandomStream& random) {
  switch (material) {
    case Material::kPlaster:
      return paint_plaster(size, texel, random);
    case Material::kConcrete:
      return paint_concrete(size, texel, random);
    case Material::kBrick:
      return paint_brick(size, texel, random);
    case Material::kTiles:
      return paint_tiles(size, texel, random);
    case Material::kWallpaper:
      return paint_wallpaper(size, texel, random);
    case Material::kCarpet:
      return paint_carpet(size, texel, random);
    case Material::kWood:
      return paint_wood(size, texel, random);
    case Material::kPanels:
      return paint_panels(size, texel, random);
    case Material::kFabric:
      return paint_fabric(size, texel, random);
    case Material::kBlank:
      break;
  }
  return {size, CV_32F, cv::Scalar(random.uniform(150.0, 190.0))};
}

}  // namespace

cv::Mat multi_scale_noise(const cv::Size& size, double coarsest, RandomStream& random) {
  cv::Mat sum = cv::Mat::zeros(size, CV_32F);
  double weight = 0.5;
  double blob = std::max(2.0, coarsest);
  while (blob >= 1.5) {
    cv::Mat coarse(static_cast<int>(size.height / blob) + 3, static_cast<int>(size.width / blob) + 3, CV_32F);
    opencv_random(random).fill(coarse, cv::RNG::NORMAL, 0.0, weight);
    cv::Mat fine;
    cv::resize(coarse, fine, {}, blob, blob, cv::INTER_CUBIC);
    const cv::Point corner(random.below(std::max(1, fine.cols - size.width)),
                           random.below(std::max(1, fine.rows - size.height)));
    sum += fine(cv::Rect(corner, size));
    blob *= 0.5;
    weight *= 0.75;
  }
  return sum;
}

cv::Mat paint_material(Material material, double width, double height, double texel, RandomStream random) {
  const cv::Size size(texels(width, texel), texels(height, texel));
  cv::Mat picture;
  paint_float(material, size, texel, random).convertTo(picture, CV_8U);
  return picture;
}

}  // namespace cosight::sim
