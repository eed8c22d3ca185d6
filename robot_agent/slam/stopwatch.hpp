#pragma once

#include <functional>

#include "shared/dataset/stamp.hpp"

namespace cosight::slam {

/// Laps in milliseconds on a clock that is handed in; without one every lap is zero, and results stay a
/// function of the input alone.
class Stopwatch {
 public:
  using Clock = std::function<Stamp()>;
  explicit Stopwatch(const Clock& clock) : clock_(clock), start_(now()), lap_(start_) {}

  /// Adds the time since the last lap to `stage`.
  void lap(double& stage) {
    const Stamp time = now();
    stage += milliseconds(time - lap_);
    lap_ = time;
  }
  double total() const { return milliseconds(now() - start_); }

 private:
  static double milliseconds(Stamp duration) { return static_cast<double>(duration) * 1e-6; }
  Stamp now() const { return clock_ ? clock_() : 0; }

  const Clock& clock_;
  Stamp start_;
  Stamp lap_;
};

}  // namespace cosight::slam
