// A measured twist in the filter: against the textbook filter, and where the two contradict each other.
#include <gtest/gtest.h>

#include "tests/robot_agent/ekf/side_by_side.hpp"

namespace cosight::ekf {
namespace {

using Eigen::VectorXd;

class FilterTwistSideBySide : public SideBySide {};

TEST_P(FilterTwistSideBySide, MovesTheWholeStateAsTheTextbookSays) {
  add_both_ways(new_match());
  predict_both(0.1);
  UncertainTwist measured;
  const auto twist_of = [this](const VectorXd& x) {
    const CameraState c = camera_of(x);
    VectorXd twist(6);
    twist << c.q_WS.toRotationMatrix().transpose() * c.v_W, c.omega_S;
    return twist;
  };
  const VectorXd z = twist_of(dense.x) + 0.01 * scene.normals(6);
  measured.v_S = z.head<3>();
  measured.omega_S = z.tail<3>();
  measured.covariance = scene.covariance(6, 0.02);
  const TwistReport report = filter.update_twist(measured);
  EXPECT_EQ(report.outcome, Outcome::kFused);
  dense.update(twist_of, z, measured.covariance);
  expect_same();
}

INSTANTIATE_TEST_SUITE_P(Seeds, FilterTwistSideBySide, testing::Range(1U, 11U));

TEST(FilterTwist, OneThatContradictsTheFilterIsGatedAndChangesNothing) {
  FilterOptions options;
  options.gate_probability = 0.99;
  Filter filter(RandomScene(1).camera(), options);
  filter.reset(UncertainPose{}, 0.1, 0.1);
  const VectorXd before = filter.state().x();
  UncertainTwist measured;
  measured.v_S.x() = 2.0;
  measured.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
  const TwistReport report = filter.update_twist(measured);
  EXPECT_EQ(report.outcome, Outcome::kGated);
  EXPECT_GT(report.nis, report.gate);
  EXPECT_EQ(filter.state().x(), before);
}

}  // namespace
}  // namespace cosight::ekf
