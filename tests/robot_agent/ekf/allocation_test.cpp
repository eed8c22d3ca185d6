// Once everything has its size, the filter and the search take no memory: every allocation of this process is
// counted, Eigen's included.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/ekf/joint_compatibility.hpp"
#include "robot_agent/vision/active_search.hpp"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define COSIGHT_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<long> allocations{0};
}  // namespace

#if defined(COSIGHT_COUNTS_ALLOCATIONS)
// glibc lets a program replace malloc, and keeps its own under these names.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* memory, std::size_t size);            // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  ++allocations;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
#endif

namespace cosight {
namespace {

template <class Work>
long allocations_of(const Work& work) {
  const long before = allocations;
  work();
  return allocations - before;
}

CameraModel pinhole() {
  return {.fx = 450.0, .fy = 450.0, .cx = 320.0, .cy = 240.0, .width = 640, .height = 480};
}

class SteadyState : public testing::Test {
 protected:
  void SetUp() override {
#if !defined(COSIGHT_COUNTS_ALLOCATIONS)
    GTEST_SKIP() << "allocations can't be counted in this build";
#endif
  }
};

TEST_F(SteadyState, AnAllocationIsCounted) {
  EXPECT_GT(allocations_of([] { std::vector<double> storage(100); }), 0);
  EXPECT_GT(allocations_of([] { Eigen::VectorXd::Zero(100).eval(); }), 0);
}

/// Thirty landmarks, each seen in every frame.
struct Scene {
  Scene() {
    UncertainPose T_WS;
    T_WS.T.q = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
    T_WS.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    filter.reset(T_WS, 0.3, 0.3);
    ekf::StereoRig rig{pinhole(), pinhole(), {}, 1.0, 1.0};
    rig.T_SF.T.p = {0.5, 0.0, 0.0};
    rig.T_SF.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d p_S(-1.0 + 0.4 * (i % 6), -0.8 + 0.4 * (i / 6), 4.0 + 0.1 * i);
      filter.add_pseudo_stereo_landmark(
          {*pinhole().project(p_S), *pinhole().project(rig.T_SF.T.inverse() * p_S)}, rig);
    }
    measurements.reserve(30);
  }

  void frame() {
    filter.predict(0.033);
    measurements.clear();
    for (int i = 0; i < filter.landmark_count(); ++i) {
      const auto predicted = filter.predict_pixel(filter.landmark_id(i));
      if (!predicted) continue;
      measurements.push_back(
          ekf::Measurement::pixel(predicted->landmark, predicted->pixel + Eigen::Vector2d(0.3, -0.2), 1.0));
    }
    kept += compatibility.test(filter.innovation(measurements)).removed;
    fused += filter.update(measurements).fused;
  }

  ekf::Filter filter{pinhole(), {}};
  ekf::JointCompatibility compatibility;
  std::vector<ekf::Measurement> measurements;
  int kept = 0;
  int fused = 0;
};

TEST_F(SteadyState, TheFilterTakesNoMemory) {
  Scene scene;
  for (int frame = 0; frame < 3; ++frame)
    scene.frame();
  const int fused = scene.fused;
  EXPECT_EQ(allocations_of([&] {
              for (int frame = 0; frame < 20; ++frame)
                scene.frame();
            }),
            0);
  EXPECT_GT(scene.fused, fused + 400);
}

/// A texture without repetition.
GrayImage textured(int width, int height, int shift) {
  GrayImage image;
  image.width = width;
  image.height = height;
  image.data.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto hash =
          static_cast<unsigned>((x + shift) / 2) * 2654435761U ^ static_cast<unsigned>(y / 2) * 2246822519U;
      image.row(y)[x] = static_cast<std::uint8_t>((hash ^ (hash >> 13)) * 2654435761U >> 24);
    }
  }
  return image;
}

TEST_F(SteadyState, TheSearchTakesNoMemory) {
  constexpr int kSide = 13;
  const GrayImage first = textured(320, 240, 0);
  const GrayImage second = textured(320, 240, 3);
  std::vector<Eigen::Vector2d> pixels;
  for (int i = 0; i < 12; ++i)
    pixels.emplace_back(60 + 50 * (i % 4), 60 + 50 * (i / 4));
  vision::ActiveSearch search;
  int found = 0;
  const auto frame = [&](double sigma) {
    const Eigen::Matrix2d S = sigma * sigma * Eigen::Matrix2d::Identity();
    for (const Eigen::Vector2d& pixel : pixels) {
      const auto patch =
          vision::warp_pyramid(vision::cut_reference(first, pixel), Eigen::Matrix2d::Identity(), kSide);
      found += patch && search.find(second, *patch, pixel, S) ? 1 : 0;
    }
  };
  for (const double sigma : {4.0, 12.0})  // all places, and coarse to fine
    frame(sigma);
  found = 0;
  EXPECT_EQ(allocations_of([&] {
              for (const double sigma : {4.0, 12.0})
                frame(sigma);
            }),
            0);
  EXPECT_GT(found, 6);
}

}  // namespace
}  // namespace cosight
