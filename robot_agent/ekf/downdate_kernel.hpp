#pragma once

// The arithmetic of the covariance update on raw memory, compiled once for each instruction set: no library
// header here, or code for one machine could be linked into the program of another. Every sum runs in the
// same order in all of them and without fused multiply-add: the bytes are the same on every machine.

namespace cosight::ekf::kernel {

/// A panel holds eight rows of W: its k-th vector is W(8 p .. 8 p + 7, k).
inline constexpr int kPanelRows = 8;

/// W = B L^-T and d = W w. B: rows x depth, column-major, readable in whole panels. L: depth x depth, lower,
/// column-major. W: whole panels, each depth x 8. d: whole panels.
struct SolveArguments {
  const double* B;
  long B_stride;
  const double* L;
  long L_stride;
  const double* w;
  double* W;
  double* d;
  int panels;
  int depth;
};

/// P -= W W^T in the lower triangle of the size x size matrix P, column-major.
struct DowndateArguments {
  const double* W;
  double* P;
  long P_stride;
  int panels;
  int depth;
  int size;
};

using SolvePanels = void (*)(const SolveArguments&);
using DowndatePanels = void (*)(const DowndateArguments&);

void solve_panels_baseline(const SolveArguments& a);
void downdate_panels_baseline(const DowndateArguments& a);
void solve_panels_avx2(const SolveArguments& a);
void downdate_panels_avx2(const DowndateArguments& a);
void solve_panels_avx512(const SolveArguments& a);
void downdate_panels_avx512(const DowndateArguments& a);

// From here on every translation unit has its own copy: static, as the instruction sets differ.

using Vector8 = double __attribute__((vector_size(64), may_alias));
using Unaligned8 = double __attribute__((vector_size(64), aligned(8), may_alias));

template <int Panels>
static inline void solve_panel_group(const SolveArguments& a, int first) {
  for (int k = 0; k < a.depth; ++k) {
    Vector8 sum[Panels];
    for (int p = 0; p < Panels; ++p) {
      sum[p] = *reinterpret_cast<const Unaligned8*>(a.B + k * a.B_stride + (first + p) * kPanelRows);
    }
    for (int l = 0; l < k; ++l) {
      const double L_kl = a.L[l * a.L_stride + k];
      for (int p = 0; p < Panels; ++p) {
        const long at = (static_cast<long>(first + p) * a.depth + l) * kPanelRows;
        sum[p] -= *reinterpret_cast<const Vector8*>(a.W + at) * L_kl;
      }
    }
    const double inverse = 1.0 / a.L[k * a.L_stride + k];
    for (int p = 0; p < Panels; ++p) {
      const long at = (static_cast<long>(first + p) * a.depth + k) * kPanelRows;
      const Vector8 W_k = sum[p] * inverse;
      *reinterpret_cast<Vector8*>(a.W + at) = W_k;
      auto* d = reinterpret_cast<Vector8*>(a.d + (first + p) * kPanelRows);
      *d = k == 0 ? W_k * a.w[0] : *d + W_k * a.w[k];
    }
  }
}

template <int Group>
static inline void solve_panels(const SolveArguments& a) {
  int p = 0;
  for (; p + Group <= a.panels; p += Group)
    solve_panel_group<Group>(a, p);
  for (; p < a.panels; ++p)
    solve_panel_group<1>(a, p);
}

/// Rows of `RowPanels` panels from `row_panel`, `Columns` columns of panel `column_panel` from its `column`.
template <int RowPanels, int Columns>
static inline void downdate_tile(const DowndateArguments& a, int row_panel, int column_panel, int column) {
  Vector8 sum[Columns][RowPanels] = {};
  const long panel_size = static_cast<long>(a.depth) * kPanelRows;
  const double* rows = a.W + row_panel * panel_size;
  const double* columns = a.W + column_panel * panel_size + column;
  for (int k = 0; k < a.depth; ++k) {
    for (int p = 0; p < RowPanels; ++p) {
      const Vector8 W_row = *reinterpret_cast<const Vector8*>(rows + p * panel_size + k * kPanelRows);
      for (int c = 0; c < Columns; ++c)
        sum[c][p] += W_row * columns[k * kPanelRows + c];
    }
  }
  for (int c = 0; c < Columns; ++c) {
    const int j = column_panel * kPanelRows + column + c;
    if (j >= a.size) return;
    for (int p = 0; p < RowPanels; ++p) {
      const int i = (row_panel + p) * kPanelRows;
      double* P = a.P + j * a.P_stride + i;
      if (i > j && i + kPanelRows <= a.size) {
        *reinterpret_cast<Unaligned8*>(P) -= sum[c][p];
        continue;
      }
      for (int r = 0; r < kPanelRows && i + r < a.size; ++r) {
        if (i + r >= j) P[r] -= sum[c][p][r];
      }
    }
  }
}

template <int RowPanels, int Columns>
static inline void downdate_panels(const DowndateArguments& a) {
  for (int j = 0; j < a.panels; ++j) {
    int i = j;
    for (; i + RowPanels <= a.panels; i += RowPanels) {
      for (int c = 0; c < kPanelRows; c += Columns)
        downdate_tile<RowPanels, Columns>(a, i, j, c);
    }
    for (; i < a.panels; ++i) {
      for (int c = 0; c < kPanelRows; c += Columns)
        downdate_tile<1, Columns>(a, i, j, c);
    }
  }
}

}  // namespace cosight::ekf::kernel
