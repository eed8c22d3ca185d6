// Monte Carlo: is the true pose as far from the estimate as the covariance says?
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdio>
#include <map>

#include "robot_agent/ekf/filter.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/ekf/feature_world.hpp"

namespace cosight::ekf {
namespace {

struct RunOptions {
  FeatureWorldOptions world;
  FilterOptions filter;
  double claimed_variance = 1.0;  ///< the filter is told so many times the true variance of each measurement
  int map_size = 20;
  int steps = 60;
  int wearer_away_from = 1'000;  ///< step
};

/// One run of the filter in a world, association known.
class Run {
 public:
  Run(unsigned seed, const RunOptions& options)
      : options_(options), world_(seed, options.world), filter_(camera(), filter_options(options)) {
    rig_.camera_S = camera();
    rig_.camera_F = camera();
    rig_.sigma_pixel_S = filter_.options().pixel_sigma;
    rig_.sigma_pixel_F = filter_.options().pixel_sigma;
    const double scale = std::sqrt(options.claimed_variance);
    const double p = scale * options.world.wearer_sigma_p;
    const double theta = scale * options.world.wearer_sigma_theta;
    rig_.T_SF.covariance.diagonal() << p * p, p * p, p * p, theta * theta, theta * theta, theta * theta;
    start();
  }

  void step(int index) {
    world_.step();
    filter_.predict(options_.world.dt);
    const auto seen = world_.observe(index < options_.wearer_away_from);
    const auto wearer = world_.measured_wearer();
    rig_.T_SF.T = {Eigen::Quaterniond(wearer.R), wearer.p};
    measure(seen);
    grow(seen);
  }

  /// Normalised error squared of position (3) and pose (6).
  Eigen::Vector2d nees() const {
    const UncertainPose estimate = filter_.T_WS();
    Eigen::Matrix<double, 6, 1> error;
    error.head<3>() = world_.camera().p - estimate.T.p;
    error.tail<3>() = quaternion_log(
        Eigen::Quaterniond(world_.camera().R * estimate.T.q.toRotationMatrix().transpose()).normalized());
    const Eigen::Matrix3d P_position = estimate.covariance.topLeftCorner<3, 3>();
    return {error.head<3>().dot(P_position.llt().solve(error.head<3>())),
            error.dot(estimate.covariance.llt().solve(error))};
  }

  double nis_sum = 0.0;
  double nis_rows = 0.0;
  const Filter& filter() const { return filter_; }

 private:
  static CameraModel camera() {
    return {.fx = FeatureWorld::kFocal,
            .fy = FeatureWorld::kFocal,
            .cx = 0.5 * FeatureWorld::kWidth,
            .cy = 0.5 * FeatureWorld::kHeight,
            .width = FeatureWorld::kWidth,
            .height = FeatureWorld::kHeight};
  }

  static FilterOptions filter_options(const RunOptions& options) {
    FilterOptions o = options.filter;
    o.max_landmarks = options.map_size;
    o.motion = {options.world.sigma_acceleration, options.world.sigma_angular_acceleration};
    o.pixel_sigma = options.world.pixel_sigma * std::sqrt(options.claimed_variance);
    o.gate_probability = 1.0;
    return o;
  }

  void start() {
    constexpr double kSigmaP = 0.005;
    constexpr double kSigmaTheta = 0.001;
    constexpr double kSigmaV = 0.05;
    constexpr double kSigmaOmega = 0.02;
    const auto sigma = [](double s) { return s * s * Eigen::Matrix3d::Identity(); };
    UncertainPose T_WS;
    T_WS.T.q = Eigen::Quaterniond(FeatureWorld::rodrigues(kSigmaTheta * world_.draw()) * world_.camera().R);
    T_WS.T.p = world_.camera().p + kSigmaP * world_.draw();
    T_WS.covariance.topLeftCorner<3, 3>() = sigma(kSigmaP);
    T_WS.covariance.bottomRightCorner<3, 3>() = sigma(kSigmaTheta);
    filter_.reset(T_WS, kSigmaV, kSigmaOmega);
    CameraState x = filter_.camera();
    x.v_W = world_.velocity() + kSigmaV * world_.draw();
    x.omega_S = world_.angular_velocity() + kSigmaOmega * world_.draw();
    filter_.reset(x, filter_.camera_covariance());
  }

  void measure(const std::vector<FeatureWorld::Seen>& seen) {
    std::vector<Measurement> measurements;
    std::map<int, LandmarkId> still_seen;
    for (const auto& s : seen) {
      const auto known = map_.find(s.point);
      if (known == map_.end()) continue;
      still_seen.insert(*known);
      const auto point = s.pixel_F ? measure_point({s.pixel_S, *s.pixel_F}, rig_) : std::nullopt;
      const bool deep = point && is_near(s.point);
      measurements.push_back(
          deep ? Measurement::point(known->second, *point)
               : Measurement::pixel(known->second, s.pixel_S, filter_.options().pixel_sigma));
    }
    const UpdateReport& report = filter_.update(measurements);
    nis_sum += report.nis;
    nis_rows += report.rows;
    for (const auto& [point, id] : map_) {
      if (!still_seen.contains(point)) filter_.remove_landmark(id);
    }
    map_ = still_seen;
  }

  void grow(const std::vector<FeatureWorld::Seen>& seen) {
    std::vector<StereoMatch> matches;
    std::vector<int> points;
    for (const auto& s : seen) {
      if (map_.contains(s.point) || !s.pixel_F) continue;
      if (static_cast<int>(map_.size() + points.size()) >= options_.map_size) break;
      const auto point = measure_point({s.pixel_S, *s.pixel_F}, rig_);
      if (!point || !is_near(s.point)) continue;
      matches.push_back({s.pixel_S, *s.pixel_F});
      points.push_back(s.point);
    }
    const auto ids = filter_.add_pseudo_stereo_landmarks(matches, rig_);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i]) map_[points[i]] = *ids[i];
    }
  }

  /// Chosen by the truth: to choose by measured parallax favours points that look nearer than they are.
  bool is_near(int point) const { return (world_.point(point) - world_.camera().p).norm() < 10.0; }

  RunOptions options_;
  FeatureWorld world_;
  Filter filter_;
  StereoRig rig_;
  std::map<int, LandmarkId> map_;
};

/// Averages over many runs.
struct Consistency {
  double position_in_band = 0.0;  ///< share of steps whose average NEES lies inside its 95 % band
  double pose_in_band = 0.0;
  double mean_position_nees = 0.0;
  double mean_pose_nees = 0.0;
  double nis_per_row = 0.0;
};

Consistency monte_carlo(const RunOptions& options, int runs) {
  std::vector<Eigen::Vector2d> sum(static_cast<std::size_t>(options.steps), Eigen::Vector2d::Zero());
  double nis = 0.0;
  double rows = 0.0;
  for (int r = 0; r < runs; ++r) {
    Run run(static_cast<unsigned>(1'000 + r), options);
    for (int i = 0; i < options.steps; ++i) {
      run.step(i);
      sum[static_cast<std::size_t>(i)] += run.nees() / runs;
    }
    nis += run.nis_sum;
    rows += run.nis_rows;
  }
  const auto inside = [runs](double average, int dof) {
    return average * runs > chi_squared_quantile(0.025, dof * runs) &&
           average * runs < chi_squared_quantile(0.975, dof * runs);
  };
  Consistency result;
  for (const Eigen::Vector2d& average : sum) {
    result.position_in_band += (inside(average(0), 3) ? 1.0 : 0.0) / options.steps;
    result.pose_in_band += (inside(average(1), 6) ? 1.0 : 0.0) / options.steps;
    result.mean_position_nees += average(0) / options.steps;
    result.mean_pose_nees += average(1) / options.steps;
  }
  result.nis_per_row = nis / rows;
  std::printf("position NEES %.2f (%.0f %% in band), pose NEES %.2f (%.0f %% in band), NIS a row %.3f\n",
              result.mean_position_nees, 100.0 * result.position_in_band, result.mean_pose_nees,
              100.0 * result.pose_in_band, result.nis_per_row);
  return result;
}

constexpr int kRuns = 50;

/// Depth from the wearer in the first half second only: what follows is known geometry.
TEST(PoseConsistency, AverageNeesIsInsideChiSquaredBand) {
  RunOptions options;
  options.wearer_away_from = 5;
  const Consistency c = monte_carlo(options, kRuns);
  EXPECT_GE(c.position_in_band, 0.9);
  EXPECT_GE(c.pose_in_band, 0.9);
  EXPECT_NEAR(c.nis_per_row, 1.0, 0.03);
}

/// With the wearer there all the time the average is about a tenth above its six degrees of freedom: what
/// linearisation, and the error of T_SF that new landmarks share with the update before them, leave.
TEST(PoseConsistency, CollaborativeAverageNeesIsNearItsDegreesOfFreedom) {
  const Consistency c = monte_carlo({}, kRuns);
  EXPECT_LT(c.mean_position_nees, 3.9);
  EXPECT_LT(c.mean_pose_nees, 7.4);
  EXPECT_GT(c.mean_pose_nees, 5.1);
  EXPECT_NEAR(c.nis_per_row, 1.0, 0.03);
}

TEST(PoseConsistency, OverconfidentFilterIsCaught) {
  RunOptions options;
  options.claimed_variance = 1.0 / 3.0;
  options.wearer_away_from = 5;
  const Consistency c = monte_carlo(options, kRuns);
  EXPECT_LT(c.pose_in_band, 0.2);
  EXPECT_GT(c.mean_pose_nees, 8.0);
  EXPECT_GT(c.nis_per_row, 2.0);
}

/// C5 in metres: triangulated depth is too far from linear there.
TEST(PoseConsistency, PointsComparedInMetresAreOverconfident) {
  RunOptions options;
  options.filter.point_form = PointForm::kEuclidean;
  const Consistency c = monte_carlo(options, kRuns);
  EXPECT_GT(c.mean_pose_nees, 9.0);
}

/// The paper's R: the innovations are smaller than such a filter expects, because it counts one error many
/// times.
TEST(PoseConsistency, PointsTakenAsIndependentHaveTooSmallInnovations) {
  RunOptions options;
  options.filter.correlated_wearer_pose = false;
  const Consistency c = monte_carlo(options, kRuns);
  EXPECT_LT(c.nis_per_row, 0.985);
}

}  // namespace
}  // namespace cosight::ekf
