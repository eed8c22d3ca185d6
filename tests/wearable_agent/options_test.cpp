#include "wearable_agent/options.hpp"

#include <gtest/gtest.h>

#include "tests/shared/config/described_defaults.hpp"

namespace cosight::wearable {
namespace {

WearableOptions read(const ConfigFile& file) {
  WearableOptions options = read_wearable_options(file.root());
  file.refuse_unknown_keys();
  return options;
}

TEST(WearableOptionsTest, TheCommentedFileHasEveryKeyWithItsDefault) {
  expect_describes_defaults("wearable.yaml", read_wearable_options, "input.dataset=folder", {});
}

TEST(WearableOptionsTest, ReadsWhatTheFileSays) {
  const WearableOptions options = read(ConfigFile::parse(
      "agent_id: anna\ninput: {video: a.mp4, gate: '0:1', encoding: png}\nreplay: {rate: 0.5, loop: true}\n"
      "dds: {domain: 7, interfaces: [lo], peers: [10.0.0.1]}\nstart: {wait_for_robot: 20}\n",
      "a.yaml"));
  EXPECT_EQ(options.agent_id, "anna");
  EXPECT_EQ(options.input.video, "a.mp4");
  EXPECT_EQ(options.input.gate.size(), 1U);
  EXPECT_EQ(options.input.output.encoding, ImageEncoding::kPng);
  EXPECT_DOUBLE_EQ(options.replay.rate, 0.5);
  EXPECT_TRUE(options.replay.loop);
  EXPECT_EQ(options.dds.domain, 7);
  EXPECT_EQ(options.dds.interfaces, std::vector<std::string>{"lo"});
  EXPECT_EQ(options.dds.peers, std::vector<std::string>{"10.0.0.1"});
  EXPECT_DOUBLE_EQ(options.wait_for_robot, 20.0);
}

}  // namespace
}  // namespace cosight::wearable
