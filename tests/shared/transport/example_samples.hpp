#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <random>

#include "shared/transport/samples.hpp"

namespace cosight::transport {

/// One sample of each kind with no value like another, so that swapped fields show.
struct ExampleSamples {
  static constexpr Stamp kStamp = 1'403'715'273'262'142'976;  // a EuRoC stamp, with all its nanoseconds

  std::mt19937_64 random{7};

  double number() { return std::uniform_real_distribution<double>(0.1, 2.0)(random); }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }

  template <int N>
  Eigen::Matrix<double, N, N> covariance() {
    Eigen::Matrix<double, N, N> A;
    for (double& entry : A.reshaped())
      entry = number();
    return A * A.transpose();
  }

  UncertainPose pose() {
    UncertainPose T;
    T.T.q = Eigen::Quaterniond(number(), number(), number(), number()).normalized();
    T.T.p = vector();
    T.covariance = covariance<6>();
    return T;
  }

  ImageSample image(ImageEncoding encoding, int width, int height) {
    ImageSample sample{
        .stamp = kStamp, .sequence = 0, .encoding = encoding, .width = width, .height = height, .bytes = {}};
    sample.bytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::uint8_t& byte : sample.bytes)
      byte = static_cast<std::uint8_t>(random());
    return sample;
  }

  CameraInfoSample camera_info(Distortion distortion) {
    CameraInfoSample sample{kStamp, {}};
    sample.camera = {.fx = 458.654,
                     .fy = 457.296,
                     .cx = 367.215,
                     .cy = 248.375,
                     .width = 752,
                     .height = 480,
                     .distortion = distortion,
                     .coefficients = {}};
    const int used = distortion == Distortion::kRadtan         ? 5
                     : distortion == Distortion::kEquidistant  ? 4
                     : distortion == Distortion::kScenelibWide ? 1
                                                               : 0;
    for (int i = 0; i < used; ++i)
      sample.camera.coefficients.at(static_cast<std::size_t>(i)) = number();
    return sample;
  }

  AhrsSample ahrs() {
    const UncertainPose T = pose();
    return {kStamp, T.T.q, covariance<3>(), vector(), vector()};
  }

  LaserScanSample scan(std::size_t points) {
    const auto value = [this] { return static_cast<float>(number()); };
    LaserScanSample sample{kStamp, "laser_front", value(), value(), value(), value(), {}};
    for (std::size_t i = 0; i < points; ++i)
      sample.ranges.push_back(value());
    return sample;
  }

  ImuSample imu() { return {kStamp, vector(), vector()}; }

  WheelOdometrySample wheel_odometry() { return {kStamp, number(), number(), number(), number(), number()}; }

  WearerPoseSample wearer_pose(bool has_orientation) { return {kStamp, pose(), has_orientation}; }

  OdometrySample odometry() { return {kStamp, pose(), vector(), vector(), covariance<6>()}; }

  PointCloudSample cloud(std::size_t points) {
    PointCloudSample sample{kStamp, {}};
    const auto value = [this] { return static_cast<float>(number()); };
    for (std::size_t i = 0; i < points; ++i)
      sample.points.push_back({value(), value(), value(), value(), value()});
    return sample;
  }

  OverlapSample overlap() {
    OverlapSample sample;
    sample.stamp = kStamp;
    sample.predicted = true;
    sample.far_depth = number();
    sample.roi_in_S = {{1.5, 2.5}, {3.5, 4.5}, {5.5, 6.5}};
    sample.roi_in_F = {{7.5, 8.5}, {9.5, 10.5}, {11.5, 12.5}, {13.5, 14.5}};
    sample.described = 45;
    sample.ratio_test = 1;
    sample.epipolar = 2;
    sample.too_little_parallax = 3;
    sample.chi_squared = 4;
    sample.joint_compatibility = 5;
    sample.fused = 6;
    sample.initialised = 7;
    sample.redundant = 17;
    sample.outcome = "matched";
    return sample;
  }

  DiagnosticSample diagnostic() {
    return {kStamp, DiagnosticLevel::kError, "slam", "lost", {{"test_ratio", "0.05"}, {"resets", "3"}}};
  }

  HeartbeatSample heartbeat() {
    HeartbeatSample sample;
    sample.stamp = kStamp;
    sample.agent_id = "wearable-1";
    sample.instance_id = 0xFEDC'BA98'7654'3210;
    sample.beat = 11;
    sample.frames_sent = 12;
    sample.orientations_sent = 13;
    sample.frames = {
        .delivered = 1, .unreadable = 2, .wrong_size = 3, .not_finite = 4, .stamp_went_back = 5, .gaps = 6};
    sample.orientations = {.delivered = 21,
                           .unreadable = 22,
                           .wrong_size = 23,
                           .not_finite = 24,
                           .stamp_went_back = 25,
                           .gaps = 26};
    return sample;
  }
};

}  // namespace cosight::transport
