#include "robot_agent/vision/active_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "robot_agent/vision/zncc_kernel.hpp"
#include "tests/robot_agent/vision/synthetic_texture.hpp"

namespace cosight::vision {
namespace {

constexpr int kSide = 13;

/// Textbook ZNCC with means first, in double: shares nothing with the scan.
double naive_zncc(const GrayImage& image, const std::vector<double>& templ, int side, int x, int y) {
  std::vector<double> window;
  for (int v = y - side / 2; v <= y + side / 2; ++v) {
    for (int u = x - side / 2; u <= x + side / 2; ++u)
      window.push_back(image.row(v)[u]);
  }
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
      sum += value;
    return sum / static_cast<double>(values.size());
  };
  const double mean_t = mean(templ);
  const double mean_w = mean(window);
  double tw = 0.0;
  double tt = 0.0;
  double ww = 0.0;
  for (std::size_t i = 0; i < templ.size(); ++i) {
    tw += (templ[i] - mean_t) * (window[i] - mean_w);
    tt += (templ[i] - mean_t) * (templ[i] - mean_t);
    ww += (window[i] - mean_w) * (window[i] - mean_w);
  }
  return ww < static_cast<double>(templ.size()) ? 0.0 : tw / std::sqrt(tt * ww);
}

std::vector<double> gray_levels(const Patch& patch) {
  std::vector<double> levels;
  for (int r = 0; r < patch.side; ++r) {
    for (int c = 0; c < patch.side; ++c) {
      levels.push_back(patch.mean + patch.deviations[index(r * Patch::kStride + c)]);
    }
  }
  return levels;
}

PatchPyramid pyramid_at(const GrayImage& image, const Eigen::Vector2d& pixel) {
  return *warp_pyramid(cut_reference(image, pixel), Eigen::Matrix2d::Identity(), kSide);
}

struct NaiveBest {
  Eigen::Vector2i pixel = Eigen::Vector2i::Zero();
  double score = -2.0;
};

NaiveBest naive_search(const GrayImage& image, const Patch& patch, const Eigen::Vector2d& predicted,
                       const Eigen::Matrix2d& S, const SearchOptions& options) {
  const std::vector<double> levels = gray_levels(patch);
  const int half = patch.half();
  NaiveBest best;
  for (int y = half; y < image.height - half; ++y) {
    for (int x = half; x < image.width - half; ++x) {
      const Eigen::Vector2d d = Eigen::Vector2d(x, y) - predicted;
      if (d.dot(S.inverse() * d) > options.n_sigmas * options.n_sigmas) continue;
      const double score = naive_zncc(image, levels, patch.side, x, y);
      if (score > best.score) best = {{x, y}, score};
    }
  }
  return best;
}

class ActiveSearchAgainstNaive : public testing::TestWithParam<unsigned> {};

TEST_P(ActiveSearchAgainstNaive, FindsTheSameBestPixelAndScore) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  GrayImage image = SyntheticTexture(GetParam(), 4.0).render(120, 90);
  std::normal_distribution<double> noise(0.0, 12.0);
  const GrayImage clean = image;
  for (auto& gray : image.data) {
    gray = static_cast<std::uint8_t>(std::clamp(static_cast<double>(gray) + noise(random), 0.0, 255.0));
  }
  SearchOptions options;
  options.min_score = 0.0;
  options.max_second_ratio = 1.0;
  ActiveSearch search(options);
  for (int trial = 0; trial < 12; ++trial) {
    const Eigen::Vector2d pixel(120.0 * unit(random), 90.0 * unit(random));
    const double major = 2.0 + 6.0 * unit(random);
    const double minor = 1.0 + 3.0 * unit(random);
    const Eigen::Rotation2Dd turn(3.0 * unit(random));
    const Eigen::Matrix2d S = turn.toRotationMatrix() *
                              Eigen::Vector2d(major * major, minor * minor).asDiagonal() *
                              turn.toRotationMatrix().transpose();
    const Eigen::Vector2d predicted = pixel + Eigen::Vector2d(6.0 * unit(random), 6.0 * unit(random));
    const PatchPyramid patch = pyramid_at(clean, pixel);
    const NaiveBest expected = naive_search(image, patch.full, predicted, S, options);
    const PatchMatch match = search.find(image, patch, predicted, S);
    if (expected.score <= 0.1) continue;
    ASSERT_EQ(match.outcome, SearchOutcome::kFound);
    EXPECT_EQ(match.best, expected.pixel);
    EXPECT_NEAR(match.score, expected.score, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ActiveSearchAgainstNaive, testing::Range(1U, 9U));

TEST(CorrelateRow, VectorVersionsEqualThePlainLoop) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> level(-255, 255);
  Patch patch;
  for (int side : {3, 11, 13, 15}) {
    for (auto& value : patch.deviations)
      value = static_cast<std::int16_t>(level(random));
    constexpr int kStride = 53;
    std::vector<std::int16_t> window(index(kStride * 16));
    for (auto& value : window)
      value = static_cast<std::int16_t>(level(random));
    for (int count : {1, 2, 3, 4, 5, 8, 31}) {
      std::vector<std::int32_t> plain(static_cast<std::size_t>(count));
      correlate_row_portable(patch.deviations.data(), side, window.data(), kStride, count, plain.data());
      for (const CorrelateRow correlate_row : vector_correlate_rows()) {
        std::vector<std::int32_t> fast(static_cast<std::size_t>(count + kCorrelationBlock));
        correlate_row(patch.deviations.data(), side, window.data(), kStride, count, fast.data());
        fast.resize(plain.size());
        EXPECT_EQ(plain, fast);
      }
    }
  }
}

TEST(ActiveSearch, FindsAFractionOfAPixel) {
  const SyntheticTexture texture(3);
  const GrayImage first = texture.render(160, 120);
  ActiveSearch search;
  double squares = 0.0;
  int n = 0;
  for (double shift = -0.5; shift <= 0.5; shift += 0.125) {
    const Eigen::Vector2d move(4.0 + shift, -3.0 - 0.5 * shift);
    const GrayImage second = texture.render(160, 120, [&](const Eigen::Vector2d& u) { return u - move; });
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(60, 50), Eigen::Vector2d(90.4, 70.3)}) {
      const PatchMatch match =
          search.find(second, pyramid_at(first, pixel), pixel, 9.0 * Eigen::Matrix2d::Identity());
      ASSERT_TRUE(match);
      squares += (match.pixel - pixel - move).squaredNorm();
      ++n;
    }
  }
  EXPECT_LT(std::sqrt(squares / n), 0.05);
}

TEST(ActiveSearch, FindsFarMotionThroughTheCoarseStage) {
  const SyntheticTexture texture(11);
  const GrayImage first = texture.render(400, 300);
  ActiveSearch search;
  const Eigen::Matrix2d S = 400.0 * Eigen::Matrix2d::Identity();  // 60 px at three sigmas
  int found = 0;
  int trials = 0;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> motion(-40.0, 40.0);
  std::uniform_real_distribution<double> place(100.0, 200.0);
  for (; trials < 40; ++trials) {
    const Eigen::Vector2d move(motion(random), motion(random));
    const Eigen::Vector2d pixel(place(random) + 50.0, place(random));
    const GrayImage second = texture.render(400, 300, [&](const Eigen::Vector2d& u) { return u - move; });
    const PatchMatch match = search.find(second, pyramid_at(first, pixel), pixel, S);
    if (match && (match.pixel - pixel - move).norm() < 0.5) ++found;
  }
  EXPECT_GE(found, trials - 1);
}

TEST(ActiveSearch, SaysThatTwoPeaksLookAlike) {
  // Period of 16 px along x: the next copy lies in the ellipse.
  const SyntheticTexture texture(4);
  const auto wrap = [](const Eigen::Vector2d& u) {
    return Eigen::Vector2d(u.x() - 16.0 * std::floor(u.x() / 16.0), u.y());
  };
  const GrayImage image = texture.render(160, 120, wrap);
  ActiveSearch search;
  const Eigen::Vector2d pixel(80, 60);
  const PatchMatch match =
      search.find(image, pyramid_at(image, pixel), pixel, 64.0 * Eigen::Matrix2d::Identity());
  EXPECT_EQ(match.outcome, SearchOutcome::kAmbiguous);
  EXPECT_GT(match.second_score, 0.99);
  EXPECT_EQ(std::abs(match.second_best.x() - match.best.x()) % 16, 0);
  const PatchMatch near =
      search.find(image, pyramid_at(image, pixel), pixel, 4.0 * Eigen::Matrix2d::Identity());
  EXPECT_EQ(near.outcome, SearchOutcome::kFound);
}

TEST(ActiveSearch, SaysWhyItFoundNothing) {
  const GrayImage image = SyntheticTexture(6).render(160, 120);
  const GrayImage other = SyntheticTexture(60).render(160, 120);
  const GrayImage gray{160, 120, std::vector<std::uint8_t>(19200, 90)};
  ActiveSearch search;
  const Eigen::Matrix2d S = 9.0 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d pixel(80, 60);
  EXPECT_EQ(search.find(other, pyramid_at(image, pixel), pixel, S).outcome, SearchOutcome::kWeak);
  EXPECT_EQ(search.find(gray, pyramid_at(image, pixel), pixel, S).outcome, SearchOutcome::kWeak);
  EXPECT_EQ(search.find(image, pyramid_at(gray, pixel), pixel, S).outcome, SearchOutcome::kFlatPatch);
  EXPECT_EQ(search.find(image, pyramid_at(image, pixel), {-40, 60}, S).outcome, SearchOutcome::kOutsideImage);
  EXPECT_EQ(search.find(image, pyramid_at(image, pixel), {1e12, -1e12}, S).outcome,
            SearchOutcome::kOutsideImage);
  EXPECT_EQ(search.find(image, pyramid_at(image, pixel), {NAN, 60}, S).outcome, SearchOutcome::kOutsideImage);
  EXPECT_EQ(search.find(image, pyramid_at(image, pixel), pixel, Eigen::Matrix2d::Zero()).outcome,
            SearchOutcome::kOutsideImage);
}

TEST(ActiveSearch, StaysInsideTheImageAtEveryBorder) {
  const GrayImage image = SyntheticTexture(8).render(100, 80);
  ActiveSearch search;
  for (const double sigma : {3.0, 15.0, 200.0}) {
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(0, 0), Eigen::Vector2d(99, 0), Eigen::Vector2d(0, 79), Eigen::Vector2d(99, 79)}) {
      const PatchMatch match =
          search.find(image, pyramid_at(image, pixel), pixel, sigma * sigma * Eigen::Matrix2d::Identity());
      if (!match) continue;
      EXPECT_GE(match.best.x(), kSide / 2);
      EXPECT_LT(match.best.x(), 100 - kSide / 2);
      EXPECT_GE(match.best.y(), kSide / 2);
      EXPECT_LT(match.best.y(), 80 - kSide / 2);
    }
  }
}

}  // namespace
}  // namespace cosight::vision
