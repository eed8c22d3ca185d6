#include <fstream>

#include "tests/integration/session.hpp"

namespace cosight::integration {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;

struct ProgramUnderTest {
  std::string name;
  std::string path;
};

void PrintTo(const ProgramUnderTest& program, std::ostream* out) {
  *out << program.name;
}

/// All programs answer alike.
class AnyProgram : public Session, public testing::WithParamInterface<ProgramUnderTest> {
 protected:
  Ending run(const Arguments& arguments) const {
    return ChildProcess(GetParam().path, arguments, in_folder("streams")).wait();
  }
  /// One line on stderr that begins with the program's name.
  std::string says(const std::string& sentence) const { return GetParam().name + ": " + sentence + "\n"; }
};

INSTANTIATE_TEST_SUITE_P(Programs, AnyProgram,
                         testing::Values(ProgramUnderTest{"robot_agent", ROBOT_AGENT},
                                         ProgramUnderTest{"wearable_agent", WEARABLE_AGENT},
                                         ProgramUnderTest{"sim", SIM}, ProgramUnderTest{"cosight", COSIGHT}),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(AnyProgram, HelpShowsExamples) {
  const Ending ending = run({"--help"});
  EXPECT_EQ(ending.exit_code, 0);
  EXPECT_EQ(ending.err, "");
  EXPECT_THAT(ending.out, HasSubstr("Examples:\n  " + GetParam().name + " "));
}

TEST_P(AnyProgram, VersionIsNameAndNumber) {
  const Ending ending = run({"--version"});
  EXPECT_EQ(ending.exit_code, 0);
  EXPECT_THAT(ending.out, MatchesRegex(GetParam().name + " [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_P(AnyProgram, WithoutArgumentsItSaysWhatIsMissing) {
  const Ending ending = run({});
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_EQ(ending.out, "");
  EXPECT_THAT(ending.err, MatchesRegex(GetParam().name + ": [^\n]*\n"));
}

TEST_F(Session, CosightNamesTheCommandThatLacksAnArgument) {
  const Ending ending = ChildProcess(COSIGHT, {"info"}, in_folder("streams")).wait();
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_EQ(ending.err, "cosight: file is required; see cosight info --help\n");
}

/// Both agents answer alike.
class CommandLine : public AnyProgram {};

INSTANTIATE_TEST_SUITE_P(Agents, CommandLine,
                         testing::Values(ProgramUnderTest{"robot_agent", ROBOT_AGENT},
                                         ProgramUnderTest{"wearable_agent", WEARABLE_AGENT}),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(CommandLine, AMissingDatasetIsNamed) {
  const Ending ending = run({"--dataset", "/no/such/folder"});
  EXPECT_EQ(ending.exit_code, 1);
  EXPECT_EQ(ending.err, says("/no/such/folder: no such folder; make a dataset with sim or cosight prepare"));
}

TEST_P(CommandLine, AnUnknownOptionIsNamed) {
  const Ending ending = run({"--colour"});
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_THAT(ending.err, HasSubstr("--colour"));
  EXPECT_THAT(ending.err, EndsWith("; see " + GetParam().name + " --help\n"));
}

TEST_P(CommandLine, AnUnknownKeyIsNamedWithFileAndLine) {
  const auto file = in_folder("config.yaml");
  std::ofstream(file) << "input:\n  dataset: " << small_scene().string() << "\nreplay:\n  speed: 2\n";
  const Ending ending = run({"--config", file.string()});
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_THAT(ending.err, testing::StartsWith(GetParam().name + ": " + file.string() +
                                              ":4: replay.speed: is no known key"));
}

TEST_P(CommandLine, AValueOutOfRangeIsNamedWithItsOption) {
  const Ending ending = run({"--dataset", small_scene().string(), "--domain", "300"});
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_EQ(ending.err, says("--domain: dds.domain: 300 is not in [0, 232]; leave it out for 0"));
}

}  // namespace
}  // namespace cosight::integration
