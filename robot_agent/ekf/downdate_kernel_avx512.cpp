// Compiled for AVX-512; called only where the processor has it.
#include "robot_agent/ekf/downdate_kernel.hpp"

namespace cosight::ekf::kernel {

void solve_panels_avx512(const SolveArguments& a) {
  solve_panels<4>(a);
}

void downdate_panels_avx512(const DowndateArguments& a) {
  downdate_panels<2, 8>(a);
}

}  // namespace cosight::ekf::kernel
