#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cosight::integration {

/// Number of frames of each camera in the small scene, 100 ms apart.
constexpr int kFrames = 41;

/// Renders a corridor for both agents, once a process; where it is.
const std::filesystem::path& small_scene();

/// What it was rendered from.
std::filesystem::path small_scene_file();

/// A copy of the small scene that a test may spoil.
void copy_small_scene(const std::filesystem::path& to);

/// Hands the cells of each row (0: the first after the header) to `change` and writes them back. A row that
/// is left empty goes.
void change_rows(const std::filesystem::path& csv,
                 const std::function<void(std::size_t row, std::vector<std::string>& cells)>& change);

/// Of the last row.
std::string last_stamp(const std::filesystem::path& csv);

}  // namespace cosight::integration
