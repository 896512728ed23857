// How the command line calls the kinds of partition, and the options that choose among them.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "apps/palpate/common/choice_option.h"
#include "palpate/hdb/literal_traversal.h"

namespace palpate::app {

std::string nameOf(hdb::TreeKind tree);
std::string nameOf(hdb::Assignment assignment);

/// Adds --tree, --assign, --threshold and --leaf-rule. `settings` must outlive the command.
void addPartitionSettings(CLI::App& command, hdb::BuildSettings& settings);

/// The words of --traversal.
const Choices<std::optional<hdb::LiteralTraversal>>& traversalChoices();

}  // namespace palpate::app
