#include "tests/bench/rendered_walk.hpp"

#include <cmath>
#include <memory>

#include "sim/parallel.hpp"
#include "sim/render/exposure.hpp"
#include "sim/render/renderer.hpp"
#include "sim/scenario.hpp"
#include "sim/sensors/tracker.hpp"
#include "sim/world/floor_plan.hpp"

namespace cosight::bench {
namespace {

constexpr Stamp kInterval = kNanosecondsPerSecond / 20;

double seconds(int frame) {
  return to_seconds(frame * kInterval);
}

sim::Scene hall() {
  sim::FloorPlan plan;
  plan.outlines.push_back(
      {{{-2.0, -3.0}, {12.0, -3.0}, {12.0, 3.0}, {-2.0, 3.0}}, sim::Material::kConcrete, 1.0});
  plan.boxes.push_back({{6.5, 1.6}, {0.8, 0.6, 1.3}, 0.4, 0.0, sim::Material::kWood});
  plan.boxes.push_back({{7.5, -1.6}, {0.6, 0.8, 1.6}, -0.3, 0.0, sim::Material::kConcrete});
  plan.boxes.push_back({{9.5, 0.4}, {0.9, 0.9, 1.1}, 0.2, 0.0, sim::Material::kWood});
  return build_scene(plan, 7);
}

Pose T_WF(int frame) {
  const double t = seconds(frame);
  return sim::optical_mount({0.2 + 0.6 * t, 0.6 + 0.1 * std::sin(1.1 * t), 1.4 + 0.02 * std::sin(9.0 * t)},
                            -0.08 + 0.05 * std::sin(0.7 * t), -0.05);
}

}  // namespace

Pose RenderedWalk::T_WS(int frame) {
  const double t = seconds(frame);
  return sim::optical_mount({0.6 * t, 0.15 * std::sin(0.8 * t), 1.0}, 0.1 * std::sin(0.9 * t), 0.02);
}

const RenderedWalk& RenderedWalk::instance() {
  static const RenderedWalk walk;
  return walk;
}

RenderedWalk::RenderedWalk()
    : camera_{.fx = 458.0,
              .fy = 457.0,
              .cx = 367.0,
              .cy = 248.0,
              .width = 752,
              .height = 480,
              .distortion = Distortion::kRadtan,
              .coefficients = {-0.12, 0.02, 0.0002, 0.00002, 0.0}},
      bundles_(kFrames) {
  const sim::Scene scene = hall();
  const sim::Camera lens(camera_);
  const sim::Exposure robot_sensor({}, 1);
  const sim::Exposure worn_sensor({}, 2);
  const sim::TrackerPlan tracker;
  const auto draw = [&](sim::Renderer& renderer, std::size_t job) {
    const int frame = static_cast<int>(job);
    FrameBundle& bundle = bundles_[job];
    bundle.stamp = 100 * kNanosecondsPerSecond + frame * kInterval;
    bundle.sequence = job;
    bundle.image =
        std::make_shared<GrayImage>(robot_sensor.expose(renderer.render(scene.quads, T_WS(frame)), job));
    WearerView& wearer = bundle.wearer.emplace();
    wearer.stamp = bundle.stamp;
    wearer.image =
        std::make_shared<GrayImage>(worn_sensor.expose(renderer.render(scene.quads, T_WF(frame)), job));
    wearer.camera = camera_;
    wearer.T_SF = sim::track(tracker, T_WS(frame).inverse() * T_WF(frame), 1, job);
  };
  constexpr unsigned kThreads = 2;
  sim::for_each_job(
      bundles_.size(), kThreads, [&] { return sim::Renderer(lens); }, draw);
}

}  // namespace cosight::bench
