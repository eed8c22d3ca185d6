#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace cosight::outbox {

/// Durations of any number of frames in constant memory: quantiles to 1 % of their value between 1 us and
/// 1000 s, mean and maximum exact.
class DurationHistogram {
 public:
  void add(double milliseconds);

  /// The smallest duration that a share `q` in [0, 1] of the frames did not exceed; 0 without frames [ms].
  double quantile(double q) const;
  double mean() const { return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_); }
  double max() const { return max_; }
  std::uint64_t count() const { return count_; }

 private:
  // Bin i holds [kLeast kRatio^i, kLeast kRatio^(i+1)): 1.02^1047 = 1e9.
  static constexpr double kLeast = 1e-3;  // [ms]
  static constexpr double kRatio = 1.02;
  static constexpr std::size_t kBins = 1'048;

  std::array<std::uint64_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  double sum_ = 0.0;
  double max_ = 0.0;
};

}  // namespace cosight::outbox
