#include "sim/sensor_plans_file.hpp"

#include <numbers>
#include <vector>

namespace cosight::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

CameraModel read_lens(const ConfigNode& node, CameraModel lens) {
  lens.width = node.integer("width_px", lens.width, 32, 4096);
  lens.height = node.integer("height_px", lens.height, 32, 4096);
  lens.fx = node.number("focal_length_px", lens.fx, 10.0, 10000.0);
  lens.fy = node.number("focal_length_y_px", lens.fx, 10.0, 10000.0);
  const std::vector<double> centre =
      node.numbers("principal_point_px", {0.5 * (lens.width - 1), 0.5 * (lens.height - 1)});
  if (centre.size() != 2) throw node.error("principal_point_px", "has to be two numbers");
  lens.cx = centre[0];
  lens.cy = centre[1];
  const std::vector<double> radtan = node.numbers("radtan", {});
  if (!radtan.empty() && radtan.size() != 4) throw node.error("radtan", "has to be [k1, k2, p1, p2]");
  lens.distortion = radtan.empty() ? Distortion::kNone : Distortion::kRadtan;
  for (std::size_t k = 0; k < radtan.size(); ++k)
    lens.coefficients.at(k) = radtan[k];
  return lens;
}

ExposurePlan read_exposure(const ConfigNode& node, ExposurePlan plan) {
  plan.gain = node.number("gain", plan.gain, 0.01, 100.0);
  plan.auto_exposure = node.number("auto_exposure", plan.auto_exposure, 0.0, 1.0);
  plan.target = node.number("target_gray", plan.target, 10.0, 245.0);
  plan.read_noise = node.number("read_noise_gray", plan.read_noise, 0.0, 50.0);
  plan.shot_noise = node.number("shot_noise_gray", plan.shot_noise, 0.0, 10.0);
  plan.vignetting = node.number("vignetting", plan.vignetting, 0.0, 1.0);
  return plan;
}

}  // namespace

TimingPlan read_timing(const ConfigNode& node, TimingPlan timing) {
  timing.rate = node.number("rate_hz", timing.rate, 0.1, 1000.0);
  timing.latency = node.number("latency_s", timing.latency, 0.0, 1.0);
  timing.jitter = node.number("jitter_s", timing.jitter, 0.0, 1.0);
  timing.drop_out = node.number("drop_out", timing.drop_out, 0.0, 1.0);
  timing.clock_offset = node.number("clock_offset_s", timing.clock_offset, -100.0, 100.0);
  timing.clock_drift = 1e-6 * node.number("clock_drift_ppm", 1e6 * timing.clock_drift, -1000.0, 1000.0);
  return timing;
}

CameraPlan read_camera(const ConfigNode& node, CameraPlan camera, const Eigen::Vector3d& otherwise_at) {
  camera.lens = read_lens(node, camera.lens);
  camera.timing = read_timing(node, camera.timing);
  camera.shutter.exposure_time = node.number("exposure_time_s", camera.shutter.exposure_time, 0.0, 0.2);
  camera.shutter.readout_time = node.number("readout_time_s", camera.shutter.readout_time, 0.0, 0.2);
  camera.shutter.blur_steps = node.integer("blur_steps", camera.shutter.blur_steps, 2, 64);
  camera.jpeg_quality = node.integer("jpeg_quality", camera.jpeg_quality, 10, 100);
  camera.exposure = read_exposure(node.section("exposure"), camera.exposure);
  camera.T_BC = optical_mount(node.vector3("at_m", otherwise_at), kDegree * node.number("left_deg", 0.0),
                              kDegree * node.number("up_deg", 0.0));
  return camera;
}

ImuPlan read_imu(const ConfigNode& node) {
  ImuPlan imu;
  imu.timing = read_timing(node, imu.timing);
  imu.T_BI.p = node.vector3("at_m", imu.T_BI.p);
  imu.gyro_density = node.number("gyro_density", imu.gyro_density, 0.0, 1.0);
  imu.gyro_bias = node.number("gyro_bias_radps", imu.gyro_bias, 0.0, 1.0);
  imu.gyro_bias_wander = node.number("gyro_bias_wander_radps", imu.gyro_bias_wander, 0.0, 1.0);
  imu.acceleration_density = node.number("acceleration_density", imu.acceleration_density, 0.0, 1.0);
  imu.acceleration_bias = node.number("acceleration_bias_mps2", imu.acceleration_bias, 0.0, 10.0);
  imu.acceleration_bias_wander =
      node.number("acceleration_bias_wander_mps2", imu.acceleration_bias_wander, 0.0, 10.0);
  imu.wander_time = node.number("wander_time_s", imu.wander_time, 0.1, 1e5);
  return imu;
}

}  // namespace cosight::sim
