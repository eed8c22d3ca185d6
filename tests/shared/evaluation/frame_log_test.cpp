#include "shared/evaluation/frame_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/evaluation/evaluation_error.hpp"
#include "tests/shared/evaluation/text_file.hpp"

namespace cosight {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(FrameLog, IsReadByTheNamesOfItsColumns) {
  const TextFile file("frames",
                      "total_ms,overlap,stamp_ns,fused,initialised,tracking,landmarks\n"
                      "4.5,1,100,0,2,tracking,31\n9,0,200,0,0,lost,30\n");
  const std::vector<FrameRecord> frames = read_frame_log(file.path());
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].stamp, 100);
  EXPECT_TRUE(frames[0].pseudo_stereo);
  EXPECT_FALSE(frames[0].lost);
  EXPECT_EQ(frames[0].landmarks, 31.0);
  EXPECT_EQ(frames[0].total_ms, 4.5);
  EXPECT_FALSE(frames[1].pseudo_stereo);
  EXPECT_TRUE(frames[1].lost);
}

TEST(FrameLog, DropsALastLineThatAKillCutShort) {
  const TextFile file("frames_cut", "stamp_ns,overlap\n100,1\n20");
  EXPECT_EQ(read_frame_log(file.path()).size(), 1U);
}

TEST(FrameLog, RefusesAShortLineInTheMiddle) {
  const TextFile file("frames_short", "stamp_ns,overlap\n100\n200,1\n");
  EXPECT_THAT([&] { read_frame_log(file.path()); },
              ThrowsMessage<EvaluationError>(HasSubstr(file.path().string() + ":2: has 1 columns")));
}

TEST(FrameLog, RefusesNaNAndMissingStamps) {
  const TextFile nan("frames_nan", "stamp_ns,landmarks\n100,nan\n");
  EXPECT_THAT([&] { read_frame_log(nan.path()); },
              ThrowsMessage<EvaluationError>(HasSubstr(":2: landmarks: 'nan'")));
  const TextFile none("frames_none", "time,overlap\n100,1\n");
  EXPECT_THAT([&] { read_frame_log(none.path()); },
              ThrowsMessage<EvaluationError>(HasSubstr("no column 'stamp_ns'")));
}

}  // namespace
}  // namespace cosight
