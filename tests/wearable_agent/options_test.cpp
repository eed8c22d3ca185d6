#include "wearable_agent/options.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

namespace cosight::wearable {
namespace {

WearableOptions read(const ConfigFile& file) {
  WearableOptions options = read_wearable_options(file.root());
  file.refuse_unknown_keys();
  return options;
}

/// Every key with its value, in any order.
std::multiset<std::string> lines_of(const std::string& text) {
  std::multiset<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.insert(line);
  return lines;
}

TEST(WearableOptionsTest, TheCommentedFileSaysExactlyTheDefaults) {
  const ConfigOverride dataset{"input.dataset", "/data", "--dataset", true};
  const ConfigFile empty = ConfigFile::parse("", "empty", {dataset});
  const ConfigFile commented = ConfigFile::load(COSIGHT_SOURCE_DIR "/config/wearable.yaml", {dataset});
  read(empty);
  read(commented);
  EXPECT_EQ(lines_of(commented.resolved()), lines_of(empty.resolved()));
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
