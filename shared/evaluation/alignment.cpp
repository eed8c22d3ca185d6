#include "shared/evaluation/alignment.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>
#include <utility>

namespace cosight {
namespace {

constexpr std::array<std::pair<Alignment, const char*>, 4> kNames{{{Alignment::kNone, "none"},
                                                                   {Alignment::kFirstPose, "first_pose"},
                                                                   {Alignment::kSe3, "se3"},
                                                                   {Alignment::kSim3, "sim3"}}};
constexpr double kMinVariance = 1e-12;              // [m^2]: a camera that stood still
constexpr double kMinRelativeSingularValue = 1e-9;  // second to first: a straight line

/// First and second moments of the two sets of positions.
struct Moments {
  Eigen::Vector3d mean_estimate = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_truth = Eigen::Vector3d::Zero();
  double variance_estimate = 0.0;                              ///< [m^2]
  Eigen::Matrix3d cross_covariance = Eigen::Matrix3d::Zero();  ///< truth x estimate^T [m^2]
};

Moments moments_of(const std::vector<PosePair>& pairs) {
  Moments moments;
  const double count = static_cast<double>(pairs.size());
  for (const PosePair& pair : pairs) {
    moments.mean_estimate += pair.T_WC_estimate.p / count;
    moments.mean_truth += pair.T_WC_truth.p / count;
  }
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d estimate = pair.T_WC_estimate.p - moments.mean_estimate;
    moments.variance_estimate += estimate.squaredNorm() / count;
    moments.cross_covariance += (pair.T_WC_truth.p - moments.mean_truth) * estimate.transpose() / count;
  }
  return moments;
}

/// The rotation R, and trace(D S), of Umeyama's solution: R = U S V^T with S = diag(1, 1, +-1), so that R is
/// no reflection.
struct UmeyamaRotation {
  Eigen::Matrix3d R;
  double trace = 0.0;
  bool is_unique = false;
};

UmeyamaRotation umeyama_rotation(const Eigen::Matrix3d& cross_covariance) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross_covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  const Eigen::Vector3d& d = svd.singularValues();
  return {svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose(), d.dot(signs),
          d(1) > kMinRelativeSingularValue * d(0)};
}

std::optional<Similarity> umeyama(const std::vector<PosePair>& pairs, bool with_scale) {
  if (pairs.size() < 3) return std::nullopt;
  const Moments moments = moments_of(pairs);
  const UmeyamaRotation rotation = umeyama_rotation(moments.cross_covariance);
  if (moments.variance_estimate < kMinVariance || !rotation.is_unique) return std::nullopt;
  Similarity similarity;
  similarity.scale = with_scale ? rotation.trace / moments.variance_estimate : 1.0;
  similarity.T.q = Eigen::Quaterniond(rotation.R).normalized();
  similarity.T.p = moments.mean_truth - similarity.scale * (rotation.R * moments.mean_estimate);
  return similarity;
}

}  // namespace

const char* to_string(Alignment alignment) {
  for (const auto& [value, name] : kNames) {
    if (value == alignment) return name;
  }
  return "unknown";
}

std::optional<Alignment> alignment_from(const std::string& name) {
  for (const auto& [value, known] : kNames) {
    if (name == known) return value;
  }
  return std::nullopt;
}

std::optional<Similarity> align(const std::vector<PosePair>& pairs, Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return Similarity{};
    case Alignment::kFirstPose:
      if (pairs.empty()) return std::nullopt;
      return Similarity{1.0, pairs.front().T_WC_truth * pairs.front().T_WC_estimate.inverse()};
    case Alignment::kSe3:
      return umeyama(pairs, false);
    case Alignment::kSim3:
      return umeyama(pairs, true);
  }
  return std::nullopt;
}

std::optional<double> estimated_scale(const std::vector<PosePair>& pairs) {
  if (pairs.size() < 2) return std::nullopt;
  const Moments moments = moments_of(pairs);
  const double trace = umeyama_rotation(moments.cross_covariance).trace;
  if (moments.variance_estimate < kMinVariance || trace < kMinVariance) return std::nullopt;
  return moments.variance_estimate / trace;
}

}  // namespace cosight
