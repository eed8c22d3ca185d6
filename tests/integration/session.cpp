#include "tests/integration/session.hpp"

#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <sstream>
#include <thread>
#include <utility>

namespace cosight::integration {
namespace {

namespace fs = std::filesystem;

bool bring_loopback_up() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ - 1);
  request.ifr_flags = IFF_UP;
  const bool is_up = ::ioctl(socket, SIOCSIFFLAGS, &request) == 0;
  ::close(socket);
  return is_up;
}

/// Another program on the same domain would be a third agent. A network of its own keeps everybody out;
/// where the system gives none (no root), a number that few use has to do.
int private_domain() {
  static const bool has_own_network = ::unshare(CLONE_NEWNET) == 0 && bring_loopback_up();
  constexpr int kDomains = 99;  // above, the ports reach into the ephemeral range
  return has_own_network ? 1 : 1 + static_cast<int>(::getpid() % kDomains);
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::istringstream in(text_of(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::istringstream in(line + ",");
  std::vector<std::string> cells;
  for (std::string cell; std::getline(in, cell, ',');)
    cells.push_back(cell);
  return cells;
}

bool eventually(const std::function<bool()>& condition) {
  constexpr std::chrono::seconds kPatience{60};
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds{20});
  }
  return true;
}

}  // namespace

RunFiles::RunFiles(fs::path folder) : folder_(std::move(folder)) {
  std::vector<std::string> names;
  for (const std::string& line : lines_of(folder_ / "frames.csv")) {
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    Row& row = frames_.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i)
      row[names[i]] = cells[i];
  }
  for (const std::string& line : lines_of(folder_ / "trajectory.tum")) {
    if (!line.starts_with('#')) trajectory_.push_back(line.substr(0, line.find(' ')));
  }
}

std::size_t RunFiles::frames_with_scale() const {
  return static_cast<std::size_t>(std::count_if(frames_.begin(), frames_.end(), [](const Row& row) {
    return row.at("tracking") != "waiting_for_scale";
  }));
}

int RunFiles::summary(const std::string& key) const {
  const ConfigFile file = ConfigFile::load(folder_ / "summary.yaml");
  const auto dot = key.find('.');
  if (dot == std::string::npos) return file.root().integer(key, -1);
  return file.root().section(key.substr(0, dot)).integer(key.substr(dot + 1), -1);
}

int RunFiles::count(const std::string& column, std::size_t first) const {
  int frames = 0;
  for (std::size_t i = first; i < frames_.size(); ++i)
    frames += frames_[i].at(column) != "0" ? 1 : 0;
  return frames;
}

Session::Session() {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = "cosight_integration_" + std::to_string(::getpid()) + "_" + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  folder_ = fs::path(testing::TempDir()) / name;
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  run_folder_ = folder_ / "run";
}

Session::~Session() {
  if (HasFailure()) return;  // its files say why
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

Session::Process Session::robot(const fs::path& dataset, const Arguments& more) {
  return start(ROBOT_AGENT, "robot", {"--dataset", dataset.string(), "--run-dir", run_folder().string()},
               more);
}

Session::Process Session::wearer(const fs::path& dataset, const Arguments& more) {
  return start(WEARABLE_AGENT, "wearer", {"--dataset", dataset.string(), "--set", "start.wait_for_robot=20"},
               more);
}

Session::Process Session::robot_on_topics(const Arguments& more) {
  return start(ROBOT_AGENT, "robot",
               {"--from-topics", "--run-dir", run_folder().string(), "--set", "input.end_after_s=1"}, more);
}

Session::Process Session::live_scene(const Arguments& more) {
  return start(SIM, "sim", {"--config", small_scene_file().string(), "--live", "--seed", "1"}, more);
}

Session::Process Session::start(const std::string& program, const std::string& name, Arguments arguments,
                                const Arguments& more) {
  const Arguments apart{"--domain", std::to_string(private_domain()), "--set", "dds.interfaces=[lo]"};
  arguments.insert(arguments.end(), apart.begin(), apart.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return std::make_unique<ChildProcess>(program, arguments, in_folder(name + std::to_string(++started_)));
}

Session::Process Session::robot_from(const std::filesystem::path& recording, const Arguments& more) {
  Arguments arguments{"--from", recording, "--rate", "0", "--run-dir", run_folder()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return std::make_unique<ChildProcess>(ROBOT_AGENT, arguments,
                                        in_folder("offline" + std::to_string(++started_)));
}

Session::Process Session::recorder(const std::filesystem::path& recording) {
  const Arguments arguments{"record",      recording, "--domain", std::to_string(private_domain()),
                            "--interface", "lo"};
  return std::make_unique<ChildProcess>(COSIGHT, arguments,
                                        in_folder("recorder" + std::to_string(++started_)));
}

bool Session::robot_reaches(int frames) const {
  return eventually([&] { return run_files().frames().size() >= static_cast<std::size_t>(frames); });
}

bool Session::says(const ChildProcess& process, const std::string& text) {
  return eventually([&] { return process.err().find(text) != std::string::npos; });
}

}  // namespace cosight::integration
