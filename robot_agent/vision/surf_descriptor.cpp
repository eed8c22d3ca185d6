// Orientation and descriptor of SURF; the detector is in surf_detector.cpp.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "robot_agent/vision/index.hpp"
#include "robot_agent/vision/surf.hpp"

namespace cosight::vision {
namespace {

/// Haar wavelets of even side at a pixel: right minus left, lower minus upper half.
struct Wavelet {
  float x = 0.0F;
  float y = 0.0F;
};

/// With `kInside` the caller promises that the box lies in the image.
template <bool kInside>
Wavelet wavelet(const IntegralImage& image, int x, int y, int half) {
  const auto sum = [&](int x0, int y0, int x1, int y1) {
    return kInside ? image.sum(x0, y0, x1, y1) : image.clamped_sum(x0, y0, x1, y1);
  };
  const std::int32_t upper_left = sum(x - half, y - half, x, y);
  const std::int32_t upper_right = sum(x, y - half, x + half, y);
  const std::int32_t lower_left = sum(x - half, y, x, y + half);
  const std::int32_t lower_right = sum(x, y, x + half, y + half);
  return {static_cast<float>(upper_right + lower_right - upper_left - lower_left),
          static_cast<float>(lower_left + lower_right - upper_left - upper_right)};
}

int rounded(double value) {
  return static_cast<int>(std::lround(value));
}

bool holds(const IntegralImage& image, const Eigen::Vector2d& centre, double reach) {
  return centre.x() - reach >= 0.0 && centre.y() - reach >= 0.0 &&
         centre.x() + reach <= image.width() - 1.0 && centre.y() + reach <= image.height() - 1.0;
}

struct Gradient {
  double angle;
  double x;
  double y;
};

/// The sum of the gradients within a sixth of the circle, where it is longest (Bay, section 4.1).
double longest_direction(std::array<Gradient, 128>& gradients, std::size_t count) {
  constexpr double kWindow = std::numbers::pi / 3.0;
  const auto last = gradients.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(gradients.begin(), last, [](const Gradient& a, const Gradient& b) { return a.angle < b.angle; });
  double best = -1.0;
  double best_angle = 0.0;
  double x = 0.0;
  double y = 0.0;
  std::size_t end = 0;  // one past the window, counted on beyond the full circle
  for (std::size_t begin = 0; begin < count; ++begin) {
    const auto reached = [&](std::size_t i) {
      return gradients[i % count].angle + (i >= count ? 2.0 * std::numbers::pi : 0.0);
    };
    while (end < begin + count && reached(end) < gradients[begin].angle + kWindow) {
      x += gradients[end % count].x;
      y += gradients[end % count].y;
      ++end;
    }
    const double length = x * x + y * y;
    if (length > best) {
      best = length;
      best_angle = std::atan2(y, x);
    }
    x -= gradients[begin].x;
    y -= gradients[begin].y;
  }
  return best_angle;
}

}  // namespace

Surf::Surf(const SurfOptions& options) : options_(options) {
  options_.octaves = std::clamp(options_.octaves, 1, 4);
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 9; ++i) {
      const double r2 = (i - 4) * (i - 4) + (j - 4) * (j - 4);
      region_weights_[index(j * 9 + i)] = static_cast<float>(std::exp(-r2 / (2.0 * 2.5 * 2.5)));
    }
  }
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double r2 = (i - 1.5) * (i - 1.5) + (j - 1.5) * (j - 1.5);
      grid_weights_[index(j * 4 + i)] = static_cast<float>(std::exp(-r2 / (2.0 * 1.5 * 1.5)));
    }
  }
}

// Wavelets of side 4 s on a disk of radius 6 s, in steps of s, weighted by a Gaussian of 2.5 s.
double Surf::orientation(const IntegralImage& image, const SurfPoint& point) const {
  const double s = point.scale;
  const int half = std::max(rounded(2.0 * s), 1);
  const bool inside = holds(image, point.pixel, 6.0 * s + half + 1.0);
  std::array<Gradient, 128> gradients;
  std::size_t count = 0;
  for (int j = -6; j <= 6; ++j) {
    for (int i = -6; i <= 6; ++i) {
      if (i * i + j * j >= 36) continue;
      const int x = rounded(point.pixel.x() + s * i);
      const int y = rounded(point.pixel.y() + s * j);
      const Wavelet w = inside ? wavelet<true>(image, x, y, half) : wavelet<false>(image, x, y, half);
      const double weight = std::exp(-(i * i + j * j) / (2.0 * 2.5 * 2.5));
      const double gx = weight * static_cast<double>(w.x);
      const double gy = weight * static_cast<double>(w.y);
      gradients[count++] = {std::atan2(gy, gx), gx, gy};
    }
  }
  return longest_direction(gradients, count);
}

// 24x24 wavelets of side 2 s in steps of s along the point's own axes; 4x4 regions of 9x9 samples, 5 apart;
// of each the sums of dx, dy, |dx|, |dy| (Bay, section 4.2).
SurfDescriptor Surf::describe(const IntegralImage& image, const SurfPoint& point) const {
  const double s = point.scale;
  const int half = std::max(rounded(s), 1);
  const double cosine = std::cos(point.angle);
  const double sine = std::sin(point.angle);
  const auto c = static_cast<float>(cosine);
  const auto n = static_cast<float>(sine);
  const bool inside = holds(image, point.pixel, s * 17.0 + half + 1.0);
  std::array<Wavelet, std::size_t{kGrid} * kGrid> samples;
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const double u = s * (i - 0.5 * (kGrid - 1));
      const double v = s * (j - 0.5 * (kGrid - 1));
      const int x = rounded(point.pixel.x() + cosine * u - sine * v);
      const int y = rounded(point.pixel.y() + sine * u + cosine * v);
      const Wavelet w = inside ? wavelet<true>(image, x, y, half) : wavelet<false>(image, x, y, half);
      samples[index(j * kGrid + i)] = {c * w.x + n * w.y, c * w.y - n * w.x};
    }
  }
  SurfDescriptor descriptor{};
  float squares = 0.0F;
  for (int region = 0; region < 16; ++region) {
    const int left = 5 * (region % 4);
    const int top = 5 * (region / 4);
    float sums[4] = {};
    for (int j = 0; j < 9; ++j) {
      for (int i = 0; i < 9; ++i) {
        const float weight = region_weights_[index(j * 9 + i)];
        const Wavelet& w = samples[index((top + j) * kGrid + left + i)];
        sums[0] += weight * w.x;
        sums[1] += weight * w.y;
        sums[2] += weight * std::abs(w.x);
        sums[3] += weight * std::abs(w.y);
      }
    }
    for (int k = 0; k < 4; ++k) {
      const float value = grid_weights_[static_cast<std::size_t>(region)] * sums[k];
      descriptor[index(4 * region + k)] = value;
      squares += value * value;
    }
  }
  const float scale = squares > 0.0F ? 1.0F / std::sqrt(squares) : 0.0F;
  for (float& value : descriptor)
    value *= scale;
  return descriptor;
}

}  // namespace cosight::vision
