#include "robot_agent/wearer/body_sighting.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "robot_agent/wearer/clusters.hpp"

namespace cosight::wearer {
namespace {

using Points = std::vector<ScanPoint>;

bool sees_torso(const PlanarScan& scan, const PersonModel& person) {
  return scan.T_OL.p.z() > person.hip_height;
}

Eigen::Vector2d middle(const Points& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const ScanPoint& point : points)
    sum += point.p_O;
  return sum / static_cast<double>(points.size());
}

double width(const Points& points) {
  double widest = 0.0;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = a + 1; b < points.size(); ++b)
      widest = std::max(widest, (points[a].p_O - points[b].p_O).norm());
  }
  return widest;
}

/// R diag(along, across) R^T with the first axis along the unit vector `u`.
Eigen::Matrix2d along_and_across(const Eigen::Vector2d& u, double along_sigma, double across_sigma) {
  const Eigen::Vector2d v(-u.y(), u.x());
  return along_sigma * along_sigma * u * u.transpose() + across_sigma * across_sigma * v * v.transpose();
}

/// Two groups, each point with the nearer middle, from the two outermost points on.
std::array<Points, 2> halves(const Points& points) {
  constexpr int kRounds = 5;
  std::array<Eigen::Vector2d, 2> centre{points.front().p_O, points.back().p_O};
  std::array<Points, 2> half;
  for (int round = 0; round < kRounds; ++round) {
    half = {};
    for (const ScanPoint& point : points)
      half[(point.p_O - centre[0]).norm() <= (point.p_O - centre[1]).norm() ? 0 : 1].push_back(point);
    if (half[0].empty() || half[1].empty()) return half;
    centre = {middle(half[0]), middle(half[1])};
  }
  return half;
}

bool stands_free(const PlanarScan& scan, const Points& points) {
  constexpr double kBehind = 0.3;  // [m]
  const double range = (middle(points) - scan.origin_O()).norm();
  const auto last = static_cast<int>(scan.ranges.size()) - 1;
  for (const int ray :
       {points.front().ray - 2, points.front().ray - 1, points.back().ray + 1, points.back().ray + 2}) {
    if (ray < 0 || ray > last) return false;
    const double measured = scan.ranges[static_cast<std::size_t>(ray)];
    if (measured > 0.0 && measured < range + kBehind) return false;
  }
  return true;
}

/// One smooth front, flat or round: a pillar or the end of a box, where two legs have a gap between them.
/// Deviation from x^2 + y^2 = 2 a x + 2 b y + c by least squares, and from a straight line.
bool is_one_front(const Points& points, double sigma) {
  constexpr std::size_t kFewest = 7;
  if (points.size() < kFewest) return false;
  const Eigen::Vector2d m = middle(points);
  Eigen::MatrixXd A(points.size(), 3);
  Eigen::VectorXd squares(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector2d d = points[k].p_O - m;
    const auto row = static_cast<Eigen::Index>(k);
    A.row(row) << 2.0 * d.x(), 2.0 * d.y(), 1.0;
    squares[row] = d.squaredNorm();
    spread += d * d.transpose();
  }
  const auto count = static_cast<double>(points.size());
  const double tolerance = 1.15 * sigma;
  if (std::sqrt(spread.selfadjointView<Eigen::Lower>().eigenvalues()[0] / (count - 2.0)) < tolerance)
    return true;
  const Eigen::Vector3d circle = A.colPivHouseholderQr().solve(squares);
  const double radius = std::sqrt(std::max(circle[2] + circle.head<2>().squaredNorm(), 0.0));
  double sum = 0.0;
  for (const ScanPoint& point : points)
    sum += std::pow((point.p_O - m - circle.head<2>()).norm() - radius, 2);
  return std::sqrt(sum / (count - 3.0)) < tolerance;
}

bool touch(const Points& a, const Points& b, double gap) {
  for (const ScanPoint& p : a) {
    for (const ScanPoint& q : b) {
      if ((p.p_O - q.p_O).squaredNorm() < gap * gap) return true;
    }
  }
  return false;
}

Limb fit(const PlanarScan& scan, const Points& points, double radius) {
  Limb limb = fit_cylinder(points, scan.origin_O(), radius, scan.sigma);
  limb.stands_free = stands_free(scan, points);
  return limb;
}

void add_legs(std::vector<Limb>& limbs, const PlanarScan& scan, const Points& cluster,
              const PersonModel& person) {
  const double wide = width(cluster);
  if (wide <= person.max_leg_width) {
    limbs.push_back(fit(scan, cluster, person.leg_radius));
  } else if (wide <= person.max_stride + person.max_leg_width && !is_one_front(cluster, scan.sigma)) {
    for (const Points& half : halves(cluster)) {
      if (!half.empty() && width(half) <= 1.3 * person.max_leg_width)
        limbs.push_back(fit(scan, half, person.leg_radius));
    }
  }
}

BodySighting two_legs(const std::vector<Limb>& limbs, std::size_t a, std::size_t b,
                      const PersonModel& person) {
  BodySighting body;
  body.part = BodyPart::kTwoLegs;
  body.p_O = 0.5 * (limbs[a].p_O + limbs[b].p_O);
  body.covariance = 0.25 * (limbs[a].covariance + limbs[b].covariance) +
                    person.pair_sigma * person.pair_sigma * Eigen::Matrix2d::Identity();
  body.correlation = 2.0;
  // The legs stand at p + d and p - d, so that their distance 2 d has four times the covariance of d.
  const double variance = 4.0 * person.leg_spread * person.leg_spread;
  constexpr double kBothSeen = 0.6;
  body.surprise = (limbs[a].p_O - limbs[b].p_O).squaredNorm() / variance +
                  2.0 * std::log(2.0 * std::numbers::pi * variance) - 2.0 * std::log(kBothSeen);
  body.limbs = {a, b};
  return body;
}

BodySighting one_leg(const std::vector<Limb>& limbs, std::size_t a, const PersonModel& person) {
  const Limb& leg = limbs[a];
  BodySighting body;
  body.part = BodyPart::kOneLeg;
  body.p_O = leg.p_O;
  body.covariance = leg.covariance;
  body.correlation = person.hidden_scans;
  if (leg.stands_free) {
    // Then the other leg is hidden behind this one: 0.2 to 0.5 m away, the axis in the middle.
    body.p_O += 0.75 * person.leg_spread * leg.along_ray;
    body.covariance += along_and_across(leg.along_ray, 0.6 * person.leg_spread, 0.6 * person.leg_spread);
  } else {
    // Whatever hides the other leg hides the same side of the body for longer than a step.
    constexpr double kSteps = 3.0;
    body.correlation *= kSteps;
    body.covariance += person.leg_spread * person.leg_spread * Eigen::Matrix2d::Identity();
  }
  constexpr double kOneSeen = 0.3;
  body.surprise = -2.0 * std::log(kOneSeen);
  body.limbs = {a};
  return body;
}

BodySighting torso(const std::vector<Limb>& limbs, std::size_t a, const PersonModel& person) {
  constexpr double kSeen = 0.9;
  BodySighting body;
  body.part = BodyPart::kTorso;
  body.p_O = limbs[a].p_O;
  const double sigma = 0.35 * person.torso_radius;  // a torso is no cylinder
  body.covariance = limbs[a].covariance + sigma * sigma * Eigen::Matrix2d::Identity();
  body.correlation = 5.0;
  body.surprise = -2.0 * std::log(kSeen);
  body.limbs = {a};
  return body;
}

}  // namespace

Limb fit_cylinder(const Points& points, const Eigen::Vector2d& origin_O, double radius, double sigma) {
  constexpr double kShapeSigma = 0.01;  // folds of trousers [m]
  constexpr int kSteps = 4;
  const Eigen::Vector2d m = middle(points);
  Limb limb;
  limb.along_ray = (m - origin_O).normalized();
  const Eigen::Vector2d c0 = m + 0.25 * std::numbers::pi * radius * limb.along_ray;
  const Eigen::Matrix2d information_of_c0 =
      along_and_across(limb.along_ray, 0.3 * radius, 0.6 * radius).inverse();
  const double weight = 1.0 / (sigma * sigma + kShapeSigma * kShapeSigma);
  limb.p_O = c0;
  Eigen::Matrix2d information = information_of_c0;
  for (int step = 0; step < kSteps; ++step) {
    information = information_of_c0;
    Eigen::Vector2d gradient = information_of_c0 * (c0 - limb.p_O);
    for (const ScanPoint& point : points) {
      const Eigen::Vector2d d = point.p_O - limb.p_O;
      const double distance = std::max(d.norm(), 1e-6);
      const Eigen::Vector2d outward = d / distance;  // = - d residual / d c
      information += weight * outward * outward.transpose();
      gradient += weight * (distance - radius) * outward;
    }
    limb.p_O += information.llt().solve(gradient);
  }
  limb.covariance = information.inverse();
  return limb;
}

std::vector<Limb> find_limbs(const PlanarScan& scan, const Points& points, const Points& furniture,
                             const SceneOptions& scene, const PersonModel& person) {
  std::vector<Limb> limbs;
  for (const Points& cluster : clusters(points, scene.cluster_gap)) {
    if (touch(cluster, furniture, scene.furniture_gap)) continue;
    if (!sees_torso(scan, person)) {
      add_legs(limbs, scan, cluster, person);
    } else if (cluster.size() > 1 && width(cluster) <= person.max_width) {
      limbs.push_back(fit(scan, cluster, person.torso_radius));
    }
  }
  return limbs;
}

std::vector<BodySighting> possible_bodies(const PlanarScan& scan, const std::vector<Limb>& limbs,
                                          const PersonModel& person) {
  std::vector<BodySighting> bodies;
  for (std::size_t a = 0; a < limbs.size(); ++a) {
    if (sees_torso(scan, person)) {
      bodies.push_back(torso(limbs, a, person));
      continue;
    }
    bodies.push_back(one_leg(limbs, a, person));
    for (std::size_t b = a + 1; b < limbs.size(); ++b) {
      const double stride = (limbs[a].p_O - limbs[b].p_O).norm();
      if (stride >= person.leg_radius && stride <= person.max_stride)
        bodies.push_back(two_legs(limbs, a, b, person));
    }
  }
  return bodies;
}

}  // namespace cosight::wearer
