#include "experiments/urban_canyon/parallel.hpp"

#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "shared/program/status_line.hpp"

namespace cosight::experiments {
namespace {

/// Counts what is done, and keeps the first failure.
class Progress {
 public:
  Progress(std::string what, int count) : what_(std::move(what)), count_(count) { show(); }

  void add() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    show();
  }
  void fail(std::exception_ptr failure) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void show() {
    if (line_.is_visible())
      line_.show(what_ + ": " + std::to_string(done_) + " of " + std::to_string(count_));
  }

  std::string what_;
  int count_;
  int done_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
  StatusLine line_;
};

}  // namespace

void Workers::run(const std::string& what, int count, const std::function<void(int)>& task) const {
  std::atomic<int> next = 0;
  Progress progress(what, count);
  const auto work = [&] {
    try {
      for (int i = next++; i < count && !stop_; i = next++) {
        task(i);
        progress.add();
      }
    } catch (...) {
      next = count;
      progress.fail(std::current_exception());
    }
  };
  {
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(threads_));
    for (int i = 0; i < threads_; ++i)
      workers.emplace_back(work);
  }
  progress.rethrow();
  if (stop_) throw Interrupted(what + ": stopped before all were done; there is no summary");
}

}  // namespace cosight::experiments
