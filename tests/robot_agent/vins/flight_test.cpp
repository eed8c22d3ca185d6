// A real flight: Vicon truth, a 20 Hz camera and a 200 Hz IMU (euroc_v101_flight).
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "robot_agent/vins/adaptive_vins.hpp"
#include "robot_agent/vins/feature_tracker.hpp"
#include "shared/config/calibration.hpp"
#include "shared/evaluation/error_statistics.hpp"
#include "shared/evaluation/evaluation.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "tests/robot_agent/vins/flight_data.hpp"

namespace cosight::vins {
namespace {

VinsOptions euroc_options() {
  VinsOptions options;
  options.noise = flight_noise();
  options.window.solver.graph.trust.pixel_noise = 0.3;
  return options;
}

TEST(RealFlight, InitialisesWithinTwoSecondsAndStaysWithinThreeCentimetres) {
  if (!std::filesystem::exists(flight())) GTEST_SKIP() << flight() << " is not there";
  const CameraModel camera = load_camera_model(flight() / "calib.yaml");
  const Pose T_BS = load_body_extrinsics(flight() / "calib.yaml").value();
  AdaptiveVins vins(euroc_options(), T_BS);
  for (const ImuSample& sample : flight_imu())
    vins.add_imu(sample);
  FeatureTracker tracker(camera, {});
  const std::vector<FeatureFrame> frames = flight_features(tracker);
  ASSERT_EQ(frames.size(), 90U);

  Trajectory estimate;
  for (const FeatureFrame& frame : frames) {
    const VinsEstimate now = vins.process(frame);
    if (now.status == VinsStatus::kTracking) estimate.push_back({frame.stamp, now.report->state.T_WB * T_BS});
  }
  ASSERT_FALSE(estimate.empty());
  const double until_ready = to_seconds(estimate.front().stamp - frames.front().stamp);
  EvaluationOptions compare;
  compare.alignment = Alignment::kSe3;
  const Evaluation result = evaluate(estimate, read_trajectory(flight() / "gt_cam0.tum"), compare);
  const double ate = statistics_of(result.position_errors).rmse;
  RecordProperty("until_ready_s", std::to_string(until_ready));
  RecordProperty("ate_m", std::to_string(ate));
  std::printf("ready after %.2f s, ATE %.4f m over %zu frames\n", until_ready, ate, result.pairs.size());
  EXPECT_LE(until_ready, 2.0);
  EXPECT_LE(ate, 0.03);
}

}  // namespace
}  // namespace cosight::vins
