#include "robot_agent/slam/map_maintenance.hpp"

#include <gtest/gtest.h>

namespace cosight::slam {
namespace {

/// A filter with landmarks in front of the camera, each with a track.
class Maintenance : public testing::Test {
 protected:
  Maintenance() : filter_(CameraModel{}, ekf::FilterOptions{}) { options_.max_landmarks = 6; }

  ekf::LandmarkId add(int frames_unseen = 0) {
    const double x = 0.2 * filter_.landmark_count();
    LandmarkTrack track;
    track.id = *filter_.add_known_point({x, 0.0, 3.0}, 1e-4 * Eigen::Matrix3d::Identity());
    track.found = frames_unseen == 0;
    track.frames_unseen = frames_unseen;
    track.observations = 10;
    tracks_.add(track);
    return track.id;
  }
  void lose_all() {
    for (LandmarkTrack& track : tracks_.all())
      track.found = false;
  }

  MapOptions options_;
  ekf::Filter filter_;
  LandmarkTracks tracks_;
};

TEST_F(Maintenance, MakesRoomByThoseOutOfViewTheLongest) {
  const auto seen = add();
  const auto recently = add(3);
  const auto longest = add(9);
  const auto long_ago = add(7);
  const auto also_seen = add();
  const auto missed_once = add(1);
  const MapMaintenance maintenance(options_);
  EXPECT_EQ(maintenance.make_room(filter_, tracks_, 1), 1);
  EXPECT_FALSE(filter_.contains(longest));
  EXPECT_EQ(filter_.landmark_count(), 5);
  EXPECT_EQ(maintenance.make_room(filter_, tracks_, 2), 2);
  EXPECT_FALSE(filter_.contains(long_ago));
  EXPECT_TRUE(filter_.contains(recently));
  // What is in view, or was missed once only, stays however much is wanted.
  EXPECT_EQ(maintenance.make_room(filter_, tracks_, 10), 3);
  for (const auto id : {seen, also_seen, missed_once}) {
    EXPECT_TRUE(filter_.contains(id));
    EXPECT_NE(tracks_.find(id), nullptr);
  }
  EXPECT_EQ(tracks_.all().size(), 3U);
}

TEST_F(Maintenance, TakesNoneAwayWhenThereIsRoom) {
  add(9);
  const MapMaintenance maintenance(options_);
  EXPECT_EQ(maintenance.make_room(filter_, tracks_, 3), 3);
  EXPECT_EQ(filter_.landmark_count(), 1);
  EXPECT_EQ(maintenance.make_room(filter_, tracks_, 0), 0);
}

TEST_F(Maintenance, ForgetsWhatIsUnseenForLongAndKeepsItInTheMap) {
  const auto id = add();
  MapMaintenance maintenance(options_);
  EXPECT_EQ(maintenance.tidy(filter_, tracks_), 0);
  lose_all();
  for (int frame = 0; frame < options_.forget_after_frames; ++frame)
    EXPECT_EQ(maintenance.tidy(filter_, tracks_), 0) << frame;
  EXPECT_EQ(maintenance.tidy(filter_, tracks_), 1);
  EXPECT_FALSE(filter_.contains(id));
  EXPECT_EQ(tracks_.find(id), nullptr);
  maintenance.tidy(filter_, tracks_);
  const auto map = maintenance.map();
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map[0].id, id);
  EXPECT_FALSE(map[0].in_filter);
}

TEST_F(Maintenance, ASightingStartsTheCountAnew) {
  const auto id = add(10);
  tracks_.find(id)->found = true;
  MapMaintenance maintenance(options_);
  maintenance.tidy(filter_, tracks_);
  EXPECT_EQ(tracks_.find(id)->frames_unseen, 0);
}

TEST_F(Maintenance, WhatFailsTooOftenLeavesFilterAndMap) {
  const auto good = add();
  const auto bad = add();
  MapMaintenance maintenance(options_);
  maintenance.tidy(filter_, tracks_);
  EXPECT_EQ(maintenance.map().size(), 2U);
  LandmarkTrack* track = tracks_.find(bad);
  track->attempts = options_.min_attempts - 1;
  track->failures = track->attempts;
  EXPECT_EQ(maintenance.tidy(filter_, tracks_), 0) << "too few attempts to judge";
  ++track->attempts;
  EXPECT_EQ(maintenance.tidy(filter_, tracks_), 1);
  EXPECT_TRUE(filter_.contains(good));
  EXPECT_FALSE(filter_.contains(bad));
  const auto map = maintenance.map();
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map[0].id, good);
}

}  // namespace
}  // namespace cosight::slam
