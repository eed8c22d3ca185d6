#include "tests/robot_agent/slam/two_camera_world.hpp"

#include <cmath>
#include <numbers>

#include "robot_agent/vision/corner_detector.hpp"
#include "sim/render/exposure.hpp"
#include "sim/render/renderer.hpp"
#include "sim/scenario.hpp"
#include "sim/world/floor_plan.hpp"

namespace cosight::slam {
namespace {

sim::Scene furnished_room() {
  sim::FloorPlan plan;
  plan.outlines.push_back(
      {{{-2.0, -2.0}, {7.0, -2.0}, {7.0, 2.2}, {-2.0, 2.2}}, sim::Material::kConcrete, 1.0});
  plan.boxes.push_back({{4.5, 1.3}, {0.8, 0.6, 1.3}, 0.4, 0.0, sim::Material::kWood});
  plan.boxes.push_back({{5.0, -1.2}, {0.6, 0.8, 1.6}, -0.3, 0.0, sim::Material::kConcrete});
  plan.texel = 0.01;
  return build_scene(plan, 7);
}

double seconds(int frame) {
  return to_seconds(frame * TwoCameraWorld::kInterval);
}

/// What a corner of the image shows.
std::vector<KnownPoint> surveyed(const sim::Scene& scene, const CameraModel& camera, const GrayImage& image,
                                 const Pose& T_WC) {
  vision::CornerOptions options;
  options.min_distance = 35.0;
  std::vector<KnownPoint> points;
  for (const vision::Corner& corner : vision::CornerDetector(options).detect(image, {}, 12)) {
    const Eigen::Vector3d ray = T_WC.q * *camera.unproject(corner.pixel);
    if (const auto hit = cast_ray(scene.quads, T_WC.p, ray))
      points.push_back({T_WC.p + hit->range * ray, corner.pixel});
  }
  return points;
}

}  // namespace

const TwoCameraWorld& TwoCameraWorld::instance() {
  static const TwoCameraWorld world;
  return world;
}

TwoCameraWorld::TwoCameraWorld()
    : camera_{.fx = 230, .fy = 230, .cx = 159.5, .cy = 119.5, .width = 320, .height = 240} {
  const sim::Scene scene = furnished_room();
  const sim::Camera lens(camera_);
  sim::Renderer renderer(lens);
  const sim::Exposure robot_sensor({}, 1);
  const sim::Exposure worn_sensor({}, 2);
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto number = static_cast<std::uint64_t>(frame);
    FrameBundle bundle;
    bundle.stamp = kFirstStamp + frame * kInterval;
    bundle.sequence = number;
    bundle.image =
        std::make_shared<GrayImage>(robot_sensor.expose(renderer.render(scene.quads, T_WS(frame)), number));
    WearerView& wearer = bundle.wearer.emplace();
    wearer.stamp = bundle.stamp;
    wearer.image =
        std::make_shared<GrayImage>(worn_sensor.expose(renderer.render(scene.quads, T_WF(frame)), number));
    wearer.camera = camera_;
    wearer.T_SF.T = T_WS(frame).inverse() * T_WF(frame);
    constexpr double kSigmaPosition = 2e-3;                           // [m]
    constexpr double kSigmaRotation = 0.03 * std::numbers::pi / 180;  // [rad]
    wearer.T_SF.covariance.diagonal().head<3>().setConstant(kSigmaPosition * kSigmaPosition);
    wearer.T_SF.covariance.diagonal().tail<3>().setConstant(kSigmaRotation * kSigmaRotation);
    bundles_.push_back(std::move(bundle));
  }
  known_points_ = surveyed(scene, camera_, *bundles_.front().image, T_WS(0));
}

Pose TwoCameraWorld::T_WS(int frame) const {
  const double t = seconds(frame);
  return sim::optical_mount({-1.0 + 0.6 * t, 0.15 * std::sin(0.8 * t), 0.8}, 0.1 * std::sin(0.9 * t), 0.02);
}

Pose TwoCameraWorld::T_WF(int frame) const {
  const double t = seconds(frame);
  return sim::optical_mount({-0.8 + 0.6 * t, 0.5 + 0.1 * std::sin(1.1 * t), 1.1 + 0.02 * std::sin(9.0 * t)},
                            -0.08 + 0.05 * std::sin(0.7 * t), -0.03);
}

double TwoCameraWorld::path_length(int first, int last) const {
  double length = 0.0;
  for (int frame = first; frame < last; ++frame)
    length += (T_WS(frame + 1).p - T_WS(frame).p).norm();
  return length;
}

FrameBundle TwoCameraWorld::without_wearer(int frame) const {
  FrameBundle result = bundle(frame);
  result.wearer.reset();
  return result;
}

FrameBundle TwoCameraWorld::without_image(int frame) const {
  FrameBundle result = bundle(frame);
  result.image.reset();
  return result;
}

SlamOptions TwoCameraWorld::options() const {
  SlamOptions options;
  options.start.T_WS = T_WS(0);
  options.pseudo_stereo.interval_s = 0.0;  // every frame counts
  return options;
}

}  // namespace cosight::slam
