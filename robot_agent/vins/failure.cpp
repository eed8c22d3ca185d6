#include "robot_agent/vins/failure.hpp"

namespace cosight::vins {

const char* to_string(Failure failure) {
  switch (failure) {
    case Failure::kNone:
      return "none";
    case Failure::kSolverFailed:
      return "solver failed";
    case Failure::kLostTracks:
      return "lost tracks";
    case Failure::kImpossibleBias:
      return "impossible bias";
    case Failure::kImuGap:
      return "IMU gap";
    case Failure::kTooFast:
      return "too fast";
    case Failure::kWrongScale:
      return "wrong scale";
    case Failure::kJumped:
      break;
  }
  return "jumped";
}

Failure detect_failure(const WindowReport& report, const FailureOptions& options) {
  const NavState& now = report.state;
  const Pose& expected = report.predicted.T_WB;
  // A comparison with NaN is false: each is written so that false is a failure.
  if (!report.solve.usable || !now.T_WB.p.allFinite() || !now.T_WB.q.coeffs().allFinite()) {
    return Failure::kSolverFailed;
  }
  if (report.tracked < options.min_tracked) return Failure::kLostTracks;
  if (!(now.bias.accelerometer.norm() < options.max_accelerometer_bias) ||
      !(now.bias.gyroscope.norm() < options.max_gyroscope_bias)) {
    return Failure::kImpossibleBias;
  }
  if (!(now.v_W.norm() < options.max_speed)) return Failure::kTooFast;
  if (contradicts(report.distances)) return Failure::kWrongScale;
  if (!((now.T_WB.p - expected.p).norm() <= options.max_position_jump) ||
      !(now.T_WB.q.angularDistance(expected.q) <= options.max_rotation_jump)) {
    return Failure::kJumped;
  }
  return Failure::kNone;
}

}  // namespace cosight::vins
