#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "robot_agent/ekf/camera_state.hpp"
#include "robot_agent/ekf/chi_squared.hpp"
#include "robot_agent/ekf/covariance_update.hpp"
#include "robot_agent/ekf/gaussian_state.hpp"
#include "robot_agent/ekf/inverse_depth_point.hpp"
#include "robot_agent/ekf/joint_innovation.hpp"
#include "robot_agent/ekf/measurement.hpp"
#include "robot_agent/ekf/motion.hpp"
#include "robot_agent/ekf/observation.hpp"
#include "robot_agent/ekf/rig_error.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/uncertain_pose.hpp"
#include "shared/geometry/uncertain_twist.hpp"

namespace cosight::ekf {

/// A camera pose kept in the state, fully correlated with everything else.
using CloneId = std::uint64_t;

/// In which coordinates a measured point is compared with its prediction. The information is the same to
/// first order; what is left of the curvature is not.
enum class PointForm {
  kEuclidean,        ///< x, y, z in S, as in the paper (C5)
  kInverseDistance,  ///< x/z, y/z, 1/|p|: nearly linear in what triangulation measures
};

struct FilterOptions {
  MotionNoise motion;
  int max_landmarks = 100;   ///< storage is allocated for so many, once
  int max_clones = 0;        ///< cloned poses held at a time; 7 rows of P each
  double pixel_sigma = 1.0;  ///< [px] of a feature in the SLAM camera
  /// Individual gate inside update(); 1 switches it off. Lower it where nothing else rejects outliers.
  double gate_probability = 0.999;
  /// Points of one frame share the error of T_SF. True: as the correlation that it is; false: independent, as
  /// in the paper.
  bool correlated_wearer_pose = true;
  RigErrorOptions rig_error;  ///< the same error as a state instead
  PointForm point_form = PointForm::kInverseDistance;
  int max_iterations = 1;           ///< Gauss-Newton steps of one update; 1 is the plain EKF
  double min_inverse_depth = 1e-3;  ///< [1/m] a landmark farther than this is not measured as a point
};

/// Where a landmark should be seen, and how surely.
struct PixelPrediction {
  LandmarkId landmark = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< [px], may be outside the image
  Eigen::Matrix2d S = Eigen::Matrix2d::Identity();  ///< innovation covariance, pixel noise included [px^2]
  double depth = 0.0;  ///< z of the point in S [m]; not positive or not finite when it is at infinity
};

/// Where a landmark lies in the SLAM camera.
struct PointPrediction {
  LandmarkId landmark = 0;
  Eigen::Vector3d p_S = Eigen::Vector3d::Zero();             ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< H P H^T, no measurement noise [m^2]
};

/// A landmark as the map shows it.
struct LandmarkEstimate {
  LandmarkId id = 0;
  bool is_inverse_depth = true;  ///< false: kept as a point, `y` is then unset
  InverseDepthPoint y;
  double sigma_rho = 0.0;                                    ///< [1/m], zero for a point
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();             ///< [m]; not finite at infinity
  Eigen::Matrix3d p_W_covariance = Eigen::Matrix3d::Zero();  ///< first order [m^2]
};

/// A feature's first sighting, kept outside the state.
struct FirstSighting {
  UncertainPose T_WS;  ///< camera pose then, and its covariance then
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// The collaborative DI-D EKF: camera, landmarks and cloned poses in one Gaussian. A pure function of the
/// calls made to it; no clock, no thread, no image.
class Filter {
 public:
  Filter(const CameraModel& camera, const FilterOptions& options);

  const CameraModel& camera_model() const { return camera_model_; }
  const FilterOptions& options() const { return options_; }

  // --- camera ---------------------------------------------------------------------------------------------
  CameraState camera() const;
  CameraState::Covariance camera_covariance() const;
  /// Pose with the covariance of [dp, dtheta], both in axes of W.
  UncertainPose T_WS() const;
  /// Of [v_W, omega_S].
  Eigen::Matrix<double, 6, 6> twist_covariance() const;

  /// Forgets everything and starts with this camera.
  void reset(const CameraState& x, const CameraState::Covariance& covariance);
  /// The same from a pose; velocities zero with the given standard deviations.
  void reset(const UncertainPose& T_WS, double sigma_v, double sigma_omega);

  /// Constant velocity over `dt` [s] (C1-C4). Nothing happens for dt <= 0 or not finite.
  void predict(double dt);

  /// Moves the camera's mean within its own uncertainty and leaves the covariance: another point to linearise
  /// at, for a prior so wide that its mean says nothing.
  void recentre_camera(const CameraState& x);

  /// The free camera's pose as the state corrects what the sensors say, with what is left of its error.
  /// Without that error in the state: what the sensors say.
  UncertainPose corrected_T_SF(const UncertainPose& T_SF_sensed) const;

  // --- landmarks ------------------------------------------------------------------------------------------
  int landmark_count() const { return static_cast<int>(landmarks_.size()); }
  bool has_room() const;
  bool contains(LandmarkId id) const { return find(id) != nullptr; }
  /// The index-th landmark, 0 <= index < landmark_count(), oldest first.
  LandmarkId landmark_id(int index) const { return landmarks_[static_cast<std::size_t>(index)].id; }
  /// Nothing when there is no such landmark.
  std::optional<LandmarkEstimate> landmark(LandmarkId id) const;
  void remove_landmark(LandmarkId id);

  /// Nothing when the landmark is not in front of the camera or does not exist.
  std::optional<PixelPrediction> predict_pixel(LandmarkId id) const;
  std::optional<PointPrediction> predict_point(LandmarkId id) const;

  // Starts of landmarks. Nothing when there is no room, no depth can be told, the rays part, or the ray
  // points straight up or down.

  /// Pseudo-stereo (C section 2): one match with the free camera, 11 uncertain inputs.
  std::optional<LandmarkId> add_pseudo_stereo_landmark(const StereoMatch& match, const StereoRig& rig);
  /// The same for several matches of one frame. With correlated_wearer_pose the new landmarks share the error
  /// of T_SF; added one by one they would not. Where that error is a state they start from the corrected pose
  /// and correct it: their epipolar errors know nothing of depth. One entry a match.
  std::vector<std::optional<LandmarkId>> add_pseudo_stereo_landmarks(std::span<const StereoMatch> matches,
                                                                     const StereoRig& rig);
  /// Delayed (C8), first pose taken as independent of the present state (the paper's way).
  std::optional<LandmarkId> add_delayed_landmark(const FirstSighting& first,
                                                 const Eigen::Vector2d& pixel_now);
  /// Delayed, first pose a clone in the state: the consistent way.
  std::optional<LandmarkId> add_delayed_landmark(CloneId first_pose, const Eigen::Vector2d& first_pixel,
                                                 const Eigen::Vector2d& pixel_now);
  /// A pixel whose depth is only assumed: rho = 1/depth with a standard deviation of `relative_sigma` times
  /// that. The scale that such landmarks give is arbitrary.
  std::optional<LandmarkId> add_landmark_at_depth(const Eigen::Vector2d& pixel, double depth,
                                                  double relative_sigma);
  /// A surveyed point, kept as a Euclidean block. `covariance` [m^2] may be zero.
  std::optional<LandmarkId> add_known_point(const Eigen::Vector3d& p_W, const Eigen::Matrix3d& covariance);
  /// Keeps an inverse-depth landmark as a point from now on (3 instead of 6 rows of P). False when rho is
  /// less than min_inverse_depth or the landmark is none.
  bool convert_to_point(LandmarkId id);
  /// Does so with every landmark whose depth_nonlinearity is below `max_nonlinearity`. Returns how many.
  int convert_linear_landmarks(double max_nonlinearity);

  // --- cloned poses ---------------------------------------------------------------------------------------
  /// Nothing when max_clones are held.
  std::optional<CloneId> clone_camera_pose();
  void drop_clone(CloneId id);
  std::optional<UncertainPose> clone(CloneId id) const;

  // --- measurements ---------------------------------------------------------------------------------------
  /// Innovation of the given measurements at the present estimate; those without a prediction are left out.
  /// For joint compatibility. Valid until the next call on the filter that is not const. `wearer` is what is
  /// known of the free camera in this frame; without it its pixels have no prediction.
  const JointInnovation& innovation(std::span<const Measurement> measurements,
                                    const StereoRig* wearer = nullptr);
  /// Fuses all measurements that pass their own gate. The report is valid until the next update.
  const UpdateReport& update(std::span<const Measurement> measurements, const StereoRig* wearer = nullptr);
  /// Fuses a twist of the camera that was measured without the present image, its mean since the frame
  /// before: after a constant-velocity step that is what the state's velocities are,
  ///
  ///   h = [R_WS^T v_W, omega_S].
  TwistReport update_twist(const UncertainTwist& measured);

  // --- for evaluation -------------------------------------------------------------------------------------
  const GaussianState& state() const { return state_; }
  /// Offset of a landmark's block in state(); -1 when there is none.
  int landmark_offset(LandmarkId id) const;

 private:
  struct Block {
    std::uint64_t id = 0;
    int offset = 0;
    int dim = 0;
  };
  using Noise = Eigen::Matrix<double, InverseDepthPoint::kDim, InverseDepthPoint::kDim>;

  const Block* find(LandmarkId id) const;
  const Block* find_clone(CloneId id) const;
  void remove_block(std::vector<Block>& blocks, std::uint64_t id);
  LandmarkId append_landmark(const Eigen::Ref<const Eigen::VectorXd>& y,
                             std::span<const GaussianState::Dependence> dependences,
                             const Eigen::Ref<const Eigen::MatrixXd>& noise);
  UncertainPose pose_at(int offset) const;

  /// The free camera in the present frame; `guess` is the step from its mean to where its pixels are
  /// linearised.
  struct Wearer {
    WearerObservation model;
    CorrectedRig rig;
    Eigen::Matrix<double, 6, 1> guess = Eigen::Matrix<double, 6, 1>::Zero();
  };
  /// How an update came out.
  struct Fusion {
    double nis = 0.0;
    int iterations = 0;
  };

  bool linearise(const Measurement& measurement, LinearisedMeasurement& out) const;
  bool linearise_wearer_pixel(const Measurement& measurement, LinearisedMeasurement& out) const;
  void collect(std::span<const Measurement> measurements, const StereoRig* wearer);
  void report_and_gate(std::span<const Measurement> measurements);
  bool relinearise(std::span<const Measurement> measurements, const StereoRig* wearer);
  std::optional<Fusion> iterate(std::span<const Measurement> measurements, const StereoRig* wearer,
                                int max_iterations);
  void finish_update();
  void normalise_poses();
  RigError::Vector rig_error() const;
  void predict_rig_error(double dt);
  void set_wearer(const StereoRig* rig);
  std::vector<std::optional<LandmarkId>> add_with_rig_error(std::span<const StereoMatch> matches,
                                                            const StereoRig& rig);
  void normalise_quaternion(int offset);

  CameraModel camera_model_;
  FilterOptions options_;
  GaussianState state_;
  std::vector<Block> landmarks_;  ///< by id, which is also by offset
  std::vector<Block> clones_;
  std::uint64_t next_id_ = 1;

  std::optional<Wearer> wearer_;  ///< of the last call that gave one
  JointInnovation innovation_;
  CovarianceUpdate covariance_update_;
  ChiSquaredLimits gates_;
  UpdateReport report_;
  std::vector<char> keep_;
  std::vector<LinearisedMeasurement> relinearised_;
  Eigen::VectorXd x_prior_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> twist_P_Ht_;
};

}  // namespace cosight::ekf
