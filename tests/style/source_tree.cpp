#include "tests/style/source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace cosight {

std::vector<std::filesystem::path> source_files(const std::filesystem::path& repository,
                                                const std::vector<std::string>& folders) {
  std::vector<std::filesystem::path> files;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(repository / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(repository / folder)) {
      const std::filesystem::path extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      files.push_back(entry.path().lexically_relative(repository));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace cosight
