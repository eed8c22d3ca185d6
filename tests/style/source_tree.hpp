#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cosight {

/// The .hpp and .cpp files below the given folders of the repository, relative to it, in order.
std::vector<std::filesystem::path> source_files(const std::filesystem::path& repository,
                                                const std::vector<std::string>& folders);

std::string content_of(const std::filesystem::path& file);

}  // namespace cosight
