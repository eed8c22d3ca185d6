#include "robot_agent/ekf/downdate_kernel.hpp"

namespace cosight::ekf::kernel {

void solve_panels_baseline(const SolveArguments& a) {
  solve_panels<1>(a);
}

void downdate_panels_baseline(const DowndateArguments& a) {
  downdate_panels<1, 2>(a);
}

}  // namespace cosight::ekf::kernel
