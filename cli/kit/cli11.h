// CLI11, which takes the name of a file as the UTF-8 that it is, and a command with its arguments. Included instead of
// <CLI/CLI.hpp>: what follows must stand before its templates.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "palpate/base/path_text.h"

// Names that CLI11 looks for. NOLINTBEGIN(readability-identifier-naming)
namespace CLI::detail {
inline bool lexical_cast(const std::string& input, std::filesystem::path& output) {
  output = palpate::pathOf(input);
  return true;
}
}  // namespace CLI::detail
// NOLINTEND(readability-identifier-naming)

#include <CLI/CLI.hpp>

namespace palpate::app {

/// A new command of `parent`, and its arguments, for options to be added. Both live as long as `parent`; `run` is
/// called with the arguments once they are parsed.
template <class Arguments, class Run>
std::pair<CLI::App&, Arguments&> addCommand(CLI::App& parent, const std::string& name, const std::string& help,
                                            const Run& run) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *parent.add_subcommand(name, help);
  command.callback([arguments, run] { run(*arguments); });
  return {command, *arguments};
}
template <class Arguments>
auto addCommand(CLI::App& parent, const std::string& name, const std::string& help, void (*run)(const Arguments&)) {
  return addCommand<Arguments, void (*)(const Arguments&)>(parent, name, help, run);
}

}  // namespace palpate::app
