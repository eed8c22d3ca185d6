// Landmarks that are kept as points once their depth is known well enough.
#include <gtest/gtest.h>

#include "robot_agent/ekf/filter.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

CameraModel pinhole() {
  return {.fx = 450.0, .fy = 450.0, .cx = 320.0, .cy = 240.0, .width = 640, .height = 480};
}

Filter filter_at_rest() {
  FilterOptions options;
  options.motion = {0.5, 0.5};
  Filter filter(pinhole(), options);
  UncertainPose T_WS;
  T_WS.T.q = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  T_WS.covariance = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
  filter.reset(T_WS, 0.1, 0.1);
  return filter;
}

StereoRig rig_of_baseline(double metres) {
  StereoRig rig{pinhole(), pinhole(), {}, 0.5, 0.5};
  rig.T_SF.T.p = {metres, 0.0, 0.0};
  rig.T_SF.covariance = 1e-8 * Eigen::Matrix<double, 6, 6>::Identity();
  return rig;
}

LandmarkId add(Filter& filter, const StereoRig& rig, const Eigen::Vector3d& p_S) {
  return *filter.add_pseudo_stereo_landmark(
      {*pinhole().project(p_S), *pinhole().project(rig.T_SF.T.inverse() * p_S)}, rig);
}

TEST(DepthNonlinearity, IsFourTimesTheRelativeDepthErrorWithoutParallax) {
  const InverseDepthPoint y{.theta = 0.3, .phi = 0.1, .rho = 0.25};
  EXPECT_NEAR(depth_nonlinearity(y, 0.01, y.anchor_W), 4.0 * 0.01 / 0.25, 1e-12);
  EXPECT_LT(depth_nonlinearity(y, 0.01, y.anchor_W + Eigen::Vector3d(0.0, 0.0, 3.0)), 0.16);
}

TEST(DepthNonlinearity, IsInfiniteAtInfinityAndBeyond) {
  const InverseDepthPoint at_infinity{.rho = 0.0};
  const InverseDepthPoint beyond{.rho = -0.01};
  EXPECT_TRUE(std::isinf(depth_nonlinearity(at_infinity, 0.01, Eigen::Vector3d::Zero())));
  EXPECT_TRUE(std::isinf(depth_nonlinearity(beyond, 0.01, Eigen::Vector3d::Zero())));
}

TEST(Conversion, TakesWhatIsNearAndLeavesWhatIsFar) {
  Filter filter = filter_at_rest();
  const StereoRig rig = rig_of_baseline(0.5);
  const LandmarkId near = add(filter, rig, {0.2, 0.1, 2.0});
  const LandmarkId far = add(filter, rig, {0.2, 0.1, 80.0});
  const int before = filter.state().size();
  EXPECT_EQ(filter.convert_linear_landmarks(0.0), 0);
  EXPECT_EQ(filter.convert_linear_landmarks(0.1), 1);
  EXPECT_EQ(filter.state().size(), before - 3);
  EXPECT_FALSE(filter.landmark(near)->is_inverse_depth);
  EXPECT_TRUE(filter.landmark(far)->is_inverse_depth);
  EXPECT_EQ(filter.convert_linear_landmarks(0.1), 0);
}

/// Two filters that see the same, of which one converts.
TEST(Conversion, LeavesTheEstimateAsAccurateAndHalvesTheState) {
  RandomScene scene(5);
  Filter inverse_depth = filter_at_rest();
  Filter points = filter_at_rest();
  const StereoRig rig = rig_of_baseline(0.5);
  std::vector<Eigen::Vector3d> landmarks_W;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d p_S = scene.point_in_view(2.0, 5.0);
    landmarks_W.emplace_back(inverse_depth.camera().T_WS() * p_S);
    add(inverse_depth, rig, p_S);
    add(points, rig, p_S);
  }
  EXPECT_EQ(points.convert_linear_landmarks(0.1), 20);
  Pose T_WS = inverse_depth.camera().T_WS();
  for (int frame = 0; frame < 30; ++frame) {
    T_WS.p += Eigen::Vector3d(0.02, 0.005, 0.0);
    for (Filter* filter : {&inverse_depth, &points}) {
      filter->predict(0.1);
      std::vector<Measurement> measured;
      RandomScene noise(static_cast<unsigned>(frame));  // the same for both
      for (int i = 0; i < 20; ++i) {
        const auto pixel = pinhole().project(T_WS.inverse() * landmarks_W[static_cast<std::size_t>(i)]);
        if (!pixel) continue;
        measured.push_back(Measurement::pixel(filter->landmark_id(i), *pixel + 0.5 * noise.normals(2), 0.5));
      }
      filter->update(measured);
    }
  }
  const double error = (inverse_depth.T_WS().T.p - T_WS.p).norm();
  EXPECT_LT(error, 0.02);
  EXPECT_LT((points.T_WS().T.p - inverse_depth.T_WS().T.p).norm(), 2e-3);
  const auto sigma = [](const Filter& f) {
    return std::sqrt(f.T_WS().covariance.topLeftCorner<3, 3>().trace());
  };
  EXPECT_NEAR(sigma(points) / sigma(inverse_depth), 1.0, 0.1);
  EXPECT_EQ(inverse_depth.state().size() - points.state().size(), 60);
}

}  // namespace
}  // namespace cosight::ekf
