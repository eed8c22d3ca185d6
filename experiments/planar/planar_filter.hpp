#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace cosight::experiments {

struct PlanarFilterOptions {
  double sigma_acceleration = 0.3;           ///< [m/s^2] each axis
  double sigma_angular_acceleration = 0.15;  ///< [rad/s^2]
  double bearing_sigma = 0.01745;            ///< [rad]
  double stereo_bearing_sigma = 0.1047;      ///< [rad]
  double range_sigma = 0.5;                  ///< [m]
  double start_sigma_velocity = 0.5;         ///< [m/s]
  double start_sigma_turn = 0.2;             ///< [rad/s]
  /// [m] across the first ray before a landmark gets a depth from Cs alone; a measured parallax instead
  /// would choose the moment at which noise makes it large.
  double min_baseline = 1.6;
};

/// The camera's part of the state, [x z theta vx vz omega] (C9).
struct PlanarCamera {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();  ///< [m]
  double theta = 0.0;                           ///< [rad]
  Eigen::Vector2d v = Eigen::Vector2d::Zero();  ///< [m/s]
  double omega = 0.0;                           ///< [rad/s]
};

/// One landmark in one frame; depth when the free camera saw it as well.
struct PlanarMeasurement {
  int landmark = 0;
  double bearing = 0.0;  ///< [rad]
  struct Stereo {
    double bearing = 0.0;  ///< [rad]
    double range = 0.0;    ///< [m]
  };
  std::optional<Stereo> stereo;
};

/// The 2-DoF collaborative DI-D EKF of C sections 3.3 and 5.1. A landmark is w_i = [x0 z0 theta rho] (C11):
/// its first sighting enters the state at once as [x0 z0 theta], fully correlated; rho follows when the
/// parallax allows it (delayed), or with the first pseudo-stereo range.
class PlanarFilter {
 public:
  /// Starts at the origin, where W is, with a known heading [rad] and unknown velocities about zero.
  PlanarFilter(const PlanarFilterOptions& options, double theta);

  /// A landmark at a surveyed point: the metric start.
  void add_known_landmark(int landmark, const Eigen::Vector2d& point, double sigma);

  /// Constant velocity over `dt` [s]; unknown accelerations as impulses.
  void predict(double dt);
  /// Fuses what has a depth already, then starts depths and landmarks.
  void update(std::span<const PlanarMeasurement> measurements);
  /// Forgets the first sightings of landmarks that have no depth and are not in `in_view`.
  void drop_lost_candidates(std::span<const PlanarMeasurement> in_view);

  PlanarCamera camera() const;
  /// Of [x z].
  Eigen::Matrix2d position_covariance() const { return P_.topLeftCorner<2, 2>(); }
  const Eigen::MatrixXd& P() const { return P_; }

  struct Landmark {
    int id = 0;
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [m]; not finite at infinity
    double rho = 0.0;                                 ///< [1/m]
    double sigma_rho = 0.0;
  };
  /// Those that have a depth, in the order in which they were first seen.
  std::vector<Landmark> landmarks() const;

 private:
  /// Where a landmark stands in x: [x0 z0 theta] at `anchor`, rho at `rho`, -1 before it has one.
  struct Block {
    int id = 0;
    int anchor = 0;
    int rho = -1;
  };
  struct Rows;

  Block* find(int id);
  void append(const Eigen::VectorXd& y, const Eigen::MatrixXd& J, const Eigen::MatrixXd& noise);
  void remove(int offset, int dim);
  void remove_block(std::size_t index);
  void add_candidate(const PlanarMeasurement& measurement);
  void add_stereo_landmark(const PlanarMeasurement& measurement);
  void start_depth(Block& block, double bearing);
  void append_rows(const Block& block, const PlanarMeasurement& measurement, Rows& rows) const;
  void correct(const Rows& rows);

  PlanarFilterOptions options_;
  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
  std::vector<Block> blocks_;
};

}  // namespace cosight::experiments
