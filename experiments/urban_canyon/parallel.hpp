#pragma once

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>

namespace cosight::experiments {

/// Somebody asked for an end before everything was done.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Threads that share the drives of a study. On a terminal a line tells how many are done.
class Workers {
 public:
  /// `stop` must outlive it.
  Workers(int threads, const std::atomic<bool>& stop) : threads_(threads), stop_(stop) {}

  /// Calls `task` once with each of 0 … `count` - 1, from several threads at once; the tasks share nothing
  /// but what they write to places of their own. Returns when all are done. What a task throws ends the
  /// others after the task they are at, and reaches the caller; so does Interrupted after a stop.
  void run(const std::string& what, int count, const std::function<void(int)>& task) const;

  /// A long task asks now and then, and gives up.
  bool must_stop() const { return stop_; }

 private:
  int threads_;
  const std::atomic<bool>& stop_;
};

}  // namespace cosight::experiments
