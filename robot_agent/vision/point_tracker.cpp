#include "robot_agent/vision/point_tracker.hpp"

#include <cstddef>
#include <opencv2/video/tracking.hpp>
#include <utility>

#include "robot_agent/vision/opencv_view.hpp"

namespace cosight::vision {
namespace {

using Pyramid = std::vector<cv::Mat>;

struct Flow {
  std::vector<cv::Point2f> to;
  std::vector<std::uint8_t> found;
};

cv::Point2f to_opencv(const Eigen::Vector2d& pixel) {
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
}

Flow follow(const Pyramid& from_image, const Pyramid& to_image, const std::vector<cv::Point2f>& from,
            std::vector<cv::Point2f> guess, const TrackerOptions& options) {
  Flow flow{std::move(guess), {}};
  std::vector<float> residual;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01);
  cv::calcOpticalFlowPyrLK(from_image, to_image, from, flow.to, flow.found, residual,
                           {options.window, options.window}, options.levels - 1, stop,
                           cv::OPTFLOW_USE_INITIAL_FLOW, 1e-4);
  return flow;
}

Track judge(const TrackStart& start, const Eigen::Vector2d& pixel, double forward_backward,
            const GrayImage& image, const TrackerOptions& options) {
  Track track;
  track.pixel = pixel;
  const double margin = start.first != nullptr ? start.first->half() : 1.0;
  if (!(pixel.x() >= margin && pixel.y() >= margin && pixel.x() <= image.width - 1 - margin &&
        pixel.y() <= image.height - 1 - margin)) {
    track.outcome = TrackOutcome::kOutsideImage;
    return track;
  }
  if (!(forward_backward <= options.max_forward_backward)) {
    track.outcome = TrackOutcome::kInconsistent;
    return track;
  }
  track.outcome = TrackOutcome::kTracked;
  if (start.first == nullptr) return track;
  track.score = zncc(*start.first, cut_patch(image, pixel, start.first->side));
  if (track.score < options.min_score) track.outcome = TrackOutcome::kChanged;
  return track;
}

}  // namespace

struct PointTracker::Pyramids {
  Pyramid previous;
  Pyramid present;
  GrayImage image;  ///< of `present`, for the check against the first patch
};

PointTracker::PointTracker(const TrackerOptions& options)
    : options_(options), pyramids_(std::make_unique<Pyramids>()) {}

PointTracker::~PointTracker() = default;

void PointTracker::advance(const GrayImage& image) {
  std::swap(pyramids_->previous, pyramids_->present);
  pyramids_->image = image;
  cv::buildOpticalFlowPyramid(opencv_view(pyramids_->image), pyramids_->present,
                              {options_.window, options_.window}, options_.levels - 1);
}

std::vector<Track> PointTracker::track(const std::vector<TrackStart>& starts) const {
  std::vector<Track> tracks(starts.size());
  const Pyramid& previous = pyramids_->previous;
  const Pyramid& present = pyramids_->present;
  if (starts.empty() || previous.empty() || present.empty() || previous[0].size() != present[0].size()) {
    return tracks;
  }
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> guess;
  for (const TrackStart& start : starts) {
    from.push_back(to_opencv(start.previous));
    guess.push_back(to_opencv(start.predicted));
  }
  const Flow forward = follow(previous, present, from, std::move(guess), options_);
  const Flow backward = follow(present, previous, forward.to, from, options_);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (forward.found[i] == 0) continue;
    const Eigen::Vector2d pixel(forward.to[i].x, forward.to[i].y);
    const double error =
        backward.found[i] != 0 ? cv::norm(backward.to[i] - from[i]) : options_.max_forward_backward + 1.0;
    tracks[i] = judge(starts[i], pixel, error, pyramids_->image, options_);
  }
  return tracks;
}

}  // namespace cosight::vision
