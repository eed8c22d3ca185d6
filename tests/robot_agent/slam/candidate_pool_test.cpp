#include "robot_agent/slam/candidate_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "robot_agent/slam/collaborative_slam.hpp"
#include "tests/robot_agent/slam/two_camera_world.hpp"

namespace cosight::slam {
namespace {

const TwoCameraWorld& world() {
  return TwoCameraWorld::instance();
}

/// A pool that is told where the camera is: the filter's mean is put onto the truth in every frame.
class Pool : public testing::TestWithParam<FirstPose> {
 protected:
  Pool() : filter_(world().camera(), filter_options()), pool_(candidate_options(), 0.5) {
    UncertainPose T_WS;
    T_WS.T = world().T_WS(0);
    T_WS.covariance = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
    filter_.reset(T_WS, 0.1, 0.1);
  }

  static ekf::FilterOptions filter_options() {
    ekf::FilterOptions options;
    options.max_clones = 14;
    return options;
  }
  static CandidateOptions candidate_options() {
    CandidateOptions options;
    options.first_pose = GetParam();
    return options;
  }

  void see(int frame, bool move = true) {
    const int place = move ? frame : 0;
    ekf::CameraState x = filter_.camera();
    x.r_WS = world().T_WS(place).p;
    x.q_WS = world().T_WS(place).q;
    filter_.recentre_camera(x);
    const GrayImage& image = *world().bundle(place).image;
    tracker_.advance(image);
    pool_.track(tracker_, filter_, 5.0, {});
    started_ += pool_.initialise(filter_, tracks_, 60, 20);
    pool_.detect(image, filter_, corners_, tracks_.found_pixels(), {}, 40);
  }
  int clones_and_camera_dim() const { return filter_.state().size() - 6 * filter_.landmark_count(); }

  ekf::Filter filter_;
  CandidatePool pool_;
  LandmarkTracks tracks_;
  vision::PointTracker tracker_;
  vision::CornerDetector corners_;
  int started_ = 0;
};

TEST_P(Pool, StartsLandmarksOnceTheyHaveParallaxAndNotBefore) {
  for (int frame = 0; frame < 6; ++frame)
    see(frame, false);
  EXPECT_GT(pool_.size(), 10);
  EXPECT_EQ(started_, 0) << "the camera stood still";
  for (int frame = 0; frame < 15; ++frame)
    see(frame);
  EXPECT_GT(started_, 5);
  EXPECT_EQ(started_, filter_.landmark_count());
  EXPECT_EQ(static_cast<std::size_t>(started_), tracks_.all().size());
}

TEST_P(Pool, PutsLandmarksWhereTheWorldIs) {
  for (int frame = 0; frame < 20; ++frame)
    see(frame);
  ASSERT_GT(filter_.landmark_count(), 5);
  int inside = 0;
  for (const LandmarkTrack& track : tracks_.all()) {
    const Eigen::Vector3d p_W = filter_.landmark(track.id)->p_W;
    const Eigen::Vector3d low(-2.5, -2.6, -0.4);
    const Eigen::Vector3d high(8.5, 2.8, 3.1);
    inside += (p_W.array() > low.array()).all() && (p_W.array() < high.array()).all();
  }
  EXPECT_GE(inside, static_cast<int>(0.8 * filter_.landmark_count()));
}

TEST_P(Pool, KeepsACloneForEachDetectionInUseAndNoneAfterClear) {
  for (int frame = 0; frame < 30; ++frame) {
    see(frame);
    const int clones = (clones_and_camera_dim() - ekf::CameraState::kDim) / ekf::CameraState::kPoseDim;
    EXPECT_LE(clones, 12) << frame;
    std::vector<ekf::CloneId> used;
    for (const Candidate& candidate : pool_.all()) {
      if (!candidate.clone) continue;
      EXPECT_TRUE(filter_.clone(*candidate.clone)) << frame;
      if (std::find(used.begin(), used.end(), *candidate.clone) == used.end())
        used.push_back(*candidate.clone);
    }
    EXPECT_EQ(clones, static_cast<int>(used.size())) << frame;
  }
  pool_.clear(filter_);
  EXPECT_EQ(pool_.size(), 0);
  EXPECT_EQ(clones_and_camera_dim(), ekf::CameraState::kDim);
}

INSTANTIATE_TEST_SUITE_P(FirstPoses, Pool, testing::Values(FirstPose::kStored, FirstPose::kCloned));

TEST(CandidatePool, LooksForNothingWhereTheWearerHidesTheScene) {
  ekf::FilterOptions options;
  options.max_clones = 14;
  ekf::Filter filter(world().camera(), options);
  CandidatePool pool({}, 0.5);
  const ConvexPolygon left_half{{0.0, 0.0}, {160.0, 0.0}, {160.0, 239.0}, {0.0, 239.0}};
  pool.detect(*world().bundle(0).image, filter, vision::CornerDetector(), {}, left_half, 40);
  EXPECT_GT(pool.size(), 5);
  for (const Candidate& candidate : pool.all())
    EXPECT_GT(candidate.pixel.x(), 160.0);
}

TEST(CandidatePool, ClonesDoNotLeakOverALongRunOfTheWholeFilter) {
  CollaborativeSlam slam(world().camera(), world().options());
  for (int frame = 0; frame < TwoCameraWorld::kFrames; ++frame) {
    slam.process(frame < 4 ? world().bundle(frame) : world().without_wearer(frame));
    const ekf::Filter& filter = slam.filter();
    const int clones = (filter.state().size() - ekf::CameraState::kDim - 6 * filter.landmark_count()) /
                       ekf::CameraState::kPoseDim;
    EXPECT_LE(clones, frame / world().options().candidates.keyframe_interval + 1) << frame;
  }
}

}  // namespace
}  // namespace cosight::slam
