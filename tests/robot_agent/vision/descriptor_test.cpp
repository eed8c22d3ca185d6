#include "robot_agent/vision/descriptor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "robot_agent/vision/descriptor_matcher.hpp"
#include "robot_agent/vision/surf.hpp"
#include "tests/robot_agent/vision/synthetic_texture.hpp"

namespace cosight::vision {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

/// A view and the same turned and scaled about its centre; `to_second` maps pixels of the first.
struct TurnedPair {
  GrayImage first;
  GrayImage second;
  Eigen::Affine2d to_second;

  TurnedPair(double degrees, double scale, unsigned seed = 40) {
    const Eigen::Vector2d centre(0.5 * (kWidth - 1), 0.5 * (kHeight - 1));
    to_second = Eigen::Translation2d(centre) * Eigen::Rotation2D<double>(degrees * M_PI / 180.0) *
                Eigen::Scaling(scale) * Eigen::Translation2d(-centre);
    const SyntheticTexture texture(seed, 5.0);
    const Eigen::Affine2d to_first = to_second.inverse();
    first = texture.render(kWidth, kHeight);
    second = texture.render(kWidth, kHeight, [&](const Eigen::Vector2d& u) { return to_first * u; });
  }
};

ConvexPolygon middle() {
  return {{60, 40}, {260, 40}, {260, 200}, {60, 200}};
}

ConvexPolygon whole() {
  return {{0, 0}, {kWidth - 1.0, 0}, {kWidth - 1.0, kHeight - 1.0}, {0, kHeight - 1.0}};
}

class Descriptor : public testing::TestWithParam<DescriptorKind> {};

TEST_P(Descriptor, MatchesNinetyPercentRightAfterATurnOfFifteenDegrees) {
  const TurnedPair pair(15.0, 1.0);
  const auto extractor = make_descriptor_extractor(GetParam());
  const DescribedFeatures a = extractor->detect_and_describe(pair.first, middle(), 300);
  const DescribedFeatures b = extractor->detect_and_describe(pair.second, whole(), 600);
  const DescriptorMatches matches = match_descriptors(a, b);
  int right = 0;
  for (const DescriptorMatch& match : matches.matches) {
    right += (pair.to_second * a.pixels[match.index_S] - b.pixels[match.index_F]).norm() < 3.0 ? 1 : 0;
  }
  EXPECT_GE(matches.counts.matched, 50);
  EXPECT_GE(right, 0.9 * matches.counts.matched);
  RecordProperty("matched", matches.counts.matched);
  RecordProperty("right", right);
  RecordProperty("detected", static_cast<int>(a.size()));
}

TEST_P(Descriptor, StaysInsideTheRegionAndUnderItsLimit) {
  const TurnedPair pair(0.0, 1.0);
  const ConvexPolygon triangle{{80, 60}, {240, 80}, {120, 180}};
  const ConvexPolygon a_pixel_larger{{77, 58}, {244, 79}, {119, 183}};  // ORB's coarse levels round
  const auto extractor = make_descriptor_extractor(GetParam());
  const DescribedFeatures features = extractor->detect_and_describe(pair.first, triangle, 20);
  EXPECT_GT(features.size(), 10U);
  EXPECT_LE(features.size(), 20U);
  for (const Eigen::Vector2d& pixel : features.pixels)
    EXPECT_TRUE(contains(a_pixel_larger, pixel));
  EXPECT_EQ(extractor->detect_and_describe(pair.first, {}, 20).size(), 0U);
  const ConvexPolygon elsewhere{{1000, 60}, {1100, 80}, {1000, 180}};
  EXPECT_EQ(extractor->detect_and_describe(pair.first, elsewhere, 20).size(), 0U);
}

TEST_P(Descriptor, DescribesGivenPixelsAlikeInBothViews) {
  const TurnedPair pair(10.0, 1.0);
  const auto extractor = make_descriptor_extractor(GetParam());
  std::vector<Eigen::Vector2d> first{{-5, 20}};
  std::vector<Eigen::Vector2d> second{{-5, 20}};
  for (int x = 80; x <= 240; x += 20) {
    for (int y = 60; y <= 180; y += 20) {
      first.emplace_back(x, y);
      second.emplace_back(pair.to_second * first.back());
    }
  }
  const DescribedFeatures a = extractor->describe(pair.first, first);
  const DescribedFeatures b = extractor->describe(pair.second, second);
  ASSERT_EQ(a.size(), first.size() - 1) << "the first lies outside of the image";
  int right = 0;
  const DescriptorMatches matches = match_descriptors(a, b);
  for (const DescriptorMatch& match : matches.matches) {
    EXPECT_EQ(a.pixels[match.index_S], first[a.sources[match.index_S]].cast<float>().cast<double>());
    right += a.sources[match.index_S] == b.sources[match.index_F] ? 1 : 0;
  }
  EXPECT_GE(right, 0.5 * static_cast<double>(a.size()));
  EXPECT_GE(right, 0.95 * matches.counts.matched);
}

TEST_P(Descriptor, GivesTheSameForTheSameImage) {
  const TurnedPair pair(0.0, 1.0);
  const auto extractor = make_descriptor_extractor(GetParam());
  const DescribedFeatures a = extractor->detect_and_describe(pair.first, middle(), 100);
  extractor->detect_and_describe(pair.second, whole(), 30);
  const DescribedFeatures b = extractor->detect_and_describe(pair.first, middle(), 100);
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.bits, b.bits);
  EXPECT_EQ(a.vectors, b.vectors);
}

TEST_P(Descriptor, FindsNothingInAFlatImage) {
  const GrayImage gray{kWidth, kHeight, std::vector<std::uint8_t>(index(kWidth * kHeight), 100)};
  const auto extractor = make_descriptor_extractor(GetParam());
  EXPECT_EQ(extractor->detect_and_describe(gray, whole(), 100).size(), 0U);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), Eigen::Vector2d(kWidth - 1, kHeight - 1)}) {
    EXPECT_NO_THROW(extractor->describe(gray, {corner}));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Descriptor,
                         testing::Values(DescriptorKind::kOrb, DescriptorKind::kSift, DescriptorKind::kSurf));

TEST(Surf, FindsABlobItsPlaceAndScale) {
  for (const double sigma : {2.5, 4.0, 6.5}) {
    const Eigen::Vector2d centre(100.3, 79.6);
    GrayImage image{200, 160, std::vector<std::uint8_t>(32000)};
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 200; ++x) {
        const double r2 = (Eigen::Vector2d(x, y) - centre).squaredNorm();
        image.row(y)[x] =
            static_cast<std::uint8_t>(std::lround(30 + 200 * std::exp(-r2 / (2 * sigma * sigma))));
      }
    }
    IntegralImage integral;
    integral.build(image, 0, 0, 200, 160);
    Surf surf;
    const auto& points = surf.detect(integral);
    ASSERT_FALSE(points.empty());
    EXPECT_LT((points.front().pixel - centre).norm(), 0.7);
    EXPECT_NEAR(points.front().scale / sigma, 1.0, 0.35);
    EXPECT_TRUE(points.front().bright);
  }
}

TEST(Surf, OrientationTurnsWithTheImage) {
  const TurnedPair pair(30.0, 1.0);
  IntegralImage first;
  IntegralImage second;
  first.build(pair.first, 0, 0, kWidth, kHeight);
  second.build(pair.second, 0, 0, kWidth, kHeight);
  Surf surf;
  const std::vector<SurfPoint> points = surf.detect(first);
  int right = 0;
  int total = 0;
  for (SurfPoint point : points) {
    if (!contains(middle(), point.pixel) || point.scale > 4.0) continue;
    const double before = surf.orientation(first, point);
    point.pixel = pair.to_second * point.pixel;
    const double turn = std::remainder(surf.orientation(second, point) - before - M_PI / 6.0, 2.0 * M_PI);
    right += std::abs(turn) < 0.2 ? 1 : 0;
    ++total;
  }
  ASSERT_GT(total, 50);
  EXPECT_GE(right, 0.6 * total);  // round blobs have no direction; by chance it would be 6 %
}

TEST(IntegralImage, SumsAnyBox) {
  const GrayImage image = SyntheticTexture(2).render(50, 40);
  IntegralImage integral;
  integral.build(image, 5, 3, 40, 30);
  for (const auto& [x0, y0, x1, y1] :
       {std::array{0, 0, 40, 30}, std::array{3, 4, 10, 9}, std::array{7, 7, 7, 9}}) {
    int expected = 0;
    for (int y = y0; y < y1; ++y)
      expected = std::accumulate(image.row(y + 3) + 5 + x0, image.row(y + 3) + 5 + x1, expected);
    EXPECT_EQ(integral.sum(x0, y0, x1, y1), expected);
    EXPECT_EQ(integral.clamped_sum(x0, y0, x1, y1), expected);
  }
  EXPECT_EQ(integral.clamped_sum(-9, -9, 99, 99), integral.sum(0, 0, 40, 30));
}

DescribedFeatures from_vectors(const std::vector<Eigen::Vector2f>& vectors) {
  DescribedFeatures features;
  features.vectors.resize(static_cast<Eigen::Index>(vectors.size()), 2);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    features.pixels.emplace_back(static_cast<double>(i), 0.0);
    features.vectors.row(static_cast<Eigen::Index>(i)) = vectors[i].transpose();
  }
  return features;
}

TEST(DescriptorMatcher, CountsEveryFeatureOnce) {
  // 0: clear; 1: between two; 2: nothing like it; 3: its best prefers 0
  const DescribedFeatures a = from_vectors({{0.0F, 0.0F}, {5.0F, 0.0F}, {50.0F, 0.0F}, {0.1F, 0.05F}});
  const DescribedFeatures b = from_vectors({{0.0F, 0.01F}, {5.0F, 0.3F}, {5.0F, -0.3F}, {9.0F, 9.0F}});
  const DescriptorMatches result = match_descriptors(a, b);
  EXPECT_EQ(result.counts.matched, 1);
  EXPECT_EQ(result.counts.ambiguous, 1);
  EXPECT_EQ(result.counts.too_far, 1);
  EXPECT_EQ(result.counts.not_mutual, 1);
  EXPECT_EQ(result.counts.no_partner, 0);
  ASSERT_EQ(result.matches.size(), 1U);
  EXPECT_EQ(result.matches[0].index_S, 0U);
  EXPECT_EQ(result.matches[0].index_F, 0U);
}

TEST(DescriptorMatcher, LetsOnlyPossiblePartnersCompete) {
  const DescribedFeatures a = from_vectors({{5.0F, 0.0F}, {1.0F, 1.0F}});
  const DescribedFeatures b = from_vectors({{5.0F, 0.3F}, {5.0F, -0.3F}});
  const auto may_match = [](std::size_t i, std::size_t k) { return i == 0 && k == 1; };
  const DescriptorMatches result = match_descriptors(a, b, {}, may_match);
  ASSERT_EQ(result.counts.matched, 1);
  EXPECT_EQ(result.matches[0].index_F, 1U);
  EXPECT_EQ(result.counts.no_partner, 1);
}

TEST(DescriptorMatcher, HasNoMatchesWithoutFeatures) {
  EXPECT_EQ(match_descriptors({}, {}).counts.matched, 0);
  EXPECT_EQ(match_descriptors(from_vectors({{1.0F, 0.0F}}), {}).counts.no_partner, 1);
}

}  // namespace
}  // namespace cosight::vision
