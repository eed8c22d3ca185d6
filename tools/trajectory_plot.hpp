#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cosight {

/// One run in a picture; `errors_csv` as write_errors_csv makes it.
struct PlottedRun {
  std::string name;
  std::filesystem::path errors_csv;
};

/// Draws trajectories from above and from the side, and the errors over time, as a PNG. The gnuplot script
/// stays beside the picture, so that it can be drawn again. False when gnuplot is not there or fails.
bool plot_trajectories(const std::filesystem::path& png, const std::string& title,
                       const std::vector<PlottedRun>& runs);

}  // namespace cosight
