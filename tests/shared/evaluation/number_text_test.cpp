#include "shared/dataset/number_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cosight {
namespace {

TEST(NumberText, SecondsKeepEveryNanosecondOfATimeSinceTheEpoch) {
  EXPECT_EQ(parse_seconds("1403715285.262143135"), 1403715285262143135);
  EXPECT_EQ(parse_seconds("1403715285.5"), 1403715285500000000);
  EXPECT_EQ(parse_seconds("-0.000000001"), -1);
  EXPECT_EQ(parse_seconds(".5"), 500000000);
  EXPECT_EQ(parse_seconds("12"), 12000000000);
}

TEST(NumberText, SecondsWithAnExponentAreReadToo) {
  EXPECT_EQ(parse_seconds("1.037359e-01"), 103735900);
  EXPECT_EQ(parse_seconds("0.000000e+00"), 0);
}

TEST(NumberText, WhatIsNoFiniteNumberIsRefused) {
  for (const char* text : {"", "nan", "-nan", "inf", "1.2x", "one", "1,2", "--1"}) {
    EXPECT_FALSE(parse_number(text).has_value()) << text;
    EXPECT_FALSE(parse_seconds(text).has_value()) << text;
  }
  EXPECT_FALSE(parse_seconds("1e30").has_value()) << "beyond a 64-bit count of nanoseconds";
  EXPECT_FALSE(parse_nanoseconds("1.5").has_value());
}

TEST(NumberText, SecondsAreWrittenAsTheyAreRead) {
  for (const Stamp stamp : {Stamp{0}, Stamp{1}, Stamp{-1'500'000'000}, Stamp{1403715285262143135}}) {
    EXPECT_EQ(parse_seconds(seconds_text(stamp)), stamp);
  }
}

TEST(NumberText, EmptyCellsBetweenCommasStay) {
  EXPECT_THAT(split_at_commas(" a, ,b,"), testing::ElementsAre("a", "", "b", ""));
  EXPECT_THAT(split_at_blanks("  a \t b\r"), testing::ElementsAre("a", "b"));
}

}  // namespace
}  // namespace cosight
