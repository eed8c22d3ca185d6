#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <utility>

#include "shared/recording/recorder.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::recording {

/// A folder that is gone with the test.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::path(testing::TempDir()) /
              ("cosight_recording_" + std::to_string(getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// A recorder that runs in a thread of its own until it is asked for its summary.
class RunningRecorder {
 public:
  RunningRecorder(const transport::Participant& participant, RecorderOptions options, SessionNotes notes = {})
      : recorder_(participant, std::move(options), MessageSchemas::built_in(), std::move(notes)),
        summary_(std::async(std::launch::async, [this] {
          return recorder_.run(stop_, save_, [this](const RecorderStatus& status) {
            received_ = status.counters.received;
            saved_ = status.saved;
          });
        })) {}
  ~RunningRecorder() { stop_ = true; }
  RunningRecorder(const RunningRecorder&) = delete;
  RunningRecorder& operator=(const RunningRecorder&) = delete;

  bool has_received(std::uint64_t messages) {
    return transport::eventually([&] { return received_ >= messages; });
  }
  void save_ring() {
    const std::uint64_t before = saved_;
    ++save_;
    transport::eventually([&] { return saved_ > before; });
  }
  RecordedSummary finish() {
    stop_ = true;
    return summary_.get();
  }

 private:
  std::atomic<bool> stop_ = false;
  std::atomic<int> save_ = 0;
  std::atomic<std::uint64_t> received_ = 0;
  std::atomic<std::uint64_t> saved_ = 0;
  Recorder recorder_;
  std::future<RecordedSummary> summary_;
};

}  // namespace cosight::recording
