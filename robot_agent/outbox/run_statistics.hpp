#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/outbox/duration_histogram.hpp"
#include "robot_agent/outbox/yaml_text.hpp"

namespace cosight::outbox {

/// The sums over all frames of a run, in constant memory.
class RunStatistics {
 public:
  void add(const FrameBundle& bundle, const FrameEstimate& estimate);

  std::uint64_t frames() const { return frames_; }
  double duration_s() const;
  double path_m() const { return path_m_; }

  /// Adds totals to the top level, and the sections `pseudo_stereo_outcomes`, `pseudo_stereo`, `search`.
  void report(YamlText& text) const;

 private:
  static constexpr std::size_t kOutcomes =
      static_cast<std::size_t>(PseudoStereoOutcome::kJointCompatibility) + 1;

  void add_tracking(const FrameEstimate& estimate);
  void add_pseudo_stereo(const PseudoStereoCounts& counts);
  void add_search(const SearchCounts& counts);
  double share(std::uint64_t frames) const;
  double mean(double sum) const;

  std::uint64_t frames_ = 0;
  std::uint64_t without_image_ = 0;
  std::uint64_t tracking_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t resets_ = 0;
  std::uint64_t with_worn_image_ = 0;
  std::uint64_t with_overlap_ = 0;
  std::uint64_t with_match_ = 0;
  std::uint64_t landmarks_added_ = 0;
  std::uint64_t landmarks_removed_ = 0;
  std::array<std::uint64_t, kOutcomes> outcomes_{};
  PseudoStereoCounts pseudo_stereo_;
  SearchCounts search_;
  double landmarks_sum_ = 0.0;
  double nis_sum_ = 0.0;
  std::uint64_t nis_frames_ = 0;
  double path_m_ = 0.0;
  std::optional<Eigen::Vector3d> last_p_WS_;  ///< while tracking
  std::optional<Stamp> first_stamp_;
  Stamp last_stamp_ = 0;
  DurationHistogram frame_ms_;
};

}  // namespace cosight::outbox
