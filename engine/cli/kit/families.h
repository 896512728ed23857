// Commands in programs of their own: palpate-<family>, one per package, which `palpate` starts as git starts
// git-<command>. So palpating needs none of the libraries for photographs, classes or reports.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::app {

/// A row of families.tsv.
struct FamilyCommand {
  std::string_view group;    ///< in the help
  std::string_view command;  ///< "recording report"
  std::string_view family;
  std::string_view what;
};
const std::vector<FamilyCommand>& familyCommands();
/// families.tsv, compiled in.
std::string_view familyTable();

/// The row that a command line begins with; nullptr for a command of `palpate` itself and for an unknown one.
const FamilyCommand* findFamilyCommand(const std::vector<std::string>& words);

/// The path next to our own program; empty where it is not installed.
std::filesystem::path familyProgram(std::string_view family);

/// This process becomes that program, with these words; where the system cannot do so, returns the program's exit code.
/// Throws Error, which says which package is missing and how it is built.
int becomeFamily(const FamilyCommand& command, const std::vector<std::string>& words);

/// This process becomes `palpate`, installed next to its own program, with these words. Throws Error.
int becomeCommand(const std::vector<std::string>& words);

/// Runs it to its end, silently. False where it is not installed or has failed.
bool runFamily(std::string_view family, const std::vector<std::string>& words);

}  // namespace palpate::app
