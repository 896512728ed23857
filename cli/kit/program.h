// What the main functions of `palpate`, of the programs that it starts and of palpate_peers have in common.
#pragma once

#include <functional>
#include <string_view>

namespace palpate::app {

/// `body` gives the exit code. Before it, writes that fail become errors and closed standard streams are held; what it
/// throws becomes one line and exit code 2.
int runProgram(const std::function<int()>& body);

/// Text on the standard output; the exit code says whether it got there.
int printed(std::string_view text);

}  // namespace palpate::app
