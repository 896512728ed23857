// Parses a command line, runs what was chosen, and turns every error into one line and an exit code.
#pragma once

#include <CLI/CLI.hpp>

namespace palpate::app {

/// 0: done; 1: the command ran and its answer is "no" (a check that failed); 2: wrong input or usage, said in one line
/// on the standard error.
int runCommandLine(CLI::App& app, int argc, char** argv);

}  // namespace palpate::app
