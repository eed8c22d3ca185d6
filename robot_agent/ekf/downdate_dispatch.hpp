#pragma once

#include <span>

#include "robot_agent/ekf/downdate_kernel.hpp"

namespace cosight::ekf::kernel {

struct KernelSet {
  const char* name;
  SolvePanels solve;
  DowndatePanels downdate;
};

/// All that this processor can run, the fastest last. All give the same bytes.
std::span<const KernelSet> available_kernels();

}  // namespace cosight::ekf::kernel
