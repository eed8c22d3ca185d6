#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#include "robot_agent/outbox/conversions.hpp"
#include "robot_agent/outbox/duration_histogram.hpp"
#include "robot_agent/outbox/frame_log.hpp"
#include "robot_agent/outbox/publisher.hpp"
#include "robot_agent/outbox/run_statistics.hpp"
#include "robot_agent/outbox/status_text.hpp"
#include "robot_agent/outbox/yaml_text.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::outbox {
namespace {

using ::testing::HasSubstr;

FrameEstimate tracked(double seconds, double x = 0.0) {
  FrameEstimate estimate;
  estimate.stamp = from_seconds(seconds);
  estimate.tracking = Tracking::kTracking;
  estimate.T_WS.T.p.x() = x;
  return estimate;
}

std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> result;
  std::stringstream stream(row + ",");
  for (std::string cell; std::getline(stream, cell, ',');)
    result.push_back(cell);
  return result;
}

std::string cell(const std::string& column, const FrameBundle& bundle, const FrameEstimate& estimate) {
  const auto names = cells(frame_log_header());
  const auto values = cells(frame_log_row(bundle, estimate));
  EXPECT_EQ(names.size(), values.size());
  const auto place = std::find(names.begin(), names.end(), column);
  return place == names.end() ? "no such column" : values.at(static_cast<std::size_t>(place - names.begin()));
}

TEST(DurationHistogram, QuantilesAreWithinOnePercent) {
  DurationHistogram histogram;
  for (int i = 1; i <= 1'000; ++i)
    histogram.add(0.1 * i);
  EXPECT_NEAR(histogram.quantile(0.5), 50.0, 0.5);
  EXPECT_NEAR(histogram.quantile(0.99), 99.0, 1.0);
  EXPECT_DOUBLE_EQ(histogram.quantile(1.0), 100.0);
  EXPECT_NEAR(histogram.mean(), 50.05, 1e-9);
}

TEST(DurationHistogram, TakesWhatNoClockShouldSay) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  for (const double odd : {0.0, -1.0, 1e30, std::numeric_limits<double>::quiet_NaN()})
    histogram.add(odd);
  EXPECT_EQ(histogram.count(), 3U);
}

TEST(YamlText, ReadsBackAsItWasGiven) {
  YamlText text;
  text.value("name", "a \"quoted\" \\ line\nend").value("nothing", std::nan("")).value("yes", true);
  text.section("part").value("count", std::uint64_t{12}).value("share", 0.25).top().value("last", 1.5);
  const YAML::Node node = YAML::Load(text.text());
  EXPECT_EQ(node["name"].as<std::string>(), "a \"quoted\" \\ line\nend");
  EXPECT_TRUE(node["nothing"].IsNull());
  EXPECT_TRUE(node["yes"].as<bool>());
  EXPECT_EQ(node["part"]["count"].as<int>(), 12);
  EXPECT_EQ(node["part"]["share"].as<double>(), 0.25);
  EXPECT_EQ(node["last"].as<double>(), 1.5);
}

TEST(FrameLog, EveryColumnHasItsValue) {
  FrameBundle bundle;
  bundle.image = std::make_shared<GrayImage>(GrayImage{100, 50, std::vector<std::uint8_t>(5'000)});
  bundle.decode_ms = 1.5;
  FrameEstimate estimate = tracked(12.0);
  estimate.overlap.predicted = true;
  estimate.overlap.roi_in_S = {{0, 0}, {50, 0}, {50, 50}, {0, 50}};
  estimate.pseudo_stereo_outcome = PseudoStereoOutcome::kEpipolar;
  estimate.pseudo_stereo.fused = 4;
  estimate.timings.total = 6.0;
  estimate.T_WS.covariance.diagonal() << 0.01, 0.02, 0.06, 0, 0, 0;
  EXPECT_EQ(cell("stamp_ns", bundle, estimate), "12000000000");
  EXPECT_EQ(cell("tracking", bundle, estimate), "tracking");
  EXPECT_EQ(cell("overlap", bundle, estimate), "1");
  EXPECT_EQ(cell("outcome", bundle, estimate), "epipolar");
  EXPECT_EQ(cell("roi_share_of_S", bundle, estimate), "0.5");
  EXPECT_EQ(cell("roi_share_of_F", bundle, estimate), "");
  EXPECT_EQ(cell("fused", bundle, estimate), "4");
  EXPECT_EQ(cell("position_sigma_m", bundle, estimate), "0.3");
  EXPECT_EQ(cell("worn_delay_ms", bundle, estimate), "");
}

TEST(FrameLog, DecodingIsPartOfTheFrameAndCountsOnce) {
  FrameBundle bundle;
  bundle.decode_ms = 1.5;
  FrameEstimate estimate;
  estimate.timings.total = 6.0;
  EXPECT_EQ(frame_ms(bundle, estimate), 7.5);
  estimate.timings.decode = 1.5;
  EXPECT_EQ(frame_ms(bundle, estimate), 6.0);
}

TEST(FrameLog, ValuesThatAreNotFiniteLeaveTheCellEmpty) {
  FrameEstimate estimate;
  estimate.nis_per_dof = std::nan("");
  estimate.T_WS.covariance(0, 0) = -1.0;
  EXPECT_EQ(cell("nis_per_dof", {}, estimate), "");
  EXPECT_EQ(cell("position_sigma_m", {}, estimate), "");
}

TEST(TrajectoryLine, KeepsTheNanosecondOfTheStamp) {
  FrameEstimate estimate;
  estimate.stamp = 1'403'715'285'262'143'135;
  estimate.T_WS.T.p = {1.25, -2.0, 3.5};
  EXPECT_EQ(trajectory_line(estimate.stamp, estimate.T_WS.T), "1403715285.262143135 1.25 -2 3.5 0 0 0 1");
}

TEST(RunStatistics, AddsUpWhatFramesSaid) {
  RunStatistics statistics;
  FrameBundle bundle;
  bundle.image = std::make_shared<GrayImage>();
  FrameEstimate estimate = tracked(1.0, 0.0);
  statistics.add({}, estimate);
  estimate = tracked(2.0, 3.0);
  estimate.overlap.predicted = true;
  estimate.pseudo_stereo.fused = 5;
  estimate.pseudo_stereo_outcome = PseudoStereoOutcome::kMatched;
  statistics.add(bundle, estimate);
  estimate = tracked(3.0, 100.0);
  estimate.tracking = Tracking::kLost;
  statistics.add(bundle, estimate);
  statistics.add(bundle, tracked(5.0, 200.0));
  YamlText text;
  statistics.report(text);
  const YAML::Node node = YAML::Load(text.text());
  EXPECT_EQ(node["frames"].as<int>(), 4);
  EXPECT_EQ(node["frames_without_image"].as<int>(), 1);
  EXPECT_EQ(node["duration_s"].as<double>(), 4.0);
  EXPECT_EQ(node["path_m"].as<double>(), 3.0);  // the way while lost is not walked
  EXPECT_EQ(node["frames_lost"].as<int>(), 1);
  EXPECT_EQ(node["overlap_ratio"].as<double>(), 0.25);
  EXPECT_EQ(node["pseudo_stereo"]["fused"].as<int>(), 5);
  EXPECT_EQ(node["pseudo_stereo_outcomes"]["matched"].as<int>(), 1);
  EXPECT_EQ(node["pseudo_stereo_outcomes"]["no_wearer_image"].as<int>(), 3);
}

TEST(Conversions, VelocityAndItsCovarianceTurnIntoTheCameraAxes) {
  FrameEstimate estimate;
  estimate.T_WS.T.q = quaternion_exp({0, 0, M_PI / 2});  // x of S is y of W
  estimate.v_W = {0, 2, 0};
  estimate.twist_covariance.diagonal() << 1, 4, 9, 16, 25, 36;
  const OdometrySample sample = odometry_of(estimate);
  EXPECT_TRUE(sample.v_S.isApprox(Eigen::Vector3d(2, 0, 0), 1e-12));
  Eigen::Matrix<double, 6, 1> expected;
  expected << 4, 1, 9, 16, 25, 36;
  EXPECT_TRUE(sample.twist_covariance.diagonal().isApprox(expected, 1e-12));
}

TEST(Conversions, TheMapKeepsPositionBrightnessAndUncertainty) {
  MapPoint point;
  point.p_W = {1, 2, 3};
  point.covariance = 0.04 * Eigen::Matrix3d::Identity();
  point.intensity = 77;
  const PointCloudSample sample = cloud_of(5, std::vector{point});
  ASSERT_EQ(sample.points.size(), 1U);
  EXPECT_EQ(sample.points[0].z, 3.0F);
  EXPECT_EQ(sample.points[0].intensity, 77.0F);
  EXPECT_FLOAT_EQ(sample.points[0].sigma, 0.2F);
}

TEST(Throttle, LetsOneThroughInAnInterval) {
  Throttle throttle(100);
  EXPECT_TRUE(throttle.due(1'000));
  EXPECT_FALSE(throttle.due(1'099));
  EXPECT_TRUE(throttle.due(1'100));
  EXPECT_TRUE(throttle.due(5));  // the clock was set back
}

TEST(StatusText, AveragesSinceTheLineBefore) {
  StatusText status(from_seconds(1.0));
  FrameEstimate estimate = tracked(0.0);
  estimate.landmarks = 41;
  estimate.timings.total = 8.0;
  for (int i = 0; i < 10; ++i) {
    estimate.stamp = from_seconds(0.1 * i);
    estimate.overlap.predicted = i >= 5;
    EXPECT_FALSE(status.update({}, estimate, {}, from_seconds(50 + 0.1 * i))) << i;
  }
  estimate.stamp = from_seconds(1.0);
  const auto line = status.update({}, estimate, {.lost = 3}, from_seconds(51.0));
  ASSERT_TRUE(line);
  EXPECT_EQ(*line, "tracking  1.0 s  11.0 frames/s  8.0 ms  41 landmarks  overlap 54 %  matches 0  lost 3");
}

TEST(StatusText, SaysHowTheWearersFramesComeOnceThereAreAny) {
  StatusText status(0);
  const LinkState link{.lost = 0, .worn_behind = from_seconds(0.0142), .wearer_offset = from_seconds(-0.25)};
  const auto line = status.update({}, tracked(0.0), link, from_seconds(51.0));
  ASSERT_TRUE(line);
  EXPECT_TRUE(line->ends_with("lost 0  worn +14 ms  clock -250.0 ms")) << *line;
}

}  // namespace
}  // namespace cosight::outbox
