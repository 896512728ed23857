// Text that somebody else wrote - notes, names, events of a recording, what a file is called - for a terminal or a
// page.
#pragma once

#include <string>
#include <string_view>

namespace palpate::app {

/// What is no UTF-8, a control character (but tab and line end), or turns the direction of writing becomes U+FFFD: no
/// terminal obeys it, and XML may hold it.
std::string readableText(std::string_view text);

/// The same in one line: line ends and tabs become blanks, so that no word of a stranger looks like a line of ours.
std::string readableLine(std::string_view text);

/// To stdout. For results that hold such text.
void printReadable(std::string_view text);

}  // namespace palpate::app
