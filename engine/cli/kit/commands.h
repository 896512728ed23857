// The command line of `palpate`, of the programs that it starts (families.h) and of palpate_peers: how it is run.
// Each command lives in a file of its own, adds itself to the command line or to its group, and runs when chosen; the
// commands.h of its house declares it.
#pragma once

#include <string>
#include <vector>

#include "cli/kit/options.h"

namespace palpate::app {

/// Replaces commands renamed in the last release by their present names, and prints the change.
std::vector<std::string> withPresentCommand(std::vector<std::string> words);

/// Parses a command line, runs the chosen command, and turns every error into one line and an exit code. 0: done; 1:
/// the command ran and its answer is "no" (a check that failed); 2: wrong input or usage, in one line on the standard
/// error, also when the standard output cannot be written; 128 and the signal's number after a signal (interruption.h).
int runCommandLine(Command& app, const std::vector<std::string>& words);

/// The words of the command that is running: for another program that continues with it (families.h).
const std::vector<std::string>& typedWords();

/// `palpate body`, `palpate recording`: made on first use.
Command& commandGroup(Command& app, const std::string& name);

}  // namespace palpate::app
