#include "tests/integration/small_scene.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "tests/integration/child_process.hpp"

namespace cosight::integration {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCorridor = R"(
name: integration
duration_s: 4
known_points: 12
world:
  floor: carpet
  ceiling: panels
  outlines:
    - {corners_m: [[-2.5, -1.1], [9, -1.1], [9, 1.1], [-2.5, 1.1]], decoration: 1.0}
  boxes:
    - {centre_m: [3.0, 0.9], size_m: [1.2, 0.4, 0.75], material: wood}
robot:
  path: {waypoints_m: [[-1.2, 0.0], [6.0, 0.0]], speed_mps: 0.7, ramp_s: 1.0}
  camera: &camera {width_px: 320, height_px: 240, focal_length_px: 230}
wearer:
  ahead_m: [[0, 0.5]]
  left_m: [[0, 0.5]]
  gaze_left_deg: [[0, -5]]
  camera: *camera
)";

/// Rendered at construction, gone with the process.
class RenderedScene {
 public:
  RenderedScene()
      : folder_(fs::path(testing::TempDir()) / ("cosight_integration_scene_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "scene.yaml") << kCorridor;
    ChildProcess sim(
        SIM, {"--config", (folder_ / "scene.yaml").string(), "--out", dataset().string(), "--seed", "1"},
        folder_ / "sim");
    const Ending ending = sim.wait(std::chrono::seconds{90});
    if (ending.exit_code != 0) throw std::runtime_error("sim failed: " + ending.err);
  }
  RenderedScene(const RenderedScene&) = delete;
  RenderedScene& operator=(const RenderedScene&) = delete;
  ~RenderedScene() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path dataset() const { return folder_ / "dataset"; }

 private:
  fs::path folder_;
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char letter : line) {
    if (letter == ',') {
      cells.emplace_back();
    } else {
      cells.back() += letter;
    }
  }
  return cells;
}

std::string join(const std::vector<std::string>& cells) {
  std::string line = cells.front();
  for (std::size_t i = 1; i < cells.size(); ++i)
    line += "," + cells[i];
  return line;
}

}  // namespace

const fs::path& small_scene() {
  static const RenderedScene scene;
  static const fs::path dataset = scene.dataset();
  return dataset;
}

fs::path small_scene_file() {
  return small_scene().parent_path() / "scene.yaml";
}

void copy_small_scene(const fs::path& to) {
  fs::copy(small_scene(), to, fs::copy_options::recursive);
}

void change_rows(const fs::path& csv,
                 const std::function<void(std::size_t, std::vector<std::string>&)>& change) {
  std::istringstream in(text_of(csv));
  std::ofstream out(csv);
  std::string line;
  std::getline(in, line);
  out << line << '\n';
  for (std::size_t row = 0; std::getline(in, line); ++row) {
    std::vector<std::string> cells = split(line);
    change(row, cells);
    if (!cells.empty()) out << join(cells) << '\n';
  }
}

std::string last_stamp(const fs::path& csv) {
  std::istringstream in(text_of(csv));
  std::string last;
  for (std::string line; std::getline(in, line);)
    last = split(line).front();
  return last;
}

}  // namespace cosight::integration
