#include "shared/dataset/motion_csv.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/shared/dataset/dataset_fixture.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MotionCsv : public DatasetFixture {
 protected:
  std::vector<WearerPoseSample> poses(const std::string& csv, SourceCounters* counters = nullptr) const {
    const auto source = open_wearer_pose_csv(write("wearer_pose.csv", csv), {0.1, 0.2});
    std::vector<WearerPoseSample> samples;
    while (auto sample = source->next())
      samples.push_back(std::get<WearerPoseSample>(*sample));
    if (counters != nullptr) *counters = source->counters();
    return samples;
  }
};

TEST_F(MotionCsv, ReadsAnAhrsWithAndWithoutItsRates) {
  const auto shorter = open_ahrs_csv(write("a.csv", "stamp_ns,qx,qy,qz,qw\n5,0,0,0.6,0.8\n"), {0.01, 0.02});
  const auto first = std::get<AhrsSample>(*shorter->next());
  EXPECT_EQ(first.stamp, 5);
  EXPECT_NEAR(first.q_WH.z(), 0.6, 1e-12);
  EXPECT_NEAR(first.q_WH.w(), 0.8, 1e-12);
  EXPECT_TRUE(first.orientation_covariance.diagonal().isApprox(Eigen::Vector3d(1e-4, 1e-4, 4e-4)));
  const auto full =
      open_ahrs_csv(write("b.csv", "stamp_ns,qx,qy,qz,qw,wx,wy,wz,ax,ay,az\n5,0,0,0,1,1,2,3,4,5,6\n"));
  const auto second = std::get<AhrsSample>(*full->next());
  EXPECT_EQ(second.angular_velocity_H, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(second.acceleration_H, Eigen::Vector3d(4, 5, 6));
}

TEST_F(MotionCsv, BadAhrsRowsAreCounted) {
  const auto source = open_ahrs_csv(write("a.csv",
                                          "stamp_ns,qx,qy,qz,qw\n1,0,0,0,1\n2,nan,0,0,1\n3,0,0,0,0\n4,0,0,0\n"
                                          "0,0,0,0,1\n5,0,0,0,1\n6,0,0,0,1\n10,0,0,0,1\n"));
  EXPECT_THAT(stamps_of(all_of(*source)), ElementsAre(1, 5, 6, 10));
  EXPECT_EQ(source->counters(SampleKind::kAhrs).not_finite, 3U);
  EXPECT_EQ(source->counters().stamp_went_back, 1U);
}

TEST_F(MotionCsv, ARowFromTheFutureIsNotTheLast) {
  const auto source =
      open_ahrs_csv(write("a.csv",
                          "stamp_ns,qx,qy,qz,qw\n1000,0,0,0,1\n2000,0,0,0,1\n99000000000,0,0,0,1\n"
                          "3000,0,0,0,1\n4000,0,0,0,1\n"));
  EXPECT_THAT(stamps_of(all_of(*source)), ElementsAre(1000, 2000, 3000, 4000));
  EXPECT_EQ(source->counters().stamp_went_back, 1U);
}

TEST_F(MotionCsv, APoseWithoutCovarianceGetsTheConfiguredOne) {
  const auto samples = poses("stamp_ns,px,py,pz,qx,qy,qz,qw\n7,1,2,3,0,0,0.6,0.8\n");
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].T_SF.T.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(samples[0].T_SF.T.q.z(), 0.6, 1e-12);
  EXPECT_TRUE(samples[0].has_orientation);
  Eigen::Matrix<double, 6, 1> variances;
  variances << 0.01, 0.01, 0.01, 0.04, 0.04, 0.04;
  EXPECT_TRUE(samples[0].T_SF.covariance.isApprox(Eigen::Matrix<double, 6, 6>(variances.asDiagonal())));
}

TEST_F(MotionCsv, SixSigmasAreSquared) {
  const auto samples = poses("1,0,0,0,0,0,0,1,0.1,0.2,0.3,0.4,0.5,0.6\n");
  Eigen::Matrix<double, 6, 1> sigmas;
  sigmas << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6;
  EXPECT_TRUE(samples.at(0).T_SF.covariance.diagonal().isApprox(sigmas.cwiseAbs2()));
}

TEST_F(MotionCsv, TwentyOneEntriesAreTheUpperTriangle) {
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Identity();
  for (Eigen::Index i = 0; i < 36; ++i)
    A.data()[i] += 0.03 * static_cast<double>(i);
  const Eigen::Matrix<double, 6, 6> covariance = A * A.transpose();
  std::ostringstream row;
  row.precision(17);
  row << "1,0,0,0,0,0,0,1";
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index k = i; k < 6; ++k)
      row << ',' << covariance(i, k);
  }
  EXPECT_TRUE(poses(row.str() + "\n").at(0).T_SF.covariance.isApprox(covariance, 1e-12));
}

TEST_F(MotionCsv, APositionAloneLeavesTheQuaternionEmpty) {
  const auto samples = poses("1,1,2,3,,,,,0.1,0.1,0.1,0,0,0\n2,1,2,3,0,0,0,1,0.1,0.1,0.1,0,0,0\n");
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_FALSE(samples[0].has_orientation);
  EXPECT_EQ(samples[0].T_SF.T.p, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(samples[1].has_orientation);
}

TEST_F(MotionCsv, BadPosesAreCounted) {
  SourceCounters counters;
  const auto samples = poses(
      "stamp_ns,px,py,pz,qx,qy,qz,qw,a,b,c,d,e,f\n"
      "1,0,0,0,0,0,0,1,1,1,1,1,1,1\n"
      "2,nan,0,0,0,0,0,1,1,1,1,1,1,1\n"
      "3,0,0,0,0,,0,1,1,1,1,1,1,1\n"
      "4,0,0,0,0,0,0,2,1,1,1,1,1,1\n"
      "5,0,0,0,0,0,0,1,1,1,1,1,1,inf\n"
      "6,0,0,0,0,0,0,1,1\n"
      "1,0,0,0,0,0,0,1,1,1,1,1,1,1\n",
      &counters);
  EXPECT_EQ(samples.size(), 1U);
  EXPECT_EQ(counters.not_finite, 5U);
  EXPECT_EQ(counters.stamp_went_back, 1U);
}

TEST_F(MotionCsv, AWrongNumberOfColumnsIsAnErrorWithItsLine) {
  EXPECT_THAT(error_of<DatasetError>([&] { poses("\nstamp_ns,px,py\n1,2,3\n"); }),
              HasSubstr("wearer_pose.csv:2: has 3 columns"));
  EXPECT_THAT(error_of<DatasetError>([&] { open_ahrs_csv(write("a.csv", "1,0,0,0\n")); }),
              HasSubstr("a.csv:1: has 4 columns"));
  EXPECT_THAT(error_of<DatasetError>([&] { poses("nan,0,0,0,0,0,0,1\n"); }),
              HasSubstr(":1: neither this row"));
}

TEST_F(MotionCsv, KnownPointsMayLackTheirPixelButNotTheirPlace) {
  const auto points = read_known_points(write("k.csv", "px,py,pz,u,v\n1,2,3,4,5\n6,7,8,,\n"));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].p_W, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(points[0].pixel, Eigen::Vector2d(4, 5));
  EXPECT_FALSE(points[1].pixel);
  EXPECT_EQ(read_known_points(write("k.csv", "px,py,pz\n1,2,3\n")).size(), 1U);
  EXPECT_THAT(error_of<DatasetError>([&] { read_known_points(write("k.csv", "1,2,3,4,5\n1,2,nan,4,5\n")); }),
              HasSubstr("k.csv:2: is no surveyed point"));
}

}  // namespace
}  // namespace cosight
