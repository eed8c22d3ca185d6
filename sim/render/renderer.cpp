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
  constexpr int kSameFilter = 8;  // [px] over which the footprint hardly changes
  std::uint16_t last = Radiance::kSky;
  Texture::Filter filter;
  for (int column = 0; column < radiance_.width; ++column) {
    const std::size_t k = index_of(row, column, radiance_.width);
    const Eigen::Vector2f ray{camera_.rays_x()[k], camera_.rays_y()[k]};
    if (is_border(row, column)) {
      radiance_.brightness[k] = shade_border(row, column, T_WC);
      continue;
    }
    if (winners_[k] != last || column % kSameFilter == 0) {
      last = winners_[k];
      filter = filter_at(last, ray, ray_step(row, column));
    }
    radiance_.brightness[k] = shade(last, ray, filter, T_WC);
  }
}

Renderer::RayStep Renderer::ray_step(int row, int column) const {
  // The last column and row take the step of the one before.
  const std::size_t k =
      index_of(std::min(row, radiance_.height - 2), std::min(column, radiance_.width - 2), radiance_.width);
  const auto width = static_cast<std::size_t>(radiance_.width);
  const std::vector<float>& x = camera_.rays_x();
  const std::vector<float>& y = camera_.rays_y();
  return {{x[k + 1] - x[k], y[k + 1] - y[k]}, {x[k + width] - x[k], y[k + width] - y[k]}};
}

float Renderer::shade_border(int row, int column, const Pose& T_WC) const {
  const std::size_t k = index_of(row, column, radiance_.width);
  const Eigen::Vector2f ray{camera_.rays_x()[k], camera_.rays_y()[k]};
  const RayStep step = ray_step(row, column);
  const RayStep half_step{0.5F * step.right, 0.5F * step.down};
  const std::span<const std::uint16_t> candidates = candidates_at(row, column);
  // A rotated grid: four different columns and rows, better for near-vertical edges than a square one.
  constexpr std::array<std::array<float, 2>, 4> kParts{
      {{-0.375F, -0.125F}, {0.125F, -0.375F}, {0.375F, 0.125F}, {-0.125F, 0.375F}}};
  float sum = 0.0F;
  for (const auto& [dx, dy] : kParts) {
    const Eigen::Vector2f part = ray + dx * step.right + dy * step.down;
    const std::uint16_t winner = cast(candidates, part);
    sum += shade(winner, part, filter_at(winner, part, half_step), T_WC);
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

Texture::Filter Renderer::filter_at(std::uint16_t visible, const Eigen::Vector2f& ray,
                                    const RayStep& step) const {
  if (visible == Radiance::kSky) return {};
  const Plane& plane = planes_[visible];
  const Quad& quad = quads_[visible_[visible]];
  const float z = 1.0F / dot(plane.inverse_z, ray);
  // Quotient rule on (s/z) / (1/z), along a step of the ray.
  const Eigen::Vector3f ds = z * (plane.s_over_z - z * dot(plane.s_over_z, ray) * plane.inverse_z);
  const Eigen::Vector3f dt = z * (plane.t_over_z - z * dot(plane.t_over_z, ray) * plane.inverse_z);
  const Eigen::Vector2f du = (quad.u1 - quad.u0) * ds.head<2>();
  const Eigen::Vector2f dv = (quad.v1 - quad.v0) * dt.head<2>();
  return quad.texture->filter_for(
      {du.dot(step.right), dv.dot(step.right), du.dot(step.down), dv.dot(step.down)});
}

float Renderer::shade(std::uint16_t visible, const Eigen::Vector2f& ray, const Texture::Filter& filter,
                      const Pose& T_WC) const {
  if (visible == Radiance::kSky) return kSkyBrightness;
  const Plane& plane = planes_[visible];
  const Quad& quad = quads_[visible_[visible]];
  const float z = 1.0F / dot(plane.inverse_z, ray);
  const float s = z * dot(plane.s_over_z, ray);
  const float t = z * dot(plane.t_over_z, ray);
  const float own = quad.shade * quad.texture->sample(quad.u0 + s * (quad.u1 - quad.u0),
                                                      quad.v0 + t * (quad.v1 - quad.v0), filter);
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
  const float u = quad.u0 + static_cast<float>(hit->s) * (quad.u1 - quad.u0);
  const float v = quad.v0 + static_cast<float>(hit->t) * (quad.v1 - quad.v0);
  return quad.shade * quad.texture->sample(u, v, quad.texture->filter_for({du, 0.0F, 0.0F, dv}));
}

}  // namespace cosight::sim
