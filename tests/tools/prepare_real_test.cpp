// Checks the geometry of prepared real sequences where the data is at hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/tools/scratch_folder.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight {
namespace {

std::filesystem::path data_folder() {
  const char* named = std::getenv("COSIGHT_DATA");  // NOLINT(concurrency-mt-unsafe)
  return named != nullptr ? std::filesystem::path(named)
                          : std::filesystem::path(COSIGHT_SOURCE_DIR) / ".." / "shared" / "data";
}

class PreparedRealSequence : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(data_folder() / "kitti00")) GTEST_SKIP() << "no real data; set COSIGHT_DATA";
  }
};

TEST_F(PreparedRealSequence, TagboxCornersFallOnTheirPixels) {
  const RealSequence sequence = read_tagbox(data_folder() / "tagbox");
  ASSERT_EQ(sequence.robot_images.size(), 210U);
  ASSERT_EQ(sequence.known_points.size(), 12U);
  double squares = 0.0;
  for (const KnownPoint& point : sequence.known_points) {
    const auto pixel = sequence.robot_camera.project(sequence.robot_images[0].T_WC->inverse() * point.p_W);
    squares += (pixel.value() - point.pixel.value()).squaredNorm() / 12.0;
  }
  EXPECT_LT(std::sqrt(squares), 1.5);
}

TEST_F(PreparedRealSequence, KittiDrivesAheadAlongXWithZUp) {
  const RealSequence sequence = read_kitti(data_folder() / "kitti00");
  ASSERT_EQ(sequence.robot_images.size(), 100U);
  ASSERT_EQ(sequence.wearer_images.size(), 100U);
  const Pose first = *sequence.robot_images.front().T_WC;
  EXPECT_LT((first.q * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-9) << "looks along x";
  EXPECT_LT((first.q * -Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(), 1e-9) << "up is z";
  const Eigen::Vector3d step = sequence.robot_images[1].T_WC->p - first.p;
  EXPECT_GT(step.x(), 0.8);
  EXPECT_LT(step.tail<2>().norm(), 0.1);
}

TEST_F(PreparedRealSequence, KittiRightCameraLooksAlongTheSameRows) {
  const RealSequence sequence = read_kitti(data_folder() / "kitti00");
  for (std::size_t i = 0; i < sequence.robot_images.size(); ++i) {
    const Pose T_SF = sequence.robot_images[i].T_WC->inverse() * *sequence.wearer_images[i].T_WC;
    EXPECT_LT((T_SF.p - Eigen::Vector3d(0.5371657, 0, 0)).norm(), 1e-9);
    EXPECT_LT(T_SF.q.angularDistance(Eigen::Quaterniond::Identity()), 1e-7);
  }
}

TEST_F(PreparedRealSequence, EurocOffersViewsAtTheirNearestFrames) {
  const ScratchFolder folder("euroc");
  const RealSequence sequence =
      read_euroc(data_folder() / "euroc_v101_flight", data_folder() / "euroc_v101_views", folder.path());
  EXPECT_EQ(sequence.robot_images.size(), 90U);
  EXPECT_EQ(sequence.wearer_images.size(), 57U) << "60 views, three of which are flight frames themselves";
  for (std::size_t i = 1; i < sequence.wearer_images.size(); ++i) {
    EXPECT_GT(sequence.wearer_images[i].stamp, sequence.wearer_images[i - 1].stamp) << "one view a frame";
  }
  const Pose T_SF = sequence.robot_images[0].T_WC->inverse() * *sequence.wearer_images[0].T_WC;
  EXPECT_EQ(sequence.wearer_images[0].stamp, sequence.robot_images[0].stamp);
  EXPECT_LT(T_SF.p.norm(), 0.2);
}

TEST_F(PreparedRealSequence, ScenelibCornersFallInsideTheImage) {
  const RealSequence sequence = read_scenelib(data_folder() / "scenelib");
  ASSERT_EQ(sequence.known_points.size(), 4U);
  for (const KnownPoint& point : sequence.known_points) {
    EXPECT_TRUE(sequence.robot_camera.contains(point.pixel.value()));
  }
  // Measured by eye in the first image: the dark card's upper left corner.
  EXPECT_LT((sequence.known_points[0].pixel.value() - Eigen::Vector2d(120.0, 113.0)).norm(), 3.0);
}

TEST_F(PreparedRealSequence, TelloFliesAheadOfItsCamera) {
  const RealSequence sequence = read_tello(data_folder() / "tello_line");
  ASSERT_EQ(sequence.robot_images.size(), 211U);
  std::vector<Pose> poses;
  for (const RecordedImage& image : sequence.robot_images) {
    if (image.T_WC) poses.push_back(*image.T_WC);
  }
  ASSERT_GT(poses.size(), 150U);
  const Eigen::Vector3d way = poses.front().q.conjugate() * (poses.back().p - poses.front().p);
  EXPECT_GT(way.normalized().z(), 0.9);
}

}  // namespace
}  // namespace cosight
