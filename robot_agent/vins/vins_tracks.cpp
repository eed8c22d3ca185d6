#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "robot_agent/vins/track_run.hpp"
#include "shared/evaluation/trajectory_writer.hpp"
#include "shared/program/program.hpp"

namespace {

using namespace cosight;        // NOLINT(google-build-using-namespace): a program's own file
using namespace cosight::vins;  // NOLINT(google-build-using-namespace)

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

struct Arguments {
  std::filesystem::path folder;
  std::filesystem::path trajectory;
  TrackRunOptions options;
};

void add_options(CLI::App& app, Arguments& arguments) {
  TrackRunOptions& options = arguments.options;
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
  app.add_option("--frames", options.max_frames, "stop after so many");
  app.add_option("folder", arguments.folder, "holds cam.txt, imu.txt, tracks.txt and gt_tum.txt")->required();
  app.add_option("--tum", arguments.trajectory, "write the trajectory here");
}

void print_summary(const TrackRun& run) {
  const TrackMetrics& m = run.metrics;
  std::printf("rpe_1s mean %.4f std %.4f max %.3f | frame %.5f | drift %.3f %% | outliers %.1f %%\n",
              m.rpe_mean, m.rpe_std, m.rpe_max, m.rpe_frame_mean, m.drift_percent, m.outlier_percent);
  std::printf("solve median %.2f p99 %.2f ms, marginalise median %.2f ms\n", run.solve_ms_median,
              run.solve_ms_p99, run.marginalise_ms_median);
}

void run_and_report(const Arguments& arguments, const std::atomic<bool>& stop) {
  const TrackRun run = run_tracks(read_track_sequence(arguments.folder), arguments.options, &stop);
  if (stop) throw std::runtime_error("interrupted");
  print_summary(run);
  if (!arguments.trajectory.empty())
    write_trajectory(arguments.trajectory, run.estimate, TrajectoryFormat::kTum);
}

}  // namespace

int main(int argc, char** argv) {
  Program program(
      {.name = "vins_tracks",
       .purpose =
           "Visual-inertial odometry on recorded feature tracks, from their true first state, as the paper "
           "reports it.",
       .examples = "  vins_tracks tracks/uc2_20 --mode ac_me_guarded --pixel-noise 0.25 --tum guarded.tum\n"
                   "  vins_tracks tracks/uc1_9 --mode vins --frames 700\n"});
  Arguments arguments;
  add_options(program.command_line(), arguments);
  return program.run(argc, argv, [&](const ConfigFile& config, const std::atomic<bool>& stop) {
    config.refuse_unknown_keys();
    run_and_report(arguments, stop);
    return ExitCode::kDone;
  });
}
