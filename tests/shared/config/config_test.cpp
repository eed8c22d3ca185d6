#include "shared/config/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>

namespace cosight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

enum class Descriptor { kOrb, kSift };

const char* const kYaml = R"(# a robot
slam:
  max_landmarks: 60
  gate: 3.84
search:
  equalize: true
  descriptor: sift
  levels: [1, 2.5, 4]
  folder: here/there
  max_features: 0

name: "it's"
scenes:
  - {width: 3}
  - {width: 4}
)";

ConfigNode root(const std::string& yaml = kYaml) {
  return ConfigFile::parse(yaml, "config/robot.yaml").root();
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Config, GivesWhatTheFileSays) {
  const ConfigNode node = root();
  EXPECT_EQ(node.section("slam").integer("max_landmarks", 1), 60);
  EXPECT_DOUBLE_EQ(node.section("slam").number("gate", 1.0), 3.84);
  const ConfigNode search = node.section("search");
  EXPECT_TRUE(search.boolean("equalize", false));
  EXPECT_EQ(
      search.choice("descriptor", Descriptor::kOrb, {{"orb", Descriptor::kOrb}, {"sift", Descriptor::kSift}}),
      Descriptor::kSift);
  EXPECT_THAT(search.numbers("levels", {}), ElementsAre(1.0, 2.5, 4.0));
  EXPECT_EQ(search.vector3("levels", Eigen::Vector3d::Zero()), Eigen::Vector3d(1.0, 2.5, 4.0));
  EXPECT_EQ(node.text("name", ""), "it's");
  EXPECT_EQ(node.sections("scenes").at(1).integer("width", 0), 4);
}

TEST(Config, AnEmptyFileMeansTheDefaults) {
  for (const char* yaml : {"", "\n# nothing\n", "slam:\n"}) {
    const ConfigFile file = ConfigFile::parse(yaml, "empty.yaml");
    EXPECT_EQ(file.root().section("slam").integer("max_landmarks", 7), 7);
    EXPECT_EQ(file.root().section("slam").section("deeper").text("x", "y"), "y");
    EXPECT_THAT(file.root().numbers("list", {1, 2}), ElementsAre(1, 2));
    EXPECT_TRUE(file.root().sections("scenes").empty());
    EXPECT_NO_THROW(file.refuse_unknown_keys());
  }
}

TEST(Config, ErrorsNameFileLineKeyAndRange) {
  EXPECT_EQ(error_of([] { root().section("search").integer("max_features", 60, 10, 1000); }),
            "config/robot.yaml:10: search.max_features: 0 is not in [10, 1000]; leave it out for 60");
  EXPECT_THAT(error_of([] { root().section("slam").number("gate", 1.0, 5.0); }),
              StartsWith("config/robot.yaml:4: slam.gate: 3.84 is below 5"));
  EXPECT_THAT(error_of([] { root().section("search").numbers("levels", {}, 0, 3); }),
              StartsWith("config/robot.yaml:8: search.levels[2]: 4 is not in [0, 3]"));
}

TEST(Config, RefusesValuesOfTheWrongKind) {
  EXPECT_THAT(error_of([] { root().number("name", 1.0); }),
              HasSubstr("robot.yaml:12: name: 'it's' is not a number"));
  EXPECT_THAT(error_of([] { root().section("slam").integer("gate", 1); }), HasSubstr("not a whole number"));
  EXPECT_THAT(error_of([] { root().section("slam").boolean("gate", true); }),
              HasSubstr("neither true nor false"));
  EXPECT_THAT(error_of([] { root().number("slam", 1.0); }), HasSubstr("has to be a number"));
  EXPECT_THAT(error_of([] { root().section("name"); }), HasSubstr("has to be a section"));
  EXPECT_THAT(error_of([] { root().text("slam", ""); }), HasSubstr("has to be a text"));
  EXPECT_THAT(
      error_of([] {
        root().choice("name", Descriptor::kOrb, {{"orb", Descriptor::kOrb}, {"sift", Descriptor::kSift}});
      }),
      HasSubstr("is none of orb, sift"));
}

TEST(Config, RefusesNumbersThatAreNotFinite) {
  for (const char* value : {"nan", ".nan", "inf", "-.inf", "1e999", "0x10", "12abc", "1,5", "''"}) {
    const std::string yaml = std::string("a: 1\nx: ") + value + "\n";
    EXPECT_THAT(error_of([&] { root(yaml).number("x", 1.0); }), StartsWith("config/robot.yaml:2: x: "))
        << value;
  }
  EXPECT_THAT(error_of([] { root("x: 99999999999").integer("x", 1); }), HasSubstr("not a whole number"));
}

TEST(Config, AnUnknownKeyIsAnErrorWithItsLineAndTheNearestKnownOne) {
  const ConfigFile file = ConfigFile::parse("slam:\n  max_landmark: 60\n", "a.yaml");
  file.root().section("slam").integer("max_landmarks", 1);
  file.root().section("slam").integer("levels", 1);
  EXPECT_EQ(error_of([&] { file.refuse_unknown_keys(); }),
            "a.yaml:2: slam.max_landmark: is no known key; did you mean max_landmarks?");
}

TEST(Config, AnUnknownKeyInsideAListOfSectionsIsFound) {
  const ConfigFile file = ConfigFile::parse("scenes:\n  - {width: 1}\n  - {with: 2}\n", "a.yaml");
  for (const auto& scene : file.root().sections("scenes"))
    scene.integer("width", 0);
  EXPECT_THAT(error_of([&] { file.refuse_unknown_keys(); }), StartsWith("a.yaml:3: scenes[1].with"));
}

TEST(Config, TheCommandLineReplacesTheFile) {
  const ConfigFile file = ConfigFile::parse(kYaml, "robot.yaml",
                                            {parse_override("slam.max_landmarks=12"),
                                             parse_override("search.levels=[9, 8]"),
                                             {"name", "a: [b", "--name", true},
                                             parse_override("new.section.key=true")});
  EXPECT_EQ(file.root().section("slam").integer("max_landmarks", 1), 12);
  EXPECT_DOUBLE_EQ(file.root().section("slam").number("gate", 1.0), 3.84);
  EXPECT_THAT(file.root().section("search").numbers("levels", {}), ElementsAre(9, 8));
  EXPECT_EQ(file.root().text("name", ""), "a: [b");
  EXPECT_TRUE(file.root().section("new").section("section").boolean("key", false));
}

TEST(Config, ErrorsOfTheCommandLineNameTheOption) {
  const ConfigFile file = ConfigFile::parse(kYaml, "robot.yaml", {parse_override("slam.gate=-1")});
  EXPECT_EQ(error_of([&] { file.root().section("slam").number("gate", 3, 0); }),
            "--set: slam.gate: -1 is below 0; leave it out for 3");
  EXPECT_THAT(error_of([] { parse_override("slam.gate"); }), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(error_of([] { ConfigFile::parse("a: 1", "x", {parse_override("a.b=1")}); }),
              HasSubstr("a is a value, not a section"));
  EXPECT_THAT(error_of([] { ConfigFile::parse("", "x", {parse_override("a=[1")}); }),
              HasSubstr("--set: a: not yaml"));
}

TEST(Config, BrokenYamlIsReportedWithItsLine) {
  EXPECT_THAT(error_of([] { root("a: 1\nb: [1, 2\nc: 3\n"); }), HasSubstr("not yaml"));
  EXPECT_THAT(error_of([] { root("a: 1\n  b: 2\n"); }), StartsWith("config/robot.yaml:2: not yaml"));
  EXPECT_EQ(error_of([] { root("a: 1\nb: 2\na: 3\n"); }),
            "config/robot.yaml:3: a: is given twice, first at config/robot.yaml:1; keep one");
  EXPECT_THAT(error_of([] { root("just words"); }), HasSubstr("is a single value"));
  EXPECT_THAT(error_of([] { ConfigFile::load("/no/such.yaml"); }), HasSubstr("/no/such.yaml: can't be read"));
  EXPECT_THAT(error_of([] { ConfigFile::load("/"); }), HasSubstr("is a folder"));
}

TEST(Config, YamlThatUnfoldsWithoutEndIsRefused) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string name = "a" + std::to_string(i);
    const std::string inner = "*a" + std::to_string(i - 1);
    bomb += name + ": &" + name + " [";
    for (int k = 0; k < 10; ++k)
      bomb += (k == 0 ? "" : ", ") + inner;
    bomb += "]\n";
  }
  EXPECT_THAT(error_of([&] { root(bomb); }), HasSubstr("too large"));
}

/// Sets a variable of the environment for one test.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(Config, PathsStartFromTheFileOrTheWorkingFolder) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "cosight_config_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.yaml")
      << "in: sub/x.csv\nabsolute: /y\ndata: $COSIGHT_DATA/k\nhome: ~/z\nno: $NOT_SET_X/a\n";
  const Environment data("COSIGHT_DATA", "/data");
  const Environment home("HOME", "/home/me");
  const ConfigFile file = ConfigFile::load(folder / "a.yaml", {{"cli", "x/y", "--dataset", true}});
  EXPECT_EQ(file.root().path("in", ""), folder / "sub/x.csv");
  EXPECT_EQ(file.root().path("absolute", ""), "/y");
  EXPECT_EQ(file.root().path("data", ""), "/data/k");
  EXPECT_EQ(file.root().path("home", ""), "/home/me/z");
  EXPECT_EQ(file.root().path("cli", ""), "x/y");
  EXPECT_EQ(file.root().path("absent", "d/e"), "d/e");
  EXPECT_THAT(error_of([&] { (void)file.root().path("no", ""); }),
              HasSubstr("a.yaml:5: no: $NOT_SET_X is not set"));
}

TEST(Config, ResolvedTextKeepsListsOfSections) {
  const auto read = [](const ConfigFile& file) {
    std::vector<int> widths;
    for (const auto& scene : file.root().section("world").sections("scenes")) {
      widths.push_back(scene.integer("width", 5));
      widths.push_back(scene.section("inner").integer("height", 6));
    }
    return widths;
  };
  const ConfigFile file =
      ConfigFile::parse("world: {scenes: [{width: 1}, {}, {inner: {height: 2}}]}", "a.yaml");
  const auto first = read(file);
  EXPECT_THAT(first, ElementsAre(1, 6, 5, 6, 5, 2));
  EXPECT_EQ(read(ConfigFile::parse(file.resolved(), "resolved")), first) << file.resolved();
}

TEST(Config, ResolvedTextReadsBackAsTheSameConfiguration) {
  const auto read = [](const ConfigFile& file) {
    const ConfigNode slam = file.root().section("slam");
    return std::tuple(slam.integer("max_landmarks", 5), slam.number("gate", 0.1),
                      file.root().text("name", "x"), slam.section("deep").boolean("on", true),
                      slam.numbers("list", {0.25, 3}), slam.texts("words", {"a", "b'c"}));
  };
  const ConfigFile file = ConfigFile::parse("slam: {max_landmarks: 60}\nname: it's\n", "a.yaml");
  const auto first = read(file);
  const ConfigFile again = ConfigFile::parse(file.resolved(), "resolved");
  EXPECT_EQ(read(again), first);
  EXPECT_NO_THROW(again.refuse_unknown_keys());
  EXPECT_THAT(file.resolved(), HasSubstr("  gate: 0.1\n"));
}

}  // namespace
}  // namespace cosight
