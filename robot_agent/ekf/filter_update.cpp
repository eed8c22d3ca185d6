#include <cmath>

#include "robot_agent/ekf/filter.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

/// H P H^T of one linearised measurement from the blocks it touches.
template <int Rows, int Dim>
Eigen::Matrix<double, Rows, Rows> predicted_covariance(const GaussianState& state, int offset,
                                                       const ObservationJacobians<Rows, Dim>& H) {
  const Eigen::Matrix<double, Rows, Dim> H_P_lc = H.H_camera * state.covariance<7, Dim>(0, offset);
  const Eigen::Matrix<double, Rows, Rows> cross = H_P_lc * H.H_landmark.transpose();
  return H.H_camera * state.covariance<7, 7>(0, 0) * H.H_camera.transpose() + cross + cross.transpose() +
         H.H_landmark * state.covariance<Dim, Dim>(offset, offset) * H.H_landmark.transpose();
}

/// Evaluates a model for whichever kind of landmark stands at `offset` and hands its Jacobians to `use`.
/// Nothing when there is no prediction.
template <class Model, class Use>
auto observe(const Model& model, const GaussianState& state, int offset, int dim, Use use)
    -> decltype(model.predict(CameraState{}, InverseDepthPoint{})) {
  const CameraState x = CameraState::from_vector(state.x().head<CameraState::kDim>());
  if (dim == InverseDepthPoint::kDim) {
    typename Model::Jacobians H;
    const auto y = InverseDepthPoint::from_vector(state.x().segment<InverseDepthPoint::kDim>(offset));
    auto h = model.predict(x, y, &H);
    if (h) use(H);
    return h;
  }
  typename Model::PointJacobians H;
  auto h = model.predict(x, Eigen::Vector3d(state.x().segment<3>(offset)), &H);
  if (h) use(H);
  return h;
}

template <class Model>
bool linearise_with(const Model& model, const GaussianState& state, const Measurement& measurement,
                    LinearisedMeasurement& out) {
  const auto h = observe(model, state, out.offset, out.dim, [&out](const auto& H) {
    out.H_camera.topRows<Model::kDim>() = H.H_camera;
    out.H_landmark.topLeftCorner(Model::kDim, H.H_landmark.cols()) = H.H_landmark;
  });
  if (!h) return false;
  out.rows = Model::kDim;
  out.innovation.head<Model::kDim>() = measurement.z.head<Model::kDim>() - *h;
  return out.innovation.allFinite();
}

/// A point's innovation in bearing and inverse distance instead of metres; each side by its own Jacobian.
bool to_inverse_distance(const Measurement& measurement, LinearisedMeasurement& m) {
  if (!(measurement.z.z() > 0.0)) return false;
  Eigen::Matrix3d J_measured;
  Eigen::Matrix3d J_predicted;
  const Eigen::Vector3d predicted = measurement.z - m.innovation;
  m.innovation = bearing_and_inverse_distance(measurement.z, &J_measured) -
                 bearing_and_inverse_distance(predicted, &J_predicted);
  m.H_camera = (J_predicted * m.H_camera).eval();
  m.H_landmark.leftCols(m.dim) = (J_predicted * m.H_landmark.leftCols(m.dim)).eval();
  m.R = J_measured * measurement.R * J_measured.transpose();
  m.shared_factor = J_measured * measurement.shared_factor;
  return m.innovation.allFinite();
}

}  // namespace

std::optional<PixelPrediction> Filter::predict_pixel(LandmarkId id) const {
  const Block* block = find(id);
  if (block == nullptr) return std::nullopt;
  PixelPrediction prediction;
  prediction.landmark = id;
  const auto pixel =
      observe(BearingObservation{camera_model_}, state_, block->offset, block->dim,
              [&](const auto& H) { prediction.S = predicted_covariance(state_, block->offset, H); });
  if (!pixel) return std::nullopt;
  prediction.pixel = *pixel;
  prediction.S.diagonal().array() += options_.pixel_sigma * options_.pixel_sigma;
  const Eigen::Vector3d p_W = block->dim == InverseDepthPoint::kDim
                                  ? InverseDepthPoint::from_vector(state_.x().segment<6>(block->offset)).p_W()
                                  : Eigen::Vector3d(state_.x().segment<3>(block->offset));
  prediction.depth = (camera().q_WS.conjugate() * (p_W - camera().r_WS)).z();
  return prediction;
}

std::optional<PointPrediction> Filter::predict_point(LandmarkId id) const {
  const Block* block = find(id);
  if (block == nullptr) return std::nullopt;
  PointPrediction prediction;
  prediction.landmark = id;
  const EuclideanObservation model{options_.min_inverse_depth};
  const auto p_S = observe(model, state_, block->offset, block->dim, [&](const auto& H) {
    prediction.covariance = predicted_covariance(state_, block->offset, H);
  });
  if (!p_S) return std::nullopt;
  prediction.p_S = *p_S;
  return prediction;
}

bool Filter::linearise(const Measurement& measurement, LinearisedMeasurement& out) const {
  const Block* block = find(measurement.landmark);
  if (block == nullptr) return false;
  out.offset = block->offset;
  out.dim = block->dim;
  out.R = measurement.R;
  out.shared_factor = measurement.shared_factor;
  out.shares_error = measurement.kind != MeasurementKind::kPixel;
  out.sees_rig_error = false;
  if (measurement.kind == MeasurementKind::kPixel) {
    return linearise_with(BearingObservation{camera_model_}, state_, measurement, out);
  }
  if (measurement.kind == MeasurementKind::kWearerPixel) return linearise_wearer_pixel(measurement, out);
  if (!linearise_with(EuclideanObservation{options_.min_inverse_depth}, state_, measurement, out))
    return false;
  return options_.point_form == PointForm::kEuclidean || to_inverse_distance(measurement, out);
}

/// The noise of T_SF enters at the predicted point: at the measured one it would depend on the measurement's
/// own error, and what looks too near would count more.
bool Filter::linearise_wearer_pixel(const Measurement& measurement, LinearisedMeasurement& out) const {
  if (!wearer_) return false;
  Eigen::Matrix<double, 2, 6> H_wearer;
  const auto h = observe(wearer_->model, state_, out.offset, out.dim, [&](const auto& H) {
    out.H_camera.topRows<2>() = H.H_camera;
    out.H_landmark.topLeftCorner(2, H.H_landmark.cols()) = H.H_landmark;
    H_wearer = H.H_wearer;
  });
  if (!h) return false;
  out.rows = 2;
  out.innovation.head<2>() = measurement.z.head<2>() - *h + H_wearer * wearer_->guess;
  out.sees_rig_error = options_.rig_error.is_state;
  out.H_rig = H_wearer * wearer_->rig.by_eta;
  out.shared_factor.topRows<2>() = H_wearer * wearer_->rig.noise_factor;
  out.R.topLeftCorner<2, 2>() += out.shared_factor.topRows<2>() * out.shared_factor.topRows<2>().transpose();
  return out.innovation.head<2>().allFinite();
}

void Filter::set_wearer(const StereoRig* rig) {
  wearer_.reset();
  if (rig == nullptr) return;
  const CorrectedRig corrected = correct_rig(rig->T_SF, options_.rig_error, rig_error());
  wearer_ = Wearer{{rig->camera_F, corrected.T_SF}, corrected};
  if (!rig->has_guess || options_.rig_error.is_state) return;
  wearer_->model.T_SF = rig->T_SF_guess;
  wearer_->guess << rig->T_SF_guess.p - corrected.T_SF.p,
      quaternion_log(rig->T_SF_guess.q * corrected.T_SF.q.conjugate());
}

void Filter::collect(std::span<const Measurement> measurements, const StereoRig* wearer) {
  set_wearer(wearer);
  innovation_.clear();
  LinearisedMeasurement linearised;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    linearised.measurement = static_cast<int>(i);
    if (linearise(measurements[i], linearised)) innovation_.push_back(linearised);
  }
  innovation_.compute(state_, options_.correlated_wearer_pose);
}

const JointInnovation& Filter::innovation(std::span<const Measurement> measurements,
                                          const StereoRig* wearer) {
  collect(measurements, wearer);
  return innovation_;
}

void Filter::report_and_gate(std::span<const Measurement> measurements) {
  report_.measurements.assign(measurements.size(), MeasurementReport{});
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    report_.measurements[i].landmark = measurements[i].landmark;
    report_.measurements[i].kind = measurements[i].kind;
    report_.measurements[i].rows = measurements[i].rows();
  }
  keep_.clear();
  for (const LinearisedMeasurement& m : innovation_.measurements()) {
    MeasurementReport& report = report_.measurements[static_cast<std::size_t>(m.measurement)];
    report.innovation.head(m.rows) = m.innovation.head(m.rows);
    for (int k = 0; k < m.rows; ++k) {
      report.innovation_std(k) = std::sqrt(innovation_.S_lower()(m.row + k, m.row + k));
    }
    report.nis = m.nis;
    report.gate = gates_(m.rows);
    const bool conditioned = std::isfinite(m.nis);
    const bool inside = conditioned && m.nis <= report.gate;
    report.outcome = inside ? Outcome::kFused : conditioned ? Outcome::kGated : Outcome::kIllConditioned;
    keep_.push_back(inside ? 1 : 0);
  }
  innovation_.keep_only(keep_);
}

const UpdateReport& Filter::update(std::span<const Measurement> measurements, const StereoRig* wearer) {
  report_.fused = 0;
  report_.rows = 0;
  report_.nis = 0.0;
  report_.iterations = 0;
  collect(measurements, wearer);
  report_and_gate(measurements);
  if (innovation_.rows() == 0) return report_;
  const auto fusion = iterate(measurements, wearer, options_.max_iterations);
  if (!fusion) {
    for (MeasurementReport& report : report_.measurements) {
      if (report.outcome == Outcome::kFused) report.outcome = Outcome::kIllConditioned;
    }
    return report_;
  }
  report_.nis = fusion->nis;
  report_.iterations = fusion->iterations;
  report_.fused = static_cast<int>(innovation_.measurements().size());
  report_.rows = innovation_.rows();
  finish_update();
  return report_;
}

void Filter::finish_update() {
  covariance_update_.downdate(state_);
  normalise_poses();
}

void Filter::normalise_poses() {
  normalise_quaternion(CameraState::kOrientation);
  for (const Block& clone : clones_)
    normalise_quaternion(clone.offset + CameraState::kOrientation);
}

/// Gauss-Newton on the measurement (iterated EKF): x_i+1 = x_0 + K_i (z - h(x_i) - H_i (x_0 - x_i)). Leaves
/// the corrected mean in the state and the last factorisation in covariance_update_. Nothing when the
/// innovation covariance cannot be inverted: then nothing has changed.
std::optional<Filter::Fusion> Filter::iterate(std::span<const Measurement> measurements,
                                              const StereoRig* wearer, int max_iterations) {
  constexpr double kConverged = 1e-4;  // of the step's own size
  if (!covariance_update_.factorise(innovation_)) return std::nullopt;
  Fusion fusion{covariance_update_.nis(), 1};
  auto x_prior = x_prior_.head(state_.size());
  x_prior = state_.x();
  state_.x() += covariance_update_.correction();
  while (fusion.iterations < max_iterations && relinearise(measurements, wearer)) {
    innovation_.compute(state_, options_.correlated_wearer_pose);
    if (!covariance_update_.factorise(innovation_)) {
      state_.x() = x_prior;
      return std::nullopt;
    }
    ++fusion.iterations;
    double change = 0.0;
    const auto correction = covariance_update_.correction();
    for (int i = 0; i < state_.size(); ++i) {
      const double next = x_prior(i) + correction(i);
      change += (next - state_.x()(i)) * (next - state_.x()(i));
      state_.x()(i) = next;
    }
    if (change <= kConverged * kConverged * correction.squaredNorm()) break;
  }
  return fusion;
}

/// The fused measurements again at the present mean. False when one has no prediction there: then the last
/// linearisation stands.
bool Filter::relinearise(std::span<const Measurement> measurements, const StereoRig* wearer) {
  relinearised_.clear();
  set_wearer(wearer);
  const auto x_prior = x_prior_.head(state_.size());
  for (const LinearisedMeasurement& old : innovation_.measurements()) {
    LinearisedMeasurement m = old;
    if (!linearise(measurements[static_cast<std::size_t>(old.measurement)], m)) return false;
    const Eigen::Matrix<double, CameraState::kPoseDim, 1> camera_step =
        x_prior.head<CameraState::kPoseDim>() - state_.x().head<CameraState::kPoseDim>();
    m.innovation.head(m.rows) -= m.H_camera.topRows(m.rows).lazyProduct(camera_step);
    for (int c = 0; c < m.dim; ++c) {
      const double landmark_step = x_prior(m.offset + c) - state_.x()(m.offset + c);
      m.innovation.head(m.rows) -= landmark_step * m.H_landmark.col(c).head(m.rows);
    }
    if (m.sees_rig_error) {
      m.innovation.head<2>() -= m.H_rig * (x_prior.segment<RigError::kDim>(RigError::kOffset) - rig_error());
    }
    relinearised_.push_back(m);
  }
  innovation_.clear();
  for (const LinearisedMeasurement& m : relinearised_)
    innovation_.push_back(m);
  return true;
}

void Filter::normalise_quaternion(int offset) {
  const Eigen::Vector4d q = state_.x().segment<4>(offset);
  state_.transform(offset, q.normalized(), normalisation_jacobian(q));
}

}  // namespace cosight::ekf
