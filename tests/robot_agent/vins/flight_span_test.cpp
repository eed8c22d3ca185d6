// How far the covariance of a pre-integration can be believed on a real flight (euroc_v101_flight): IMU alone
// over 0.5 s against the truth, with every other error of the comparison measured and stated.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "robot_agent/vins/feature_tracker.hpp"
#include "shared/config/calibration.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "tests/robot_agent/vins/flight_bundle.hpp"
#include "tests/robot_agent/vins/flight_data.hpp"
#include "tests/robot_agent/vins/flight_motion.hpp"

namespace cosight::vins {
namespace {

constexpr std::size_t kSpan = 10;  ///< steps of the truth's 20 Hz
constexpr double kGravity = 9.81;

/// What no span knows of itself and the other spans tell: accelerometer bias (m/s^2), gyroscope bias (rad/s),
/// and how far gravity leans in the truth's world, x and y (m/s^2).
constexpr int kCalibration = 8;
using CalibrationVector = Eigen::Matrix<double, kCalibration, 1>;
using CalibrationMatrix = Eigen::Matrix<double, kCalibration, kCalibration>;
using CalibrationJacobian = Eigen::Matrix<double, 9, kCalibration>;

/// Half a second of IMU against the truth.
struct Span {
  std::size_t start = 0;   ///< index of the truth
  Vector9 error;           ///< IMU minus truth
  CalibrationJacobian J;   ///< d error / d calibration
  Matrix9 own_covariance;  ///< of the pre-integration
};

/// What the flight says of the truth's error in an increment, by the camera.
struct TruthNoise {
  Matrix9 covariance = Matrix9::Zero();  ///< second moments of camera minus truth
  Vector9 camera = Vector9::Zero();      ///< deviations of the camera's part in it, from two halves of it
};

std::vector<Span> spans(const ImuNoise& noise, const CalibrationVector& calibration) {
  const Trajectory truth = read_trajectory(flight() / "gt_body.tum");
  ImuBuffer imu;
  for (const ImuSample& sample : flight_imu())
    imu.push(sample);
  std::vector<Span> out;
  for (std::size_t k = kStencil; k + kSpan + kStencil < truth.size(); ++k) {
    const Stamp from = truth[k].stamp;
    const Stamp to = truth[k + kSpan].stamp;
    if (!imu.covers(from, to)) continue;
    const Preintegration measured(imu.between(from, to), {calibration.head<3>(), calibration.segment<3>(3)},
                                  noise);
    Span span{.start = k,
              .error = difference(measured.increment(), increment_of(truth, k, k + kSpan, kGravity)),
              .J = CalibrationJacobian::Zero(),
              .own_covariance = measured.covariance().topLeftCorner<9, 9>()};
    span.J.leftCols<6>() = measured.jacobian().block<9, 6>(0, Preintegration::kAccelerometerBias);
    const Eigen::Matrix<double, 3, 2> lean = truth[k].T_WC.q.toRotationMatrix().transpose().leftCols<2>();
    const double dt = measured.duration();
    span.J.block<3, 2>(Preintegration::kAlpha, 6) = -0.5 * dt * dt * lean;
    span.J.block<3, 2>(Preintegration::kBeta, 6) = -dt * lean;
    span.error += span.J.rightCols<2>() * calibration.tail<2>();
    out.push_back(std::move(span));
  }
  return out;
}

/// Bundle adjustment of the images, in two halves that share no feature, says how wrong the truth is: camera
/// and truth have no sensor in common.
TruthNoise measure_truth_noise() {
  const Pose T_BS = load_body_extrinsics(flight() / "calib.yaml").value();
  const Trajectory truth = read_trajectory(flight() / "gt_cam0.tum");
  FeatureTracker tracker(load_camera_model(flight() / "calib.yaml"),
                         {.max_features = 300, .min_distance = 15.0});
  const std::vector<FeatureFrame> frames = flight_features(tracker);
  const Trajectory truth_B = of_body(truth, T_BS);
  std::array<Trajectory, 2> halves;
  for (FeatureId half = 0; half < 2; ++half) {
    halves.at(half) = of_body(laid_onto(truth, bundle_adjust(half_of(frames, half), truth)), T_BS);
  }
  TruthNoise noise;
  double count = 0.0;
  for (std::size_t k = kStencil; k + kSpan + kStencil < truth.size(); ++k) {
    const MotionIncrement expected = increment_of(truth_B, k, k + kSpan, kGravity);
    const Vector9 first = difference(increment_of(halves[0], k, k + kSpan, kGravity), expected);
    const Vector9 second = difference(increment_of(halves[1], k, k + kSpan, kGravity), expected);
    noise.covariance += 0.25 * (first + second) * (first + second).transpose();
    noise.camera += 0.25 * (first - second).cwiseAbs2();
    count += 1.0;
  }
  noise.covariance /= count;
  noise.camera = (noise.camera / count).cwiseSqrt();
  return noise;
}

/// The calibration from those spans that share no truth with `but` (all without it), and its covariance.
/// Each span overlaps kSpan others, so it counts as that part of one.
std::pair<CalibrationVector, CalibrationMatrix> calibrate(const std::vector<Span>& spans,
                                                          const Matrix9& truth_covariance, const Span* but) {
  CalibrationMatrix H = CalibrationMatrix::Zero();
  CalibrationVector b = CalibrationVector::Zero();
  for (const Span& span : spans) {
    const std::size_t apart =
        but == nullptr ? spans.size() : std::max(span.start, but->start) - std::min(span.start, but->start);
    if (apart <= kSpan + 2 * kStencil) continue;
    const Matrix9 S = span.own_covariance + truth_covariance;
    const CalibrationJacobian weighted = S.llt().solve(span.J);
    H += span.J.transpose() * weighted / static_cast<double>(kSpan);
    b -= weighted.transpose() * span.error / static_cast<double>(kSpan);
  }
  const CalibrationMatrix covariance = H.inverse();
  return {covariance * b, covariance};
}

struct Shares {
  std::array<double, 9> axes{};     ///< |e_i| <= 3 sigma_i
  std::array<double, 3> parts{};    ///< position, rotation, velocity: chi^2 of 3
  double all = 0.0;                 ///< chi^2 of 9
  Vector9 rms = Vector9::Zero();    ///< of the errors
  Vector9 sigma = Vector9::Zero();  ///< root mean square of what they are held against
};

/// Limits of chi^2 with the probability of 3 sigma, 99.73 %.
constexpr double kLimitOf3 = 14.16;
constexpr double kLimitOf9 = 25.26;

void count(const Vector9& e, const Matrix9& S, double share, Shares& shares) {
  for (int i = 0; i < 9; ++i)
    shares.axes.at(static_cast<std::size_t>(i)) += e(i) * e(i) <= 9.0 * S(i, i) ? share : 0.0;
  for (int part = 0; part < 3; ++part) {
    const Eigen::Vector3d e_part = e.segment<3>(3 * part);
    const Eigen::Matrix3d S_part = S.block<3, 3>(3 * part, 3 * part);
    shares.parts.at(static_cast<std::size_t>(part)) +=
        e_part.dot(S_part.llt().solve(e_part)) <= kLimitOf3 ? share : 0.0;
  }
  shares.all += e.dot(S.llt().solve(e)) <= kLimitOf9 ? share : 0.0;
  shares.rms += share * e.cwiseAbs2();
  shares.sigma += share * S.diagonal();
}

/// The errors of all spans, counted against their own covariance, and against that of everything that is in
/// the comparison.
struct Result {
  Shares own, whole;
};

Result compare(const ImuNoise& noise, const Matrix9& truth_covariance) {
  CalibrationVector near = CalibrationVector::Zero();
  for (int pass = 0; pass < 2; ++pass)
    near += calibrate(spans(noise, near), truth_covariance, nullptr).first;
  const std::vector<Span> all = spans(noise, near);
  Result result;
  for (const Span& span : all) {
    const auto [change, covariance] = calibrate(all, truth_covariance, &span);
    const Vector9 e = span.error + span.J * change;
    const double share = 1.0 / static_cast<double>(all.size());
    count(e, span.own_covariance, share, result.own);
    count(e, span.own_covariance + truth_covariance + span.J * covariance * span.J.transpose(), share,
          result.whole);
  }
  for (Shares* shares : {&result.own, &result.whole}) {
    shares->rms = shares->rms.cwiseSqrt();
    shares->sigma = shares->sigma.cwiseSqrt();
  }
  std::printf("%zu spans; biases and leaning of gravity:", all.size());
  for (const double x : near)
    std::printf(" %.4f", x);
  std::printf("\n");
  return result;
}

void print(const char* name, const Shares& shares) {
  std::printf("%-28s position %.3f rotation %.3f velocity %.3f all %.3f | axes", name, shares.parts[0],
              shares.parts[1], shares.parts[2], shares.all);
  for (const double share : shares.axes)
    std::printf(" %.3f", share);
  std::printf("\n  rms   [mm, mrad, mm/s]");
  for (const double x : shares.rms)
    std::printf(" %.2f", 1e3 * x);
  std::printf("\n  sigma [mm, mrad, mm/s]");
  for (const double x : shares.sigma)
    std::printf(" %.2f", 1e3 * x);
  std::printf("\n");
}

TEST(RealSpans, LieWithinThreeSigmaOnceTheNoiseOfFlightAndOfTheTruthAreCounted) {
  if (!std::filesystem::exists(flight())) GTEST_SKIP() << flight() << " is not there";
  const TruthNoise truth = measure_truth_noise();
  const ImuNoise sheet = flight_noise();
  ImuNoise in_flight = noise_in_band(flight_imu(), 40.0, 60.0);
  in_flight.accelerometer_walk = sheet.accelerometer_walk;
  in_flight.gyroscope_walk = sheet.gyroscope_walk;
  std::printf("density of 40-60 Hz: accelerometer %.2e, gyroscope %.2e\n", in_flight.accelerometer,
              in_flight.gyroscope);
  std::printf("truth against camera and camera alone [mm, mrad, mm/s]\n");
  for (int i = 0; i < 9; ++i)
    std::printf("  %.2f (%.2f)", 1e3 * std::sqrt(truth.covariance(i, i)), 1e3 * truth.camera(i));
  std::printf("\n");
  const Result by_sheet = compare(sheet, truth.covariance);
  const Result by_flight = compare(in_flight, truth.covariance);
  print("data sheet alone", by_sheet.own);
  print("data sheet and truth", by_sheet.whole);
  print("noise in flight alone", by_flight.own);
  print("noise in flight and truth", by_flight.whole);
  EXPECT_LT(by_sheet.whole.all, 0.9) << "noise ten times too small is seen beside the truth's";
  for (const double share : by_flight.whole.axes)
    EXPECT_GE(share, 0.99);
  for (const double share : by_flight.whole.parts)
    EXPECT_GE(share, 0.99);
  EXPECT_GE(by_flight.whole.all, 0.99);
}

}  // namespace
}  // namespace cosight::vins
