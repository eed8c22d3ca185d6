#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "robot_agent/outbox/duration_histogram.hpp"
#include "robot_agent/outbox/line_file.hpp"
#include "robot_agent/outbox/yaml_text.hpp"
#include "robot_agent/vins/vins_thread.hpp"

namespace cosight::robot {

/// "tracking", "failed: jumped", "not yet observable: too little parallax".
std::string spoken(const vins::VinsEstimate& estimate);

/// What VINS made of a run: `vins.tum` frame by frame, and the sums for summary.yaml.
class VinsRecord {
 public:
  /// Throws OutputError.
  explicit VinsRecord(const std::filesystem::path& folder);

  /// `T_WS`: while tracking.
  void add(const vins::VinsEstimate& estimate, const std::optional<Pose>& T_WS);

  /// Returns what could not be written, if anything.
  std::optional<std::string> close();

  /// Sections `vins`, `vins_not_yet_observable`, `vins_failures`.
  void report(outbox::YamlText& text, const vins::VinsCounters& counters) const;

  std::uint64_t tracking() const { return tracking_; }

 private:
  static constexpr std::size_t kReasons =
      static_cast<std::size_t>(vins::InitialisationOutcome::kInconsistent) + 1;
  static constexpr std::size_t kFailures = static_cast<std::size_t>(vins::Failure::kJumped) + 1;

  outbox::LineFile trajectory_;
  std::uint64_t tracking_ = 0;
  std::uint64_t starts_ = 0;
  std::array<std::uint64_t, kReasons> not_yet_{};  ///< frames without an estimate, by what is missing
  std::array<std::uint64_t, kFailures> failures_{};
  std::optional<Stamp> first_stamp_;
  std::optional<Stamp> first_tracking_;
  std::optional<Eigen::Vector3d> last_p_WS_;  ///< while tracking
  double path_m_ = 0.0;
  std::string last_state_;
  outbox::DurationHistogram solve_ms_;
  outbox::DurationHistogram marginalise_ms_;
};

}  // namespace cosight::robot
