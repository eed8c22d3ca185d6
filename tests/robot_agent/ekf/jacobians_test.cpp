// Every Jacobian of the filter against central differences over random states; the seed is the parameter.
#include <gtest/gtest.h>

#include "robot_agent/ekf/motion.hpp"
#include "robot_agent/ekf/observation.hpp"
#include "robot_agent/ekf/triangulation.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kTolerance = 2e-6;

class Jacobians : public testing::TestWithParam<unsigned> {
 protected:
  CameraState camera_with_pose(const VectorXd& pose) {
    CameraState x;
    x.r_WS = pose.head<3>();
    x.q_WS = from_wxyz(pose.segment<4>(3));
    return x;
  }

  RandomScene scene{GetParam()};
};

TEST_P(Jacobians, OfRayAnglesMatchCentralDifferences) {
  const RayAngles angles{scene.uniform(-3.1, 3.1), scene.uniform(-1.5, 1.5)};
  Eigen::Matrix<double, 3, 2> m_angles;
  const Vector3d m = ray_of_angles(angles, &m_angles);
  EXPECT_NEAR(m.norm(), 1.0, 1e-12);
  const auto ray = [](const VectorXd& a) -> VectorXd { return ray_of_angles({a(0), a(1)}); };
  EXPECT_THAT(m_angles, IsNearMatrix(numeric_jacobian(ray, Vector2d(angles.theta, angles.phi)), kTolerance));

  const Vector3d longer = 2.5 * m;
  Eigen::Matrix<double, 2, 3> angles_m;
  const auto back = angles_of_ray(longer, &angles_m);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->theta, angles.theta, 1e-12);
  EXPECT_NEAR(back->phi, angles.phi, 1e-12);
  const auto of_ray = [](const VectorXd& r) -> VectorXd {
    const auto a = angles_of_ray(Vector3d(r));
    return Vector2d(a->theta, a->phi);
  };
  EXPECT_THAT(angles_m, IsNearMatrix(numeric_jacobian(of_ray, longer, 1e-7), kTolerance));
}

TEST_P(Jacobians, OfMotionMatchCentralDifferences) {
  const CameraState x = scene.camera_state();
  const double dt = scene.uniform(0.01, 2.0);
  const MotionNoise noise{0.7, 1.3};
  const MotionStep step = predict_motion(x, dt, noise);
  const auto move = [&](const VectorXd& v) -> VectorXd {
    return predict_motion(CameraState::from_vector(v), dt, noise).x.vector();
  };
  EXPECT_THAT(step.F(), IsNearMatrix(numeric_jacobian(move, x.vector()), kTolerance));
  // The impulses enter as a change of velocity before the step.
  const auto kicked = [&](const VectorXd& impulse) -> VectorXd {
    CameraState k = x;
    k.v_W += impulse.head<3>();
    k.omega_S += impulse.tail<3>();
    return predict_motion(k, dt, noise).x.vector();
  };
  const Eigen::MatrixXd G = numeric_jacobian(kicked, VectorXd::Zero(6));
  VectorXd variance(6);
  variance << VectorXd::Constant(3, 0.49), VectorXd::Constant(3, 1.69);
  EXPECT_THAT(step.process_noise,
              IsNearMatrix(G * (variance * dt * dt).asDiagonal() * G.transpose(), kTolerance));
}

TEST_P(Jacobians, OfBearingObservationMatchCentralDifferences) {
  const BearingObservation model{scene.camera()};
  const CameraState x = scene.camera_state();
  for (const double rho : {scene.uniform(0.05, 1.0), 1e-9, 0.0, -0.01}) {  // as far as beyond infinity
    const InverseDepthPoint y = scene.landmark_in_view(x, rho);
    BearingObservation::Jacobians H;
    ASSERT_TRUE(model.predict(x, y, &H));
    const auto by_camera = [&](const VectorXd& p) -> VectorXd {
      return *model.predict(camera_with_pose(p), y);
    };
    const auto by_landmark = [&](const VectorXd& v) -> VectorXd {
      return *model.predict(x, InverseDepthPoint::from_vector(v));
    };
    EXPECT_THAT(H.H_camera, IsNearMatrix(numeric_jacobian(by_camera, x.vector().head<7>()), kTolerance));
    EXPECT_THAT(H.H_landmark, IsNearMatrix(numeric_jacobian(by_landmark, y.vector()), kTolerance));
  }
}

TEST_P(Jacobians, OfEuclideanObservationMatchCentralDifferences) {
  const EuclideanObservation model;
  const CameraState x = scene.camera_state();
  for (const double rho : {scene.uniform(0.1, 1.0), 0.01}) {
    const InverseDepthPoint y = scene.landmark_in_view(x, rho);
    EuclideanObservation::Jacobians H;
    ASSERT_TRUE(model.predict(x, y, &H));
    const auto by_camera = [&](const VectorXd& p) -> VectorXd {
      return *model.predict(camera_with_pose(p), y);
    };
    const auto by_landmark = [&](const VectorXd& v) -> VectorXd {
      return *model.predict(x, InverseDepthPoint::from_vector(v));
    };
    EXPECT_THAT(H.H_camera, IsNearMatrix(numeric_jacobian(by_camera, x.vector().head<7>()), kTolerance));
    EXPECT_THAT(H.H_landmark, IsNearMatrix(numeric_jacobian(by_landmark, y.vector(), 1e-7), 1e-5));
  }
}

TEST_P(Jacobians, OfPointLandmarksMatchCentralDifferences) {
  const BearingObservation bearing{scene.camera()};
  const EuclideanObservation euclidean;
  const CameraState x = scene.camera_state();
  const Vector3d p_W = x.T_WS() * scene.point_in_view(0.5, 20.0);
  const VectorXd pose = x.vector().head<7>();
  BearingObservation::PointJacobians H_c;
  ASSERT_TRUE(bearing.predict(x, p_W, &H_c));
  const auto pixel_by_camera = [&](const VectorXd& p) -> VectorXd {
    return *bearing.predict(camera_with_pose(p), p_W);
  };
  const auto pixel_by_point = [&](const VectorXd& p) -> VectorXd { return *bearing.predict(x, Vector3d(p)); };
  EXPECT_THAT(H_c.H_camera, IsNearMatrix(numeric_jacobian(pixel_by_camera, pose), kTolerance));
  EXPECT_THAT(H_c.H_landmark, IsNearMatrix(numeric_jacobian(pixel_by_point, p_W), kTolerance));
  EuclideanObservation::PointJacobians H_e;
  ASSERT_TRUE(euclidean.predict(x, p_W, &H_e));
  const auto point_by_camera = [&](const VectorXd& p) -> VectorXd {
    return *euclidean.predict(camera_with_pose(p), p_W);
  };
  const auto point_by_point = [&](const VectorXd& p) -> VectorXd {
    return *euclidean.predict(x, Vector3d(p));
  };
  EXPECT_THAT(H_e.H_camera, IsNearMatrix(numeric_jacobian(point_by_camera, pose), kTolerance));
  EXPECT_THAT(H_e.H_landmark, IsNearMatrix(numeric_jacobian(point_by_point, p_W), kTolerance));
}

TEST_P(Jacobians, OfThePointInWorldMatchCentralDifferences) {
  const InverseDepthPoint y = scene.landmark_in_view(scene.camera_state(), scene.uniform(0.1, 2.0));
  Eigen::Matrix<double, 3, 6> J;
  y.p_W(&J);
  const auto point = [](const VectorXd& v) -> VectorXd { return InverseDepthPoint::from_vector(v).p_W(); };
  EXPECT_THAT(J, IsNearMatrix(numeric_jacobian(point, y.vector()), kTolerance));
}

/// A match of a point `depth` away over a baseline of half a metre, with pixel noise so that the rays are
/// skew.
struct StereoScene {
  StereoScene(RandomScene& scene, double depth) : camera_S(scene.camera()), camera_F(scene.camera()) {
    const Vector3d p_S = scene.point_in_view(depth, depth);
    T_SF.p = Vector3d(scene.uniform(0.3, 0.6), scene.uniform(-0.2, 0.2), scene.uniform(-0.1, 0.1));
    const Vector3d forward = (p_S - T_SF.p).normalized();
    T_SF.q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), forward) *
             quaternion_exp(0.1 * Vector3d(scene.normals(3)));
    match.pixel_S = *camera_S.project(p_S) + Vector2d(0.3 * scene.normal(), 0.3 * scene.normal());
    match.pixel_F =
        *camera_F.project(T_SF.inverse() * p_S) + Vector2d(0.3 * scene.normal(), 0.3 * scene.normal());
  }
  VectorXd pixels() const {
    VectorXd v(4);
    v << match.pixel_S, match.pixel_F;
    return v;
  }
  VectorXd pose() const {
    VectorXd v(7);
    v << T_SF.p, wxyz(T_SF.q);
    return v;
  }
  auto triangulate_with(const VectorXd& pixels, const VectorXd& pose) const {
    return triangulate({pixels.head<2>(), pixels.tail<2>()}, camera_S, camera_F,
                       {from_wxyz(pose.tail<4>()), pose.head<3>()});
  }

  CameraModel camera_S;
  CameraModel camera_F;
  Pose T_SF;
  StereoMatch match;
};

TEST_P(Jacobians, OfTheWearersPixelMatchCentralDifferences) {
  const CameraState x = scene.camera_state();
  const StereoScene stereo(scene, scene.uniform(1.0, 10.0));
  const WearerObservation model{stereo.camera_F, stereo.T_SF};
  const auto with_error = [&](const VectorXd& xi) {
    return WearerObservation{stereo.camera_F,
                             {quaternion_exp(xi.tail<3>()) * stereo.T_SF.q, stereo.T_SF.p + xi.head<3>()}};
  };
  const Vector3d ray_S = *stereo.camera_S.unproject(stereo.match.pixel_S);
  const auto angles = angles_of_ray(x.q_WS * ray_S);
  for (const double rho : {1.0 / scene.uniform(2.0, 20.0), 1e-9, 0.0, -0.01}) {
    const InverseDepthPoint y{x.r_WS + 0.01 * Vector3d(scene.normals(3)), angles->theta, angles->phi, rho};
    WearerObservation::Jacobians H;
    if (!model.predict(x, y, &H)) continue;
    const auto by_camera = [&](const VectorXd& p) -> VectorXd {
      return *model.predict(camera_with_pose(p), y);
    };
    const auto by_landmark = [&](const VectorXd& v) -> VectorXd {
      return *model.predict(x, InverseDepthPoint::from_vector(v));
    };
    const auto by_wearer = [&](const VectorXd& xi) -> VectorXd { return *with_error(xi).predict(x, y); };
    EXPECT_THAT(H.H_camera, IsNearMatrix(numeric_jacobian(by_camera, x.vector().head<7>()), kTolerance));
    EXPECT_THAT(H.H_landmark, IsNearMatrix(numeric_jacobian(by_landmark, y.vector()), kTolerance));
    EXPECT_THAT(H.H_wearer, IsNearMatrix(numeric_jacobian(by_wearer, VectorXd::Zero(6)), kTolerance));
  }
  const Vector3d p_W = x.T_WS() * (8.0 * ray_S);
  WearerObservation::PointJacobians H;
  if (!model.predict(x, p_W, &H)) return;
  const auto by_camera = [&](const VectorXd& p) -> VectorXd {
    return *model.predict(camera_with_pose(p), p_W);
  };
  const auto by_point = [&](const VectorXd& p) -> VectorXd { return *model.predict(x, Vector3d(p)); };
  const auto by_wearer = [&](const VectorXd& xi) -> VectorXd { return *with_error(xi).predict(x, p_W); };
  EXPECT_THAT(H.H_camera, IsNearMatrix(numeric_jacobian(by_camera, x.vector().head<7>()), kTolerance));
  EXPECT_THAT(H.H_landmark, IsNearMatrix(numeric_jacobian(by_point, p_W), kTolerance));
  EXPECT_THAT(H.H_wearer, IsNearMatrix(numeric_jacobian(by_wearer, VectorXd::Zero(6)), kTolerance));
}

TEST_P(Jacobians, OfTriangulationByAllElevenInputsMatchCentralDifferences) {
  for (const double depth : {scene.uniform(1.0, 3.0), scene.uniform(5.0, 15.0)}) {
    const StereoScene stereo(scene, depth);
    const auto point = stereo.triangulate_with(stereo.pixels(), stereo.pose());
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->p_S.norm(), depth * 1.1, 0.25 * depth);
    const auto by_pixels = [&](const VectorXd& v) -> VectorXd {
      return stereo.triangulate_with(v, stereo.pose())->p_S;
    };
    const auto by_pose = [&](const VectorXd& v) -> VectorXd {
      return stereo.triangulate_with(stereo.pixels(), v)->p_S;
    };
    const auto rho_by_pixels = [&](const VectorXd& v) -> VectorXd {
      return VectorXd::Constant(1, stereo.triangulate_with(v, stereo.pose())->rho);
    };
    const auto rho_by_pose = [&](const VectorXd& v) -> VectorXd {
      return VectorXd::Constant(1, stereo.triangulate_with(stereo.pixels(), v)->rho);
    };
    const auto ray_by_pixel = [&](const VectorXd& v) -> VectorXd {
      VectorXd pixels = stereo.pixels();
      pixels.head<2>() = v;
      return stereo.triangulate_with(pixels, stereo.pose())->ray_S;
    };
    EXPECT_THAT(point->p_S_pixels, IsNearMatrix(numeric_jacobian(by_pixels, stereo.pixels(), 1e-4), 1e-5));
    EXPECT_THAT(point->p_S_pose, IsNearMatrix(numeric_jacobian(by_pose, stereo.pose()), 1e-5));
    EXPECT_THAT(point->rho_pixels,
                IsNearMatrix(numeric_jacobian(rho_by_pixels, stereo.pixels(), 1e-4), 1e-5));
    EXPECT_THAT(point->rho_pose, IsNearMatrix(numeric_jacobian(rho_by_pose, stereo.pose()), 1e-5));
    EXPECT_THAT(point->ray_pixel_S,
                IsNearMatrix(numeric_jacobian(ray_by_pixel, stereo.match.pixel_S, 1e-4), kTolerance));
  }
}

TEST_P(Jacobians, OfInverseDepthAtTinyParallaxMatchCentralDifferences) {
  const Vector3d b(0.3, 0.05, -0.02);  // from the other centre to the current one
  const Vector3d p = 5'000.0 * scene.point_in_view(1.0, 1.0);
  const Vector3d h_current = 0.7 * p;
  const Vector3d h_other = 1.4 * (p + b);
  const auto depth = inverse_depth_by_sines(h_current, h_other, b);
  ASSERT_TRUE(depth);
  EXPECT_NEAR(depth->rho * p.norm(), 1.0, 1e-6);
  VectorXd input(9);
  input << h_current / h_current.norm(), h_other / h_other.norm(), b;
  const auto rho = [](const VectorXd& v) -> VectorXd {
    return VectorXd::Constant(1, inverse_depth_by_sines(v.head<3>(), v.segment<3>(3), v.tail<3>())->rho);
  };
  const auto unit = inverse_depth_by_sines(input.head<3>(), input.segment<3>(3), b);
  Eigen::Matrix<double, 1, 9> J;
  J << unit->rho_h_current, unit->rho_h_other, unit->rho_b;
  EXPECT_THAT(J, IsNearMatrix(numeric_jacobian(rho, input), 1e-5));
}

TEST(InverseDepthBySines, HasNoAnswerAlongTheBaseline) {
  const Vector3d b(1.0, 0.0, 0.0);
  EXPECT_FALSE(inverse_depth_by_sines(b, Vector3d(0.0, 0.0, 1.0), b));
  EXPECT_FALSE(inverse_depth_by_sines(Vector3d(0.0, 0.0, 1.0), b, b));
  EXPECT_FALSE(inverse_depth_by_sines(Vector3d(0.0, 0.0, 1.0), Vector3d(0.1, 0.0, 1.0), Vector3d::Zero()));
}

TEST(InverseDepthBySines, SaysThatPartingRaysMeetBehind) {
  const auto depth = inverse_depth_by_sines({0.2, 0.0, 1.0}, {-0.2, 0.0, 1.0}, {1.0, 0.0, 0.0});
  ASSERT_TRUE(depth);
  EXPECT_LT(depth->parallax, 0.0);
}

TEST(AnglesOfRay, HaveNoAnswerStraightUp) {
  EXPECT_FALSE(angles_of_ray({0.0, 0.0, 1.0}));
  EXPECT_FALSE(angles_of_ray({1e-8, 0.0, -1.0}));
  EXPECT_TRUE(angles_of_ray({1e-3, 0.0, 1.0}));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Jacobians, testing::Range(1U, 41U));

}  // namespace
}  // namespace cosight::ekf
