#include "tests/robot_agent/vins/flight_motion.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "shared/evaluation/alignment.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Vector3d;

/// One window of the averaged periodogram.
constexpr std::size_t kWindow = 256;

Vector3d velocity(const Trajectory& T_WB, std::size_t k) {
  const double step = 0.5 * to_seconds(T_WB[k + 1].stamp - T_WB[k - 1].stamp);
  const Vector3d near = T_WB[k + 1].T_WC.p - T_WB[k - 1].T_WC.p;
  const Vector3d far = T_WB[k + 2].T_WC.p - T_WB[k - 2].T_WC.p;
  return (8.0 * near - far) / (12.0 * step);
}

/// Two-sided spectral density of `x` at one frequency, in a Hann window [unit^2/Hz].
double density_at(const std::vector<double>& x, double frequency, double rate) {
  std::complex<double> sum = 0.0;
  double power = 0.0;
  double mean = 0.0;
  for (const double value : x)
    mean += value / static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i);
    const double hann = 0.5 - 0.5 * std::cos(phase / static_cast<double>(x.size()));
    sum += hann * (x[i] - mean) * std::polar(1.0, -phase * frequency / rate);
    power += hann * hann;
  }
  return std::norm(sum) / (rate * power);
}

/// Root of the mean density of one kind of samples over axes, windows and the band's frequencies.
double mean_density(const std::vector<ImuSample>& samples, Vector3d ImuSample::*kind, double low,
                    double high) {
  const double rate =
      static_cast<double>(samples.size() - 1) / to_seconds(samples.back().stamp - samples.front().stamp);
  const double bin = rate / static_cast<double>(kWindow);
  double sum = 0.0;
  int count = 0;
  for (std::size_t start = 0; start + kWindow <= samples.size(); start += kWindow / 2) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> x;
      for (std::size_t i = 0; i < kWindow; ++i)
        x.push_back((samples[start + i].*kind)(axis));
      for (double k = std::ceil(low / bin); k * bin < high; k += 1.0) {
        sum += density_at(x, k * bin, rate);
        ++count;
      }
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace

MotionIncrement increment_of(const Trajectory& T_WB, std::size_t from, std::size_t to, double gravity) {
  const double dt = to_seconds(T_WB[to].stamp - T_WB[from].stamp);
  const Vector3d g_W(0.0, 0.0, gravity);
  const Pose& start = T_WB[from].T_WC;
  const Pose& end = T_WB[to].T_WC;
  const Vector3d v_start = velocity(T_WB, from);
  const Eigen::Quaterniond q_BW = start.q.conjugate();
  return {q_BW * (end.p - start.p - v_start * dt + 0.5 * dt * dt * g_W),
          q_BW * (velocity(T_WB, to) - v_start + dt * g_W), q_BW * end.q};
}

Vector9 difference(const MotionIncrement& a, const MotionIncrement& b) {
  Vector9 e;
  e << a.alpha - b.alpha, quaternion_log(b.gamma.conjugate() * a.gamma), a.beta - b.beta;
  return e;
}

Trajectory laid_onto(const Trajectory& truth, Trajectory poses) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < poses.size(); ++i)
    pairs.push_back({poses[i].stamp, poses[i].T_WC, truth[i].T_WC});
  const Similarity T = align(pairs, Alignment::kSim3).value();
  Vector3d mean = Vector3d::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].T_WC = T * poses[i].T_WC;
    mean += quaternion_log(poses[i].T_WC.q.conjugate() * truth[i].T_WC.q);
  }
  const Eigen::Quaterniond turn = quaternion_exp(mean / static_cast<double>(poses.size()));
  for (StampedPose& pose : poses)
    pose.T_WC.q = (pose.T_WC.q * turn).normalized();
  return poses;
}

Trajectory of_body(Trajectory T_WS, const Pose& T_BS) {
  const Pose T_SB = T_BS.inverse();
  for (StampedPose& pose : T_WS)
    pose.T_WC = pose.T_WC * T_SB;
  return T_WS;
}

ImuNoise noise_in_band(const std::vector<ImuSample>& samples, double low, double high) {
  return {.accelerometer = mean_density(samples, &ImuSample::acceleration_B, low, high),
          .gyroscope = mean_density(samples, &ImuSample::angular_velocity_B, low, high),
          .accelerometer_walk = 0.0,
          .gyroscope_walk = 0.0};
}

}  // namespace cosight::vins
