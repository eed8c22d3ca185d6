#include "tests/robot_agent/vins/flight_bundle.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <map>
#include <optional>

namespace cosight::vins {
namespace {

struct Sight {
  std::size_t frame;
  Eigen::Vector2d point;
};
using Tracks = std::map<FeatureId, std::vector<Sight>>;

/// u - projection(R^T (X - p)) [px] at f = 460.
struct PinholeError {
  Eigen::Vector2d seen;

  template <typename T>
  bool operator()(const T* q, const T* p, const T* X, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> q_WS(q);
    const Vector h = q_WS.conjugate() * (Eigen::Map<const Vector>(X) - Eigen::Map<const Vector>(p));
    residual[0] = (h.x() / h.z() - seen.x()) * 460.0;
    residual[1] = (h.y() / h.z() - seen.y()) * 460.0;
    return true;
  }
};

/// What fixes the scale: p within a centimetre of where it was taken to be.
struct PositionGuess {
  Eigen::Vector3d guess;

  template <typename T>
  bool operator()(const T* p, T* residual) const {
    constexpr double kDeviation = 0.01;  // [m]
    Eigen::Map<Eigen::Matrix<T, 3, 1>>(residual, 3) =
        (Eigen::Map<const Eigen::Matrix<T, 3, 1>>(p) - guess) / kDeviation;
    return true;
  }
};

/// Of the features that five frames saw, or more.
Tracks tracks_of(const std::vector<FeatureFrame>& frames) {
  Tracks tracks;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const TrackedFeature& feature : frames[i].features)
      tracks[feature.id].push_back({i, feature.sighting.point});
  }
  std::erase_if(tracks, [](const auto& track) { return track.second.size() < 5; });
  return tracks;
}

/// The point nearest to all rays; nothing when they hardly differ, or when it is not in front.
std::optional<Eigen::Vector3d> intersect(const std::vector<Sight>& track, const Trajectory& poses) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Sight& sight : track) {
    const Pose& T_WC = poses[sight.frame].T_WC;
    const Eigen::Vector3d ray = T_WC.q * sight.point.homogeneous().normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
    A += across;
    b += across * T_WC.p;
  }
  constexpr double kMinParallaxSquared = 1e-4;  // mean over the sightings [rad^2]
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(A).eigenvalues()(0);
  if (least < kMinParallaxSquared * static_cast<double>(track.size())) return std::nullopt;
  const Eigen::Vector3d point = A.ldlt().solve(b);
  const double depth = (poses[track.front().frame].T_WC.inverse() * point).z();
  if (depth < 0.3 || depth > 30.0) return std::nullopt;
  return point;
}

}  // namespace

Trajectory bundle_adjust(const std::vector<FeatureFrame>& frames, const Trajectory& guess) {
  Trajectory poses(guess.begin(), guess.begin() + static_cast<std::ptrdiff_t>(frames.size()));
  std::map<FeatureId, Eigen::Vector3d> points;
  ceres::Problem problem;
  auto* kernel = new ceres::CauchyLoss(0.5);              // NOLINT: the problem owns it
  auto* manifold = new ceres::EigenQuaternionManifold();  // NOLINT: likewise
  for (StampedPose& pose : poses)
    problem.AddParameterBlock(pose.T_WC.q.coeffs().data(), 4, manifold);
  for (const auto& [id, track] : tracks_of(frames)) {
    const auto point = intersect(track, guess);
    if (!point) continue;
    double* const X = points.emplace(id, *point).first->second.data();
    for (const Sight& sight : track) {
      Pose& T_WC = poses[sight.frame].T_WC;
      auto* cost = new ceres::AutoDiffCostFunction<PinholeError, 2, 4, 3, 3>(  // NOLINT: likewise
          new PinholeError{sight.point});                                      // NOLINT: likewise
      problem.AddResidualBlock(cost, kernel, T_WC.q.coeffs().data(), T_WC.p.data(), X);
    }
  }
  problem.SetParameterBlockConstant(poses.front().T_WC.q.coeffs().data());
  problem.SetParameterBlockConstant(poses.front().T_WC.p.data());
  Eigen::Vector3d& last = poses.back().T_WC.p;
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<PositionGuess, 3, 3>(new PositionGuess{last}),  // NOLINT: likewise
      nullptr, last.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.max_num_iterations = 40;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return poses;
}

std::vector<FeatureFrame> half_of(const std::vector<FeatureFrame>& frames, FeatureId parity) {
  std::vector<FeatureFrame> half = frames;
  for (FeatureFrame& frame : half)
    std::erase_if(frame.features, [parity](const TrackedFeature& f) { return f.id % 2 != parity; });
  return half;
}

}  // namespace cosight::vins
