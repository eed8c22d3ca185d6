// What must never happen, whatever is measured: NaN, a negative eigenvalue, an update that throws everything
// away.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "robot_agent/ekf/filter.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

#ifndef COSIGHT_TORTURE_STEPS
#define COSIGHT_TORTURE_STEPS 2500
#endif
constexpr int kSteps = COSIGHT_TORTURE_STEPS;  // for each of six seeds

CameraModel pinhole() {
  return {.fx = 450.0, .fy = 450.0, .cx = 320.0, .cy = 240.0, .width = 640, .height = 480};
}

/// Smallest eigenvalue of P scaled to unit diagonal.
double smallest_eigenvalue(const GaussianState& state) {
  const MatrixXd P = state.P_lower().selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd s = P.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(s.asDiagonal() * P * s.asDiagonal(), Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

void expect_healthy(const Filter& filter) {
  ASSERT_TRUE(filter.state().x().allFinite());
  const MatrixXd P = filter.state().P_lower().selfadjointView<Eigen::Lower>();
  ASSERT_TRUE(P.allFinite());
  EXPECT_GE(P.diagonal().minCoeff(), 0.0);
  EXPECT_GE(smallest_eigenvalue(filter.state()), -1e-7);
  EXPECT_NEAR(filter.camera().q_WS.norm(), 1.0, 1e-12);
}

/// A filter that is told anything at all.
class Torture : public testing::TestWithParam<unsigned> {
 protected:
  Torture() {
    FilterOptions options;
    options.max_landmarks = 8;
    options.max_clones = 2;
    options.gate_probability = GetParam() % 2 == 0 ? 0.999 : 1.0;
    options.max_iterations = GetParam() % 3 == 0 ? 3 : 1;
    filter = std::make_unique<Filter>(pinhole(), options);
    restart();
    rig.camera_S = pinhole();
    rig.camera_F = pinhole();
  }

  void restart() {
    UncertainPose T_WS;
    T_WS.T.q = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
    T_WS.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    filter->reset(T_WS, 0.3, 0.3);
  }

  void add() {
    rig.T_SF.T = {quaternion_exp(0.1 * Vector3d(scene.normals(3))), 0.5 * Vector3d(scene.normals(3))};
    rig.T_SF.covariance =
        Eigen::Matrix<double, 6, 6>::Identity() * std::pow(10.0, scene.uniform(-12.0, -1.0));
    if (scene.uniform(0.0, 1.0) < 0.1) rig.T_SF.T.p.setZero();  // no parallax
    const double far = scene.uniform(0.0, 1.0) < 0.1 ? 1e7 : 300.0;
    const Vector3d p_S = scene.point_in_view(0.3, far);
    const auto pixel_F = rig.camera_F.project(rig.T_SF.T.inverse() * p_S);
    const Vector2d pixel_S = *rig.camera_S.project(p_S);
    if (pixel_F) filter->add_pseudo_stereo_landmark({pixel_S, *pixel_F + Vector2d(scene.normal(), 0.0)}, rig);
    if (scene.uniform(0.0, 1.0) < 0.2) {
      filter->add_known_point(filter->camera().T_WS() * p_S, 1e-6 * Eigen::Matrix3d::Identity());
    }
  }

  /// The landmarks behind the camera from one frame to the next.
  void turn_around() {
    CameraState x = filter->camera();
    x.q_WS = x.q_WS * Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0);
    filter->recentre_camera(x);
  }

  std::vector<Measurement> measurements() {
    std::vector<Measurement> all;
    const int count = scene.uniform(0.0, 1.0) < 0.1 ? 1 : filter->landmark_count();
    for (int i = 0; i < std::min(count, filter->landmark_count()); ++i) {
      const LandmarkId id = filter->landmark_id(i);
      const auto pixel = filter->predict_pixel(id);
      if (!pixel) continue;
      const double sigma = std::pow(10.0, scene.uniform(-3.0, 1.0));
      const double wrong = scene.uniform(0.0, 1.0) < 0.02 ? 100.0 : 1.0;
      all.push_back(Measurement::pixel(id, pixel->pixel + wrong * sigma * scene.normals(2), sigma));
      const auto point = filter->predict_point(id);
      if (!point || scene.uniform(0.0, 1.0) < 0.5) continue;
      PointMeasurement measured;
      measured.p_S = point->p_S + 0.1 * sigma * scene.normals(3);
      measured.R = 0.01 * sigma * sigma * Eigen::Matrix3d::Identity();
      all.push_back(Measurement::point(id, measured));  // and the pixel: both of one landmark
    }
    return all;
  }

  RandomScene scene{GetParam()};
  std::unique_ptr<Filter> filter;
  StereoRig rig;
};

TEST_P(Torture, LeavesACovariance) {
  int fused = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double die = scene.uniform(0.0, 1.0);
    filter->predict(die < 0.02 ? 60.0 : die < 0.1 ? 0.0 : 0.033);
    if (filter->landmark_count() < 8) add();
    if (die > 0.95 && filter->landmark_count() > 0) filter->remove_landmark(filter->landmark_id(0));
    if (die > 0.90 && die < 0.92) filter->clone_camera_pose();
    if (die > 0.86 && die < 0.861) turn_around();
    if (die > 0.88 && die < 0.90 && filter->landmark_count() > 0)
      filter->convert_to_point(filter->landmark_id(0));
    fused += filter->update(measurements()).fused;
    if (i % 50 == 0) expect_healthy(*filter);
    if (filter->camera().r_WS.norm() > 1e6) restart();
  }
  EXPECT_GT(fused, kSteps);
  expect_healthy(*filter);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Torture, testing::Range(1U, 7U));

class Edge : public testing::Test {
 protected:
  Edge() {
    UncertainPose T_WS;
    T_WS.T.q = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
    T_WS.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    filter.reset(T_WS, 0.3, 0.3);
  }
  Filter filter{pinhole(), {}};
};

TEST_F(Edge, NoTimeChangesNothing) {
  const Eigen::VectorXd x = filter.state().x();
  const MatrixXd P = filter.state().P_lower();
  for (const double dt : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    filter.predict(dt);
  EXPECT_EQ(Eigen::VectorXd(filter.state().x()), x);
  EXPECT_EQ(MatrixXd(filter.state().P_lower()), P);
}

TEST_F(Edge, AnUpdateOfNothingIsNoUpdate) {
  EXPECT_EQ(filter.update({}).fused, 0);
  const std::array<Measurement, 1> unknown{Measurement::pixel(77, {1.0, 2.0}, 1.0)};
  const UpdateReport& report = filter.update(unknown);
  EXPECT_EQ(report.fused, 0);
  EXPECT_EQ(report.measurements[0].outcome, Outcome::kUnpredictable);
  EXPECT_EQ(report.measurements[0].landmark, 77U);
}

TEST_F(Edge, NotANumberIsLeftOut) {
  const auto id = filter.add_known_point({3.0, 0.0, 0.0}, Eigen::Matrix3d::Identity() * 1e-4);
  const std::array<Measurement, 1> broken{
      Measurement::pixel(*id, {std::numeric_limits<double>::quiet_NaN(), 2.0}, 1.0)};
  EXPECT_EQ(filter.update(broken).measurements[0].outcome, Outcome::kUnpredictable);
  expect_healthy(filter);
}

TEST_F(Edge, AMeasurementOutsideItsGateIsReportedAndLeftOut) {
  const auto id = filter.add_known_point({3.0, 0.0, 0.0}, Eigen::Matrix3d::Identity() * 1e-6);
  const auto other = filter.add_known_point({3.0, 0.5, 0.0}, Eigen::Matrix3d::Identity() * 1e-6);
  const auto predicted = filter.predict_pixel(*id);
  const std::array<Measurement, 2> both{Measurement::pixel(*id, predicted->pixel + Vector2d(200.0, 0.0), 1.0),
                                        Measurement::pixel(*other, filter.predict_pixel(*other)->pixel, 1.0)};
  const UpdateReport& report = filter.update(both);
  EXPECT_EQ(report.measurements[0].outcome, Outcome::kGated);
  EXPECT_GT(report.measurements[0].nis, report.measurements[0].gate);
  EXPECT_EQ(report.measurements[1].outcome, Outcome::kFused);
  EXPECT_EQ(report.fused, 1);
  EXPECT_EQ(report.rows, 2);
}

TEST_F(Edge, NoiseThatIsNoCovarianceIsSkippedAndCounted) {
  const auto a = filter.add_known_point({3.0, 0.0, 0.0}, Eigen::Matrix3d::Identity() * 1e-6);
  const auto b = filter.add_known_point({3.0, 0.5, 0.0}, Eigen::Matrix3d::Identity() * 1e-6);
  PointMeasurement point;
  point.R = 1e-4 * Eigen::Matrix3d::Identity();
  point.shared_factor.leftCols<3>() = Eigen::Matrix3d::Identity();  // shares more than it has
  point.p_S = filter.predict_point(*a)->p_S;
  const Measurement first = Measurement::point(*a, point);
  point.p_S = filter.predict_point(*b)->p_S;
  const std::array<Measurement, 2> both{first, Measurement::point(*b, point)};
  const MatrixXd P = filter.state().P_lower();
  const UpdateReport& report = filter.update(both);
  EXPECT_EQ(report.fused, 0);
  EXPECT_EQ(report.measurements[0].outcome, Outcome::kIllConditioned);
  EXPECT_EQ(MatrixXd(filter.state().P_lower()), P);
}

TEST_F(Edge, ALandmarkBeyondInfinityIsStillMeasuredAsABearing) {
  FilterOptions options;
  options.motion = {1e-3, 1e-3};
  options.gate_probability = 1.0;
  Filter far(pinhole(), options);
  CameraState x = filter.camera();
  x.v_W = {0.0, -1.0, 0.0};  // to the camera's right
  far.reset(x, 1e-8 * CameraState::Covariance::Identity());
  StereoRig rig{pinhole(), pinhole(), {}, 1.0, 1.0};
  rig.T_SF.T.p = {0.5, 0.0, 0.0};
  const auto id = far.add_pseudo_stereo_landmark({{320.0, 240.0}, {319.0, 240.0}}, rig);
  ASSERT_TRUE(id);
  InverseDepthPoint beyond = far.landmark(*id)->y;
  beyond.rho = -0.01;
  for (int i = 0; i < 10; ++i) {
    far.predict(0.5);
    const auto pixel = BearingObservation{pinhole()}.predict(far.camera(), beyond);
    ASSERT_TRUE(pixel);
    const std::array<Measurement, 1> measured{Measurement::pixel(*id, *pixel, 0.5)};
    EXPECT_EQ(far.update(measured).fused, 1);
  }
  EXPECT_LT(far.landmark(*id)->y.rho, 0.0);
  EXPECT_TRUE(far.predict_pixel(*id));
  EXPECT_FALSE(far.predict_point(*id));
  expect_healthy(far);
}

TEST(PointForm, JacobianMatchesCentralDifferences) {
  RandomScene scene(3);
  for (int i = 0; i < 20; ++i) {
    const Vector3d p_S = scene.point_in_view(0.3, 50.0);
    Eigen::Matrix3d J;
    bearing_and_inverse_distance(p_S, &J);
    const auto form = [](const Eigen::VectorXd& p) -> Eigen::VectorXd {
      return bearing_and_inverse_distance(Vector3d(p));
    };
    EXPECT_THAT(J, IsNearMatrix(numeric_jacobian(form, p_S), 1e-6));
  }
}

}  // namespace
}  // namespace cosight::ekf
