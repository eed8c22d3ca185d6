#pragma once

#include <functional>

namespace cosight::experiments {

/// Calls `task` once with each of 0 … `count` - 1, from `threads` threads at once; the tasks share nothing
/// but what they write to places of their own. Returns when all are done. What a task throws ends the others
/// after the task they are at, and reaches the caller.
void in_parallel(int count, int threads, const std::function<void(int)>& task);

}  // namespace cosight::experiments
