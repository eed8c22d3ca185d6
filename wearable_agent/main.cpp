#include <spdlog/spdlog.h>

#include <cstdio>

#include "shared/program/agent_options.hpp"
#include "shared/program/program.hpp"
#include "shared/program/status_line.hpp"
#include "wearable_agent/wearable_agent.hpp"

namespace {

using namespace cosight;  // NOLINT(google-build-using-namespace): a program's own file

ExitCode run(const ConfigFile& config, const std::atomic<bool>& stop) {
  const auto options = wearable::read_wearable_options(config.root());
  config.refuse_unknown_keys();
  wearable::WearableAgent agent(options, stop);
  StatusLine status;
  const auto report = agent.run([&](const wearable::RunReport& so_far, int frame_readers) {
    if (status.is_visible()) status.show(wearable::status_text(so_far, frame_readers));
  });
  status.clear();
  std::fputs(wearable::summary_yaml(report).c_str(), stdout);
  if (!options.summary.empty()) wearable::write_summary(options.summary, report);
  if (!report.lost_data()) return ExitCode::kDone;
  spdlog::warn("{} frames and {} orientations could not be used, {} messages not be sent",
               report.frames.lost(), report.orientations.lost(), report.sent.not_taken);
  return ExitCode::kDataLost;
}

}  // namespace

int main(int argc, char** argv) {
  Program program({.name = "wearable_agent",
                   .purpose = "Streams the worn camera and its orientation over DDS.",
                   .examples = "  wearable_agent --dataset runs/demo/dataset\n"
                               "  wearable_agent --images mav0/cam0 --rate 0.5 --loop\n"
                               "  wearable_agent --config config/wearable.yaml --device /dev/video0\n"});
  add_agent_options(program)
      .option("--encoding", "input.encoding", "jpeg, png or raw")
      .option("--quality", "input.quality", "of JPEG, 1 to 100; 0: pass JPEG files on unchanged")
      .option("--gate", "input.gate", "frames only in these seconds, such as 0:1.5,3:4.2")
      .option("--wait-for-robot", "start.wait_for_robot",
              "seconds to wait for a robot before the first frame")
      .option("--summary", "summary", "yaml file for the figures of the run");
  return program.run(argc, argv, run);
}
