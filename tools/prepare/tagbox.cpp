#include <fstream>
#include <sstream>
#include <string>

#include "shared/config/calibration.hpp"
#include "shared/dataset/number_text.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "tools/prepare/image_list.hpp"
#include "tools/prepare/prepare_error.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight {
namespace {

constexpr Stamp kFirstStamp = 1000 * kNanosecondsPerSecond;  // the data's own starts at zero
constexpr double kMetresPerCentimetre = 0.01;

std::ifstream opened(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw PrepareError(path.string() + ": cannot be opened");
  return file;
}

/// Corners of the box, "x, y, z" a line [cm], returned in metres.
std::vector<Eigen::Vector3d> read_corners(const std::filesystem::path& path) {
  std::ifstream file = opened(path);
  std::vector<Eigen::Vector3d> corners;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const auto parts = split_at_commas(line);
    if (parts.size() == 1 && parts[0].empty()) continue;
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = parts.size() == 3 ? parse_number(parts[i]) : std::nullopt;
      if (!value) throw PrepareError(path.string() + ":" + std::to_string(number) + ": is not 'x, y, z'");
      p_W(static_cast<int>(i)) = *value * kMetresPerCentimetre;
    }
    corners.push_back(p_W);
  }
  return corners;
}

/// Pixels of all corners in the first frame: u v u v … in one line.
std::vector<Eigen::Vector2d> read_first_pixels(const std::filesystem::path& path) {
  std::ifstream file = opened(path);
  std::string line;
  std::getline(file, line);
  std::istringstream numbers(line);
  std::vector<Eigen::Vector2d> pixels;
  for (Eigen::Vector2d pixel; numbers >> pixel.x() >> pixel.y();)
    pixels.push_back(pixel);
  return pixels;
}

std::vector<KnownPoint> read_known_points(const std::filesystem::path& folder) {
  const auto corners = read_corners(folder / "p_W_corners.txt");
  const auto pixels = read_first_pixels(folder / "detected_corners.txt");
  if (corners.size() != pixels.size()) {
    throw PrepareError((folder / "detected_corners.txt").string() + ":1: has " +
                       std::to_string(pixels.size()) + " pixels for " + std::to_string(corners.size()) +
                       " corners");
  }
  std::vector<KnownPoint> points;
  for (std::size_t i = 0; i < corners.size(); ++i)
    points.push_back({corners[i], pixels[i]});
  return points;
}

}  // namespace

RealSequence read_tagbox(const std::filesystem::path& folder) {
  RealSequence sequence;
  sequence.robot_camera = load_camera_model(folder / "calib.yaml", "cam0");
  sequence.known_points = read_known_points(folder);
  const Trajectory truth = read_trajectory(folder / "gt_cam0_pnp.tum");
  const auto images = images_in(folder / "cam0");
  if (images.size() != truth.size()) {
    throw PrepareError((folder / "cam0").string() + ": holds " + std::to_string(images.size()) +
                       " images for " + std::to_string(truth.size()) + " poses; the data is incomplete");
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sequence.robot_images.push_back({truth[i].stamp + kFirstStamp, images[i], truth[i].T_WC});
  }
  sequence.notes.emplace_back("W is the survey's own frame, in metres; nothing says which way is up");
  return sequence;
}

}  // namespace cosight
