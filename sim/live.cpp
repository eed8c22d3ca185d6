#include "sim/live.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>
#include <type_traits>
#include <utility>

#include "shared/dataset/merged_source.hpp"
#include "shared/dataset/motion_csv.hpp"
#include "shared/dataset/paced_replay.hpp"
#include "shared/transport/agent_presence.hpp"
#include "shared/transport/robot_publisher.hpp"
#include "shared/transport/wearer_publisher.hpp"
#include "sim/rendered_frames.hpp"

namespace cosight::sim {
namespace {

using std::chrono::milliseconds;
using Sources = std::vector<std::unique_ptr<SampleSource>>;

template <class Row, class Convert>
std::unique_ptr<SampleSource> list(SampleKind kind, const std::vector<Row>& rows, const Convert& convert) {
  using Converted = std::remove_cvref_t<std::invoke_result_t<Convert, const Row&>>;
  std::vector<Sample> samples;
  samples.reserve(rows.size());
  for (const Row& row : rows)
    samples.emplace_back(std::in_place_type<Converted>, std::invoke(convert, row));
  return std::make_unique<SampleListSource>(std::move(samples), kind, SourceCounters{}, "simulated");
}

std::unique_ptr<SampleSource> scans(const std::vector<LaserScan>& scans, const LaserPlan& plan,
                                    const char* laser) {
  return list(SampleKind::kLaserScan, scans, [&](const LaserScan& scan) {
    return LaserScanSample{.stamp = scan.stamp,
                           .laser = laser,
                           .angle_min = static_cast<float>(plan.angle_of(0)),
                           .angle_increment = static_cast<float>(plan.angle_of(1) - plan.angle_of(0)),
                           .range_min = static_cast<float>(plan.range_min),
                           .range_max = static_cast<float>(plan.range_max),
                           .ranges = scan.ranges};
  });
}

/// In the order in which a dataset's are played: what belongs to a frame comes before it.
Sources robot_sources(const SimulatedRun& run, const LiveOptions& options) {
  Sources sources;
  sources.push_back(list(SampleKind::kWheelOdometry, run.odometry(), std::identity()));
  sources.push_back(list(SampleKind::kImu, run.imu(), &BiasedImuSample::measured));
  sources.push_back(scans(run.front_scans(), run.scenario().front_laser, "laser_front"));
  sources.push_back(scans(run.rear_scans(), run.scenario().rear_laser, "laser_rear"));
  if (options.tracks_wearer) {
    sources.push_back(list(SampleKind::kWearerPose, run.tracked_poses(), std::identity()));
  }
  sources.push_back(std::make_unique<RenderedFrames>(run.robot(), std::max(1U, options.threads / 2)));
  return sources;
}

Sources wearer_sources(const SimulatedRun& run, const LiveOptions& options) {
  Sources sources;
  sources.push_back(list(SampleKind::kAhrs, run.ahrs(), std::identity()));
  sources.push_back(std::make_unique<RenderedFrames>(run.wearer(), std::max(1U, options.threads / 2)));
  return sources;
}

/// One agent's samples to its topics, in the rhythm of their stamps.
template <class Publisher>
LiveStream play(Sources sources, double rate, Publisher& publisher, const std::atomic<bool>& stop) {
  constexpr double kLate = 0.05;
  SteadyClock clock;
  const auto open = [&sources] { return std::make_unique<MergedSource>(std::move(sources)); };
  PacedReplay replay(open, {.rate = rate, .loop = false}, clock, stop);
  LiveStream stream;
  std::optional<Stamp> first;
  const Stamp start = clock.now();
  while (const auto sample = replay.next()) {
    const Stamp stamp = stamp_of(*sample);
    first = first.value_or(stamp);
    publisher.publish(*sample);
    ++stream.samples;
    if (kind_of(*sample) != SampleKind::kImage) continue;
    ++stream.frames;
    const double lateness = to_seconds(clock.now() - start) - to_seconds(stamp - *first) / rate;
    stream.late += lateness > kLate ? 1 : 0;
    stream.worst_lateness = std::max(stream.worst_lateness, lateness);
  }
  constexpr milliseconds kPatience{2000};
  if (!stop) publisher.wait_until_delivered(kPatience);
  return stream;
}

/// True when a robot reads what both say; false when the time is up or `stop` is set.
bool wait_for_readers(const transport::RobotPublisher& robot, const transport::WearerPublisher& wearer,
                      double patience, const std::atomic<bool>& stop) {
  constexpr milliseconds kSlice{20};
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  while (!stop && std::chrono::steady_clock::now() < end) {
    if (robot.wait_for_robot(kSlice) && wearer.wait_for_robot(kSlice)) return true;
  }
  return false;
}

transport::ParticipantOptions named(transport::ParticipantOptions options, const char* name) {
  options.name = name;
  return options;
}

}  // namespace

LiveReport play_live(const SimulatedRun& run, const LiveOptions& options, const std::atomic<bool>& stop) {
  Sources robot_samples = robot_sources(run, options);
  Sources wearer_samples = wearer_sources(run, options);
  const transport::Participant robot_side(named(options.dds, "sim_robot"));
  const transport::Participant wearer_side(named(options.dds, "sim_wearable"));
  transport::RobotPublisher robot(robot_side, ImageEncoding::kJpeg, options.tracks_wearer);
  transport::WearerPublisher wearer(wearer_side, ImageEncoding::kJpeg);
  const transport::AgentPresence presence(wearer_side, transport::topics::kWearableHeartbeat, "wearer");
  // Before anybody listens: who needs the calibration to begin gets it at once.
  robot.publish(run.robot().camera.calibration(), kStartStamp);
  wearer.publish(run.wearer().camera.calibration(), kStartStamp);
  LiveReport report;
  report.had_readers = wait_for_readers(robot, wearer, options.wait, stop);
  {
    const std::jthread wearer_thread(
        [&] { report.wearer = play(std::move(wearer_samples), options.rate, wearer, stop); });
    report.robot = play(std::move(robot_samples), options.rate, robot, stop);
  }
  return report;
}

}  // namespace cosight::sim
