#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cosight::recording {

/// The words and signs of an .idl file without comments and preprocessor lines. A scoped name "a::b::C" is
/// one word, and so is the name of an annotation with its "@".
std::vector<std::string> idl_tokens(std::string_view text);

}  // namespace cosight::recording
