#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace cosight {

/// A file with the given content, named after its test, that goes when the test ends.
class TextFile {
 public:
  TextFile(const std::string& name, const std::string& content)
      : path_(std::filesystem::temp_directory_path() / ("cosight_evaluation_" + name)) {
    std::ofstream(path_) << content;
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace cosight
