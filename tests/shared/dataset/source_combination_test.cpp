#include <gmock/gmock.h>

#include "shared/dataset/gated_source.hpp"
#include "shared/dataset/merged_source.hpp"
#include "tests/shared/dataset/memory_source.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;

TEST(MergedSource, GivesSamplesInTheOrderOfTheirStamps) {
  std::vector<std::unique_ptr<SampleSource>> sources;
  sources.push_back(orientations({5, 10, 20}));
  sources.push_back(images({0, 10, 30}));
  MergedSource merged(std::move(sources));
  const auto samples = all_of(merged);
  EXPECT_THAT(stamps_of(samples), ElementsAre(0, 5, 10, 10, 20, 30));
  EXPECT_EQ(kind_of(samples[2]), SampleKind::kAhrs) << "of equal stamps the earlier source comes first";
  EXPECT_EQ(merged.counters(SampleKind::kImage).delivered, 3U);
  EXPECT_EQ(merged.counters(SampleKind::kAhrs).delivered, 3U);
  EXPECT_EQ(merged.counters(SampleKind::kWearerPose).delivered, 0U);
}

TEST(MergedSource, CountsOnlyWhatItHasHandedOn) {
  std::vector<std::unique_ptr<SampleSource>> sources;
  sources.push_back(images({0, 10, 30}));
  MergedSource merged(std::move(sources));
  EXPECT_EQ(merged.counters().delivered, 0U);
  merged.next();
  EXPECT_EQ(merged.counters().delivered, 1U);
}

TEST(GatedSource, HoldsImagesBackOutsideItsIntervalsAndNothingElse) {
  std::vector<std::unique_ptr<SampleSource>> sources;
  const Stamp second = kNanosecondsPerSecond;
  sources.push_back(orientations({0, 7 * second + 1}));
  sources.push_back(images({5 * second, 6 * second, 7 * second, 8 * second, 9 * second}));
  GatedSource gated(std::make_unique<MergedSource>(std::move(sources)), {{0.0, 1.0}, {3.0, 9.0}});
  const auto samples = all_of(gated);
  EXPECT_THAT(stamps_of(samples), ElementsAre(0, 5 * second, 7 * second + 1, 8 * second, 9 * second));
  EXPECT_THAT(sequences_of(samples), ElementsAre(0, 1, 2)) << "held back is not lost";
  EXPECT_EQ(gated.counters(SampleKind::kImage).delivered, 3U);
  EXPECT_EQ(gated.counters(SampleKind::kAhrs).delivered, 2U);
}

TEST(GatedSource, IntervalsAreReadFromText) {
  const auto intervals = parse_intervals("0:1.5,3:4.2");
  ASSERT_TRUE(intervals);
  ASSERT_EQ(intervals->size(), 2U);
  EXPECT_DOUBLE_EQ((*intervals)[0].to, 1.5);
  EXPECT_DOUBLE_EQ((*intervals)[1].from, 3.0);
  EXPECT_TRUE(parse_intervals("")->empty());
  for (const char* text : {"1", "1:", ":1", "2:1", "1:1", "a:b", "0:1;2:3", "0:nan"}) {
    EXPECT_FALSE(parse_intervals(text)) << text;
  }
}

}  // namespace
}  // namespace cosight
