#include "tests/robot_agent/wearer/simulated_walk.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <variant>

#include "shared/config/config.hpp"
#include "sim/scenario_file.hpp"
#include "sim/world_model.hpp"

namespace cosight::wearer {
namespace {

struct Event {
  Sample sample;
  double time = 0.0;
};

LaserScanSample scan_of(const sim::LaserPlan& plan, const sim::LaserScan& scan, const std::string& name) {
  LaserScanSample sample;
  sample.stamp = scan.stamp;
  sample.laser = name;
  sample.angle_min = static_cast<float>(plan.angle_of(0));
  sample.angle_increment = static_cast<float>(plan.angle_of(1) - plan.angle_of(0));
  sample.range_min = static_cast<float>(plan.range_min);
  sample.range_max = static_cast<float>(plan.range_max);
  sample.ranges = scan.ranges;
  return sample;
}

std::vector<Sample> samples_of(const sim::Scenario& scenario, const sim::World& world, std::uint64_t seed) {
  const sim::Motion T_WB = [&](double t) { return world.robot(t); };
  const sim::Motion T_WH = [&](double t) { return world.head(t); };
  const double height = scenario.front_laser.T_BL.p.z();
  const auto quads_at = [&](double t) {
    std::vector<sim::Quad> quads = world.before_robot(t);
    std::erase_if(quads, [&](const sim::Quad& quad) {
      double low = 1e9;
      double high = -1e9;
      for (const double s : {0.0, 1.0}) {
        for (const double u : {0.0, 1.0}) {
          const double z = (quad.origin + s * quad.edge_s + u * quad.edge_t).z();
          low = std::min(low, z);
          high = std::max(high, z);
        }
      }
      return low > height + 0.15 || high < height - 0.15;  // far from the lasers' plane
    });
    return quads;
  };
  std::vector<Sample> samples;
  const double duration = world.duration();
  for (const auto& scan : sim::simulate_laser(scenario.front_laser, T_WB, quads_at, duration, seed))
    samples.emplace_back(scan_of(scenario.front_laser, scan, "laser_front"));
  for (const auto& scan : sim::simulate_laser(scenario.rear_laser, T_WB, quads_at, duration, seed + 1000))
    samples.emplace_back(scan_of(scenario.rear_laser, scan, "laser_rear"));
  for (const auto& row : sim::simulate_odometry(scenario.odometry, T_WB, duration, seed))
    samples.emplace_back(WheelOdometrySample{row.stamp, row.x, row.y, row.yaw, row.speed, row.turn_rate});
  for (const AhrsSample& sample : sim::simulate_ahrs(scenario.ahrs, T_WH, duration, seed))
    samples.emplace_back(sample);
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return stamp_of(a) < stamp_of(b); });
  return samples;
}

class Run {
 public:
  Run(const sim::Scenario& scenario, std::uint64_t seed, const WalkOptions& options)
      : scenario_(scenario),
        options_(options),
        world_(scenario, seed),
        tracker_(with_lasers(scenario, options)),
        random_(static_cast<unsigned>(seed)) {
    if (options.with_heading) tracker_.set_yaw_offset({-scenario.ahrs.north_offset, 0.01});
  }

  WalkReport report(std::uint64_t seed) {
    for (const Sample& sample : samples_of(scenario_, world_, seed)) {
      if (const auto* odometry = std::get_if<WheelOdometrySample>(&sample)) {
        if (options_.with_odometry) tracker_.add_odometry(*odometry);
        if (options_.with_heading) tell_heading(odometry->stamp);
      } else if (const auto* ahrs = std::get_if<AhrsSample>(&sample)) {
        tracker_.add_ahrs(*ahrs);
      } else {
        add_scan(std::get<LaserScanSample>(sample));
      }
    }
    report_.counters = tracker_.counters();
    return report_;
  }

 private:
  static WearerOptions with_lasers(const sim::Scenario& scenario, const WalkOptions& options) {
    WearerOptions result = options.tracker;
    result.lasers["laser_front"].T_BL = scenario.front_laser.T_BL;
    result.lasers["laser_rear"].T_BL = scenario.rear_laser.T_BL;
    result.head.T_BS = scenario.robot_camera.T_BC;
    result.head.p_HF = scenario.wearer_camera.T_BC.p;
    return result;
  }

  static double time_of(Stamp stamp) { return to_seconds(stamp - sim::kStartStamp); }

  /// As an estimate of slam: its error changes slowly.
  void tell_heading(Stamp stamp) {
    heading_error_ =
        0.98 * heading_error_ + std::sqrt(1.0 - 0.98 * 0.98) * options_.heading_sigma * normal_(random_);
    const Eigen::Quaterniond wrong(Eigen::AngleAxisd(heading_error_, Eigen::Vector3d::UnitZ()));
    tracker_.set_robot_orientation(stamp, wrong * world_.robot_camera(time_of(stamp)).q,
                                   options_.heading_sigma);
  }

  void add_scan(const LaserScanSample& scan) {
    const auto before = std::chrono::steady_clock::now();
    const auto pose = tracker_.add_scan(scan);
    report_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    ++report_.scans;
    if (!pose) return;
    const double time = time_of(scan.stamp);
    const Pose T_WB = world_.robot(time);
    const Eigen::Vector3d p_BF = T_WB.inverse() * world_.wearer_camera(time).p;
    const Eigen::Matrix3d R_BS = scenario_.robot_camera.T_BC.q.toRotationMatrix();
    Answer answer;
    answer.time = time;
    answer.error = scenario_.robot_camera.T_BC * pose->T_SF.T.p - p_BF;
    answer.covariance = R_BS * pose->T_SF.covariance.topLeftCorner<3, 3>() * R_BS.transpose();
    answer.normalised = answer.error.dot(answer.covariance.llt().solve(answer.error));
    const Eigen::Vector2d p_O = tracker_.wearer()->p_O();
    const Eigen::Vector3d body_B =
        tracker_.odometry().T_OB(scan.stamp).inverse() * Eigen::Vector3d(p_O.x(), p_O.y(), 0.0);
    const Eigen::Vector3d head_B = T_WB.inverse() * world_.head(time).p;
    answer.body_error = (body_B - head_B).head<2>();
    answer.laser = scan.laser;
    answer.seen = tracker_.wearer()->seen == scan.stamp;
    report_.answers.push_back(answer);
  }

  const sim::Scenario& scenario_;
  WalkOptions options_;
  sim::World world_;
  WearerTracker tracker_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  double heading_error_ = 0.0;
  WalkReport report_;
};

}  // namespace

double WalkReport::rms() const {
  double sum = 0.0;
  for (const Answer& answer : answers)
    sum += answer.error.squaredNorm();
  return std::sqrt(sum / static_cast<double>(answers.size()));
}

double WalkReport::worst() const {
  double worst = 0.0;
  for (const Answer& answer : answers)
    worst = std::max(worst, answer.error.norm());
  return worst;
}

double WalkReport::mean_nees() const {
  double sum = 0.0;
  for (const Answer& answer : answers)
    sum += answer.normalised;
  return sum / static_cast<double>(answers.size());
}

double WalkReport::share() const {
  return static_cast<double>(answers.size()) / static_cast<double>(scans);
}

sim::Scenario scene_of(const std::string& yaml) {
  const ConfigFile file = ConfigFile::parse(yaml, "scene");
  return sim::read_scenario(file.root());
}

WalkReport walk(const sim::Scenario& scenario, std::uint64_t seed, const WalkOptions& options) {
  return Run(scenario, seed, options).report(seed);
}

}  // namespace cosight::wearer
