#include "shared/program/process_usage.hpp"

#include <sys/resource.h>

namespace cosight {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProcessUsage process_usage() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr double kMegabytesOfKib = 1024.0 / 1e6;
  return {.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime),
          .peak_memory_mb = static_cast<double>(usage.ru_maxrss) * kMegabytesOfKib};
}

}  // namespace cosight
