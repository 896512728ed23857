#include "apps/palpate/partition/partition_names.h"

#include "palpate/hdb/literal_traversal.h"

namespace palpate::app {

using hdb::Assignment;
using hdb::TreeKind;

std::string nameOf(TreeKind tree) { return tree == TreeKind::Bsp ? "bsp" : "octree"; }

std::string nameOf(Assignment assignment) {
  return assignment == Assignment::Cut ? "A" : assignment == Assignment::BothSides ? "B" : "C";
}

void addPartitionSettings(CLI::App& command, hdb::BuildSettings& settings) {
  addChoice<TreeKind>(command, "--tree", settings.tree, {{"bsp", TreeKind::Bsp}, {"octree", TreeKind::Octree}},
                      "Halves by x, y, z in turn, or eighths");
  addChoice<Assignment>(command, "--assign", settings.assignment,
                        {{"A", Assignment::Cut}, {"B", Assignment::BothSides}, {"C", Assignment::Majority}},
                        "A triangle that a plane crosses is cut (A), kept on both sides (B) or goes to the side with "
                        "two of its vertices (C)");
  command.add_option("--threshold", settings.threshold, "Triangles up to which a node is a leaf")
      ->capture_default_str()
      ->check(CLI::Range(1u, 4000000000u));
  addChoice<bool>(command, "--leaf-rule", settings.leaf_below_threshold, {{"at-most", false}, {"below", true}},
                  "A leaf holds at most the threshold, or fewer than it as the dissertation's text has it (E7)");
}

const Choices<std::optional<hdb::LiteralTraversal>>& traversalChoices() {
  static const Choices<std::optional<hdb::LiteralTraversal>> all = [] {
    Choices<std::optional<hdb::LiteralTraversal>> choices;
    for (const hdb::TraversalWord& row : hdb::kTraversalWords) choices.push_back({row.word, row.literal});
    return choices;
  }();
  return all;
}

}  // namespace palpate::app
