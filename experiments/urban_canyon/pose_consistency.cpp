#include "experiments/urban_canyon/pose_consistency.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "experiments/consistency/monte_carlo.hpp"
#include "experiments/csv_file.hpp"
#include "experiments/urban_canyon/gaussian.hpp"
#include "experiments/urban_canyon/study.hpp"
#include "robot_agent/vins/parameter_blocks.hpp"
#include "robot_agent/vins/uncertainty.hpp"

namespace cosight::experiments {
namespace {

using Eigen::Vector3d;

/// The true state off by what the start prior allows.
vins::NavState drawn_start(const vins::NavState& truth, const vins::StartUncertainty& sigma,
                           std::mt19937_64& random) {
  vins::NavState state = truth;
  const Vector3d theta_W = gaussian<3>(random, 1.0).cwiseProduct(Vector3d(sigma.tilt, sigma.tilt, sigma.yaw));
  const Vector3d dp = gaussian<3>(random, sigma.position);
  const Vector3d theta_B = truth.T_WB.q.conjugate() * theta_W;
  const Eigen::Vector<double, 6> delta{dp.x(), dp.y(), dp.z(), theta_B.x(), theta_B.y(), theta_B.z()};
  state.T_WB = vins::moved(truth.T_WB, delta.data());
  state.v_W += gaussian<3>(random, sigma.velocity);
  return state;
}

PoseCheck check(const vins::Window& window, const vins::GraphOptions& graph, const Pose& truth,
                const Vector3d& true_velocity) {
  const vins::WindowFrame& newest = window.frames.back();
  const Eigen::Matrix<double, 6, 6> P =
      vins::state_covariance(window, graph, newest.id).topLeftCorner<6, 6>();
  const Eigen::Vector<double, 6> error = vins::difference(newest.state.T_WB, truth);
  const Vector3d dp = error.head<3>();
  PoseCheck result;
  result.pose_nees = error.dot(P.ldlt().solve(error));
  result.position_nees = dp.dot(P.topLeftCorner<3, 3>().ldlt().solve(dp));
  result.speed_error = newest.state.v_W.norm() / true_velocity.norm() - 1.0;
  return result;
}

}  // namespace

CanyonOptions static_canyon() {
  CanyonOptions options;
  options.length = 300.0;  // so that the fastest drive takes longer than what is checked of it
  options.traffic = {.ahead_share = 0.0,
                     .neighbours_per_minute = 0.0,
                     .oncoming_per_minute = 0.0,
                     .turning_per_minute = 0.0,
                     .crossing_per_corner = 0.0};
  options.front_end.noise_spread = 1.0;
  options.calibrated_noise = options.front_end.noise;
  return options;
}

std::vector<PoseCheck> check_pose(const ConsistencyOptions& options, unsigned seed) {
  const CanyonOptions canyon = static_canyon();
  const CanyonDrive drive = make_canyon_drive(canyon, seed);
  const vins::TrackSequence& sequence = drive.sequence;
  if (sequence.frames.size() <= static_cast<std::size_t>(options.frames)) {
    throw std::runtime_error("the drive of seed " + std::to_string(seed) + " has only " +
                             std::to_string(sequence.frames.size()) + " frames; " +
                             std::to_string(options.frames) + " are to be checked");
  }
  vins::WindowOptions window_options;
  window_options.solver.graph.gravity = sequence.gravity;
  window_options.solver.graph.trust = options.trust;
  vins::ImuBuffer imu;
  for (const vins::ImuSample& sample : sequence.imu)
    imu.push(sample);
  std::mt19937_64 random(seed + 7'000'000U);
  vins::WindowOdometry odometry(window_options, canyon.imu, sequence.T_BS);
  odometry.start(
      sequence.frames.front(),
      drawn_start({sequence.truth.front().T_WC, drive.velocities_W.front(), {}}, options.start, random),
      options.start);
  std::vector<PoseCheck> checks;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(options.frames); ++i) {
    odometry.process(sequence.frames[i], imu.between(sequence.frames[i - 1].stamp, sequence.frames[i].stamp));
    if (i % static_cast<std::size_t>(options.every) != 0) continue;
    checks.push_back(
        check(odometry.window(), window_options.solver.graph, sequence.truth[i].T_WC, drive.velocities_W[i]));
    checks.back().t = to_seconds(sequence.frames[i].stamp - sequence.frames.front().stamp);
  }
  return checks;
}

std::vector<PoseCheck> monte_carlo(const ConsistencyOptions& options, int runs, const Workers& workers) {
  std::vector<std::vector<PoseCheck>> all(static_cast<std::size_t>(runs));
  workers.run(std::string("static drives, ") + to_string(options.trust.mode), runs, [&](int i) {
    all[static_cast<std::size_t>(i)] = check_pose(options, static_cast<unsigned>(i) + 1U);
  });
  std::vector<PoseCheck> mean(all.front().size());
  for (const auto& checks : all) {
    for (std::size_t k = 0; k < mean.size(); ++k) {
      mean[k].t = checks[k].t;
      mean[k].pose_nees += checks[k].pose_nees / runs;
      mean[k].position_nees += checks[k].position_nees / runs;
      mean[k].speed_error += checks[k].speed_error / runs;
    }
  }
  return mean;
}

std::vector<ModeConsistency> study_consistency(int runs, const Workers& workers) {
  const CanyonOptions canyon = static_canyon();
  const vins::TrackRunOptions window = window_for(canyon);
  const Band pose_band = average_band(6, runs);
  const Band position_band = average_band(3, runs);
  std::vector<ModeConsistency> all;
  for (const Method& method : modes(window.window.solver.graph.trust)) {
    std::vector<PoseCheck> checks =
        monte_carlo({.trust = method.trust, .start = window.start}, runs, workers);
    ModeConsistency mode;
    mode.name = method.name;
    const double share = 1.0 / static_cast<double>(checks.size());
    for (const PoseCheck& check : checks) {
      mode.pose_nees += share * check.pose_nees;
      mode.position_nees += share * check.position_nees;
      mode.pose_in_band += pose_band.contains(check.pose_nees) ? share : 0.0;
      mode.position_in_band += position_band.contains(check.position_nees) ? share : 0.0;
    }
    mode.course = std::move(checks);
    all.push_back(std::move(mode));
  }
  return all;
}

std::string table(const std::vector<ModeConsistency>& modes, int runs) {
  const Band pose_band = average_band(6, runs);
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "NEES of the pose, %d static drives: expected 6, 95 %% band %.2f to %.2f\n", runs,
                pose_band.low, pose_band.high);
  std::string out = text.data();
  for (const ModeConsistency& mode : modes) {
    std::snprintf(text.data(), text.size(),
                  "%-14s pose %8.2f (%3.0f %% in band), position %8.2f (%3.0f %% in band)\n",
                  mode.name.c_str(), mode.pose_nees, 100.0 * mode.pose_in_band, mode.position_nees,
                  100.0 * mode.position_in_band);
    out += text.data();
  }
  return out;
}

void write_nees(const std::filesystem::path& folder, const std::vector<ModeConsistency>& modes) {
  for (const ModeConsistency& mode : modes) {
    CsvFile csv(folder / ("nees_" + mode.name + ".csv"), "t,pose_nees,position_nees,speed_error");
    for (const PoseCheck& check : mode.course)
      csv.row({check.t, check.pose_nees, check.position_nees, check.speed_error});
    csv.close();
  }
}

std::vector<std::pair<std::string, double>> named(const ModeConsistency& mode) {
  return {{"pose_nees", mode.pose_nees},
          {"pose_in_band", mode.pose_in_band},
          {"position_nees", mode.position_nees},
          {"position_in_band", mode.position_in_band}};
}

}  // namespace cosight::experiments
