#include "robot_agent/vins/gyroscope_bias.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <map>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kKernelWidth = 1e-3;  ///< of the coplanarity [rad]: half a pixel of an ordinary camera
constexpr std::size_t kMinPairs = 15;
constexpr std::size_t kStep = 4;  ///< frames between the two of a pair

/// Two frames' common features and the gyroscope's word on the turn between them.
struct FramePair {
  std::vector<std::pair<Vector3d, Vector3d>> bearings;  ///< f_i, f_j
  Eigen::Quaterniond q_ij;                              ///< camera j in camera i for zero bias change
  Matrix3d d_bias;                                      ///< rotation of S_j per bias, axes of S_j
  Vector3d t = Vector3d::UnitX();

  Matrix3d rotation(const Vector3d& bias) const {
    return (q_ij * quaternion_exp(d_bias * bias)).toRotationMatrix();
  }
};

double kernel_weight(double r) {
  return 1.0 / (1.0 + r * r / (kKernelWidth * kKernelWidth));
}

std::vector<std::pair<Vector3d, Vector3d>> common_bearings(const FeatureFrame& i, const FeatureFrame& j) {
  std::map<FeatureId, Vector3d> first;
  for (const TrackedFeature& feature : i.features)
    first.emplace(feature.id, feature.sighting.bearing());
  std::vector<std::pair<Vector3d, Vector3d>> pairs;
  for (const TrackedFeature& feature : j.features) {
    const auto seen = first.find(feature.id);
    if (seen != first.end()) pairs.emplace_back(seen->second, feature.sighting.bearing());
  }
  return pairs;
}

std::vector<FramePair> make_pairs(const std::vector<UnplacedFrame>& frames, const Pose& T_BS) {
  std::vector<FramePair> pairs;
  for (std::size_t i = 0; i + kStep < frames.size(); ++i) {
    Preintegration imu = *frames[i + 1].imu;
    for (std::size_t k = i + 2; k <= i + kStep; ++k)
      imu.append(*frames[k].imu);
    FramePair pair;
    pair.bearings = common_bearings(frames[i].features, frames[i + kStep].features);
    if (pair.bearings.size() < kMinPairs) continue;
    pair.q_ij = T_BS.q.conjugate() * imu.increment().gamma * T_BS.q;
    pair.d_bias = T_BS.q.toRotationMatrix().transpose() *
                  imu.jacobian().block<3, 3>(Preintegration::kTheta, Preintegration::kGyroscopeBias);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// The direction nearest to all the epipolar planes of a pair.
Vector3d best_direction(const FramePair& pair, const Matrix3d& R) {
  Matrix3d M = Matrix3d::Zero();
  for (const auto& [f_i, f_j] : pair.bearings) {
    const Vector3d n = f_i.cross(R * f_j);
    M += n * n.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(M).eigenvectors().col(0);
}

/// One pair's part of the normal equations of the bias, its own direction taken out.
void accumulate(FramePair& pair, const Vector3d& bias, Matrix3d& H, Vector3d& b) {
  const Matrix3d R = pair.rotation(bias);
  pair.t = best_direction(pair, R);
  const Eigen::Matrix<double, 2, 3> basis = tangent_basis(pair.t);
  Matrix3d H_bb = Matrix3d::Zero();
  Eigen::Matrix2d H_tt = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 3, 2> H_bt = Eigen::Matrix<double, 3, 2>::Zero();
  Vector3d b_b = Vector3d::Zero();
  Eigen::Vector2d b_t = Eigen::Vector2d::Zero();
  for (const auto& [f_i, f_j] : pair.bearings) {
    const Vector3d n = f_i.cross(R * f_j);
    const double r = pair.t.dot(n);
    const double w = kernel_weight(r);
    // t . (f_i x R Exp(d) f_j): d r = (t x f_i)^T R [-f_j]x d
    const Vector3d J_b = -(pair.t.cross(f_i).transpose() * R * skew(f_j) * pair.d_bias).transpose();
    const Eigen::Vector2d J_t = basis * n;
    H_bb += w * J_b * J_b.transpose();
    H_bt += w * J_b * J_t.transpose();
    H_tt += w * J_t * J_t.transpose();
    b_b += w * J_b * r;
    b_t += w * J_t * r;
  }
  const Eigen::Matrix<double, 3, 2> gain = H_bt * (H_tt + 1e-12 * Eigen::Matrix2d::Identity()).inverse();
  H += H_bb - gain * H_bt.transpose();
  b += b_b - gain * b_t;
}

}  // namespace

std::optional<Vector3d> estimate_gyroscope_bias(const std::vector<UnplacedFrame>& frames, const Pose& T_BS) {
  std::vector<FramePair> pairs = make_pairs(frames, T_BS);
  if (pairs.empty()) return std::nullopt;
  Vector3d bias = Vector3d::Zero();
  constexpr int kMaxSteps = 20;
  for (int step = 0; step < kMaxSteps; ++step) {
    Matrix3d H = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    for (FramePair& pair : pairs)
      accumulate(pair, bias, H, b);
    const Vector3d change = -H.ldlt().solve(b);
    if (!change.allFinite()) return std::nullopt;
    bias += change;
    if (change.norm() < 1e-6) return bias + frames[1].imu->bias().gyroscope;
  }
  return std::nullopt;
}

}  // namespace cosight::vins
