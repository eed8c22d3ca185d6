// The fast Hessian detector of SURF; orientation and descriptor are in surf_descriptor.cpp.
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "robot_agent/vision/surf.hpp"

namespace cosight::vision {

void IntegralImage::build(const GrayImage& image, int left, int top, int width, int height) {
  assert(left >= 0 && top >= 0 && left + width <= image.width && top + height <= image.height);
  width_ = width;
  height_ = height;
  const auto stride = static_cast<std::size_t>(width) + 1;
  sums_.assign(stride * (static_cast<std::size_t>(height) + 1), 0);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* gray = image.row(top + y) + left;
    const std::int32_t* above = row(y);
    std::int32_t* here = sums_.data() + (static_cast<std::size_t>(y) + 1) * stride;
    std::int32_t sum = 0;
    for (int x = 0; x < width; ++x) {
      sum += gray[x];
      here[x + 1] = above[x + 1] + sum;
    }
  }
}

std::int32_t IntegralImage::clamped_sum(int x0, int y0, int x1, int y1) const {
  return sum(std::clamp(x0, 0, width_), std::clamp(y0, 0, height_), std::clamp(x1, 0, width_),
             std::clamp(y1, 0, height_));
}

// Box filters of side L = 3 l stand for the second derivatives of a Gaussian of sigma 1.2 L / 9 (Bay, section
// 3.2): Dxx is a box minus three times its middle third, Dxy four squares beside the axes. The determinant is
// Dxx Dyy - (0.9 Dxy)^2 with each D divided by the filter's area.
void Surf::fill(const IntegralImage& image, Layer& layer) {
  const int lobe = layer.filter / 3;
  const int half = layer.filter / 2;
  const int step = layer.step;
  layer.width = image.width() / step;
  layer.height = image.height() / step;
  const auto count = static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height);
  layer.response.assign(count, 0.0F);
  layer.bright.assign(count, 0);
  const float scale = 1.0F / (255.0F * static_cast<float>(layer.filter * layer.filter));
  const int first = (half + 1 + step - 1) / step;  // the filter must lie in the image
  const int last_x = (image.width() - half - 2) / step;
  const int last_y = (image.height() - half - 2) / step;
  for (int j = first; j <= last_y; ++j) {
    const int y = j * step;
    const std::int32_t* const r[8] = {
        image.row(y - half), image.row(y - lobe), image.row(y - lobe + 1),     image.row(y - lobe / 2),
        image.row(y),        image.row(y + 1),    image.row(y + lobe / 2 + 1), image.row(y + lobe)};
    const std::int32_t* const below = image.row(y + lobe + 1);
    const std::int32_t* const bottom = image.row(y + half + 1);
    float* response = layer.response.data() + static_cast<std::ptrdiff_t>(j) * layer.width;
    std::uint8_t* bright = layer.bright.data() + static_cast<std::ptrdiff_t>(j) * layer.width;
    const auto box = [](const std::int32_t* upper, const std::int32_t* lower, int x0, int x1) {
      return lower[x1] - lower[x0] - upper[x1] + upper[x0];
    };
    for (int i = first; i <= last_x; ++i) {
      const int x = i * step;
      const std::int32_t xx =
          box(r[2], r[7], x - half, x + half + 1) - 3 * box(r[2], r[7], x - lobe / 2, x + lobe / 2 + 1);
      const std::int32_t yy =
          box(r[0], bottom, x - lobe + 1, x + lobe) - 3 * box(r[3], r[6], x - lobe + 1, x + lobe);
      const std::int32_t xy = box(r[1], r[4], x + 1, x + lobe + 1) + box(r[5], below, x - lobe, x) -
                              box(r[1], r[4], x - lobe, x) - box(r[5], below, x + 1, x + lobe + 1);
      const float dxx = scale * static_cast<float>(xx);
      const float dyy = scale * static_cast<float>(yy);
      const float dxy = scale * static_cast<float>(xy);
      response[i] = dxx * dyy - 0.81F * dxy * dxy;
      bright[i] = static_cast<std::uint8_t>(dxx + dyy < 0.0F);
    }
  }
}

// A response that is greatest among its 26 neighbours in place and scale, moved to the top of the quadratic
// through them (Brown and Lowe).
void Surf::find_maxima(int middle_layer) {
  const auto k = static_cast<std::size_t>(middle_layer);
  const Layer& below = layers_[k - 1];
  const Layer& here = layers_[k];
  const Layer& above = layers_[k + 1];
  const int border = (above.filter / 2 + 1) / above.step + 2;
  const auto threshold = static_cast<float>(options_.min_response);
  for (int y = border; y < here.height - border; ++y) {
    for (int x = border; x < here.width - border; ++x) {
      const float response = here.at(x, y);
      if (response < threshold) continue;
      bool greatest = true;
      for (int v = y - 1; v <= y + 1 && greatest; ++v) {
        for (int u = x - 1; u <= x + 1; ++u) {
          const bool itself = u == x && v == y;
          if (below.at(u, v) >= response || above.at(u, v) >= response ||
              (!itself && here.at(u, v) >= response)) {
            greatest = false;
            break;
          }
        }
      }
      if (!greatest) continue;
      const auto value = [](float v) { return static_cast<double>(v); };
      const double centre = value(response);
      Eigen::Vector3d gradient(0.5 * value(here.at(x + 1, y) - here.at(x - 1, y)),
                               0.5 * value(here.at(x, y + 1) - here.at(x, y - 1)),
                               0.5 * value(above.at(x, y) - below.at(x, y)));
      Eigen::Matrix3d H;
      H(0, 0) = value(here.at(x + 1, y)) + value(here.at(x - 1, y)) - 2.0 * centre;
      H(1, 1) = value(here.at(x, y + 1)) + value(here.at(x, y - 1)) - 2.0 * centre;
      H(2, 2) = value(above.at(x, y)) + value(below.at(x, y)) - 2.0 * centre;
      H(0, 1) = H(1, 0) = 0.25 * value(here.at(x + 1, y + 1) - here.at(x - 1, y + 1) - here.at(x + 1, y - 1) +
                                       here.at(x - 1, y - 1));
      H(0, 2) = H(2, 0) =
          0.25 * value(above.at(x + 1, y) - above.at(x - 1, y) - below.at(x + 1, y) + below.at(x - 1, y));
      H(1, 2) = H(2, 1) =
          0.25 * value(above.at(x, y + 1) - above.at(x, y - 1) - below.at(x, y + 1) + below.at(x, y - 1));
      const Eigen::Vector3d offset = -(H.inverse() * gradient);
      if (!(offset.cwiseAbs().maxCoeff() < 1.0)) continue;
      SurfPoint point;
      point.pixel = here.step * (Eigen::Vector2d(x, y) + offset.head<2>());
      point.scale = 1.2 / 9.0 * (here.filter + offset.z() * (above.filter - here.filter));
      point.response = centre + 0.5 * gradient.dot(offset);
      point.bright = here.bright[static_cast<std::size_t>(y) * static_cast<std::size_t>(here.width) +
                                 static_cast<std::size_t>(x)] != 0;
      points_.push_back(point);
    }
  }
}

const std::vector<SurfPoint>& Surf::detect(const IntegralImage& image) {
  points_.clear();
  for (int octave = 0; octave < options_.octaves; ++octave) {
    // Sizes 9 15 21 27, 15 27 39 51, 27 51 75 99, … at steps 1, 2, 4, …
    const int growth = 6 << octave;
    for (int i = 0; i < kLayers; ++i) {
      Layer& layer = layers_[static_cast<std::size_t>(i)];
      layer.filter = 3 + growth * (i + 1);
      layer.step = 1 << octave;
      fill(image, layer);
    }
    for (int middle = 1; middle + 1 < kLayers; ++middle)
      find_maxima(middle);
  }
  std::stable_sort(points_.begin(), points_.end(),
                   [](const SurfPoint& a, const SurfPoint& b) { return a.response > b.response; });
  return points_;
}

}  // namespace cosight::vision
