// What a command line says of itself to others than its user: words that may come next, for shells, and a page for man.
// Both are read off the commands themselves, so that neither can be forgotten.
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

/// Words that may stand where the last of these stands, as far as it is written: commands, options, or what an option
/// takes. Empty where files may stand.
std::vector<std::string> completionsOf(const Command& app, const std::vector<std::string>& words);

/// Section 1, as roff: the program's commands with their options. `program`: "palpate", "palpate-teach".
std::string manPage(const Command& app, const std::string& program);

}  // namespace palpate::app
