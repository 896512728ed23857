// How the command line calls the kinds of partition, and the options that choose among them.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "apps/palpate/choice_option.h"
#include "palpate/partition/literal_traversal.h"

namespace palpate::app {

std::string nameOf(partition::TreeKind tree);
std::string nameOf(partition::Assignment assignment);

/// Adds --tree, --assign, --threshold and --leaf-rule. `settings` must outlive the command.
void addPartitionSettings(CLI::App& command, partition::BuildSettings& settings);

/// The words of --traversal.
const Choices<std::optional<partition::LiteralTraversal>>& traversalChoices();

}  // namespace palpate::app
