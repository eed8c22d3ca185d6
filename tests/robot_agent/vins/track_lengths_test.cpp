#include "robot_agent/vins/track_lengths.hpp"

#include <gtest/gtest.h>

namespace cosight::vins {
namespace {

FeatureFrame frame_of(std::initializer_list<FeatureId> ids) {
  FeatureFrame frame;
  for (const FeatureId id : ids)
    frame.features.push_back({.id = id, .sighting = {}});
  return frame;
}

TEST(TrackLengths, CountSightingsOfFeaturesLostBeforeTheTenth) {
  TrackLengths lengths;
  for (int k = 0; k < 9; ++k)
    lengths.add(frame_of({1, 2}));
  lengths.add(frame_of({2}));  // 1 is lost after nine, 2 goes on
  lengths.add(frame_of({}));
  EXPECT_EQ(lengths.sightings(), 19U);
  EXPECT_EQ(lengths.outlier_sightings(), 9U);
}

TEST(TrackLengths, DoNotYetJudgeWhatIsStillFollowed) {
  TrackLengths lengths;
  lengths.add(frame_of({1}));
  EXPECT_EQ(lengths.outlier_sightings(), 0U);
}

}  // namespace
}  // namespace cosight::vins
