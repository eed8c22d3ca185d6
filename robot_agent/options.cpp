#include "robot_agent/options.hpp"

#include <numbers>

#include "robot_agent/slam_options.hpp"
#include "robot_agent/wearer/declination.hpp"
#include "shared/transport/participant_config.hpp"

namespace cosight::robot {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

inbox::InboxOptions read_inbox_options(const ConfigNode& node) {
  inbox::InboxOptions o;
  auto& pairing = o.pairing;
  const auto milliseconds = [&node](const char* key, Stamp otherwise) {
    return from_seconds(1e-3 * node.number(key, 1e3 * to_seconds(otherwise), 0.0, 1e6));
  };
  pairing.max_pair_interval = milliseconds("max_pair_interval_ms", pairing.max_pair_interval);
  pairing.max_wait = milliseconds("max_wait_ms", pairing.max_wait);
  pairing.wearer_silence = milliseconds("wearer_silence_ms", pairing.wearer_silence);
  pairing.max_queued_images = static_cast<std::size_t>(
      node.integer("max_queued_images", static_cast<int>(pairing.max_queued_images), 2, 100'000));
  o.interpolation.max_interval = milliseconds("max_pose_interval_ms", o.interpolation.max_interval);
  o.mounting.yaw_offset =
      kDegree * node.number("ahrs_yaw_offset_deg", o.mounting.yaw_offset / kDegree, -360.0, 360.0);
  // The AHRS turns from the magnetic north, maps from the true one.
  o.mounting.yaw_offset -= wearer::read_declination(node);
  return o;
}

enum class Only { kAll, kSlam, kVins };

Estimators read_estimators(const ConfigNode& root) {
  const bool enable = root.section("vins").boolean("enable", false);
  const Only only =
      root.choice("only", Only::kAll, {{"all", Only::kAll}, {"slam", Only::kSlam}, {"vins", Only::kVins}});
  if (only == Only::kVins) return Estimators::kVins;
  return enable && only == Only::kAll ? Estimators::kSlamAndVins : Estimators::kSlam;
}

VinsHelp read_vins_help(const ConfigNode& vins, Estimators estimators) {
  VinsHelp help;
  help.guides_slam = vins.boolean("guide_slam", help.guides_slam);
  help.takes_depths = vins.boolean("take_depths", help.takes_depths);
  return estimators == Estimators::kSlamAndVins ? help : VinsHelp{false, false};
}

}  // namespace

RobotOptions read_robot_options(const ConfigNode& root) {
  RobotOptions options;
  options.agent_id = root.text("agent_id", options.agent_id);
  options.input = read_input_options(root.section("input"), Agent::kRobot);
  const ConfigNode replay = root.section("replay");
  options.replay.rate = replay.number("rate", options.replay.rate, 0.0, 1000.0);
  options.replay.loop = replay.boolean("loop", options.replay.loop);
  options.dds.name = "cosight_robot";
  options.dds = transport::read_participant_options(root.section("dds"), options.dds);
  const ConfigNode inbox = root.section("inbox");
  options.inbox = read_inbox_options(inbox);
  options.slam = read_slam_options(root.section("slam"));
  // The inbox turns by what is configured; what that leaves open is slam's to find out.
  double& sigma = options.slam.yaw_offset.prior.sigma;
  sigma = kDegree * inbox.number("ahrs_yaw_offset_sigma_deg", sigma / kDegree, 0.0, 180.0);
  options.wearer = read_wearer_section(root.section("wearer"));
  options.estimators = read_estimators(root);
  options.vins = read_vins_options(root.section("vins"));
  options.vins_help = read_vins_help(root.section("vins"), options.estimators);
  const ConfigNode start = root.section("start");
  options.wait_for_wearer = start.number("wait_for_wearer", options.wait_for_wearer, 0.0, 86'400.0);
  options.wait_for_sensors = start.number("wait_for_sensors", options.wait_for_sensors, 0.0, 86'400.0);
  options.run_dir = root.path("run_dir", options.run_dir);
  return options;
}

}  // namespace cosight::robot
