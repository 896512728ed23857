#include "lab/commands/partition_options.h"

#include "cli/kit/number_option.h"

namespace palpate::app {

void addPartitionSettings(CLI::App& command, hdb::BuildSettings& settings) {
  addChoice(command, "--tree", settings.tree, "Halves by x, y, z in turn, or eighths");
  addChoice(command, "--assign", settings.assignment,
            "A triangle that a plane crosses is cut (A), kept on both sides (B) or goes to the side with two of its "
            "vertices (C)");
  addNumber(command, "--threshold", settings.threshold, between(1, 4e9), "Triangles up to which a node is a leaf")
      ->capture_default_str();
  addChoice<bool>(command, "--leaf-rule", settings.leaf_below_threshold, {{"at-most", false}, {"below", true}},
                  "A leaf holds at most the threshold, or fewer than it as the dissertation's text has it (E7)");
}

}  // namespace palpate::app
