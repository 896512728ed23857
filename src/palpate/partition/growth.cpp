#include "palpate/partition/growth.h"

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::partition {

namespace {

/// Progress is reported in steps of this share: often enough for a bar, too rarely to cost anything.
constexpr double kProgressStep = 0.01;

double middleOf(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

}  // namespace

Vec3 middlePoint(const mesh::TriangleMesh& mesh, Index triangle) {
  const Vec3& a = mesh.positions[mesh.triangles[triangle][0]];
  const Vec3& b = mesh.positions[mesh.triangles[triangle][1]];
  const Vec3& c = mesh.positions[mesh.triangles[triangle][2]];
  return {middleOf(a.x(), b.x(), c.x()), middleOf(a.y(), b.y(), c.y()), middleOf(a.z(), b.z(), c.z())};
}

void WorkDone::add(double share) {
  done_ += share;
  if (done_ < reported_ + kProgressStep) return;
  reported_ = done_;
  report(progress_, "partition", std::min(done_, 1.0));
}

Box3 childCell(TreeKind tree, const Box3& cell, int level, int slot) {
  const Vec3 middle = splitPoint(cell);
  Box3 child = cell;
  const auto halve = [&](int axis, bool positive) { (positive ? child.min() : child.max())[axis] = middle[axis]; };
  if (tree == TreeKind::Bsp) {
    halve(splitAxis(level), slot != 0);
  } else {
    for (int axis = 0; axis < 3; ++axis) halve(axis, ((slot >> axis) & 1) != 0);
  }
  return child;
}

Index addChildren(Growth& growth, Index node, const std::vector<std::uint8_t>& slots) {
  const auto first = static_cast<Index>(growth.nodes.size());
  const std::uint8_t level = growth.nodes[node].level;
  const Box3 cell = growth.cells[node];
  growth.nodes[node].first_child = first;
  growth.nodes[node].child_count = static_cast<std::uint8_t>(slots.size());
  for (const std::uint8_t slot : slots) {
    Node& child = growth.nodes.emplace_back();
    child.level = static_cast<std::uint8_t>(level + 1);
    child.slot = slot;
    growth.cells.push_back(childCell(growth.tree, cell, level, slot));
  }
  return first;
}

void makeLeaf(Growth& growth, Index node, std::size_t first_entry, std::size_t entry_count, double share) {
  if (first_entry + entry_count > kNoIndex)
    throw Error("partition: too many entries; take case C or a larger threshold");
  growth.nodes[node].is_leaf = true;
  growth.nodes[node].first_entry = static_cast<Index>(first_entry);
  growth.nodes[node].entry_count = static_cast<Index>(entry_count);
  growth.leaves.push_back(node);
  growth.work_done.add(kGrowthShare * share);
}

}  // namespace palpate::partition
