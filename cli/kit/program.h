// Shared by the main functions of `palpate`, of the programs that it starts and of palpate_peers.
#pragma once

#include <functional>
#include <string_view>

namespace palpate::app {

/// `body` returns the exit code. Before it, failing writes become errors and closed standard streams are opened; its
/// exceptions become one line and exit code 2.
int runProgram(const std::function<int()>& body);

/// Prints text on the standard output; the exit code shows whether it got there.
int printed(std::string_view text);

}  // namespace palpate::app
