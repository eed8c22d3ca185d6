#pragma once

#include <map>
#include <random>
#include <set>
#include <vector>

#include "experiments/urban_canyon/city_view.hpp"
#include "robot_agent/vins/window.hpp"

namespace cosight::experiments {

/// How well the corners of an image can be followed. By day all alike; at night some far better than others.
struct FrontEndOptions {
  int features = 110;
  double min_distance = 22.0;  ///< between features when they are chosen [px]
  double noise = 0.25;         ///< of a typical feature [px]
  double noise_spread = 1.25;  ///< one standard deviation of a feature's own noise is that factor
  double loss = 0.01;          ///< probability that a typical feature is lost in a frame
  double slip = 0.0;           ///< probability that a typical feature slips to something beside it, a frame
  double ransac_threshold = 1.0;  ///< from the epipolar line between two frames [px]
  double ransac_confidence = 0.999;
};

/// A front end as the paper's: corners are chosen spread over the image, followed from frame to frame until
/// they are lost, and rejected where RANSAC finds them off the epipolar line of two neighbouring frames.
///
/// It knows no motion but what it sees: what moves along with the car or against it stays on the line and
/// passes, and where vehicles fill the view, the static features are what RANSAC rejects.
class FrontEnd {
 public:
  FrontEnd(const FrontEndOptions& options, std::mt19937_64& random) : options_(options), random_(random) {}

  /// What the camera sees now, in the undistorted image plane.
  std::vector<vins::TrackedFeature> look(const CityView& view);

  /// Share of all sightings so far that were of vehicles [%].
  double moving_percent() const;
  /// The features that were on vehicles.
  const std::set<vins::FeatureId>& moving() const { return moving_; }

 private:
  struct Track {
    vins::FeatureId id = 0;
    double noise = 0.0;     ///< [px]
    double poorness = 1.0;  ///< its noise in typical ones: poor texture is lost sooner too
    Eigen::Vector2d drift = Eigen::Vector2d::Zero();
    Eigen::Vector2d seen = Eigen::Vector2d::Zero();    ///< in the last frame [px]
    Eigen::Vector2d before = Eigen::Vector2d::Zero();  ///< in the one before it [px]
  };

  void follow(const CityView& view);
  void choose_new(const CityView& view);
  bool keeps(Track& track, const Eigen::Vector2d& uv);
  void reject_outliers();
  bool happens(double probability);

  FrontEndOptions options_;
  std::mt19937_64& random_;
  std::map<CityPoint, Track> tracks_;
  vins::FeatureId next_id_ = 1;
  double sightings_ = 0.0, moving_sightings_ = 0.0;
  std::set<vins::FeatureId> moving_;
};

}  // namespace cosight::experiments
