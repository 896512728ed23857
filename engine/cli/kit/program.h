// Shared by the main functions of `palpate`, of the programs that it starts and of palpate_peers.
#pragma once

#include <functional>
#include <string_view>

namespace palpate::app {

/// Installs the host and runs `body`, which returns the exit code. Failing writes become errors instead of signals,
/// closed standard streams are opened, and exceptions of `body` become one line and exit code 2.
int runProgram(const std::function<int()>& body);

/// Prints text on the standard output; the exit code shows whether it got there.
int printed(std::string_view text);

}  // namespace palpate::app
