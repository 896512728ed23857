// Blocks of the manual on the screen: words that wrap, headings, lists, tables, code, links.
#pragma once

#include <string>
#include <vector>

#include "view/viewer/manual/markdown.h"

namespace palpate::viewer {

/// In the current window. The target of the link that was clicked, or empty. Scrolls to the heading of this anchor, if
/// there is one.
std::string drawBlocks(const std::vector<Block>& blocks, const std::string& to_anchor);

}  // namespace palpate::viewer
