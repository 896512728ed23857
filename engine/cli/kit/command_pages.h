// Descriptions of a command line for other readers than its user: completions for shells, and a page for man. Both are
// derived from the commands themselves, so that neither can be forgotten.
//
//   palpate --complete recording re     ─► replay, repair, report: one word a line    packaging/completions
//   palpate-teach --man                 ─► palpate-teach.1, written when it is built
#pragma once

#include <string>
#include <vector>

#include "cli/kit/options.h"

namespace palpate::app {

inline constexpr const char* kCompleteOption = "--complete";
inline constexpr const char* kManOption = "--man";

/// Completions of the last word: commands, options, or an option's values. Empty where file names may follow.
std::vector<std::string> findCompletions(const Command& app, const std::vector<std::string>& words);

/// Section 1, as roff: the program's commands with their options. `program`: "palpate", "palpate-teach".
std::string manPage(const Command& app, const std::string& program);

}  // namespace palpate::app
