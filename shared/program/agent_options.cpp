#include "shared/program/agent_options.hpp"

namespace cosight {

Program& add_agent_options(Program& program) {
  return program.option("--dataset", "input.dataset", "Cosight dataset folder")
      .option("--images", "input.images",
              "csv, EuRoC or KITTI folder, or a plain folder with --set input.rate_hz")
      .option("--video", "input.video", "video file")
      .option("--device", "input.device", "V4L2 camera, such as /dev/video0")
      .option("--calibration", "input.calibration", "the camera's yaml file")
      .option("--rate", "replay.rate", "times real time; 0: as fast as possible")
      .flag("--loop", "replay.loop", "start again at the end")
      .option("--domain", "dds.domain", "DDS domain, 0 to 232");
}

}  // namespace cosight
