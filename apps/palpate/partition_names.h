// How the command line calls the kinds of partition, and the options that choose among them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "palpate/partition/partition.h"

namespace palpate::app {

std::string nameOf(partition::TreeKind tree);
std::string nameOf(partition::Assignment assignment);

/// Adds --tree, --assign, --threshold and --leaf-rule. `settings` must outlive the command.
void addPartitionSettings(CLI::App& command, partition::BuildSettings& settings);

}  // namespace palpate::app
