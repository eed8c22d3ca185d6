#pragma once

#include <gtest/gtest.h>

#include <cstddef>

#include "shared/transport/samples.hpp"

namespace cosight::transport {

// Values travel unchanged, so samples compare exactly; only a quaternion is normalised on arrival.

inline void expect_equal(const UncertainPose& a, const UncertainPose& b) {
  EXPECT_TRUE(a.T.q.coeffs().isApprox(b.T.q.coeffs(), 1e-12));
  EXPECT_EQ(a.T.p, b.T.p);
  EXPECT_EQ(a.covariance, b.covariance);
}

inline void expect_equal(const ImageSample& a, const ImageSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.encoding, b.encoding);
  EXPECT_EQ(a.bytes, b.bytes);
  if (a.encoding != ImageEncoding::kMono8) return;  // else only the encoded bytes know
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
}

inline void expect_equal(const CameraInfoSample& a, const CameraInfoSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.camera.fx, b.camera.fx);
  EXPECT_EQ(a.camera.fy, b.camera.fy);
  EXPECT_EQ(a.camera.cx, b.camera.cx);
  EXPECT_EQ(a.camera.cy, b.camera.cy);
  EXPECT_EQ(a.camera.width, b.camera.width);
  EXPECT_EQ(a.camera.height, b.camera.height);
  EXPECT_EQ(a.camera.distortion, b.camera.distortion);
  EXPECT_EQ(a.camera.coefficients, b.camera.coefficients);
}

inline void expect_equal(const AhrsSample& a, const AhrsSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_TRUE(a.q_WH.coeffs().isApprox(b.q_WH.coeffs(), 1e-12));
  EXPECT_EQ(a.orientation_covariance, b.orientation_covariance);
  EXPECT_EQ(a.angular_velocity_H, b.angular_velocity_H);
  EXPECT_EQ(a.acceleration_H, b.acceleration_H);
}

inline void expect_equal(const LaserScanSample& a, const LaserScanSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.laser, b.laser);
  EXPECT_EQ(a.angle_min, b.angle_min);
  EXPECT_EQ(a.angle_increment, b.angle_increment);
  EXPECT_EQ(a.range_min, b.range_min);
  EXPECT_EQ(a.range_max, b.range_max);
  EXPECT_EQ(a.ranges, b.ranges);
}

inline void expect_equal(const ImuSample& a, const ImuSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.angular_velocity_I, b.angular_velocity_I);
  EXPECT_EQ(a.acceleration_I, b.acceleration_I);
}

inline void expect_equal(const WheelOdometrySample& a, const WheelOdometrySample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_NEAR(a.yaw, b.yaw, 1e-12);
  EXPECT_EQ(a.speed, b.speed);
  EXPECT_EQ(a.turn_rate, b.turn_rate);
}

inline void expect_equal(const WearerPoseSample& a, const WearerPoseSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.has_orientation, b.has_orientation);
  expect_equal(a.T_SF, b.T_SF);
}

inline void expect_equal(const OdometrySample& a, const OdometrySample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  expect_equal(a.T_WS, b.T_WS);
  EXPECT_EQ(a.v_S, b.v_S);
  EXPECT_EQ(a.omega_S, b.omega_S);
  EXPECT_EQ(a.twist_covariance, b.twist_covariance);
}

inline void expect_equal(const PointCloudSample& a, const PointCloudSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].x, b.points[i].x);
    EXPECT_EQ(a.points[i].y, b.points[i].y);
    EXPECT_EQ(a.points[i].z, b.points[i].z);
    EXPECT_EQ(a.points[i].intensity, b.points[i].intensity);
    EXPECT_EQ(a.points[i].sigma, b.points[i].sigma);
  }
}

inline void expect_equal(const DiagnosticSample& a, const DiagnosticSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.values, b.values);
}

inline void expect_equal(const OverlapSample& a, const OverlapSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.predicted, b.predicted);
  EXPECT_EQ(a.far_depth, b.far_depth);
  EXPECT_EQ(a.roi_in_S, b.roi_in_S);
  EXPECT_EQ(a.roi_in_F, b.roi_in_F);
  EXPECT_EQ(a.described, b.described);
  EXPECT_EQ(a.ratio_test, b.ratio_test);
  EXPECT_EQ(a.epipolar, b.epipolar);
  EXPECT_EQ(a.too_little_parallax, b.too_little_parallax);
  EXPECT_EQ(a.chi_squared, b.chi_squared);
  EXPECT_EQ(a.joint_compatibility, b.joint_compatibility);
  EXPECT_EQ(a.fused, b.fused);
  EXPECT_EQ(a.initialised, b.initialised);
  EXPECT_EQ(a.redundant, b.redundant);
  EXPECT_EQ(a.outcome, b.outcome);
}

inline void expect_equal(const SourceCounters& a, const SourceCounters& b) {
  EXPECT_EQ(a.delivered, b.delivered);
  EXPECT_EQ(a.unreadable, b.unreadable);
  EXPECT_EQ(a.wrong_size, b.wrong_size);
  EXPECT_EQ(a.not_finite, b.not_finite);
  EXPECT_EQ(a.stamp_went_back, b.stamp_went_back);
  EXPECT_EQ(a.gaps, b.gaps);
}

inline void expect_equal(const HeartbeatSample& a, const HeartbeatSample& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.agent_id, b.agent_id);
  EXPECT_EQ(a.instance_id, b.instance_id);
  EXPECT_EQ(a.beat, b.beat);
  EXPECT_EQ(a.frames_sent, b.frames_sent);
  EXPECT_EQ(a.orientations_sent, b.orientations_sent);
  expect_equal(a.frames, b.frames);
  expect_equal(a.orientations, b.orientations);
}

}  // namespace cosight::transport
