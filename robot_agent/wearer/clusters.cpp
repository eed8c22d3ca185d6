#include "robot_agent/wearer/clusters.hpp"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <limits>

namespace cosight::wearer {

std::vector<std::vector<ScanPoint>> clusters(const std::vector<ScanPoint>& points, double gap) {
  if (points.empty()) return {};
  const Eigen::Vector2d near = points.front().p_O;  // floats far from O's origin would lose digits
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const ScanPoint& point : points) {
    const Eigen::Vector2f p = (point.p_O - near).cast<float>();
    cloud.push_back({p.x(), p.y(), 0.0F});
  }
  const auto shared = cloud.makeShared();
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(shared);
  std::vector<pcl::PointIndices> groups;
  pcl::extractEuclideanClusters<pcl::PointXYZ>(*shared, tree, static_cast<float>(gap), groups, 1,
                                               std::numeric_limits<unsigned>::max());
  std::vector<std::vector<ScanPoint>> result;
  for (pcl::PointIndices& group : groups) {
    std::sort(group.indices.begin(), group.indices.end());
    std::vector<ScanPoint>& cluster = result.emplace_back();
    for (const auto index : group.indices)
      cluster.push_back(points[static_cast<std::size_t>(index)]);
  }
  std::sort(result.begin(), result.end(),
            [](const auto& a, const auto& b) { return a.front().ray < b.front().ray; });
  return result;
}

}  // namespace cosight::wearer
