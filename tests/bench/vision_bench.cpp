// Vision and overlap: the sizes of a robot frame of 752x480 with 60 features.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <vector>

#include "robot_agent/overlap/predict_overlap.hpp"
#include "robot_agent/vision/active_search.hpp"
#include "robot_agent/vision/band_search.hpp"
#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/descriptor.hpp"
#include "robot_agent/vision/descriptor_matcher.hpp"
#include "robot_agent/vision/epipolar_band.hpp"
#include "robot_agent/vision/point_tracker.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vision/synthetic_texture.hpp"

namespace cosight::vision {
namespace {

constexpr int kSide = 13;

GrayImage frame(const Eigen::Vector2d& shift) {
  return SyntheticTexture(3).render(752, 480, [&](const Eigen::Vector2d& u) { return u - shift; });
}

CameraModel euroc_camera() {
  CameraModel camera{458.0, 457.0, 367.0, 248.0, 752, 480, Distortion::kRadtan, {}};
  camera.coefficients = {-0.28, 0.07, 0.0002, 0.00002, 0.0};
  return camera;
}

std::vector<Eigen::Vector2d> sixty_pixels() {
  std::vector<Eigen::Vector2d> pixels;
  for (int i = 0; i < 60; ++i)
    pixels.emplace_back(120 + 55 * (i % 10), 110 + 50 * (i / 10));
  return pixels;
}

/// 60 features in square windows of 2 half + 1 positions.
void search_windows(benchmark::State& state, int half) {
  const GrayImage first = frame({0, 0});
  const GrayImage second = frame({3.3, -2.2});
  SearchOptions options;
  options.max_half_window = half;
  ActiveSearch search(options);
  std::vector<PatchPyramid> patches;
  for (const Eigen::Vector2d& pixel : sixty_pixels()) {
    patches.push_back(*warp_pyramid(cut_reference(first, pixel), Eigen::Matrix2d::Identity(), kSide));
  }
  const Eigen::Matrix2d S = 1e4 * Eigen::Matrix2d::Identity();
  int found = 0;
  for (auto _ : state) {
    found = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      found += search.find(second, patches[i], sixty_pixels()[i], S) ? 1 : 0;
    }
  }
  state.counters["found"] = found;
}

void active_search_41x41(benchmark::State& state) {
  search_windows(state, 20);
}
BENCHMARK(active_search_41x41)->Unit(benchmark::kMillisecond);

void active_search_129x129(benchmark::State& state) {
  search_windows(state, 64);
}
BENCHMARK(active_search_129x129)->Unit(benchmark::kMillisecond);

void warp_60_pyramids(benchmark::State& state) {
  const ReferencePatch reference = cut_reference(frame({0, 0}), {300, 200});
  const Eigen::Matrix2d A = Eigen::Rotation2D<double>(0.2).toRotationMatrix();
  for (auto _ : state) {
    for (int i = 0; i < 60; ++i)
      benchmark::DoNotOptimize(warp_pyramid(reference, A, kSide));
  }
}
BENCHMARK(warp_60_pyramids)->Unit(benchmark::kMillisecond);

void detect_corners(benchmark::State& state) {
  const GrayImage image = frame({0, 0});
  const std::vector<Eigen::Vector2d> occupied = sixty_pixels();
  const CornerDetector detector;
  for (auto _ : state)
    benchmark::DoNotOptimize(detector.detect(image, occupied, 60));
}
BENCHMARK(detect_corners)->Unit(benchmark::kMillisecond);

void track_150_points(benchmark::State& state) {
  const GrayImage first = frame({0, 0});
  const GrayImage second = frame({3.3, -2.2});
  PointTracker tracker;
  std::vector<TrackStart> starts;
  for (const Corner& corner : CornerDetector().detect(first, {}, 150)) {
    starts.push_back({corner.pixel, corner.pixel, nullptr});
  }
  tracker.advance(first);
  for (auto _ : state) {
    tracker.advance(second);
    benchmark::DoNotOptimize(tracker.track(starts));
  }
}
BENCHMARK(track_150_points)->Unit(benchmark::kMillisecond);

void describe_third(benchmark::State& state, DescriptorKind kind, int max_features) {
  const GrayImage image = frame({0, 0});
  const ConvexPolygon roi{{200, 0}, {439, 0}, {439, 479}, {200, 479}};
  const auto extractor = make_descriptor_extractor(kind);
  std::size_t described = 0;
  for (auto _ : state)
    described = extractor->detect_and_describe(image, roi, max_features).size();
  state.counters["described"] = static_cast<double>(described);
}
BENCHMARK_CAPTURE(describe_third, orb_500, DescriptorKind::kOrb, 500)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(describe_third, sift_300, DescriptorKind::kSift, 300)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(describe_third, surf_300, DescriptorKind::kSurf, 300)->Unit(benchmark::kMillisecond);

void match_300_to_300(benchmark::State& state, DescriptorKind kind) {
  const ConvexPolygon roi{{200, 0}, {439, 0}, {439, 479}, {200, 479}};
  const auto extractor = make_descriptor_extractor(kind);
  const DescribedFeatures a = extractor->detect_and_describe(frame({0, 0}), roi, 300);
  const DescribedFeatures b = extractor->detect_and_describe(frame({3.3, -2.2}), roi, 300);
  for (auto _ : state)
    benchmark::DoNotOptimize(match_descriptors(a, b));
}
BENCHMARK_CAPTURE(match_300_to_300, orb, DescriptorKind::kOrb)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(match_300_to_300, surf, DescriptorKind::kSurf)->Unit(benchmark::kMillisecond);

UncertainPose wearer() {
  UncertainPose T_SF;
  T_SF.T = {quaternion_exp({0.0, -0.2, 0.05}), {0.6, 0.05, 0.1}};
  T_SF.covariance.diagonal() << Eigen::Vector3d::Constant(4e-4), Eigen::Vector3d::Constant(3e-5);
  return T_SF;
}

void predict_overlap_and_regions(benchmark::State& state) {
  const CameraModel camera = euroc_camera();
  const UncertainPose T_SF = wearer();
  for (auto _ : state)
    benchmark::DoNotOptimize(overlap::predict_overlap(camera, camera, T_SF));
}
BENCHMARK(predict_overlap_and_regions)->Unit(benchmark::kMicrosecond);

void predict_60_bands(benchmark::State& state) {
  const CameraModel camera = euroc_camera();
  const UncertainPose T_SF = wearer();
  for (auto _ : state) {
    for (const Eigen::Vector2d& pixel : sixty_pixels()) {
      benchmark::DoNotOptimize(
          EpipolarBand::predict(camera, camera, T_SF, pixel, InverseDistanceRange::between(0.5, 50.0)));
    }
  }
}
BENCHMARK(predict_60_bands)->Unit(benchmark::kMillisecond);

/// 60 features of which the distance is known to `relative_sigma`, 0: not at all.
void search_60_bands(benchmark::State& state, double relative_sigma) {
  const CameraModel camera = euroc_camera();
  const UncertainPose T_SF = wearer();
  const GrayImage image = frame({0, 0});
  const View slam{camera, Pose{}};
  const View worn{camera, T_SF.T};
  const auto range = relative_sigma > 0.0 ? InverseDistanceRange::around(0.3, 0.3 * relative_sigma, 3.0, 0.5)
                                          : InverseDistanceRange::between(0.5, 50.0);
  BandSearch search;
  ImagePyramid pyramid;
  build_pyramid(image, pyramid);
  for (auto _ : state) {
    for (const Eigen::Vector2d& pixel : sixty_pixels()) {
      const auto band = EpipolarBand::predict(camera, camera, T_SF, pixel, range);
      if (!band) continue;
      const ReferencePatch patch = cut_reference(image, pixel);
      benchmark::DoNotOptimize(search.find(pyramid, {patch, slam, slam, worn, pixel}, *band));
    }
  }
}
BENCHMARK_CAPTURE(search_60_bands, sigma_10_percent, 0.1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search_60_bands, unknown_distance, 0.0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cosight::vision
