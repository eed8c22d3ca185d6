#include "robot_agent/ekf/filter.hpp"

#include <algorithm>
#include <cmath>

#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

constexpr int kR = CameraState::kPosition;
constexpr int kQ = CameraState::kOrientation;
constexpr int kV = CameraState::kVelocity;
constexpr int kOmega = CameraState::kAngularVelocity;

int state_capacity(const FilterOptions& options) {
  return CameraState::kDim + InverseDepthPoint::kDim * options.max_landmarks +
         CameraState::kPoseDim * options.max_clones + (options.rig_error.is_state ? RigError::kDim : 0);
}

int row_capacity(const FilterOptions& options) {
  return std::max(1, 4 * options.max_landmarks);
}

/// d [dp, dtheta (axes of W)] / d [r, q]: the inverse of position_quaternion_jacobian on the tangent space.
Eigen::Matrix<double, 6, 7> tangent_jacobian(const Eigen::Quaterniond& q) {
  Eigen::Matrix<double, 6, 7> J = Eigen::Matrix<double, 6, 7>::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.bottomRightCorner<3, 4>() = 4.0 * left_perturbation_jacobian(q).transpose();
  return J;
}

}  // namespace

Filter::Filter(const CameraModel& camera, const FilterOptions& options)
    : camera_model_(camera),
      options_(options),
      state_(state_capacity(options)),
      innovation_(state_capacity(options), row_capacity(options)),
      covariance_update_(state_capacity(options), row_capacity(options)),
      gates_(options.gate_probability, 6),
      x_prior_(Eigen::VectorXd::Zero(state_capacity(options))),
      twist_P_Ht_(state_capacity(options), 6) {
  const auto landmarks = static_cast<std::size_t>(options.max_landmarks);
  landmarks_.reserve(landmarks);
  clones_.reserve(static_cast<std::size_t>(options.max_clones));
  report_.measurements.reserve(2 * landmarks);  // both cameras may see one
  keep_.reserve(2 * landmarks);
  relinearised_.reserve(2 * landmarks);
  reset(CameraState{}, CameraState::Covariance::Zero());
}

CameraState Filter::camera() const {
  return CameraState::from_vector(state_.x().head<CameraState::kDim>());
}

CameraState::Covariance Filter::camera_covariance() const {
  return state_.covariance<CameraState::kDim, CameraState::kDim>(0, 0);
}

UncertainPose Filter::pose_at(int offset) const {
  UncertainPose pose;
  pose.T.p = state_.x().segment<3>(offset + kR);
  pose.T.q = from_wxyz(state_.x().segment<4>(offset + kQ));
  const Eigen::Matrix<double, 6, 7> J = tangent_jacobian(pose.T.q);
  pose.covariance = J * state_.covariance<7, 7>(offset, offset) * J.transpose();
  return pose;
}

UncertainPose Filter::T_WS() const {
  return pose_at(0);
}

Eigen::Matrix<double, 6, 6> Filter::twist_covariance() const {
  return state_.covariance<6, 6>(kV, kV);
}

void Filter::reset(const CameraState& x, const CameraState::Covariance& covariance) {
  landmarks_.clear();
  clones_.clear();
  state_.remove(0, state_.size());
  CameraState unit = x;
  unit.q_WS.normalize();
  state_.append(unit.vector(), {}, covariance);
  if (options_.rig_error.is_state) state_.append(RigError::Vector::Zero(), {}, RigError::Matrix::Identity());
}

void Filter::reset(const UncertainPose& T_WS, double sigma_v, double sigma_omega) {
  CameraState x;
  x.r_WS = T_WS.T.p;
  x.q_WS = T_WS.T.q.normalized();
  CameraState::Covariance covariance = CameraState::Covariance::Zero();
  covariance.topLeftCorner<7, 7>() = position_quaternion_covariance(T_WS);
  covariance.block<3, 3>(kV, kV) = sigma_v * sigma_v * Eigen::Matrix3d::Identity();
  covariance.block<3, 3>(kOmega, kOmega) = sigma_omega * sigma_omega * Eigen::Matrix3d::Identity();
  reset(x, covariance);
}

void Filter::recentre_camera(const CameraState& x) {
  state_.x().head<CameraState::kDim>() = x.vector();
}

RigError::Vector Filter::rig_error() const {
  if (!options_.rig_error.is_state) return RigError::Vector::Zero();
  return state_.x().segment<RigError::kDim>(RigError::kOffset);
}

UncertainPose Filter::corrected_T_SF(const UncertainPose& T_SF_sensed) const {
  if (!options_.rig_error.is_state) return T_SF_sensed;
  const CorrectedRig rig = correct_rig(T_SF_sensed, options_.rig_error, rig_error());
  const RigError::Matrix P_eta =
      state_.covariance<RigError::kDim, RigError::kDim>(RigError::kOffset, RigError::kOffset);
  return {rig.T_SF,
          rig.by_eta * P_eta * rig.by_eta.transpose() + rig.noise_factor * rig.noise_factor.transpose()};
}

void Filter::predict(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) return;
  if (options_.rig_error.is_state) predict_rig_error(dt);
  const MotionStep step = predict_motion(camera(), dt, options_.motion);
  const CameraState::Covariance F = step.F();
  const CameraState::Covariance P_cc = F * camera_covariance() * F.transpose() + step.process_noise;
  auto P = state_.P_lower();
  P.topLeftCorner<CameraState::kDim, CameraState::kDim>().triangularView<Eigen::Lower>() = P_cc;
  // Everything else against the camera: P_ic' = P_ic F^T, four columns of which change.
  const Eigen::Index rest = state_.size() - CameraState::kDim;
  auto P_ir = P.block(CameraState::kDim, kR, rest, 3);
  auto P_iq = P.block(CameraState::kDim, kQ, rest, 4);
  const auto P_iv = P.block(CameraState::kDim, kV, rest, 3);
  const auto P_iomega = P.block(CameraState::kDim, kOmega, rest, 3);
  P_ir += dt * P_iv;
  for (Eigen::Index i = 0; i < rest; ++i) {
    const Eigen::Vector4d q = P_iq.row(i).transpose();
    const Eigen::Vector3d omega = P_iomega.row(i).transpose();
    P_iq.row(i) = (step.q_q * q + step.q_omega * omega).transpose();
  }
  CameraState x = step.x;
  x.q_WS.normalize();  // rounding only: F keeps the length
  state_.x().head<CameraState::kDim>() = x.vector();
}

/// eta' = phi eta + noise: its rows and columns shrink by phi, its own block tends to the identity.
void Filter::predict_rig_error(double dt) {
  constexpr int kOffset = RigError::kOffset;
  constexpr int kDim = RigError::kDim;
  const double phi = RigError::decay(dt, options_.rig_error);
  const Eigen::Index behind = state_.size() - kOffset - kDim;
  auto P = state_.P_lower();
  state_.x().segment<kDim>(kOffset) *= phi;
  P.block(kOffset, 0, kDim, kOffset) *= phi;
  P.block(kOffset + kDim, kOffset, behind, kDim) *= phi;
  auto P_eta = P.block<kDim, kDim>(kOffset, kOffset);
  P_eta *= phi * phi;
  P_eta.diagonal().array() += 1.0 - phi * phi;
}

const Filter::Block* Filter::find(LandmarkId id) const {
  const auto at = std::ranges::lower_bound(landmarks_, id, {}, &Block::id);
  return at != landmarks_.end() && at->id == id ? &*at : nullptr;
}

const Filter::Block* Filter::find_clone(CloneId id) const {
  const auto at = std::ranges::lower_bound(clones_, id, {}, &Block::id);
  return at != clones_.end() && at->id == id ? &*at : nullptr;
}

int Filter::landmark_offset(LandmarkId id) const {
  const Block* block = find(id);
  return block != nullptr ? block->offset : -1;
}

bool Filter::has_room() const {
  return landmark_count() < options_.max_landmarks;
}

std::optional<LandmarkEstimate> Filter::landmark(LandmarkId id) const {
  const Block* block = find(id);
  if (block == nullptr) return std::nullopt;
  LandmarkEstimate estimate;
  estimate.id = id;
  estimate.is_inverse_depth = block->dim == InverseDepthPoint::kDim;
  if (!estimate.is_inverse_depth) {
    estimate.p_W = state_.x().segment<3>(block->offset);
    estimate.p_W_covariance = state_.covariance<3, 3>(block->offset, block->offset);
    return estimate;
  }
  estimate.y = InverseDepthPoint::from_vector(state_.x().segment<InverseDepthPoint::kDim>(block->offset));
  Eigen::Matrix<double, 3, InverseDepthPoint::kDim> J;
  estimate.p_W = estimate.y.p_W(&J);
  const Eigen::Matrix<double, 6, 6> P_yy = state_.covariance<6, 6>(block->offset, block->offset);
  estimate.p_W_covariance = J * P_yy * J.transpose();
  estimate.sigma_rho = std::sqrt(P_yy(InverseDepthPoint::kRho, InverseDepthPoint::kRho));
  return estimate;
}

void Filter::remove_block(std::vector<Block>& blocks, std::uint64_t id) {
  const auto at = std::ranges::lower_bound(blocks, id, {}, &Block::id);
  if (at == blocks.end() || at->id != id) return;
  const Block removed = *at;
  blocks.erase(at);
  state_.remove(removed.offset, removed.dim);
  for (std::vector<Block>* list : {&landmarks_, &clones_}) {
    for (Block& block : *list) {
      if (block.offset > removed.offset) block.offset -= removed.dim;
    }
  }
}

void Filter::remove_landmark(LandmarkId id) {
  remove_block(landmarks_, id);
}

std::optional<CloneId> Filter::clone_camera_pose() {
  if (static_cast<int>(clones_.size()) >= options_.max_clones) return std::nullopt;
  const GaussianState::Dependence camera_pose{0, Eigen::Matrix<double, 7, 7>::Identity()};
  const Eigen::Matrix<double, 7, 1> pose = state_.x().head<7>();
  const int offset = state_.append(pose, {&camera_pose, 1}, Eigen::Matrix<double, 7, 7>::Zero());
  clones_.push_back({next_id_++, offset, CameraState::kPoseDim});
  return clones_.back().id;
}

void Filter::drop_clone(CloneId id) {
  remove_block(clones_, id);
}

std::optional<UncertainPose> Filter::clone(CloneId id) const {
  const Block* block = find_clone(id);
  if (block == nullptr) return std::nullopt;
  return pose_at(block->offset);
}

}  // namespace cosight::ekf
