// Makes text of others - notes, names, events of a recording, file names - safe for a terminal or a page.
#pragma once

#include <string>
#include <string_view>

namespace palpate::app {

/// Replaces invalid UTF-8, control characters (but tab and line end), and changes of the direction of writing by
/// U+FFFD: no terminal obeys it, and XML may hold it.
std::string readableText(std::string_view text);

/// The same in one line: line ends and tabs become blanks, so that foreign text cannot look like a line of ours.
std::string readableLine(std::string_view text);

/// To stdout. For results that hold such text.
void printReadable(std::string_view text);

}  // namespace palpate::app
