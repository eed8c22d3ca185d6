#pragma once

#include <filesystem>
#include <vector>

#include "experiments/urban_canyon/study.hpp"

namespace cosight::experiments {

/// What the paper's Figures 9 to 16 are drawn from, of one drive with each method:
/// truth.csv and path_METHOD.csv (t, x, y), rpe_METHOD.csv (t, error over the second that ends there) and
/// window_METHOD.csv (t, g, N, typical misfit in pixels).
void write_courses(const std::filesystem::path& folder, const vins::TrackSequence& sequence,
                   const vins::TrackRunOptions& window, const std::vector<Method>& methods);

}  // namespace cosight::experiments
