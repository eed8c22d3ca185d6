#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "tests/shared/transport/inbox_of.hpp"
#include "tests/wearable_agent/small_dataset.hpp"

namespace cosight::wearable {
namespace {

using testing::HasSubstr;

struct Ending {
  int status = -1;
  std::string output;  ///< both streams
};

Ending run(const std::string& arguments) {
  const std::string command = std::string(WEARABLE_AGENT) + " " + arguments + " 2>&1";
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  Ending ending;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr)
    ending.output += buffer.data();
  ending.status = WEXITSTATUS(::pclose(pipe));
  return ending;
}

std::string on_own_domain() {
  return " --domain " + std::to_string(transport::own_domain()) + " --set dds.interfaces=[lo] --rate 0" +
         " --set start.listen_for_twin=0";
}

TEST(WearableProgram, HelpNamesEveryOptionAndShowsExamples) {
  const Ending ending = run("--help");
  EXPECT_EQ(ending.status, 0);
  for (const char* option : {"--dataset", "--rate", "--loop", "--domain", "--encoding", "--quality",
                             "--wait-for-robot", "--gate", "--config", "--set", "Examples:"}) {
    EXPECT_THAT(ending.output, HasSubstr(option));
  }
}

TEST(WearableProgram, EndsWithZeroAfterAWholeDataset) {
  const SmallDataset dataset;
  const auto summary = dataset.folder() / "summary.yaml";
  const Ending ending =
      run("--dataset " + dataset.folder().string() + on_own_domain() + " --summary " + summary.string());
  EXPECT_EQ(ending.status, 0) << ending.output;
  EXPECT_THAT(ending.output, HasSubstr("frames_sent: 10\n"));
  EXPECT_EQ(ConfigFile::load(summary).root().integer("frames_sent", 0), 10);
}

TEST(WearableProgram, EndsWithThreeWhenAFrameWasUnreadable) {
  const SmallDataset dataset;
  std::filesystem::resize_file(dataset.frame(4), 100);
  const Ending ending = run("--dataset " + dataset.folder().string() + on_own_domain());
  EXPECT_EQ(ending.status, 3) << ending.output;
  EXPECT_THAT(ending.output, HasSubstr("unreadable: 1\n"));
  EXPECT_THAT(ending.output, HasSubstr("1 frames and 0 orientations could not be used"));
}

TEST(WearableProgram, EndsWithOneAndASentenceWhenTheInputIsMissing) {
  const Ending ending = run("--dataset /no/such/folder");
  EXPECT_EQ(ending.status, 1);
  EXPECT_THAT(
      ending.output,
      testing::EndsWith(
          "wearable_agent: /no/such/folder: no such folder; make a dataset with sim or cosight prepare\n"));
}

TEST(WearableProgram, EndsWithTwoAndASentenceWhenItIsToldNonsense) {
  EXPECT_EQ(run("").status, 2);
  const Ending ending = run("--dataset x --rate fast");
  EXPECT_EQ(ending.status, 2);
  EXPECT_THAT(ending.output, HasSubstr("--rate: replay.rate: 'fast' is not a number; leave it out for 1"));
}

}  // namespace
}  // namespace cosight::wearable
