#pragma once

#include <span>
#include <string_view>

namespace cosight::recording {

/// The texts of the files in idl/.
std::span<const std::string_view> builtin_idl();

}  // namespace cosight::recording
