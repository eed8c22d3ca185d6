#include "tools/prepare_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "tools/prepare/dataset_folder.hpp"
#include "tools/prepare/prepare_error.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;

struct PrepareArguments {
  std::string name;
  fs::path data;
  fs::path out;
  std::uint64_t seed = 1;
  double position_sigma_m = 0.0;
  std::vector<double> rotation_sigma_deg;
};

Eigen::Vector3d radians(const std::vector<double>& degrees) {
  Eigen::Vector3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    result(static_cast<int>(i)) = degrees[degrees.size() == 3 ? i : 0] * std::numbers::pi / 180.0;
  }
  return result;
}

RealSequence read_sequence(const PrepareArguments& arguments) {
  const fs::path& data = arguments.data;
  if (arguments.name == "kitti00") return read_kitti(data / "kitti00");
  if (arguments.name == "tagbox") return read_tagbox(data / "tagbox");
  if (arguments.name == "scenelib") return read_scenelib(data / "scenelib");
  if (arguments.name == "tello_line") return read_tello(data / "tello_line");
  return read_euroc(data / "euroc_v101_flight", data / "euroc_v101_views",
                    arguments.out / "wearer" / "rendered");
}

/// Standard deviations of the command line, or those this sequence is usually run with.
DatasetNoise noise_of(const PrepareArguments& arguments) {
  const bool is_euroc = arguments.name == "euroc";
  const std::vector<double> usual_rotation{is_euroc ? 0.3 : 0.05};
  const double usual_position = is_euroc ? 0.02 : 0.01;
  DatasetNoise noise;
  noise.seed = arguments.seed;
  noise.wearer_pose.position_sigma = Eigen::Vector3d::Constant(
      arguments.position_sigma_m > 0.0 ? arguments.position_sigma_m : usual_position);
  // On the command line roll, pitch, yaw; in the optical axes of Cs those are z, x, y.
  const Eigen::Vector3d roll_pitch_yaw =
      radians(arguments.rotation_sigma_deg.empty() ? usual_rotation : arguments.rotation_sigma_deg);
  noise.wearer_pose.rotation_sigma = {roll_pitch_yaw(1), roll_pitch_yaw(2), roll_pitch_yaw(0)};
  return noise;
}

void run(const PrepareArguments& arguments) {
  const RealSequence sequence = read_sequence(arguments);
  write_dataset_folder(arguments.out, sequence, noise_of(arguments));
  for (const std::string& note : sequence.notes)
    std::cout << note << '\n';
  std::cout << arguments.name << ": " << sequence.robot_images.size() << " robot frames, "
            << sequence.wearer_images.size() << " worn frames, " << sequence.known_points.size()
            << " known points -> " << arguments.out.string() << '\n';
}

}  // namespace

void add_prepare_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("prepare", "Make a two-agent dataset folder from a real sequence");
  const auto arguments = std::make_shared<PrepareArguments>();
  command->add_option("NAME", arguments->name, "Sequence")
      ->required()
      ->check(CLI::IsMember({"kitti00", "euroc", "tagbox", "scenelib", "tello_line"}));
  command->add_option("--data", arguments->data, "Folder of the real data")
      ->envname("COSIGHT_DATA")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", arguments->out, "Folder to make")->required();
  command->add_option("--seed", arguments->seed, "Of the noise on the wearer's pose")->capture_default_str();
  command->add_option("--position-sigma-m", arguments->position_sigma_m, "Noise of the wearer's position")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--rotation-sigma-deg", arguments->rotation_sigma_deg,
                   "Noise of the wearer's orientation, one value or roll,pitch,yaw")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->expected(1, 3);
  command->footer("Example: cosight prepare kitti00 --data ../shared/data --out /tmp/kitti00 --seed 1");
  command->callback([arguments] {
    if (arguments->rotation_sigma_deg.size() == 2) {
      throw PrepareError("--rotation-sigma-deg: give one value, or three as roll,pitch,yaw");
    }
    run(*arguments);
  });
}

}  // namespace cosight
