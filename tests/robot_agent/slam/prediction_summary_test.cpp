#include "robot_agent/slam/prediction_summary.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cosight::slam {
namespace {

ekf::PixelPrediction prediction(double depth, double sigma) {
  ekf::PixelPrediction result;
  result.depth = depth;
  result.S = sigma * sigma * Eigen::Matrix2d::Identity();
  return result;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PredictionSummary, TakesTheMiddleOfTheDepthsThatThereAre) {
  EXPECT_EQ(usual_depth({prediction(2.0, 1.0), prediction(9.0, 1.0), prediction(3.0, 1.0),
                         prediction(kInfinity, 1.0), prediction(-1.0, 1.0)}),
            3.0);
  EXPECT_EQ(usual_depth({prediction(kInfinity, 1.0)}), 4.0) << "a room";
}

TEST(PredictionSummary, ExpectsNothingNearerThanHalfOfTheNearest) {
  EXPECT_EQ(expected_near({prediction(8.0, 1.0), prediction(3.0, 1.0), prediction(-2.0, 1.0)}), 1.5);
  EXPECT_EQ(expected_near({}), 0.0);
}

TEST(PredictionSummary, TakesTheMiddleOfTheStandardDeviations) {
  EXPECT_DOUBLE_EQ(median_sigma({prediction(1.0, 5.0), prediction(1.0, 1.0), prediction(1.0, 40.0)}), 5.0);
}

}  // namespace
}  // namespace cosight::slam
