#include "robot_agent/map/map_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cosight::map {
namespace {

using ::testing::ElementsAre;

MapPoint good_point(std::uint64_t id, double x = 0.0) {
  MapPoint point;
  point.id = id;
  point.p_W = {x, 0.0, 1.0};
  point.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  point.observations = 10;
  return point;
}

std::vector<std::uint64_t> ids_of(const MapArchive& archive) {
  std::vector<std::uint64_t> ids;
  for (const MapPoint& point : archive.points())
    ids.push_back(point.id);
  return ids;
}

TEST(MapArchive, KeepsALandmarkAfterItLeftTheFilter) {
  MapArchive archive;
  archive.update(std::vector{good_point(7), good_point(3)});
  archive.update(std::vector{good_point(7, 2.0)});
  const auto points = archive.points();
  ASSERT_THAT(ids_of(archive), ElementsAre(3, 7));
  EXPECT_FALSE(points[0].in_filter);
  EXPECT_TRUE(points[1].in_filter);
  EXPECT_EQ(points[1].p_W.x(), 2.0);
}

TEST(MapArchive, ALandmarkThatComesBackIsInTheFilterAgain) {
  MapArchive archive;
  archive.update(std::vector{good_point(1)});
  archive.update({});
  EXPECT_FALSE(archive.points()[0].in_filter);
  archive.update(std::vector{good_point(1)});
  EXPECT_TRUE(archive.points()[0].in_filter);
}

TEST(MapArchive, WaitsUntilALandmarkIsGood) {
  MapArchive archive;
  MapPoint seldom = good_point(1);
  seldom.observations = 3;
  MapPoint vague = good_point(2);
  vague.covariance(2, 2) = 1.0;
  MapPoint broken = good_point(3);
  broken.p_W.x() = std::numeric_limits<double>::quiet_NaN();
  archive.update(std::vector{seldom, vague, broken});
  EXPECT_EQ(archive.size(), 0U);
  archive.update(std::vector{good_point(1), vague, broken});
  EXPECT_THAT(ids_of(archive), ElementsAre(1));
}

TEST(MapArchive, AWrongLandmarkLeavesTheMap) {
  MapArchive archive;
  archive.update(std::vector{good_point(1), good_point(2)});
  archive.remove(1);
  archive.update(std::vector{good_point(2)});
  EXPECT_THAT(ids_of(archive), ElementsAre(2));
}

TEST(MapArchive, CountsWhatAFullMapLeavesOut) {
  MapArchive archive({.max_points = 1});
  archive.update(std::vector{good_point(1), good_point(2)});
  EXPECT_THAT(ids_of(archive), ElementsAre(1));
  EXPECT_EQ(archive.left_out(), 1U);
}

TEST(MapArchive, SigmaIsThatOfTheWorstAxis) {
  MapPoint point;
  point.covariance << 2.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 0.5;  // eigenvalues 3, 1, 0.5
  EXPECT_NEAR(worst_sigma(point), std::sqrt(3.0), 1e-12);
}

}  // namespace
}  // namespace cosight::map
