#pragma once

namespace cosight {

/// What this process has used since its start.
struct ProcessUsage {
  double cpu_seconds = 0.0;     ///< user and system, all threads
  double peak_memory_mb = 0.0;  ///< largest resident set [1e6 bytes]
};
ProcessUsage process_usage();

}  // namespace cosight
