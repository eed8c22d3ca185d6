#include "shared/evaluation/consistency.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "shared/evaluation/error_statistics.hpp"
#include "tests/shared/evaluation/made_trajectory.hpp"
#include "tests/shared/evaluation/text_file.hpp"

namespace cosight {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Mean normalised error of 2000 poses whose errors are drawn from `drawn`, judged by `claimed`.
double mean_normalised_error(const Matrix6d& drawn, const Matrix6d& claimed) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const Matrix6d L = drawn.llt().matrixL();
  std::vector<PosePair> pairs;
  CovarianceLog covariances;
  for (Stamp stamp = 0; stamp < 2000; ++stamp) {
    Eigen::Matrix<double, 6, 1> error;
    for (int i = 0; i < 6; ++i)
      error(i) = normal(random);
    error = L * error;
    const Pose T = random_pose(random, 5.0);
    pairs.push_back({stamp, T, {quaternion_exp(error.tail<3>()) * T.q, T.p + error.head<3>()}});
    covariances[stamp] = claimed;
  }
  return statistics_of(normalised_errors(pairs, covariances)).mean;
}

Matrix6d some_covariance() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 0.02);
  Matrix6d A;
  for (double& entry : A.reshaped())
    entry = normal(random);
  return A * A.transpose() + 1e-5 * Matrix6d::Identity();
}

TEST(NormalisedErrors, AverageSixForAnHonestCovariance) {
  EXPECT_NEAR(mean_normalised_error(some_covariance(), some_covariance()), 6.0, 0.3);
}

TEST(NormalisedErrors, ExposeAnOverconfidentCovariance) {
  EXPECT_GT(mean_normalised_error(some_covariance(), some_covariance() / 3.0), 15.0);
}

TEST(NormalisedErrors, LeaveOutPosesWithoutOrWithSingularCovariance) {
  const auto pairs = pairs_of(straight_line(3, 1.0), straight_line(3, 1.0));
  CovarianceLog covariances;
  covariances[pairs[0].stamp] = Matrix6d::Identity();
  covariances[pairs[1].stamp] = Matrix6d::Zero();
  EXPECT_EQ(normalised_errors(pairs, covariances).size(), 1U);
}

TEST(CovarianceLog, IsReadFromTheUpperTriangle) {
  std::string header = "stamp_ns";
  std::string row = "7";
  for (int i = 0, entry = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j, ++entry) {
      header += ",c";
      header += std::to_string(i);
      header += std::to_string(j);
      row += ",";
      row += std::to_string(entry);
    }
  }
  const TextFile file("covariances", header + "\n" + row + "\n");
  const CovarianceLog log = read_covariance_log(file.path());
  ASSERT_EQ(log.size(), 1U);
  EXPECT_EQ(log.at(7)(0, 5), 5.0);
  EXPECT_EQ(log.at(7)(5, 0), 5.0);
  EXPECT_EQ(log.at(7)(5, 5), 20.0);
}

}  // namespace
}  // namespace cosight
