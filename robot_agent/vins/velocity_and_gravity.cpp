#include "robot_agent/vins/velocity_and_gravity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <vector>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A camera centre as a linear function of x = [v g]: c = A x + a, in the axes of the first body frame.
struct LinearCentre {
  Matrix36 A = Matrix36::Zero();
  Vector3d a = Vector3d::Zero();
  Matrix3d R_B0S = Matrix3d::Identity();
};

struct Ray {
  std::size_t frame;
  Vector3d u;  ///< in the axes of the first body frame
};

std::vector<LinearCentre> camera_centres(const std::vector<UnplacedFrame>& frames, const Pose& T_BS) {
  std::vector<LinearCentre> centres;
  std::optional<Preintegration> imu;
  for (const UnplacedFrame& frame : frames) {
    LinearCentre centre;
    Eigen::Quaterniond gamma = Eigen::Quaterniond::Identity();
    if (frame.imu) {
      if (imu) {
        imu->append(*frame.imu);
      } else {
        imu = frame.imu;
      }
      const double t = imu->duration();
      gamma = imu->increment().gamma;
      centre.A << t * Matrix3d::Identity(), -0.5 * t * t * Matrix3d::Identity();
      centre.a = imu->increment().alpha;
    }
    centre.a += gamma * T_BS.p;
    centre.R_B0S = (gamma * T_BS.q).toRotationMatrix();
    centres.push_back(centre);
  }
  return centres;
}

std::map<FeatureId, std::vector<Ray>> rays(const std::vector<UnplacedFrame>& frames,
                                           const std::vector<LinearCentre>& centres) {
  std::map<FeatureId, std::vector<Ray>> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const TrackedFeature& feature : frames[i].features.features) {
      out[feature.id].push_back({i, centres[i].R_B0S * feature.sighting.bearing()});
    }
  }
  return out;
}

/// x^T H x - 2 b^T x + c.
struct Quadratic {
  Matrix6 H = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  double c = 0.0;

  double at(const Vector6& x) const { return x.dot(H * x) - 2.0 * b.dot(x) + c; }

  Quadratic& add(const Quadratic& other, double weight) {
    H += weight * other.H;
    b += weight * other.b;
    c += weight * other.c;
    return *this;
  }
};

/// The distance of a feature from its host that fits x best.
struct LinearDistance {
  Vector6 slope = Vector6::Zero();
  double offset = 0.0;

  double at(const Vector6& x) const { return offset - slope.dot(x); }
};

/// What all features cost, and what noise of one radian in every ray would cost on average: both grow with
/// the distances, so that the least cost alone would be at too short a path.
struct Balance {
  Quadratic cost;
  Quadratic noise;
  std::vector<LinearDistance> distances;

  Quadratic cost_without(double share_of_noise) const {
    Quadratic rest = cost;
    return rest.add(noise, -share_of_noise);
  }
  bool mostly_in_front(const Vector6& x) const {
    const auto in_front =
        std::count_if(distances.begin(), distances.end(), [&](const auto& d) { return d.at(x) > 0.0; });
    return 10 * in_front > 7 * std::ssize(distances);
  }
};

/// Adds one feature with its distance taken out; `x`, when known, gives the distance that makes metres
/// angles.
void add_feature(const std::vector<Ray>& seen, const std::vector<LinearCentre>& centres, const Vector6* x,
                 Balance& sum) {
  const Ray& host = seen.front();
  Quadratic own;
  Vector6 H_xd = Vector6::Zero();
  double H_dd = 0.0;
  double b_d = 0.0;
  for (std::size_t k = 1; k < seen.size(); ++k) {
    const Matrix3d K = skew(seen[k].u);
    const Matrix36 A = K * (centres[host.frame].A - centres[seen[k].frame].A);
    const Vector3d rest = K * (centres[host.frame].a - centres[seen[k].frame].a);
    const Vector3d B = K * host.u;
    own.H += A.transpose() * A;
    own.b -= A.transpose() * rest;
    own.c += rest.squaredNorm();
    H_xd += A.transpose() * B;
    H_dd += B.squaredNorm();
    b_d -= B.dot(rest);
  }
  constexpr double kMinParallaxSquared = 1e-5;  // sum of sin^2 over the sightings
  if (H_dd < kMinParallaxSquared) return;
  const LinearDistance distance{H_xd / H_dd, b_d / H_dd};
  double weight = 1.0;
  if (x != nullptr) {
    const double metres = std::clamp(distance.at(*x), 0.5, 1000.0);
    weight = 1.0 / (metres * metres);
  }
  const Quadratic squared_distance{distance.slope * distance.slope.transpose(),
                                   distance.slope * distance.offset, distance.offset * distance.offset};
  sum.cost.add(own, weight).add(squared_distance, -weight * H_dd);
  sum.noise.add(squared_distance, weight * static_cast<double>(seen.size()));
  sum.distances.push_back(distance);
}

/// Minimum of g^T H g - 2 b^T g on the sphere |g| = radius: (H + mu I) g = b with the only mu above minus the
/// smallest eigenvalue at which the length is right.
Vector3d minimum_on_sphere(const Matrix3d& H, const Vector3d& b, double radius) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(H);
  const Vector3d projected = eigen.eigenvectors().transpose() * b;
  const auto solution = [&](double mu) -> Vector3d {
    return projected.cwiseQuotient((eigen.eigenvalues().array() + mu).matrix());
  };
  double low = -eigen.eigenvalues()(0) + 1e-12 * std::abs(eigen.eigenvalues()(2));
  double high = b.norm() / radius - eigen.eigenvalues()(0) + 1.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (solution(middle).norm() > radius ? low : high) = middle;
  }
  return eigen.eigenvectors() * solution(high).normalized() * radius;
}

/// Least value over all v and all g of length `gravity`; nothing when it has none.
std::optional<Vector6> constrained_minimum(const Quadratic& q, double gravity) {
  const Eigen::LLT<Matrix3d> H_vv(q.H.topLeftCorner<3, 3>());
  if (H_vv.info() != Eigen::Success) return std::nullopt;
  const Matrix3d H_vg = q.H.topRightCorner<3, 3>();
  const Matrix3d H_g = q.H.bottomRightCorner<3, 3>() - H_vg.transpose() * H_vv.solve(H_vg);
  const Vector3d b_g = q.b.tail<3>() - H_vg.transpose() * H_vv.solve(q.b.head<3>());
  Vector6 x;
  x.tail<3>() = minimum_on_sphere(H_g, b_g, gravity);
  x.head<3>() = H_vv.solve(q.b.head<3>() - H_vg * x.tail<3>());
  if (!x.allFinite()) return std::nullopt;
  return x;
}

/// The largest share of noise that can be taken off the cost before its minimum turns negative: the least
/// cost / noise (Taubin's fit).
double least_ratio(const Balance& sum, double gravity) {
  const auto x = constrained_minimum(sum.cost, gravity);
  if (!x) return 0.0;
  double low = 0.0;
  double high = sum.cost.at(*x) / sum.noise.at(*x);
  for (int i = 0; i < 40; ++i) {
    const double share = 0.5 * (low + high);
    const Quadratic rest = sum.cost_without(share);
    const auto candidate = constrained_minimum(rest, gravity);
    (candidate && rest.at(*candidate) > 0.0 ? low : high) = share;
  }
  return low;
}

/// The least cost / noise, or as near to it as the features still are in front of the camera: where the
/// accelerations are weak, the mirrored path, with all features behind, fits nearly as well.
std::optional<Vector6> solve_in_front(const Balance& sum, double gravity) {
  const double least = least_ratio(sum, gravity);
  for (const double part : {1.0, 0.98, 0.95, 0.9, 0.8, 0.5, 0.0}) {
    const auto x = constrained_minimum(sum.cost_without(part * least), gravity);
    if (x && sum.mostly_in_front(*x)) return x;
  }
  return std::nullopt;
}

}  // namespace

std::optional<MetricStart> estimate_velocity_and_gravity(const std::vector<UnplacedFrame>& frames,
                                                         const Pose& T_BS, double gravity) {
  const std::vector<LinearCentre> centres = camera_centres(frames, T_BS);
  const auto tracks = rays(frames, centres);
  constexpr std::size_t kMinSightings = 3;
  std::optional<Vector6> x;
  for (int pass = 0; pass < 3; ++pass) {
    Balance sum;
    for (const auto& [id, seen] : tracks) {
      if (seen.size() >= kMinSightings) add_feature(seen, centres, x ? &*x : nullptr, sum);
    }
    x = solve_in_front(sum, gravity);
    if (!x) return std::nullopt;
  }
  return MetricStart{x->head<3>(), x->tail<3>()};
}

}  // namespace cosight::vins
