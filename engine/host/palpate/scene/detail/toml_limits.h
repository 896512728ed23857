// Whether a text can be given to the TOML parser, which recurses for every level of nesting and every part of a key.
#pragma once

#include <string_view>

namespace palpate::scene {

/// Throws Error naming the file and the line where the text exceeds a limit of toml_node.h. Anything else that is wrong
/// with it is left to the parser.
void requireBoundedToml(std::string_view text, std::string_view file);

}  // namespace palpate::scene
