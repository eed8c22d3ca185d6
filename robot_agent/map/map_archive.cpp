#include "robot_agent/map/map_archive.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cosight::map {

double worst_sigma(const MapPoint& point) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(point.covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(solver.eigenvalues().maxCoeff(), 0.0));
}

void MapArchive::update(std::span<const MapPoint> in_filter) {
  std::vector<std::uint64_t> ids;
  ids.reserve(in_filter.size());
  for (const MapPoint& point : in_filter) {
    ids.push_back(point.id);
    const auto known = points_.find(point.id);
    if (known != points_.end()) {
      known->second = point;
      known->second.in_filter = true;
    } else if (is_good(point)) {
      if (points_.size() < options_.max_points) {
        points_.emplace(point.id, point);
      } else {
        ++left_out_;
      }
    }
  }
  std::sort(ids.begin(), ids.end());
  for (const std::uint64_t id : in_filter_) {
    if (std::binary_search(ids.begin(), ids.end(), id)) continue;
    const auto left = points_.find(id);
    if (left != points_.end()) left->second.in_filter = false;
  }
  in_filter_ = std::move(ids);
}

std::vector<MapPoint> MapArchive::points() const {
  std::vector<MapPoint> points;
  points.reserve(points_.size());
  for (const auto& [id, point] : points_)
    points.push_back(point);
  return points;
}

bool MapArchive::is_good(const MapPoint& point) const {
  return point.observations >= options_.min_observations && point.p_W.allFinite() &&
         point.covariance.allFinite() && worst_sigma(point) <= options_.max_sigma;
}

}  // namespace cosight::map
