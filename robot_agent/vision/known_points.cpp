#include "robot_agent/vision/known_points.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <opencv2/calib3d.hpp>
#include <random>

#include "shared/geometry/rotation.hpp"

namespace cosight::vision {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The points as OpenCV wants them: normalised rays, so that its own camera model is the identity.
struct SolverPoints {
  std::vector<cv::Point3d> p_W;
  std::vector<cv::Point2d> rays;
  std::vector<std::size_t> indices;  ///< of the points that have a ray
};

SolverPoints solver_points(const CameraModel& camera, const std::vector<KnownPoint>& points) {
  SolverPoints result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto ray = camera.unproject(points[i].pixel);
    if (!ray || !points[i].p_W.allFinite()) continue;
    result.p_W.emplace_back(points[i].p_W.x(), points[i].p_W.y(), points[i].p_W.z());
    result.rays.emplace_back(ray->x(), ray->y());
    result.indices.push_back(i);
  }
  return result;
}

Pose to_pose(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  const Eigen::Vector3d phi(rotation_vector.at<double>(0), rotation_vector.at<double>(1),
                            rotation_vector.at<double>(2));
  const Eigen::Vector3d p(translation.at<double>(0), translation.at<double>(1), translation.at<double>(2));
  return Pose{quaternion_exp(phi), p}.inverse();
}

/// Poses T_WC that agree with all points (SQPnP), or with three of them (P3P: up to four).
std::vector<Pose> solve(const std::vector<cv::Point3d>& p_W, const std::vector<cv::Point2d>& rays) {
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  std::vector<Pose> poses;
  try {
    if (p_W.size() == 3) {
      cv::solveP3P(p_W, rays, cv::Matx33d::eye(), cv::noArray(), rotations, translations, cv::SOLVEPNP_P3P);
    } else {
      cv::solvePnPGeneric(p_W, rays, cv::Matx33d::eye(), cv::noArray(), rotations, translations, false,
                          cv::SOLVEPNP_SQPNP);
    }
  } catch (const cv::Exception&) {
    return poses;  // degenerate points: OpenCV throws where the caller only wants another draw
  }
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const Pose T_WC = to_pose(rotations[i], translations[i]);
    if (T_WC.p.allFinite() && T_WC.q.coeffs().allFinite()) poses.push_back(T_WC);
  }
  return poses;
}

std::optional<double> error_px(const CameraModel& camera, const KnownPoint& point, const Pose& T_CW) {
  const auto pixel = camera.project(T_CW * point.p_W);
  if (!pixel) return std::nullopt;
  return (*pixel - point.pixel).norm();
}

int mark_inliers(const CameraModel& camera, const std::vector<KnownPoint>& points, const Pose& T_WC,
                 double max_error_px, std::vector<bool>& inliers) {
  const Pose T_CW = T_WC.inverse();
  int count = 0;
  inliers.assign(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto error = error_px(camera, points[i], T_CW);
    if (!error || *error > max_error_px) continue;
    inliers[i] = true;
    ++count;
  }
  return count;
}

/// Sums of the normal equations at T_WC; T_WC's error as in UncertainPose: p_C = R^T Exp(-dtheta)(p_W - p -
/// dp).
struct NormalEquations {
  Matrix6 information = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double squared_error = 0.0;
  int count = 0;
};

std::optional<NormalEquations> normal_equations(const CameraModel& camera,
                                                const std::vector<KnownPoint>& points,
                                                const std::vector<bool>& inliers, const Pose& T_WC) {
  NormalEquations sums;
  const Eigen::Matrix3d R_CW = T_WC.q.toRotationMatrix().transpose();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!inliers[i]) continue;
    const Eigen::Vector3d from_camera = points[i].p_W - T_WC.p;
    Eigen::Matrix<double, 2, 3> J_project;
    const auto pixel = camera.project(R_CW * from_camera, &J_project);
    if (!pixel) return std::nullopt;
    Eigen::Matrix<double, 2, 6> J;
    J.leftCols<3>() = -J_project * R_CW;
    J.rightCols<3>() = J_project * R_CW * skew(from_camera);
    const Eigen::Vector2d error = points[i].pixel - *pixel;
    sums.information += J.transpose() * J;
    sums.gradient += J.transpose() * error;
    sums.squared_error += error.squaredNorm();
    ++sums.count;
  }
  return sums;
}

bool is_determined(const Matrix6& information) {
  // Metres and radians differ in scale; the diagonal takes that out.
  const Vector6 scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Matrix6 normalised = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(normalised, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(0) > 1e-10;
}

/// Three different indices.
std::array<std::size_t, 3> draw_three(std::size_t n, std::mt19937& random) {
  std::array<std::size_t, 3> drawn{};
  for (std::size_t k = 0; k < 3;) {
    drawn[k] = random() % n;  // the standard's distributions differ between libraries
    if (std::find(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(k), drawn[k]) ==
        drawn.begin() + static_cast<std::ptrdiff_t>(k)) {
      ++k;
    }
  }
  return drawn;
}

int hypotheses_needed(int inliers, std::size_t n, const KnownPointsOptions& options) {
  const double share = static_cast<double>(inliers) / static_cast<double>(n);
  const double failure = 1.0 - share * share * share;
  if (failure < 1e-9) return 1;
  const double needed = std::log(1.0 - options.confidence) / std::log(failure);
  return static_cast<int>(std::min(needed + 1.0, static_cast<double>(options.max_hypotheses)));
}

}  // namespace

std::optional<KnownPointsPose> refine_pose(const CameraModel& camera, const std::vector<KnownPoint>& points,
                                           const std::vector<bool>& inliers, const Pose& T_WC,
                                           const KnownPointsOptions& options) {
  constexpr int kMaxIterations = 30;
  Pose pose = T_WC;
  auto sums = normal_equations(camera, points, inliers, pose);
  if (!sums || sums->count < 3) return std::nullopt;
  double damping = 1e-6;
  for (int i = 0; i < kMaxIterations; ++i) {
    Matrix6 damped = sums->information;
    damped.diagonal() *= 1.0 + damping;
    const Vector6 step = damped.ldlt().solve(sums->gradient);
    if (!step.allFinite()) return std::nullopt;
    const Pose next{(quaternion_exp(step.tail<3>()) * pose.q).normalized(), pose.p + step.head<3>()};
    const auto next_sums = normal_equations(camera, points, inliers, next);
    if (!next_sums || next_sums->squared_error > sums->squared_error * (1.0 + 1e-12)) {
      damping *= 10.0;
      if (damping > 1e6) break;
      continue;
    }
    pose = next;
    sums = next_sums;
    damping = std::max(damping * 0.1, 1e-9);
    if (step.norm() < 1e-10) break;
  }
  if (!is_determined(sums->information)) return std::nullopt;
  KnownPointsPose result;
  result.T_WC.T = pose;
  const Matrix6 inverse = sums->information.ldlt().solve(Matrix6::Identity());
  result.T_WC.covariance = 0.5 * options.sigma_pixel * options.sigma_pixel * (inverse + inverse.transpose());
  result.inliers = inliers;
  result.inlier_count = sums->count;
  result.rms_error_px = std::sqrt(sums->squared_error / sums->count);
  return result;
}

std::optional<KnownPointsPose> estimate_pose(const CameraModel& camera, const std::vector<KnownPoint>& points,
                                             const KnownPointsOptions& options) {
  const SolverPoints solver = solver_points(camera, points);
  if (solver.indices.size() < 4 || solver.indices.size() != points.size()) return std::nullopt;
  const std::vector<bool> all(points.size(), true);
  std::optional<KnownPointsPose> best;
  for (const Pose& T_WC : solve(solver.p_W, solver.rays)) {
    auto refined = refine_pose(camera, points, all, T_WC, options);
    if (refined && (!best || refined->rms_error_px < best->rms_error_px)) best = std::move(refined);
  }
  return best;
}

std::optional<KnownPointsPose> estimate_pose_ransac(const CameraModel& camera,
                                                    const std::vector<KnownPoint>& points,
                                                    const KnownPointsOptions& options) {
  const SolverPoints solver = solver_points(camera, points);
  const std::size_t n = solver.indices.size();
  if (n < 4) return std::nullopt;
  std::mt19937 random(options.seed);
  std::vector<bool> inliers;
  std::vector<bool> best_inliers;
  Pose T_WC_best;
  int best_count = 0;
  int limit = options.max_hypotheses;
  for (int hypothesis = 0; hypothesis < limit; ++hypothesis) {
    std::vector<cv::Point3d> p_W;
    std::vector<cv::Point2d> rays;
    for (const std::size_t i : draw_three(n, random)) {
      p_W.push_back(solver.p_W[i]);
      rays.push_back(solver.rays[i]);
    }
    for (const Pose& T_WC : solve(p_W, rays)) {
      const int count = mark_inliers(camera, points, T_WC, options.max_error_px, inliers);
      if (count <= best_count) continue;
      best_count = count;
      T_WC_best = T_WC;
      best_inliers = inliers;
      limit = hypotheses_needed(count, n, options);
    }
  }
  const int needed = std::max(options.min_inliers, 4);
  if (best_count < needed) return std::nullopt;
  auto refined = refine_pose(camera, points, best_inliers, T_WC_best, options);
  if (!refined) return std::nullopt;
  // A pose from three noisy points misses inliers that the refined one has.
  best_count = mark_inliers(camera, points, refined->T_WC.T, options.max_error_px, inliers);
  if (best_count < needed) return std::nullopt;
  return refine_pose(camera, points, inliers, refined->T_WC.T, options);
}

}  // namespace cosight::vision
