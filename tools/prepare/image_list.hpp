#pragma once

#include <filesystem>
#include <vector>

namespace cosight {

/// The folder's .jpg and .png files as absolute paths, in the order of their names. Throws PrepareError when
/// there is no such folder or no image in it.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);

}  // namespace cosight
