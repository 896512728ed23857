// The options that choose among the kinds of partition.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "cli/kit/choice_option.h"
#include "palpate/scene/words.h"

namespace palpate::app {

/// Adds --tree, --assign, --threshold and --leaf-rule. `settings` must outlive the command.
void addPartitionSettings(CLI::App& command, hdb::BuildSettings& settings);

}  // namespace palpate::app
