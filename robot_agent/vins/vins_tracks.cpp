#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>

#include "robot_agent/vins/track_run.hpp"
#include "shared/evaluation/trajectory_writer.hpp"

namespace {

using namespace cosight::vins;

const std::map<std::string, TrustMode> kModes{{"vins", TrustMode::kFixed},
                                              {"ac_g", TrustMode::kGeometry},
                                              {"ac_gn", TrustMode::kTracking},
                                              {"ac_me", TrustMode::kRobust},
                                              {"ac_me_guarded", TrustMode::kGuarded}};
const std::map<std::string, InformationReading> kInformation{
    {"root", InformationReading::kScalesRoot},
    {"information", InformationReading::kScalesInformation},
    {"printed", InformationReading::kAsPrinted}};
const std::map<std::string, ThresholdReading> kThresholds{{"linear", ThresholdReading::kLinear},
                                                          {"root", ThresholdReading::kRoot}};
const std::map<std::string, Kernel> kKernels{
    {"none", Kernel::kNone}, {"cauchy", Kernel::kCauchy}, {"huber", Kernel::kHuber}};

void add_trust_options(CLI::App& app, TrustOptions& trust) {
  app.add_option("--mode", trust.mode, "the paper's method")->transform(CLI::CheckedTransformer(kModes));
  app.add_option("--information", trust.information, "what V26 scales")
      ->transform(CLI::CheckedTransformer(kInformation));
  app.add_option("--threshold", trust.threshold, "how V30 grows with N")
      ->transform(CLI::CheckedTransformer(kThresholds));
  app.add_option("--kernel", trust.fixed_kernel, "of all modes but ac_me")
      ->transform(CLI::CheckedTransformer(kKernels));
  app.add_option("--pixel-noise", trust.pixel_noise, "V27 [px]");
  app.add_option("--scale", trust.scale, "s of V26");
  app.add_option("--geometry-scale", trust.geometry_scale, "s of V26 without N");
  app.add_option("--huber-scale", trust.huber_scale, "M_s of V30");
  app.add_option("--misfit-width", trust.misfit_width, "guarded: in usual misfits");
}

void add_options(CLI::App& app, TrackRunOptions& options) {
  add_trust_options(app, options.window.solver.graph.trust);
  app.add_option("--min-observations", options.window.solver.graph.min_observations);
  app.add_option("--window", options.window.size, "frames");
  app.add_option("--iterations", options.window.solver.max_iterations);
  app.add_option("--max-behind", options.window.max_behind, "[1/m]");
  app.add_option("--min-parallax", options.window.keyframe.min_parallax, "[rad]");
  app.add_option("--accelerometer-noise", options.noise.accelerometer, "[m/s^2/sqrt(Hz)]");
  app.add_option("--gyroscope-noise", options.noise.gyroscope, "[rad/s/sqrt(Hz)]");
  app.add_option("--accelerometer-walk", options.noise.accelerometer_walk);
  app.add_option("--gyroscope-walk", options.noise.gyroscope_walk);
}

void print_summary(const TrackRun& run) {
  const TrackMetrics& m = run.metrics;
  std::printf("rpe_1s mean %.4f std %.4f max %.3f | frame %.5f | drift %.3f %% | outliers %.1f %%\n",
              m.rpe_mean, m.rpe_std, m.rpe_max, m.rpe_frame_mean, m.drift_percent, m.outlier_percent);
  std::printf("solve median %.2f p99 %.2f ms, marginalise median %.2f ms\n", run.solve_ms_median,
              run.solve_ms_p99, run.marginalise_ms_median);
}

}  // namespace

/// Runs the sliding window over a feature-level sequence from its true first state, as the paper reports it.
int main(int argc, char** argv) {
  CLI::App app{"Visual-inertial odometry on recorded feature tracks"};
  std::filesystem::path folder;
  std::filesystem::path trajectory;
  TrackRunOptions options;
  add_options(app, options);
  app.add_option("--frames", options.max_frames, "stop after so many");
  app.add_option("folder", folder, "holds cam.txt, imu.txt, tracks.txt and gt_tum.txt")->required();
  app.add_option("--tum", trajectory, "write the trajectory here");
  CLI11_PARSE(app, argc, argv);
  try {
    const TrackRun run = run_tracks(read_track_sequence(folder), options);
    print_summary(run);
    if (!trajectory.empty())
      cosight::write_trajectory(trajectory, run.estimate, cosight::TrajectoryFormat::kTum);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vins_tracks: %s\n", error.what());
    return 1;
  }
  return 0;
}
