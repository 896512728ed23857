// Runs the built command as a user would, and tells what it printed and how it ended.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "support/places.h"

namespace palpate::support {

struct CommandResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Runs `program arguments` through the shell in a folder of its choice; quote what needs it.
inline CommandResult runProgram(const std::filesystem::path& program, const std::string& arguments,
                                const std::filesystem::path& in = ".") {
  static int runs = 0;
  const auto stem = std::filesystem::temp_directory_path() /
                    ("palpate_run_" + std::to_string(getpid()) + "_" + std::to_string(runs++));
  const std::string out = stem.string() + ".out";
  const std::string err = stem.string() + ".err";
  const std::string line = "cd '" + in.string() + "' && '" + program.string() + "' " + arguments + " >'" + out +
                           "' 2>'" + err + "' </dev/null";
  const int status = std::system(line.c_str());
  CommandResult result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(out), contentOf(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return result;
}

inline CommandResult runPalpate(const std::string& arguments, const std::filesystem::path& in = ".") {
  return runProgram(support::buildFolder() / "palpate", arguments, in);
}

/// Whether this build has the program that holds the command which the arguments begin with
/// (engine/cli/kit/families.tsv): without a family its commands are not tested.
inline bool hasProgramOf(const std::string& arguments) {
  std::ifstream table(support::sourceFolder() / "engine/cli/kit/families.tsv");
  for (std::string group, command, family, what; std::getline(table, group, '\t');) {
    if (!std::getline(table, command, '\t') || !std::getline(table, family, '\t') || !std::getline(table, what)) break;
    if (!(arguments + " ").starts_with(command + " ")) continue;
    return std::filesystem::exists(support::buildFolder() / ("palpate-" + family));
  }
  return true;
}

}  // namespace palpate::support
