#include "tests/style/include_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/style/source_tree.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kRepository = COSIGHT_SOURCE_DIR;

TEST(Includes, OfTheWholeTreeFollowTheTable) {
  const IncludeRules rules =
      IncludeRules::parse(content_of(kRepository / "tests" / "style" / "include_rules.txt"));
  SourceTree tree;
  for (const auto& file :
       source_files(kRepository, {"shared", "robot_agent", "wearable_agent", "sim", "tools"})) {
    tree[file] = content_of(kRepository / file);
  }
  ASSERT_GT(tree.size(), 20U);
  for (const std::string& breach : rules.breaches(tree))
    ADD_FAILURE() << breach;
}

class SmallTable : public testing::Test {
 protected:
  const IncludeRules rules_ = IncludeRules::parse(
      "library Eigen Eigen/\nlibrary OpenCV opencv2/\n"
      "room base | Eigen OpenCV(inside)\nroom top base | Eigen\nroom top/inner base |\n");
};

TEST_F(SmallTable, LetsThroughWhatItAllows) {
  EXPECT_THAT(rules_.breaches({{"top/a.cpp",
                                "#include \"base/b.hpp\"\n#include \"top/c.hpp\"\n"
                                "#include <Eigen/Core>\n#include <vector>\n"}}),
              IsEmpty());
  EXPECT_THAT(rules_.breaches({{"base/a.cpp", "#include <opencv2/core.hpp>\n"}}), IsEmpty());
}

TEST_F(SmallTable, NamesEveryBreachWithItsLine) {
  EXPECT_THAT(rules_.breaches({{"base/a.hpp", "\n#include \"top/c.hpp\"\n"}}),
              ElementsAre("base/a.hpp:2 includes \"top/c.hpp\", but base may not know top"));
  EXPECT_THAT(rules_.breaches({{"top/inner/a.cpp", "#include <Eigen/Core>\n"}}),
              ElementsAre(HasSubstr("top/inner may not use Eigen")));
  EXPECT_THAT(rules_.breaches({{"top/a.cpp", "#include \"c.hpp\"\n"}}),
              ElementsAre(HasSubstr("lies in no room")));
  EXPECT_THAT(rules_.breaches({{"top/a.cpp", "#include <zlib.h>\n"}}),
              ElementsAre(HasSubstr("belongs to no library")));
  EXPECT_THAT(rules_.breaches({{"attic/a.cpp", ""}}), ElementsAre(HasSubstr("lies in no room")));
}

TEST_F(SmallTable, KeepsALibraryOutOfHeadersThatOtherRoomsInclude) {
  SourceTree tree{{"base/view.hpp", "#include <opencv2/core.hpp>\n"},
                  {"base/open.hpp", "#include \"base/view.hpp\"\n"},
                  {"base/a.cpp", "#include \"base/open.hpp\"\n"}};
  EXPECT_THAT(rules_.breaches(tree), IsEmpty()) << "only base itself includes them";
  tree["top/a.cpp"] = "#include \"base/open.hpp\"\n";
  EXPECT_THAT(rules_.breaches(tree), ElementsAre(HasSubstr("base keeps OpenCV to itself")));
}

TEST_F(SmallTable, KeepsARoomAndItsInnerRoomApart) {
  EXPECT_THAT(rules_.breaches({{"top/a.cpp", "#include \"top/inner/c.hpp\"\n"}}),
              ElementsAre(HasSubstr("top may not know top/inner")));
}

TEST(IncludeRules, RefuseATableThatMakesNoSense) {
  EXPECT_THROW(IncludeRules::parse("rooms a | b\n"), std::runtime_error);
  EXPECT_THROW(IncludeRules::parse("room a b\n"), std::runtime_error);
  EXPECT_THROW(IncludeRules::parse("library Eigen\n"), std::runtime_error);
}

}  // namespace
}  // namespace cosight
