// CLI11, which takes the name of a file as the UTF-8 that it is. Included instead of <CLI/CLI.hpp>: what follows must
// stand before its templates.
#pragma once

#include <filesystem>
#include <string>

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
