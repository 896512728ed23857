// Rows -> groups of neighbours -> groups that would fall are joined -> a table.
// Based on: Ayer and others, "An empirical distribution function for sampling with incomplete information", 1955 (pool
// adjacent violators).
#include "palpate/tissue/fitting/force_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"

namespace palpate::tissue {

namespace {

struct Group {
  double weight = 0.0;  ///< sum of the squares
  double depth = 0.0;   ///< weighted sums
  double force = 0.0;

  double meanDepth() const { return depth / weight; }
  double meanForce() const { return std::max(0.0, force / weight); }
  void merge(const Group& other) {
    weight += other.weight;
    depth += other.depth;
    force += other.force;
  }
};

/// Groups of as many rows each, rows of one depth together.
std::vector<Group> grouped(const ForceRows& rows, const Eigen::ArrayXd& weights, std::size_t most) {
  const auto below = static_cast<std::size_t>((rows.depth_mm > 0.0).count());
  const std::size_t in_each = (below + most - 1) / most;
  std::vector<Group> groups;
  std::size_t taken = 0;
  for (Eigen::Index i = 0; i < rows.depth_mm.size(); ++i) {
    if (!(rows.depth_mm[i] > 0.0)) continue;
    const bool same_depth = i > 0 && rows.depth_mm[i] == rows.depth_mm[i - 1];
    if (taken % in_each == 0 && !(same_depth && !groups.empty())) groups.emplace_back();
    if (groups.empty()) groups.emplace_back();
    const double weight = weights[i] * weights[i];
    groups.back().merge({weight, weight * rows.depth_mm[i], weight * rows.force_n[i]});
    ++taken;
  }
  return groups;
}

std::vector<Group> rising(const std::vector<Group>& groups) {
  std::vector<Group> joined;
  for (const Group& group : groups) {
    joined.push_back(group);
    while (joined.size() > 1 && joined[joined.size() - 2].meanForce() > joined.back().meanForce()) {
      const Group last = joined.back();
      joined.pop_back();
      joined.back().merge(last);
    }
  }
  return joined;
}

}  // namespace

ForceTable smoothedTable(const ForceRows& rows, const Eigen::ArrayXd& weights, std::size_t most_rows) {
  ForceTable table;
  const std::size_t most = std::min<std::size_t>(most_rows, ForceTable::kMaxRows);
  for (const Group& group : rising(grouped(rows, weights, most))) {
    table.depth_mm.at(table.rows) = group.meanDepth();
    table.effective_mm.at(table.rows) = group.meanForce();
    ++table.rows;
  }
  if (table.rows == 0 || !(table.effective_mm.at(table.rows - 1) > 0.0)) {
    throw Error("a table of measured forces requires at least one above 0");
  }
  return table;
}

double forceIn(const ForceTable& table, double depth_mm) {
  if (!(depth_mm > 0.0) || table.rows == 0) return 0.0;
  std::uint32_t end = 0;
  while (end + 1 < table.rows && table.depth_mm.at(end) <= depth_mm) ++end;
  const double from = end == 0 ? 0.0 : table.depth_mm.at(end - 1);
  const double from_n = end == 0 ? 0.0 : table.effective_mm.at(end - 1);
  return from_n + (depth_mm - from) * (table.effective_mm.at(end) - from_n) / (table.depth_mm.at(end) - from);
}

std::string forceTableText(const ForceTable& table) {
  std::string text = "depth_mm,force_n\n";
  for (std::uint32_t i = 0; i < table.rows; ++i) {
    text += fmt::format("{:.9g},{:.9g}\n", table.depth_mm.at(i), table.effective_mm.at(i));
  }
  return text;
}

}  // namespace palpate::tissue
