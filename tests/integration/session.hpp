#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "shared/config/config.hpp"
#include "tests/integration/child_process.hpp"
#include "tests/integration/small_scene.hpp"

namespace cosight::integration {

/// What a robot wrote into its run folder.
class RunFiles {
 public:
  explicit RunFiles(std::filesystem::path folder);

  using Row = std::map<std::string, std::string>;  ///< column -> cell
  const std::vector<Row>& frames() const { return frames_; }
  /// Stamps of the trajectory as it writes them [s].
  const std::vector<std::string>& trajectory() const { return trajectory_; }
  /// Frames since the scale is known: one pose each.
  std::size_t frames_with_scale() const;
  const std::filesystem::path& folder() const { return folder_; }

  /// `inbox.paired` or `frames` of summary.yaml; -1 when it is not there.
  int summary(const std::string& key) const;

  /// Frames whose cell in `column` is not "0", from frame `first` on.
  int count(const std::string& column, std::size_t first = 0) const;

 private:
  std::filesystem::path folder_;
  std::vector<Row> frames_;
  std::vector<std::string> trajectory_;
};

/// `testing::Matcher`: the files of a run hold `frames` frames in the order of their stamps, and end at the
/// last frame of `dataset`.
MATCHER_P2(IsCompleteToTheLastFrame, frames, dataset, "") {
  *result_listener << arg.frames().size() << " rows of frames.csv, " << arg.trajectory().size() << " poses, "
                   << arg.summary("frames") << " frames in summary.yaml in " << arg.folder();
  const std::string last = last_stamp(std::filesystem::path(dataset) / "robot/cam0.csv");
  const auto count = static_cast<std::size_t>(frames);
  return arg.frames().size() == count && arg.trajectory().size() == arg.frames_with_scale() &&
         arg.summary("frames") == static_cast<int>(count) && arg.frames().back().at("stamp_ns") == last;
}

/// Two agents in a folder and on a domain of their own.
class Session : public testing::Test {
 protected:
  using Arguments = std::vector<std::string>;
  using Process = std::unique_ptr<ChildProcess>;

  Session();
  ~Session() override;

  std::filesystem::path in_folder(const std::string& name) const { return folder_ / name; }

  /// Started on the session's domain; the robot writes into `run_folder()`.
  Process robot(const std::filesystem::path& dataset, const Arguments& more = {});
  Process wearer(const std::filesystem::path& dataset, const Arguments& more = {});

  /// A robot that has its sensors, and all that it knows of them, from topics.
  Process robot_on_topics(const Arguments& more = {});

  /// The small scene, live: what both agents' sensors say, on the session's domain.
  Process live_scene(const Arguments& more = {});

  /// A robot that is fed by a recording, without DDS.
  Process robot_from(const std::filesystem::path& recording, const Arguments& more = {});
  /// Records the session's domain.
  Process recorder(const std::filesystem::path& recording);

  const std::filesystem::path& run_folder() const { return run_folder_; }
  void write_into(const std::filesystem::path& run_folder) { run_folder_ = run_folder; }
  RunFiles run_files() const { return RunFiles(run_folder()); }

  /// Until the robot's frames.csv has that many frames; false when it does not come to that.
  bool robot_reaches(int frames) const;
  /// Until `text` stands on its stderr.
  static bool says(const ChildProcess& process, const std::string& text);

 private:
  Process start(const std::string& program, const std::string& name, Arguments arguments,
                const Arguments& more);

  std::filesystem::path folder_;
  std::filesystem::path run_folder_;
  int started_ = 0;
};

}  // namespace cosight::integration
