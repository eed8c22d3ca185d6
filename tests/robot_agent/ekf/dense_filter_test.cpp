// The filter, which touches only what it must, against a textbook filter that knows nothing of structure.
#include <gtest/gtest.h>

#include "tests/robot_agent/ekf/side_by_side.hpp"

namespace cosight::ekf {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

TEST_P(SideBySide, PredictionsAgreeWithLandmarksInTheState) {
  for (int i = 0; i < 3; ++i)
    add_both_ways(new_match());
  expect_same();
  for (const double dt : {0.033, 0.5, 0.1})
    predict_both(dt);
  expect_same();
}

TEST_P(SideBySide, UpdatesOfPixelsAndPointsAgree) {
  for (int i = 0; i < 4; ++i)
    add_both_ways(new_match());
  predict_both(0.05);
  std::vector<Measurement> measurements;
  VectorXd z(10);
  MatrixXd R = MatrixXd::Zero(10, 10);
  // Pixels of landmarks 2 and 0, points of 3 and 1 which share an error.
  const std::array<int, 4> order{2, 3, 0, 1};
  Eigen::Matrix<double, 6, 6> B = Eigen::Matrix<double, 6, 6>::Zero();
  int row = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const LandmarkId id = ids[static_cast<std::size_t>(order[i])];
    const int offset = filter.landmark_offset(id);
    if (i % 2 == 0) {
      const Vector2d pixel = pixel_of(dense.x, offset) + 0.7 * scene.normals(2);
      measurements.push_back(Measurement::pixel(id, pixel, 0.8));
      z.segment<2>(row) = pixel;
      R.block<2, 2>(row, row) = 0.64 * MatrixXd::Identity(2, 2);
      row += 2;
      continue;
    }
    PointMeasurement point;
    point.p_S = point_of(dense.x, offset) + 0.02 * scene.normals(3);
    for (int k = 0; k < 18; ++k)
      point.shared_factor.data()[k] = 0.02 * scene.normal();
    point.R = scene.covariance(3, 0.02) + point.shared_factor * point.shared_factor.transpose();
    measurements.push_back(Measurement::point(id, point));
    z.segment<3>(row) = point.p_S;
    R.block<3, 3>(row, row) = point.R;
    B.middleRows<3>(i == 1 ? 0 : 3) = point.shared_factor;
    row += 3;
  }
  R.block<3, 3>(7, 2) = B.bottomRows<3>() * B.topRows<3>().transpose();
  R.block<3, 3>(2, 7) = R.block<3, 3>(7, 2).transpose();
  const std::array<int, 4> offsets{filter.landmark_offset(ids[2]), filter.landmark_offset(ids[3]),
                                   filter.landmark_offset(ids[0]), filter.landmark_offset(ids[1])};
  const bool in_metres = filter.options().point_form == PointForm::kEuclidean;
  const auto form = [in_metres](const VectorXd& v) {
    VectorXd formed = v;
    for (const int at : {2, 7}) {
      const Vector3d p = v.segment<3>(at);
      if (!in_metres) formed.segment<3>(at) << p.x() / p.z(), p.y() / p.z(), 1.0 / p.norm();
    }
    return formed;
  };
  const MatrixXd J_form = numeric_jacobian(form, z);
  R = (J_form * R * J_form.transpose()).eval();
  z = form(z);
  const auto h = [&](const VectorXd& x) {
    VectorXd v(10);
    v << pixel_of(x, offsets[0]), point_of(x, offsets[1]), pixel_of(x, offsets[2]), point_of(x, offsets[3]);
    return form(v);
  };
  const MatrixXd H = numeric_jacobian(h, dense.x);
  const MatrixXd S = H * dense.P * H.transpose() + R;
  const VectorXd g = z - h(dense.x);
  const double nis = g.dot(S.inverse() * g);

  const UpdateReport& report = filter.update(measurements);
  EXPECT_EQ(report.fused, 4);
  EXPECT_EQ(report.rows, 10);
  EXPECT_NEAR(report.nis, nis, 1e-4 * nis);
  EXPECT_THAT(report.measurements[1].innovation, IsNearMatrix(g.segment<3>(2), 1e-5));
  EXPECT_NEAR(report.measurements[1].innovation_std.y(), std::sqrt(S(3, 3)), 1e-5);
  dense.update(h, z, R);
  expect_same(1e-4);
}

/// Both pixels of three landmarks, those of the free camera with the error of T_SF that they share.
TEST_P(SideBySide, UpdatesOfTheWearersPixelsAgree) {
  for (int i = 0; i < 3; ++i)
    add_both_ways(new_match());
  const bool has_point = GetParam() % 2 == 0 && filter.convert_to_point(ids[1]);
  if (has_point) {
    dense.x = filter.state().x();
    dense.P = whole(filter.state());
  }
  const auto point_S = [&](const VectorXd& x, std::size_t i) -> Vector3d {
    const int offset = filter.landmark_offset(ids[i]);
    if (i != 1 || !has_point) return point_of(x, offset);
    const CameraState c = camera_of(x);
    return c.q_WS.toRotationMatrix().transpose() * (x.segment<3>(offset) - c.r_WS);
  };
  const auto pixels = [&](const VectorXd& x, const VectorXd& xi) {
    const Pose T_SF{quaternion_exp(xi.tail<3>()) * rig.T_SF.T.q, rig.T_SF.T.p + xi.head<3>()};
    VectorXd v(12);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d p_S = point_S(x, i);
      const auto row = static_cast<Eigen::Index>(4 * i);
      v.segment<4>(row) << *camera.project(p_S), *rig.camera_F.project(T_SF.inverse() * p_S);
    }
    return v;
  };
  const VectorXd none = VectorXd::Zero(6);
  const MatrixXd B = numeric_jacobian([&](const VectorXd& xi) { return pixels(dense.x, xi); }, none);
  MatrixXd R = B * rig.T_SF.covariance * B.transpose();
  R.diagonal() += VectorXd::Constant(12, 0.64);
  const VectorXd z = pixels(dense.x, none) + 0.7 * scene.normals(12);
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(4 * i);
    measurements.push_back(Measurement::pixel(ids[i], z.segment<2>(row), 0.8));
    measurements.push_back(Measurement::wearer_pixel(ids[i], z.segment<2>(row + 2), 0.8));
  }
  EXPECT_EQ(filter.update(measurements, &rig).fused, 6);
  dense.update([&](const VectorXd& x) { return pixels(x, none); }, z, R);
  expect_same(1e-4);
  EXPECT_EQ(filter.update(std::span(measurements).subspan(1, 1)).measurements[0].outcome,
            Outcome::kUnpredictable);
}

TEST_P(SideBySide, DelayedStartFromACloneAgrees) {
  add_both_ways(new_match());
  const auto clone = filter.clone_camera_pose();
  ASSERT_TRUE(clone);
  dense.augment([](const VectorXd& x, const VectorXd&) -> VectorXd { return x.head<7>(); },
                MatrixXd::Zero(1, 1), 1.0);
  const int clone_offset = filter.state().size() - 7;
  const Vector3d p_W = camera_of(dense.x).T_WS() * scene.point_in_view(2.0, 4.0);
  const Vector2d first_pixel = *camera.project(camera_of(dense.x).T_WS().inverse() * p_W);
  predict_both(0.3);
  const auto seen = camera.project(camera_of(dense.x).T_WS().inverse() * p_W);
  if (!seen) GTEST_SKIP() << "turned away";
  const Vector2d pixel_now = *seen + Vector2d(0.3, -0.2);
  const auto id = filter.add_delayed_landmark(*clone, first_pixel, pixel_now);
  if (!id) GTEST_SKIP() << "the rays part";
  dense.augment(
      [&](const VectorXd& x, const VectorXd& n) {
        const CameraState c = camera_of(x);
        const Vector3d h_1 = from_wxyz(x.segment<4>(clone_offset + 3)).toRotationMatrix() *
                             *camera.unproject(first_pixel + n.head<2>());
        const Vector3d h_2_S = *camera.unproject(pixel_now + n.tail<2>());
        const Vector3d b = c.r_WS - x.segment<3>(clone_offset);
        const Vector3d h_2 = c.q_WS.toRotationMatrix() * h_2_S;
        const double beta = std::acos(h_1.dot(b) / (h_1.norm() * b.norm()));
        const double gamma = std::acos(-h_2.dot(b) / (h_2.norm() * b.norm()));
        const double rho = std::sin(beta + gamma) / (b.norm() * std::sin(beta));
        return landmark_at(c, h_2_S.normalized(), rho);
      },
      MatrixXd::Identity(4, 4), 1e-4);
  expect_same(1e-3);
  filter.drop_clone(*clone);
  EXPECT_EQ(filter.landmark_offset(*id), clone_offset);
  EXPECT_FALSE(filter.clone(*clone));
}

TEST_P(SideBySide, RemovalKeepsEverythingElse) {
  for (int i = 0; i < 4; ++i)
    add_both_ways(new_match());
  filter.remove_landmark(ids[1]);
  const auto drop = [](const MatrixXd& m, bool columns) {
    MatrixXd kept(m.rows() - 6, m.cols());
    kept << m.topRows(19), m.bottomRows(m.rows() - 25);
    if (!columns) return kept;
    MatrixXd both(kept.rows(), kept.cols() - 6);
    both << kept.leftCols(19), kept.rightCols(kept.cols() - 25);
    return both;
  };
  dense.x = drop(dense.x, false);
  dense.P = drop(dense.P, true);
  expect_same();
  EXPECT_FALSE(filter.contains(ids[1]));
  EXPECT_EQ(filter.landmark_offset(ids[2]), 19);
  EXPECT_EQ(filter.landmark_offset(ids[3]), 25);
  EXPECT_EQ(filter.landmark_id(1), ids[2]);
}

TEST_P(SideBySide, ConversionToAPointAgrees) {
  for (int i = 0; i < 3; ++i)
    add_both_ways(new_match());
  const auto before = filter.landmark(ids[1]);
  const auto prediction = filter.predict_pixel(ids[1]);
  ASSERT_TRUE(filter.convert_to_point(ids[1]));
  const auto after = filter.landmark(ids[1]);
  EXPECT_FALSE(after->is_inverse_depth);
  EXPECT_THAT(after->p_W, IsNearMatrix(before->p_W, 1e-12));
  EXPECT_THAT(after->p_W_covariance, IsNearMatrix(before->p_W_covariance, 1e-9));
  EXPECT_THAT(filter.predict_pixel(ids[1])->S, IsNearMatrix(prediction->S, 1e-6));
  EXPECT_EQ(filter.landmark_offset(ids[2]), 13 + 6 + 3);
  EXPECT_EQ(filter.state().size(), 13 + 6 + 3 + 6);
}

TEST_P(SideBySide, PredictedPixelsAndPointsHaveTheInnovationCovarianceOfTheUpdate) {
  for (int i = 0; i < 3; ++i)
    add_both_ways(new_match());
  for (const LandmarkId id : ids) {
    const auto pixel = filter.predict_pixel(id);
    const auto point = filter.predict_point(id);
    ASSERT_TRUE(pixel && point);
    EXPECT_NEAR(pixel->depth, point->p_S.z(), 1e-9);
    PointMeasurement exact;
    exact.p_S = point->p_S;
    exact.R.setIdentity();
    const std::array<Measurement, 2> both{Measurement::pixel(id, pixel->pixel, 1.0),
                                          Measurement::point(id, exact)};
    const JointInnovation& innovation = filter.innovation(both);
    EXPECT_LT(innovation.g().norm(), 1e-9);
    EXPECT_THAT(
        MatrixXd(innovation.S_lower().topLeftCorner<2, 2>()).triangularView<Eigen::Lower>().toDenseMatrix(),
        IsNearMatrix(MatrixXd(pixel->S).triangularView<Eigen::Lower>().toDenseMatrix(), 1e-6));
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    if (filter.options().point_form == PointForm::kInverseDistance)
      bearing_and_inverse_distance(point->p_S, &J);
    const MatrixXd S_e = J * (point->covariance + Eigen::Matrix3d::Identity()) * J.transpose();
    EXPECT_NEAR(innovation.S_lower()(4, 4), S_e(2, 2), 1e-9);
    EXPECT_NEAR(innovation.S_lower()(3, 2), S_e(1, 0), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SideBySide, testing::Range(1U, 11U));

}  // namespace
}  // namespace cosight::ekf
