#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace cosight::sim {

/// Runs `work(worker, job)` for each job 0 … jobs - 1, jobs in turn to whichever of `threads` threads is
/// free. The first exception is thrown again at the end.
template <class MakeWorker, class Work>
void for_each_job(std::size_t jobs, unsigned threads, const MakeWorker& make_worker, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&] {
    try {
      auto worker = make_worker();
      for (std::size_t job = next++; job < jobs; job = next++)
        work(worker, job);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = jobs;
    }
  };
  {
    std::vector<std::jthread> pool;
    for (unsigned k = 0; k < threads; ++k)
      pool.emplace_back(run);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace cosight::sim
