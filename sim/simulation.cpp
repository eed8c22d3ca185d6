#include "sim/simulation.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "sim/dataset_writer.hpp"
#include "sim/known_points.hpp"
#include "sim/parallel.hpp"
#include "sim/render/view_overlap.hpp"
#include "sim/world_model.hpp"

namespace cosight::sim {
namespace {

namespace fs = std::filesystem;

std::string image_name(std::size_t frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%06zu.jpg", frame);
  return name.data();
}

std::vector<unsigned char> jpeg(const GrayImage& image, int quality) {
  const cv::Mat view(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.data.data()));
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", view, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

/// One of the two cameras on its way: what it sees, when, and where its files go.
struct Carrier {
  const CameraPlan& plan;
  Camera camera;
  Exposure exposure;
  Motion T_WC;
  std::function<std::vector<Quad>(double)> quads_at;
  std::vector<Tick> ticks;
  fs::path folder;  ///< of the agent
};

class Run {
 public:
  Run(const Scenario& scenario, const RunOptions& options, const fs::path& folder,
      const std::atomic<bool>& stop)
      : scenario_(scenario),
        options_(options),
        folder_(folder),
        stop_(stop),
        world_(scenario, options.seed),
        robot_(carrier(scenario.robot_camera, "robot")),
        wearer_(carrier(scenario.wearer_camera, "wearer")) {
    robot_.T_WC = [this](double time) { return world_.robot_camera(time); };
    robot_.quads_at = [this](double time) { return world_.before_robot(time); };
    wearer_.T_WC = [this](double time) { return world_.wearer_camera(time); };
    wearer_.quads_at = [this](double time) { return world_.before_wearer(time); };
  }

  RunReport write() {
    fit_gaze();
    RunReport report{robot_.ticks.size(), wearer_.ticks.size(), 0, world_.duration(), 0.0, false};
    for (const Carrier* carrier : {&robot_, &wearer_}) {
      write_calibration(carrier->folder / "calibration.yaml", carrier->camera.calibration(),
                        carrier->plan.T_BC);
      write_list(*carrier);
    }
    write_tum(folder_ / "truth/robot_cam0.tum", truth_of(robot_));
    write_tum(folder_ / "truth/wearer_cam0.tum", truth_of(wearer_));
    write_sensors();
    write_overlap_truth();
    report.overlap_ratio = overlap_ratio();
    report.known_points = write_survey();
    if (options_.with_frames) write_frames();
    report.stopped = stop_;
    return report;
  }

 private:
  Carrier carrier(const CameraPlan& plan, const std::string& agent) {
    return {plan,
            Camera(plan.lens),
            Exposure(plan.exposure, mix_bits(options_.seed + (agent == "robot" ? 1U : 2U))),
            {},
            {},
            ticks(plan.timing, world_.duration(), RandomStream(options_.seed, agent + " camera")),
            folder_ / agent};
  }

  static void write_list(const Carrier& carrier) {
    std::vector<Stamp> stamps;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < carrier.ticks.size(); ++k) {
      stamps.push_back(carrier.ticks[k].stamp);
      names.push_back("cam0/" + image_name(k));
    }
    write_image_list(carrier.folder / "cam0.csv", stamps, names);
  }

  static std::vector<TimedPose> truth_of(const Carrier& carrier) {
    std::vector<TimedPose> poses;
    for (const Tick& tick : carrier.ticks)
      poses.push_back({tick.stamp, carrier.T_WC(tick.time)});
    return poses;
  }

  void write_sensors() const {
    std::vector<WearerPoseSample> tracked;
    for (std::size_t k = 0; k < robot_.ticks.size(); ++k) {
      const double time = robot_.ticks[k].time;
      const Pose T_SF = robot_.T_WC(time).inverse() * wearer_.T_WC(time);
      tracked.push_back({robot_.ticks[k].stamp, track(scenario_.tracker, T_SF, options_.seed, k), true});
    }
    write_wearer_poses(robot_.folder / "wearer_pose.csv", tracked);
    const double duration = world_.duration();
    const std::uint64_t seed = options_.seed;
    const Motion T_WH = [this](double time) { return world_.head(time); };
    write_ahrs(wearer_.folder / "ahrs.csv", simulate_ahrs(scenario_.ahrs, T_WH, duration, seed));
    const Motion T_WB = [this](double time) { return world_.robot(time); };
    write_laser(robot_.folder / "laser_front.csv",
                simulate_laser(scenario_.front_laser, T_WB, robot_.quads_at, duration, mix_bits(seed + 1)));
    write_laser(robot_.folder / "laser_rear.csv",
                simulate_laser(scenario_.rear_laser, T_WB, robot_.quads_at, duration, mix_bits(seed + 2)));
    write_laser_geometry(robot_.folder / "lasers.yaml",
                         {{"front", scenario_.front_laser}, {"rear", scenario_.rear_laser}});
    const std::vector<ImuSample> imu = simulate_imu(scenario_.imu, T_WB, duration, seed);
    write_imu(robot_.folder / "imu.csv", imu);
    write_imu_biases(folder_ / "truth/imu_bias.csv", imu);
    write_odometry(robot_.folder / "odometry.csv",
                   simulate_odometry(scenario_.odometry, T_WB, duration, seed));
    write_body_truth(T_WB, T_WH);
  }

  /// Dense enough for any sensor of either body, on the true clock.
  void write_body_truth(const Motion& T_WB, const Motion& T_WH) const {
    std::vector<TimedPose> robot;
    std::vector<TimedPose> head;
    for (const Tick& tick : ticks({.rate = 100.0}, world_.duration(), RandomStream(0, "truth"))) {
      robot.push_back({tick.stamp, T_WB(tick.time)});
      head.push_back({tick.stamp, T_WH(tick.time)});
    }
    write_tum(folder_ / "truth/robot_body.tum", robot);
    write_tum(folder_ / "truth/wearer_head.tum", head);
  }

  OverlapTruth overlap_at(const Tick& tick) const {
    const Pose T_WS = robot_.T_WC(tick.time);
    const Pose T_WF = wearer_.T_WC(tick.time);
    return {tick.stamp, seen_by_both(world_.building(), robot_.camera, T_WS, wearer_.camera, T_WF),
            seen_by_both(world_.building(), wearer_.camera, T_WF, robot_.camera, T_WS)};
  }

  /// Share of the frames in which Cf sees a useful part of what Cs sees.
  double overlap_ratio() const {
    constexpr double kUsefulShare = 0.2;
    const auto useful = std::count_if(robot_.ticks.begin(), robot_.ticks.end(), [&](const Tick& tick) {
      return seen_by_both(world_.building(), robot_.camera, robot_.T_WC(tick.time), wearer_.camera,
                          wearer_.T_WC(tick.time)) >= kUsefulShare;
    });
    return static_cast<double>(useful) / static_cast<double>(std::max<std::size_t>(1, robot_.ticks.size()));
  }

  /// Lets the wearer look aside for as long as gives the wanted overlap ratio: bisection on the share of the
  /// time, because how soon the views part depends on where the two are.
  void fit_gaze() {
    if (scenario_.gaze.ratio <= 0.0) return;
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step < 8; ++step) {
      const double share = 0.5 * (low + high);
      WearerPlan plan = scenario_.wearer;
      plan.aside = glances(scenario_.gaze, share, world_.duration(), options_.seed);
      world_.set_wearer(plan);
      (overlap_ratio() < scenario_.gaze.ratio ? low : high) = share;
    }
  }

  void write_overlap_truth() const {
    std::vector<OverlapTruth> overlap;
    for (const Tick& tick : robot_.ticks)
      overlap.push_back(overlap_at(tick));
    write_overlap(folder_ / "truth/overlap.csv", overlap);
  }

  std::size_t write_survey() const {
    if (scenario_.known_points <= 0 || robot_.ticks.empty()) return 0;
    const double time = robot_.ticks.front().time;
    const std::vector<Quad> quads = robot_.quads_at(time);
    Film film(robot_.camera, robot_.exposure, robot_.plan.shutter);
    const std::vector<KnownPoint> points =
        survey(film.take(quads, robot_.T_WC, time, 0), robot_.camera, robot_.T_WC(time), quads,
               world_.building().size(), scenario_.known_points);
    write_known_points(robot_.folder / "known_points.csv", points);
    return points.size();
  }

  /// Each frame is a job of its own, of either camera in turn: threads share nothing.
  void write_frames() const {
    for (const Carrier* carrier : {&robot_, &wearer_})
      fs::create_directories(carrier->folder / "cam0");
    struct Worker {
      Film robot, wearer;
    };
    const auto make_worker = [&] {
      return Worker{Film(robot_.camera, robot_.exposure, robot_.plan.shutter),
                    Film(wearer_.camera, wearer_.exposure, wearer_.plan.shutter)};
    };
    const auto work = [&](Worker& worker, std::size_t job) {
      if (stop_) return;
      const bool is_robot = job < robot_.ticks.size();
      const Carrier& carrier = is_robot ? robot_ : wearer_;
      const std::size_t frame = is_robot ? job : job - robot_.ticks.size();
      const double time = carrier.ticks[frame].time;
      const GrayImage image =
          (is_robot ? worker.robot : worker.wearer).take(carrier.quads_at(time), carrier.T_WC, time, frame);
      write_bytes(carrier.folder / "cam0" / image_name(frame), jpeg(image, carrier.plan.jpeg_quality));
    };
    for_each_job(robot_.ticks.size() + wearer_.ticks.size(), options_.threads, make_worker, work);
  }

  const Scenario& scenario_;
  RunOptions options_;
  fs::path folder_;
  const std::atomic<bool>& stop_;
  World world_;
  Carrier robot_, wearer_;
};

}  // namespace

RunReport write_dataset(const Scenario& scenario, const RunOptions& options, const fs::path& folder,
                        const std::atomic<bool>& stop) {
  return Run(scenario, options, folder, stop).write();
}

}  // namespace cosight::sim
