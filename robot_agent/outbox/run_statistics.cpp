#include "robot_agent/outbox/run_statistics.hpp"

#include "robot_agent/outbox/frame_log.hpp"

namespace cosight::outbox {
namespace {

std::uint64_t count_of(int count) {
  return static_cast<std::uint64_t>(count);
}

}  // namespace

void RunStatistics::add(const FrameBundle& bundle, const FrameEstimate& estimate) {
  ++frames_;
  without_image_ += bundle.image ? 0 : 1;
  with_worn_image_ += bundle.wearer ? 1 : 0;
  with_overlap_ += estimate.overlap.predicted ? 1 : 0;
  with_match_ += estimate.pseudo_stereo.fused + estimate.pseudo_stereo.initialised > 0 ? 1 : 0;
  ++outcomes_.at(static_cast<std::size_t>(estimate.pseudo_stereo_outcome));
  landmarks_added_ += count_of(estimate.landmarks_added);
  landmarks_removed_ += count_of(estimate.landmarks_removed);
  landmarks_sum_ += estimate.landmarks;
  add_tracking(estimate);
  add_pseudo_stereo(estimate.pseudo_stereo);
  add_search(estimate.search);
  if (!first_stamp_) first_stamp_ = estimate.stamp;
  last_stamp_ = estimate.stamp;
  frame_ms_.add(frame_ms(bundle, estimate));
}

double RunStatistics::duration_s() const {
  return first_stamp_ ? to_seconds(last_stamp_ - *first_stamp_) : 0.0;
}

void RunStatistics::report(YamlText& text) const {
  text.value("frames", frames_)
      .value("duration_s", duration_s())
      .value("path_m", path_m_)
      .value("frames_without_image", without_image_)
      .value("frames_tracking", tracking_)
      .value("frames_lost", lost_)
      .value("resets", resets_)
      .value("frames_with_worn_image", with_worn_image_)
      .value("frames_with_overlap", with_overlap_)
      .value("frames_with_pseudo_stereo", with_match_)
      .value("overlap_ratio", share(with_overlap_))
      .value("pseudo_stereo_ratio", share(with_match_))
      .value("landmarks_mean", mean(landmarks_sum_))
      .value("landmarks_added", landmarks_added_)
      .value("landmarks_removed", landmarks_removed_)
      .value("nis_per_dof_mean", nis_frames_ == 0 ? 0.0 : nis_sum_ / static_cast<double>(nis_frames_))
      .value("frame_ms_median", frame_ms_.quantile(0.5))
      .value("frame_ms_p99", frame_ms_.quantile(0.99))
      .value("frame_ms_mean", frame_ms_.mean())
      .value("frame_ms_max", frame_ms_.max());
  text.section("pseudo_stereo_outcomes");
  for (std::size_t i = 0; i < kOutcomes; ++i) {
    text.value(to_string(static_cast<PseudoStereoOutcome>(i)), outcomes_.at(i));
  }
  text.section("pseudo_stereo")
      .value("described", count_of(pseudo_stereo_.described))
      .value("ratio_test", count_of(pseudo_stereo_.ratio_test))
      .value("epipolar", count_of(pseudo_stereo_.epipolar))
      .value("too_little_parallax", count_of(pseudo_stereo_.too_little_parallax))
      .value("chi_squared", count_of(pseudo_stereo_.chi_squared))
      .value("joint_compatibility", count_of(pseudo_stereo_.joint_compatibility))
      .value("fused", count_of(pseudo_stereo_.fused))
      .value("initialised", count_of(pseudo_stereo_.initialised))
      .value("redundant", count_of(pseudo_stereo_.redundant));
  text.section("search")
      .value("predicted_in_view", count_of(search_.predicted_in_view))
      .value("searched", count_of(search_.searched))
      .value("not_found", count_of(search_.not_found))
      .value("chi_squared", count_of(search_.chi_squared))
      .value("joint_compatibility", count_of(search_.joint_compatibility))
      .value("fused_pixels", count_of(search_.fused_pixels))
      .top();
}

void RunStatistics::add_tracking(const FrameEstimate& estimate) {
  resets_ = count_of(estimate.resets);
  lost_ += estimate.tracking == Tracking::kLost ? 1 : 0;
  if (estimate.search.fused_pixels + estimate.pseudo_stereo.fused > 0) {
    nis_sum_ += estimate.nis_per_dof;
    ++nis_frames_;
  }
  if (estimate.tracking != Tracking::kTracking) {
    last_p_WS_.reset();
    return;
  }
  ++tracking_;
  if (last_p_WS_) path_m_ += (estimate.T_WS.T.p - *last_p_WS_).norm();
  last_p_WS_ = estimate.T_WS.T.p;
}

void RunStatistics::add_pseudo_stereo(const PseudoStereoCounts& counts) {
  pseudo_stereo_.described += counts.described;
  pseudo_stereo_.ratio_test += counts.ratio_test;
  pseudo_stereo_.epipolar += counts.epipolar;
  pseudo_stereo_.too_little_parallax += counts.too_little_parallax;
  pseudo_stereo_.chi_squared += counts.chi_squared;
  pseudo_stereo_.joint_compatibility += counts.joint_compatibility;
  pseudo_stereo_.fused += counts.fused;
  pseudo_stereo_.initialised += counts.initialised;
  pseudo_stereo_.redundant += counts.redundant;
}

void RunStatistics::add_search(const SearchCounts& counts) {
  search_.predicted_in_view += counts.predicted_in_view;
  search_.searched += counts.searched;
  search_.not_found += counts.not_found;
  search_.chi_squared += counts.chi_squared;
  search_.joint_compatibility += counts.joint_compatibility;
  search_.fused_pixels += counts.fused_pixels;
}

double RunStatistics::share(std::uint64_t frames) const {
  return mean(static_cast<double>(frames));
}

double RunStatistics::mean(double sum) const {
  return frames_ == 0 ? 0.0 : sum / static_cast<double>(frames_);
}

}  // namespace cosight::outbox
