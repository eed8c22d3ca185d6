#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/style/source_tree.hpp"

namespace cosight {
namespace {

const std::filesystem::path kRepository = COSIGHT_SOURCE_DIR;

TEST(Format, OfEveryFileIsWhatClangFormatMakes) {
  if (std::system("clang-format --version >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "clang-format is not installed";
  const auto files =
      source_files(kRepository, {"shared", "robot_agent", "wearable_agent", "sim", "tools", "tests"});
  const std::filesystem::path list = std::filesystem::path(COSIGHT_BINARY_DIR) / "formatted_files.txt";
  std::ofstream out(list);
  for (const std::filesystem::path& file : files)
    out << (kRepository / file).string() << '\n';
  out.close();
  const std::string command =
      "clang-format --dry-run --Werror --ferror-limit=1 --files='" + list.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << "run clang-format -i on the files above";
}

}  // namespace
}  // namespace cosight
