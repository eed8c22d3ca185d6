#include "experiments/urban_canyon/parallel.hpp"

#include <atomic>
#include <thread>
#include <vector>

namespace cosight::experiments {

void in_parallel(int count, int threads, const std::function<void(int)>& task) {
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++)
      task(i);
  };
  std::vector<std::jthread> workers;
  for (int i = 0; i < threads; ++i)
    workers.emplace_back(work);
}

}  // namespace cosight::experiments
