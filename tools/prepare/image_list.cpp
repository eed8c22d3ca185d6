#include "tools/prepare/image_list.hpp"

#include <algorithm>

#include "tools/prepare/prepare_error.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight {

std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path extension = entry.path().extension();
    if (extension == ".jpg" || extension == ".png") files.push_back(std::filesystem::canonical(entry.path()));
  }
  if (files.empty())
    throw PrepareError(folder.string() + ": holds no image; does --data name the folder of the data?");
  std::sort(files.begin(), files.end());
  return files;
}

Eigen::Quaterniond forward_looking_camera() {
  Eigen::Matrix3d R_BC;
  R_BC << 0, 0, 1,  //
      -1, 0, 0,     //
      0, -1, 0;
  return Eigen::Quaterniond(R_BC);
}

}  // namespace cosight
