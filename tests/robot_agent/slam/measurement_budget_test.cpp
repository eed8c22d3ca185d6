#include "robot_agent/slam/measurement_budget.hpp"

#include <gtest/gtest.h>

namespace cosight::slam {
namespace {

Eigen::Matrix2d circle(double sigma) {
  return sigma * sigma * Eigen::Matrix2d::Identity();
}

int admitted(const BudgetOptions& options, int state_size, double sigma) {
  MeasurementBudget budget(options, state_size, 3.0, 40);
  int count = 0;
  while (count < 1000 && budget.admit(circle(sigma)))
    ++count;
  return count;
}

TEST(MeasurementBudget, WithoutALimitEverythingFits) {
  EXPECT_EQ(admitted({}, 613, 10.0), 1000);
}

TEST(MeasurementBudget, LargerEllipsesAndLargerFiltersLeaveRoomForFewer) {
  const BudgetOptions options{.limit_ms = 4.0};
  const int usual = admitted(options, 300, 3.0);
  EXPECT_GT(usual, 20);
  EXPECT_LT(admitted(options, 300, 12.0), usual);
  EXPECT_LT(admitted(options, 900, 3.0), usual);
  EXPECT_EQ(admitted(options, 300, 1e6), admitted(options, 300, 1e3));  // the window is cut
}

TEST(MeasurementBudget, WhatFitsIsChargedAndNeverMoreThanTheLimit) {
  MeasurementBudget budget({.limit_ms = 3.0}, 300, 3.0, 40);
  EXPECT_DOUBLE_EQ(budget.spent_ms(), 2.0);
  for (int i = 0; i < 1000; ++i)
    budget.admit(circle(2.0));
  EXPECT_GT(budget.spent_ms(), 2.9);
  EXPECT_LE(budget.spent_ms(), 3.0);
}

TEST(MeasurementBudget, ADearLandmarkLeavesRoomForACheapOne) {
  MeasurementBudget budget({.limit_ms = 2.05, .patch_us = 8.0, .place_ns = 12.0, .entry_ps = 0.0}, 300, 3.0,
                           40);
  EXPECT_FALSE(budget.admit(circle(15.0)));
  EXPECT_TRUE(budget.admit(circle(1.0)));
}

}  // namespace
}  // namespace cosight::slam
