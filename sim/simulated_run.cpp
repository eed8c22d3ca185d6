#include "sim/simulated_run.hpp"

#include <algorithm>
#include <string>

#include "sim/known_points.hpp"
#include "sim/render/view_overlap.hpp"

namespace cosight::sim {

SimulatedRun::SimulatedRun(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      world_(scenario, seed),
      robot_(carrier(scenario.robot_camera, "robot")),
      wearer_(carrier(scenario.wearer_camera, "wearer")) {
  robot_.T_WC = [this](double time) { return world_.robot_camera(time); };
  robot_.quads_at = [this](double time) { return world_.before_robot(time); };
  wearer_.T_WC = [this](double time) { return world_.wearer_camera(time); };
  wearer_.quads_at = [this](double time) { return world_.before_wearer(time); };
  fit_gaze();
}

Carrier SimulatedRun::carrier(const CameraPlan& plan, const char* agent) const {
  const std::string name(agent);
  return {plan,
          Camera(plan.lens),
          Exposure(plan.exposure, mix_bits(seed_ + (name == "robot" ? 1U : 2U))),
          {},
          {},
          ticks(plan.timing, world_.duration(), RandomStream(seed_, name + " camera"))};
}

Motion SimulatedRun::T_WB() const {
  return [this](double time) { return world_.robot(time); };
}

Motion SimulatedRun::T_WH() const {
  return [this](double time) { return world_.head(time); };
}

std::vector<WearerPoseSample> SimulatedRun::tracked_poses() const {
  std::vector<WearerPoseSample> tracked;
  for (std::size_t k = 0; k < robot_.ticks.size(); ++k) {
    const double time = robot_.ticks[k].time;
    const Pose T_SF = robot_.T_WC(time).inverse() * wearer_.T_WC(time);
    tracked.push_back({robot_.ticks[k].stamp, track(scenario_.tracker, T_SF, seed_, k), true});
  }
  return tracked;
}

std::vector<AhrsSample> SimulatedRun::ahrs() const {
  return simulate_ahrs(scenario_.ahrs, T_WH(), world_.duration(), seed_);
}

std::vector<LaserScan> SimulatedRun::front_scans() const {
  return simulate_laser(scenario_.front_laser, T_WB(), robot_.quads_at, world_.duration(),
                        mix_bits(seed_ + 1));
}

std::vector<LaserScan> SimulatedRun::rear_scans() const {
  return simulate_laser(scenario_.rear_laser, T_WB(), robot_.quads_at, world_.duration(),
                        mix_bits(seed_ + 2));
}

std::vector<BiasedImuSample> SimulatedRun::imu() const {
  return simulate_imu(scenario_.imu, T_WB(), world_.duration(), seed_);
}

std::vector<WheelOdometrySample> SimulatedRun::odometry() const {
  return simulate_odometry(scenario_.odometry, T_WB(), world_.duration(), seed_);
}

std::vector<OverlapTruth> SimulatedRun::overlap() const {
  std::vector<OverlapTruth> overlap;
  for (const Tick& tick : robot_.ticks) {
    const Pose T_WS = robot_.T_WC(tick.time);
    const Pose T_WF = wearer_.T_WC(tick.time);
    overlap.push_back({tick.stamp, seen_by_both(world_.building(), robot_.camera, T_WS, wearer_.camera, T_WF),
                       seen_by_both(world_.building(), wearer_.camera, T_WF, robot_.camera, T_WS)});
  }
  return overlap;
}

double SimulatedRun::overlap_ratio() const {
  constexpr double kUsefulShare = 0.2;
  const auto useful = std::count_if(robot_.ticks.begin(), robot_.ticks.end(), [&](const Tick& tick) {
    return seen_by_both(world_.building(), robot_.camera, robot_.T_WC(tick.time), wearer_.camera,
                        wearer_.T_WC(tick.time)) >= kUsefulShare;
  });
  return static_cast<double>(useful) / static_cast<double>(std::max<std::size_t>(1, robot_.ticks.size()));
}

/// Lets the wearer look aside for as long as gives the wanted overlap ratio: bisection on the share of the
/// time, because how soon the views part depends on where the two are.
void SimulatedRun::fit_gaze() {
  if (scenario_.gaze.ratio <= 0.0) return;
  double low = 0.0;
  double high = 1.0;
  for (int step = 0; step < 8; ++step) {
    const double share = 0.5 * (low + high);
    WearerPlan plan = scenario_.wearer;
    plan.aside = glances(scenario_.gaze, share, world_.duration(), seed_);
    world_.set_wearer(plan);
    (overlap_ratio() < scenario_.gaze.ratio ? low : high) = share;
  }
}

std::vector<KnownPoint> SimulatedRun::known_points() const {
  if (scenario_.known_points <= 0 || robot_.ticks.empty()) return {};
  const double time = robot_.ticks.front().time;
  Film film = robot_.film();
  return survey(robot_.take(film, 0), robot_.camera, robot_.T_WC(time), robot_.quads_at(time),
                world_.building().size(), scenario_.known_points);
}

}  // namespace cosight::sim
