#include "robot_agent/ekf/measurement.hpp"

namespace cosight::ekf {

Measurement Measurement::pixel(LandmarkId landmark, const Eigen::Vector2d& z, double sigma) {
  Measurement m;
  m.landmark = landmark;
  m.z.head<2>() = z;
  m.R *= sigma * sigma;
  return m;
}

Measurement Measurement::point(LandmarkId landmark, const PointMeasurement& measured) {
  Measurement m;
  m.landmark = landmark;
  m.kind = MeasurementKind::kPoint;
  m.z = measured.p_S;
  m.R = measured.R;
  m.shared_factor = measured.shared_factor;
  return m;
}

Measurement Measurement::wearer_pixel(LandmarkId landmark, const Eigen::Vector2d& z, double sigma) {
  Measurement m = pixel(landmark, z, sigma);
  m.kind = MeasurementKind::kWearerPixel;
  return m;
}

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFused:
      return "fused";
    case Outcome::kUnpredictable:
      return "unpredictable";
    case Outcome::kGated:
      return "gated";
    case Outcome::kIncompatible:
      return "incompatible";
    case Outcome::kIllConditioned:
      return "ill_conditioned";
  }
  return "unknown";
}

}  // namespace cosight::ekf
