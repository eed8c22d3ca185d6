#include "sim/render/renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cosight::sim {
namespace {

constexpr int kTileWidth = 32;  // [px]
constexpr int kTileHeight = 8;  // [px]
constexpr float kSkyBrightness = 0.0F;

std::size_t index_of(int row, int column, int width) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
}

/// How far, at most, a ray (x/z, y/z) turns between two poses when nothing is nearer than half a metre.
double ray_movement(const Pose& T_WA, const Pose& T_WB) {
  constexpr double kNearest = 0.5;      // [m]
  constexpr double kTowardsEdge = 2.0;  // d(tan) is larger than d(angle) off the axis
  return kTowardsEdge * (T_WA.q.angularDistance(T_WB.q) + (T_WA.p - T_WB.p).norm() / kNearest);
}

float dot(const Eigen::Vector3f& plane, const Eigen::Vector2f& ray) {
  return plane.x() * ray.x() + plane.y() * ray.y() + plane.z();
}

}  // namespace

Renderer::Renderer(const Camera& camera) : camera_(camera) {
  radiance_.width = camera.calibration().width;
  radiance_.height = camera.calibration().height;
  const std::size_t pixels = index_of(radiance_.height, 0, radiance_.width);
  radiance_.brightness.resize(pixels);
  radiance_.depth.resize(pixels);
  radiance_.quad.resize(pixels);
  winners_.resize(pixels);
  tile_columns_ = (radiance_.width + kTileWidth - 1) / kTileWidth;
}

const Radiance& Renderer::render(std::span<const Quad> quads, const Pose& T_WC) {
  quads_ = quads;
  find_candidates(T_WC, 0.0);
  set_planes(T_WC);
  for (int row = 0; row < radiance_.height; ++row)
    find_winners(row);
  for (int row = 0; row < radiance_.height; ++row)
    shade_row(row, T_WC);
  return radiance_;
}

const Radiance& Renderer::render(std::span<const Quad> quads, const RowPose& T_WC_of_row) {
  quads_ = quads;
  const Pose T_WC_middle = T_WC_of_row(radiance_.height / 2);
  find_candidates(T_WC_middle, std::max(ray_movement(T_WC_middle, T_WC_of_row(0)),
                                        ray_movement(T_WC_middle, T_WC_of_row(radiance_.height - 1))));
  for (int row = 0; row < radiance_.height; ++row) {
    set_planes(T_WC_of_row(row));
    find_winners(row);
  }
  for (int row = 0; row < radiance_.height; ++row) {
    const Pose T_WC = T_WC_of_row(row);
    set_planes(T_WC);
    shade_row(row, T_WC);
  }
  return radiance_;
}

RayBox Renderer::rays_of_tile(int tile_row, int tile_column) const {
  const int top = tile_row * kTileHeight;
  const int left = tile_column * kTileWidth;
  const int bottom = std::min(top + kTileHeight, radiance_.height) - 1;
  const int right = std::min(left + kTileWidth, radiance_.width) - 1;
  RayBox box{Eigen::Vector2f::Constant(1e9F), Eigen::Vector2f::Constant(-1e9F)};
  for (const int row : {top, bottom}) {
    for (const int column : {left, (left + right) / 2, right}) {
      const std::size_t k = index_of(row, column, radiance_.width);
      const Eigen::Vector2f ray{camera_.rays_x()[k], camera_.rays_y()[k]};
      box.low = box.low.cwiseMin(ray);
      box.high = box.high.cwiseMax(ray);
    }
  }
  return box;
}

void Renderer::find_candidates(const Pose& T_WC, double movement) {
  const Pose T_CW = T_WC.inverse();
  // Half a pixel for the divided pixels and half for the lens's curvature inside a tile.
  const auto margin =
      static_cast<float>(movement + 1.0 / camera_.calibration().fx + 1.0 / camera_.calibration().fy);
  visible_.clear();
  outlines_.clear();
  for (std::size_t k = 0; k < quads_.size(); ++k) {
    const Outline outline(quads_[k], T_CW);
    // Under a rolling shutter a quad seen edge-on from the middle row may face another row: kept out, one
    // pixel wide at most.
    if (outline.empty()) continue;
    visible_.push_back(static_cast<std::uint16_t>(k));
    outlines_.push_back(outline);
  }
  tiles_.clear();
  candidates_.clear();
  for (int tile_row = 0; tile_row * kTileHeight < radiance_.height; ++tile_row) {
    for (int tile_column = 0; tile_column < tile_columns_; ++tile_column) {
      RayBox box = rays_of_tile(tile_row, tile_column);
      box.low.array() -= margin;
      box.high.array() += margin;
      const std::size_t first = candidates_.size();
      for (std::size_t k = 0; k < outlines_.size(); ++k) {
        if (outlines_[k].may_overlap(box)) candidates_.push_back(static_cast<std::uint16_t>(k));
      }
      tiles_.push_back({first, candidates_.size() - first});
    }
  }
}

void Renderer::set_planes(const Pose& T_WC) {
  const Pose T_CW = T_WC.inverse();
  const Eigen::Matrix3d R_CW = T_CW.q.toRotationMatrix();
  planes_.resize(visible_.size());
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    const Quad& quad = quads_[visible_[k]];
    const Eigen::Vector3d origin_C = R_CW * quad.origin + T_CW.p;
    const Eigen::Vector3d s_C = R_CW * quad.edge_s;
    const Eigen::Vector3d t_C = R_CW * quad.edge_t;
    const Eigen::Vector3d n = s_C.cross(t_C);
    // n . z ray = n . origin;  s = (z ray - origin) . (t x n) / n^2;  t = (z ray - origin) . (n x s) / n^2
    const Eigen::Vector3d inverse_z = n / n.dot(origin_C);
    const Eigen::Vector3d along_s = t_C.cross(n) / n.squaredNorm();
    const Eigen::Vector3d along_t = n.cross(s_C) / n.squaredNorm();
    planes_[k] = {inverse_z.cast<float>(), (along_s - along_s.dot(origin_C) * inverse_z).cast<float>(),
                  (along_t - along_t.dot(origin_C) * inverse_z).cast<float>()};
  }
}

std::span<const std::uint16_t> Renderer::candidates_at(int row, int column) const {
  const Tile& tile = tiles_[index_of(row / kTileHeight, column / kTileWidth, tile_columns_)];
  return std::span(candidates_).subspan(tile.first, tile.count);
}

void Renderer::find_winners(int row) {
  for (int left = 0; left < radiance_.width; left += kTileWidth) {
    const std::size_t start = index_of(row, left, radiance_.width);
    const auto count = static_cast<std::size_t>(std::min(kTileWidth, radiance_.width - left));
    const float* x = camera_.rays_x().data() + start;
    const float* y = camera_.rays_y().data() + start;
    std::array<float, kTileWidth> nearest{};  // 1/z
    std::array<std::int32_t, kTileWidth> winner{};
    winner.fill(Radiance::kSky);
    for (const std::uint16_t candidate : candidates_at(row, left)) {
      const Plane plane = planes_[candidate];
      const std::int32_t id = candidate;
      for (std::size_t k = 0; k < count; ++k) {
        const float w = plane.inverse_z.x() * x[k] + plane.inverse_z.y() * y[k] + plane.inverse_z.z();
        const float s = plane.s_over_z.x() * x[k] + plane.s_over_z.y() * y[k] + plane.s_over_z.z();
        const float t = plane.t_over_z.x() * x[k] + plane.t_over_z.y() * y[k] + plane.t_over_z.z();
        // 0 <= s/z <= 1/z and the same for t, without a branch so that the loop is vectorised.
        const bool wins = (w > nearest[k]) & (s >= 0.0F) & (s <= w) & (t >= 0.0F) & (t <= w);
        nearest[k] = wins ? w : nearest[k];
        winner[k] = wins ? id : winner[k];
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      winners_[start + k] = static_cast<std::uint16_t>(winner[k]);
      radiance_.quad[start + k] =
          winner[k] == Radiance::kSky ? Radiance::kSky : visible_[static_cast<std::size_t>(winner[k])];
      radiance_.depth[start + k] = nearest[k] > 0.0F ? 1.0F / nearest[k] : 0.0F;
    }
  }
}

bool Renderer::is_border(int row, int column) const {
  const std::size_t k = index_of(row, column, radiance_.width);
  const auto width = static_cast<std::size_t>(radiance_.width);
  const std::uint16_t own = winners_[k];
  return (column > 0 && winners_[k - 1] != own) || (column + 1 < radiance_.width && winners_[k + 1] != own) ||
         (row > 0 && winners_[k - width] != own) ||
         (row + 1 < radiance_.height && winners_[k + width] != own);
}

void Renderer::shade_row(int row, const Pose& T_WC) {
  for (int column = 0; column < radiance_.width; ++column) {
    const std::size_t k = index_of(row, column, radiance_.width);
    radiance_.brightness[k] = shade_pixel(row, column, T_WC);
  }
}

float Renderer::shade_pixel(int row, int column, const Pose& T_WC) const {
  const std::size_t k = index_of(row, column, radiance_.width);
  // Neighbours towards the inside give the ray's step, so that the last row and column have one as well.
  const std::size_t beside = column + 1 < radiance_.width ? k + 1 : k - 1;
  const std::size_t below = row + 1 < radiance_.height ? k + static_cast<std::size_t>(radiance_.width)
                                                       : k - static_cast<std::size_t>(radiance_.width);
  const std::vector<float>& x = camera_.rays_x();
  const std::vector<float>& y = camera_.rays_y();
  const Eigen::Vector2f ray{x[k], y[k]};
  const Eigen::Vector2f step_x{std::abs(x[beside] - x[k]), y[beside] - y[k]};
  const Eigen::Vector2f step_y{x[below] - x[k], std::abs(y[below] - y[k])};
  if (!is_border(row, column)) return shade(winners_[k], ray, step_x, step_y, T_WC);
  const std::span<const std::uint16_t> candidates = candidates_at(row, column);
  float sum = 0.0F;
  // A rotated grid: four different columns and rows, better for near-vertical edges than a square one.
  constexpr std::array<std::array<float, 2>, 4> kParts{
      {{-0.375F, -0.125F}, {0.125F, -0.375F}, {0.375F, 0.125F}, {-0.125F, 0.375F}}};
  for (const auto& [dx, dy] : kParts) {
    const Eigen::Vector2f part = ray + dx * step_x + dy * step_y;
    sum += shade(cast(candidates, part), part, 0.5F * step_x, 0.5F * step_y, T_WC);
  }
  return 0.25F * sum;
}

std::uint16_t Renderer::cast(std::span<const std::uint16_t> candidates, const Eigen::Vector2f& ray) const {
  std::uint16_t winner = Radiance::kSky;
  float nearest = 0.0F;
  for (const std::uint16_t candidate : candidates) {
    const Plane& plane = planes_[candidate];
    const float w = dot(plane.inverse_z, ray);
    const float s = dot(plane.s_over_z, ray);
    const float t = dot(plane.t_over_z, ray);
    if (w <= nearest || s < 0.0F || s > w || t < 0.0F || t > w) continue;
    nearest = w;
    winner = candidate;
  }
  return winner;
}

float Renderer::shade(std::uint16_t visible, const Eigen::Vector2f& ray, const Eigen::Vector2f& step_x,
                      const Eigen::Vector2f& step_y, const Pose& T_WC) const {
  if (visible == Radiance::kSky) return kSkyBrightness;
  const Plane& plane = planes_[visible];
  const Quad& quad = quads_[visible_[visible]];
  const float z = 1.0F / dot(plane.inverse_z, ray);
  const float s = z * dot(plane.s_over_z, ray);
  const float t = z * dot(plane.t_over_z, ray);
  const float du = quad.u1 - quad.u0;
  const float dv = quad.v1 - quad.v0;
  // d(s/z / (1/z)): the quotient's derivative along a step of the ray.
  const auto change = [&](const Eigen::Vector3f& over_z, float value, const Eigen::Vector2f& step) {
    return z * ((over_z.x() - value * plane.inverse_z.x()) * step.x() +
                (over_z.y() - value * plane.inverse_z.y()) * step.y());
  };
  const Footprint footprint{du * change(plane.s_over_z, s, step_x), dv * change(plane.t_over_z, t, step_x),
                            du * change(plane.s_over_z, s, step_y), dv * change(plane.t_over_z, t, step_y)};
  const float own = quad.shade * quad.texture->sample(quad.u0 + s * du, quad.v0 + t * dv, footprint);
  if (quad.reflectivity <= 0.0F) return own;
  const Eigen::Vector3d p_C = static_cast<double>(z) * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
  return (1.0F - quad.reflectivity) * own + quad.reflectivity * reflection(quad, p_C, T_WC);
}

float Renderer::reflection(const Quad& mirror, const Eigen::Vector3d& p_C, const Pose& T_WC) const {
  const Eigen::Vector3d n = mirror.inward_normal().normalized();
  const Eigen::Vector3d incoming = (T_WC.q * p_C).normalized();
  const Eigen::Vector3d outgoing = incoming - 2.0 * n.dot(incoming) * n;
  const std::optional<Hit> hit = cast_ray(quads_, T_WC * p_C - 1e-6 * n, outgoing);
  if (!hit) return kSkyBrightness;
  const Quad& quad = quads_[hit->quad];
  // The pixel's width where the mirrored ray ends, as if it met the quad squarely.
  const double width = (p_C.norm() + hit->range) / camera_.calibration().fx;
  const auto du = static_cast<float>(width / quad.edge_s.norm()) * (quad.u1 - quad.u0);
  const auto dv = static_cast<float>(width / quad.edge_t.norm()) * (quad.v1 - quad.v0);
  return quad.shade * quad.texture->sample(quad.u0 + static_cast<float>(hit->s) * (quad.u1 - quad.u0),
                                           quad.v0 + static_cast<float>(hit->t) * (quad.v1 - quad.v0),
                                           {du, 0.0F, 0.0F, dv});
}

}  // namespace cosight::sim
