#include "robot_agent/ekf/downdate_dispatch.hpp"

#include <array>

namespace cosight::ekf::kernel {
namespace {

constexpr std::array kKernels {
  KernelSet{"baseline", solve_panels_baseline, downdate_panels_baseline},
#if defined(COSIGHT_EKF_X86_KERNELS)
      KernelSet{"avx2", solve_panels_avx2, downdate_panels_avx2},
      KernelSet{"avx512", solve_panels_avx512, downdate_panels_avx512},
#endif
};

std::size_t count_available() {
#if defined(COSIGHT_EKF_X86_KERNELS)
  if (__builtin_cpu_supports("avx512f") != 0) return 3;
  if (__builtin_cpu_supports("avx2") != 0) return 2;
#endif
  return 1;
}

}  // namespace

std::span<const KernelSet> available_kernels() {
  return std::span(kKernels).first(count_available());
}

}  // namespace cosight::ekf::kernel
