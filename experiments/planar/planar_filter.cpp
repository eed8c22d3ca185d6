#include "experiments/planar/planar_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cosight::experiments {
namespace {

constexpr int kTheta = 2;
constexpr int kVelocity = 3;
constexpr int kOmega = 5;
constexpr int kCamera = 6;
constexpr int kAnchor = 3;  // x0 z0 theta

Eigen::Vector2d ray(double angle) {
  return {std::cos(angle), std::sin(angle)};
}
/// d ray / d angle.
Eigen::Vector2d across(double angle) {
  return {-std::sin(angle), std::cos(angle)};
}
double wrapped(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

}  // namespace

/// Stacked innovations with their rows of H and their independent variances.
struct PlanarFilter::Rows {
  explicit Rows(Eigen::Index states) : H(0, states) {}

  /// A zeroed row of H to be filled.
  auto add(double innovation, double sigma) {
    const Eigen::Index row = H.rows();
    H.conservativeResize(row + 1, Eigen::NoChange);
    H.row(row).setZero();
    g.conservativeResize(row + 1);
    variance.conservativeResize(row + 1);
    g(row) = innovation;
    variance(row) = sigma * sigma;
    return H.row(row);
  }

  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  Eigen::VectorXd variance;
};

PlanarFilter::PlanarFilter(const PlanarFilterOptions& options, double theta)
    : options_(options), x_(Eigen::VectorXd::Zero(kCamera)), P_(Eigen::MatrixXd::Zero(kCamera, kCamera)) {
  x_(kTheta) = theta;
  const double v = options.start_sigma_velocity;
  P_.diagonal() << 0.0, 0.0, 0.0, v * v, v * v, options.start_sigma_turn * options.start_sigma_turn;
}

PlanarCamera PlanarFilter::camera() const {
  return {x_.head<2>(), x_(kTheta), x_.segment<2>(kVelocity), x_(kOmega)};
}

PlanarFilter::Block* PlanarFilter::find(int id) {
  const auto found =
      std::find_if(blocks_.begin(), blocks_.end(), [id](const Block& b) { return b.id == id; });
  return found == blocks_.end() ? nullptr : &*found;
}

std::vector<PlanarFilter::Landmark> PlanarFilter::landmarks() const {
  std::vector<Landmark> all;
  for (const Block& block : blocks_) {
    if (block.rho < 0) continue;
    const double rho = x_(block.rho);
    all.push_back({block.id, x_.segment<2>(block.anchor) + ray(x_(block.anchor + 2)) / rho, rho,
                   std::sqrt(P_(block.rho, block.rho))});
  }
  return all;
}

/// y = f(x, n): P grows by J P and J P J^T + noise.
void PlanarFilter::append(const Eigen::VectorXd& y, const Eigen::MatrixXd& J, const Eigen::MatrixXd& noise) {
  const Eigen::Index n = x_.size();
  const Eigen::MatrixXd J_P = J * P_;
  P_.conservativeResize(n + y.size(), n + y.size());
  P_.bottomLeftCorner(y.size(), n) = J_P;
  P_.topRightCorner(n, y.size()) = J_P.transpose();
  P_.bottomRightCorner(y.size(), y.size()) = J_P * J.transpose() + noise;
  x_.conservativeResize(n + y.size());
  x_.tail(y.size()) = y;
}

void PlanarFilter::remove(int offset, int dim) {
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(x_.size()); ++i) {
    if (i < offset || i >= offset + dim) kept.push_back(i);
  }
  x_ = Eigen::VectorXd(x_(kept));
  P_ = Eigen::MatrixXd(P_(kept, kept));
  for (Block& block : blocks_) {
    if (block.anchor > offset) block.anchor -= dim;
    if (block.rho > offset) block.rho -= dim;
  }
}

void PlanarFilter::remove_block(std::size_t index) {
  const Block block = blocks_[index];
  blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(index));
  if (block.rho >= 0) remove(block.rho, 1);
  remove(block.anchor, kAnchor);
}

void PlanarFilter::add_known_landmark(int landmark, const Eigen::Vector2d& point, double sigma) {
  const Eigen::Vector2d to = point - x_.head<2>();
  const double d = to.norm();
  const double rho = 1.0 / d;
  const int offset = static_cast<int>(x_.size());
  Eigen::Vector4d y;
  y << x_.head<2>(), std::atan2(to.y(), to.x()), rho;
  Eigen::Matrix4d noise = Eigen::Matrix4d::Zero();
  noise(2, 2) = sigma * sigma * rho * rho;
  noise(3, 3) = sigma * sigma * rho * rho * rho * rho;
  append(y, Eigen::MatrixXd::Zero(4, offset), noise);
  blocks_.push_back({landmark, offset, offset + kAnchor});
}

/// C9 in steps of dt, the accelerations as impulses a dt: x' = F x, P' = F P F^T + G Q G^T.
void PlanarFilter::predict(double dt) {
  x_.head<3>() += dt * x_.segment<3>(kVelocity);
  P_.topRows<3>() += dt * P_.middleRows<3>(kVelocity);
  P_.leftCols<3>() += dt * P_.middleCols<3>(kVelocity);
  Eigen::Matrix<double, kCamera, 3> G;
  G << dt * Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity();
  const Eigen::Vector3d sigma = dt * Eigen::Vector3d(options_.sigma_acceleration, options_.sigma_acceleration,
                                                     options_.sigma_angular_acceleration);
  P_.topLeftCorner<kCamera, kCamera>() += G * sigma.cwiseAbs2().asDiagonal() * G.transpose();
}

/// With c = rho (r0 - r) + m(theta_i), the landmark's direction scaled by rho (good at infinity):
///   bearing = atan2(c_z, c_x) - theta,   range = |c| / rho.
void PlanarFilter::append_rows(const Block& block, const PlanarMeasurement& measurement, Rows& rows) const {
  const double rho = x_(block.rho);
  const double angle = x_(block.anchor + 2);
  const Eigen::Vector2d offset = x_.segment<2>(block.anchor) - x_.head<2>();
  const Eigen::Vector2d c = rho * offset + ray(angle);
  const double norm = c.norm();
  const auto fill = [&](auto row, const Eigen::RowVector2d& by_c, double by_theta, double by_rho) {
    row.template segment<2>(0) = -rho * by_c;
    row(kTheta) = by_theta;
    row.template segment<2>(block.anchor) = rho * by_c;
    row(block.anchor + 2) = by_c * across(angle);
    row(block.rho) = by_c.dot(offset) + by_rho;
  };
  const Eigen::RowVector2d turn = Eigen::RowVector2d(-c.y(), c.x()) / (norm * norm);
  const double bearing = std::atan2(c.y(), c.x()) - x_(kTheta);
  fill(rows.add(wrapped(measurement.bearing - bearing), options_.bearing_sigma), turn, -1.0, 0.0);
  if (!measurement.stereo || rho <= 0.0) return;
  fill(rows.add(wrapped(measurement.stereo->bearing - bearing), options_.stereo_bearing_sigma), turn, -1.0,
       0.0);
  fill(rows.add(measurement.stereo->range - norm / rho, options_.range_sigma), c.transpose() / (norm * rho),
       0.0, -norm / (rho * rho));
}

/// K = P H^T S^-1, x += K g, P -= K S K^T.
void PlanarFilter::correct(const Rows& rows) {
  const Eigen::MatrixXd P_Ht = P_ * rows.H.transpose();
  Eigen::MatrixXd S = rows.H * P_Ht;
  S.diagonal() += rows.variance;
  const Eigen::LLT<Eigen::MatrixXd> llt(S);
  const Eigen::MatrixXd W = llt.matrixL().solve(P_Ht.transpose());
  x_ += W.transpose() * llt.matrixL().solve(rows.g);
  P_ -= W.transpose() * W;
}

void PlanarFilter::update(std::span<const PlanarMeasurement> measurements) {
  Rows rows(x_.size());
  std::vector<const PlanarMeasurement*> unused;
  for (const PlanarMeasurement& m : measurements) {
    const Block* block = find(m.landmark);
    if (block != nullptr && block->rho >= 0) {
      append_rows(*block, m, rows);
    } else {
      unused.push_back(&m);
    }
  }
  if (rows.g.size() > 0) correct(rows);
  for (const PlanarMeasurement* m : unused) {
    if (m->stereo && m->stereo->range > 0.0) {
      add_stereo_landmark(*m);
    } else if (Block* block = find(m->landmark)) {
      start_depth(*block, m->bearing);
    } else {
      add_candidate(*m);
    }
  }
}

void PlanarFilter::drop_lost_candidates(std::span<const PlanarMeasurement> in_view) {
  for (std::size_t i = blocks_.size(); i-- > 0;) {
    const bool seen = std::any_of(in_view.begin(), in_view.end(),
                                  [&](const PlanarMeasurement& m) { return m.landmark == blocks_[i].id; });
    if (blocks_[i].rho < 0 && !seen) remove_block(i);
  }
}

/// The first sighting: [x z theta + bearing], as it is.
void PlanarFilter::add_candidate(const PlanarMeasurement& measurement) {
  const int offset = static_cast<int>(x_.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(kAnchor, offset);
  J.leftCols<3>().setIdentity();
  Eigen::Vector3d y = x_.head<3>();
  y(2) += measurement.bearing;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
  noise(2, 2) = options_.bearing_sigma * options_.bearing_sigma;
  append(y, J, noise);
  blocks_.push_back({measurement.landmark, offset, -1});
}

/// Pseudo-stereo start: anchored here and now, rho = 1 / range.
void PlanarFilter::add_stereo_landmark(const PlanarMeasurement& measurement) {
  if (const Block* old = find(measurement.landmark))
    remove_block(static_cast<std::size_t>(old - blocks_.data()));
  add_candidate(measurement);
  const double rho = 1.0 / measurement.stereo->range;
  Eigen::MatrixXd noise(1, 1);
  noise << std::pow(rho * rho * options_.range_sigma, 2);
  Block& block = blocks_.back();
  block.rho = static_cast<int>(x_.size());
  append(Eigen::VectorXd::Constant(1, rho), Eigen::MatrixXd::Zero(1, x_.size()), noise);
}

/// Delayed start: with b from the first centre to the present one, phi the ray's angle now and phi_0 then,
///   rho = N / D,   N = sin(phi - phi_0),   D = b x m(phi) = b_x sin(phi) - b_z cos(phi).
void PlanarFilter::start_depth(Block& block, double bearing) {
  const double phi = x_(kTheta) + bearing;
  const double parallax = phi - x_(block.anchor + 2);
  const Eigen::Vector2d b = x_.head<2>() - x_.segment<2>(block.anchor);
  const double N = std::sin(parallax);
  const double D = b.x() * std::sin(phi) - b.y() * std::cos(phi);
  const double baseline = std::abs(b.dot(across(x_(block.anchor + 2))));
  if (baseline < options_.min_baseline || N * D <= 0.0) return;
  const double rho = N / D;
  const double by_phi = (std::cos(parallax) - rho * b.dot(ray(phi))) / D;
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(1, x_.size());
  J.leftCols<2>() = rho / D * across(phi).transpose();
  J(kTheta) = by_phi;
  J.middleCols<2>(block.anchor) = -rho / D * across(phi).transpose();
  J(block.anchor + 2) = -std::cos(parallax) / D;
  Eigen::MatrixXd noise(1, 1);
  noise << std::pow(by_phi * options_.bearing_sigma, 2);
  block.rho = static_cast<int>(x_.size());
  append(Eigen::VectorXd::Constant(1, rho), J, noise);
}

}  // namespace cosight::experiments
