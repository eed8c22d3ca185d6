// Compiled for AVX2; called only where the processor has it.
#include "robot_agent/ekf/downdate_kernel.hpp"

namespace cosight::ekf::kernel {

void solve_panels_avx2(const SolveArguments& a) {
  solve_panels<2>(a);
}

void downdate_panels_avx2(const DowndateArguments& a) {
  downdate_panels<1, 4>(a);
}

}  // namespace cosight::ekf::kernel
