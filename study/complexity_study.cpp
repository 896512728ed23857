// The study of the search's cost: Tables 3.3 and 3.4 counted on complete trees, then real models over thresholds and
// sizes of the detecting box, then each claim of 3.3.4 and 3.4.2 against the counts.
#include "study/complexity_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/partition/complexity.h"
#include "study/model_meshes.h"
#include "study/search_cost.h"

namespace palpate::study {

namespace {

using figures::Figure;
using figures::Marker;
using figures::Plot;
using figures::Scale;
using figures::Series;
using figures::Stroke;
using partition::TreeKind;

constexpr std::array kTrees{TreeKind::Bsp, TreeKind::Octree};
constexpr std::array kThresholds{64, 128, 256, 512, 1024, 2048, 4096};
constexpr Index kPrintedThreshold = 1024;
// Edges of the detecting box as parts of the model's longest edge; a quarter is the dissertation's.
constexpr std::array kParts{16, 8, 4, 2};
constexpr int kPrintedPart = 4;
// In smaller trees a single leaf is too large a share of all for shares to mean something.
constexpr double kFewestLeaves = 30.0;

const char* nameOf(TreeKind tree) { return tree == TreeKind::Bsp ? "BSP tree" : "octree"; }
int arityOf(TreeKind tree) { return tree == TreeKind::Bsp ? partition::kBspArity : partition::kOctreeArity; }
std::size_t indexOf(TreeKind tree) { return tree == TreeKind::Bsp ? 0 : 1; }
// What (3.5) and (3.9) print for c over n.
double printedCost(TreeKind tree) { return tree == TreeKind::Bsp ? 0.8 : 0.4; }

// A column of Table 3.3 or 3.4.
struct WorstColumn {
  TreeKind tree = TreeKind::Bsp;
  int height = 0;
  double printed = 0.0;
  double closed = 0.0;
  double counted = 0.0;
};

// w from a search that ends in one leaf of a complete tree, node by node.
double countedW(TreeKind tree, int height) {
  const mesh::TriangleMesh mesh = completeTreeMesh(tree, height);
  const partition::Partition built = partition::buildPartition(mesh, {.tree = tree, .threshold = 1});
  SearchCounter counter(built);
  const SearchCount count = counter.count(partition::hapticBox(mesh.positions[0], 1e-4));
  const auto leaves = static_cast<double>(built.leaves.size());
  return (count.on_paths / built.tree_node_count) / (count.leaves_found / leaves);
}

std::vector<WorstColumn> worstColumns() {
  std::vector<WorstColumn> columns;
  const auto add = [&](TreeKind tree, int height, double printed) {
    columns.push_back({tree, height, printed, partition::worstSearch(arityOf(tree), height).w, countedW(tree, height)});
  };
  for (std::size_t i = 0; i < std::size(partition::kTable33Heights); ++i) {
    add(TreeKind::Bsp, partition::kTable33Heights[i], partition::kTable33PrintedW[i]);
  }
  for (std::size_t i = 0; i < std::size(partition::kTable34Heights); ++i) {
    add(TreeKind::Octree, partition::kTable34Heights[i], partition::kTable34PrintedW[i]);
  }
  return columns;
}

struct Model {
  std::string name;
  mesh::TriangleMesh mesh;
};

std::vector<Model> models(bool quick) {
  std::vector<Model> all;
  all.push_back({fmt::format("back of {}", counted(kBackTriangles)), backModel()});
  if (quick) return all;
  all.push_back({fmt::format("hand of {}", counted(kHandTriangles)), handModel()});
  all.push_back({"back of 20,389", backModel(20389)});
  all.push_back({"back of 41,582", backModel(41582)});
  return all;
}

struct Case {
  std::string model;
  TreeKind tree = TreeKind::Bsp;
  Index threshold = 0;
  int part = 0;
  SearchSweep sweep;
};

struct Results {
  std::vector<WorstColumn> columns;
  std::vector<Case> cases;
  std::string largest_model;
};

void sweepModel(const Model& model, std::size_t most_places, std::vector<Case>& cases) {
  for (const TreeKind tree : kTrees) {
    for (const int threshold : kThresholds) {
      if (static_cast<std::size_t>(threshold) >= model.mesh.triangles.size()) continue;
      const auto most = static_cast<Index>(threshold);
      const partition::Partition built = partition::buildPartition(model.mesh, {.tree = tree, .threshold = most});
      const double longest = built.bounds.sizes().maxCoeff();
      for (const int part : kParts) {
        cases.push_back({model.name, tree, most, part, sweepSearches(model.mesh, built, longest / part, most_places)});
      }
    }
  }
}

Results measured(const StudySettings& settings) {
  Results results;
  report(settings.progress, "complete trees", 0.0);
  results.columns = worstColumns();
  const std::vector<Model> all = models(settings.quick);
  for (std::size_t i = 0; i < all.size(); ++i) {
    report(settings.progress, "searches in the " + all[i].name,
           0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(all.size()));
    sweepModel(all[i], settings.quick ? 100 : 1500, results.cases);
  }
  results.largest_model = all.back().name;
  return results;
}

template <class Wanted>
std::vector<const Case*> casesWhere(const Results& results, const Wanted& wanted) {
  std::vector<const Case*> found;
  for (const Case& one : results.cases) {
    if (wanted(one)) found.push_back(&one);
  }
  return found;
}

const Case& printedCase(const Results& results, const std::string& model, TreeKind tree) {
  return *casesWhere(results, [&](const Case& one) {
            return one.model == model && one.tree == tree && one.threshold == kPrintedThreshold &&
                   one.part == kPrintedPart;
          }).front();
}

// --- figures

Series worstSeries(const Results& results, TreeKind tree, const std::string& name, double WorstColumn::*value) {
  Series series{.name = name};
  for (const WorstColumn& column : results.columns) {
    if (column.tree != tree) continue;
    series.x.push_back(column.height);
    series.y.push_back(column.*value);
  }
  return series;
}

Plot worstPlot(const Results& results) {
  Plot plot{.title = "w on complete trees, one leaf found"};
  plot.x = {.label = "height of the tree", .from = 1.0, .to = 11.0};
  plot.y = {.label = "w", .from = 0.0};
  for (const TreeKind tree : kTrees) {
    const bool bsp = tree == TreeKind::Bsp;
    Series counted = worstSeries(results, tree, fmt::format("{}, counted", nameOf(tree)), &WorstColumn::counted);
    counted.marker = bsp ? Marker::circle : Marker::square;
    Series printed = worstSeries(results, tree, bsp ? "Table 3.3" : "Table 3.4", &WorstColumn::printed);
    printed.stroke = Stroke::none;
    printed.marker = bsp ? Marker::cross : Marker::diamond;
    printed.colour = figures::kInk;
    plot.series.push_back(counted);
    plot.series.push_back(printed);
  }
  return plot;
}

// What m of n leaves cost at most on a complete tree: nodes on paths, and boxes tested.
Series boundSeries(const std::string& name, TreeKind tree, int height, bool tested) {
  Series bound{.name = name, .stroke = Stroke::dashed, .colour = tested ? figures::kVermilion : figures::kBlue};
  const double leaves = static_cast<double>(partition::leavesOfCompleteTree(arityOf(tree), height));
  for (double found = 1.0; found <= leaves; found += std::max(1.0, leaves / 200.0)) {
    const auto m = static_cast<std::uint64_t>(found);
    const auto nodes = tested ? partition::mostNodesTested(arityOf(tree), height, m)
                              : partition::mostNodesOnPaths(arityOf(tree), height, m);
    bound.x.push_back(found / leaves);
    bound.y.push_back(static_cast<double>(nodes) / leaves);
  }
  return bound;
}

Series straight(const std::string& name, const Vec2& from, const Vec2& to) {
  return {.name = name,
          .x = {from.x(), to.x()},
          .y = {from.y(), to.y()},
          .stroke = Stroke::dotted,
          .colour = figures::kInk,
          .width_px = 1.4};
}

// Every search of the largest model: its share of leaves found and what it cost.
Plot sharePlot(const Results& results, TreeKind tree) {
  const int height = tree == TreeKind::Bsp ? partition::kBspWorstHeight : partition::kOctreeWorstHeight;
  const double steepness = printedCost(tree) / partition::kWorstLeafRatio;
  Plot plot{.title = fmt::format("The {}: cost over the leaves found", nameOf(tree))};
  plot.x = {.label = "leaves found over all leaves, m / n", .from = 0.0, .to = 1.0};
  plot.y = {.label = "cost over all leaves, c / n", .from = 0.0, .to = 2.2};
  Series paths{.name = "real models: nodes on the ways",
               .stroke = Stroke::none,
               .marker = Marker::circle,
               .colour = figures::withAlpha(figures::kBlue, 0.35)};
  Series tested{.name = "boxes tested",
                .stroke = Stroke::none,
                .marker = Marker::circle,
                .colour = figures::withAlpha(figures::kVermilion, 0.35)};
  for (const Case* one :
       casesWhere(results, [&](const Case& a) { return a.tree == tree && a.sweep.leaves >= kFewestLeaves; })) {
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {  // of the queries ordered by leaves: a few of the many
      std::vector<SearchCount> queries = one->sweep.queries;
      const auto at = queries.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(queries.size() - 1));
      std::nth_element(queries.begin(), at, queries.end(),
                       [](const SearchCount& a, const SearchCount& b) { return a.leaves_found < b.leaves_found; });
      paths.x.push_back(at->leaves_found / one->sweep.leaves);
      paths.y.push_back(at->on_paths / one->sweep.leaves);
      tested.x.push_back(at->leaves_found / one->sweep.leaves);
      tested.y.push_back(at->tested / one->sweep.leaves);
    }
  }
  plot.series = {paths,
                 tested,
                 boundSeries(fmt::format("most nodes on ways, height {}", height), tree, height, false),
                 boundSeries(fmt::format("most boxes tested, height {}", height), tree, height, true),
                 straight(tree == TreeKind::Bsp ? "(3.5): 0.8 n at m = 0.1 n" : "(3.9): 0.4 n at m = 0.1 n", {0.0, 0.0},
                          {2.2 / steepness, 2.2}),
                 straight("list of leaves: n", {0.0, 1.0}, {1.0, 1.0})};
  plot.series.back().stroke = Stroke::solid;
  plot.places = {{{partition::kWorstLeafRatio, printedCost(tree)}, "printed worst case", Marker::diamond}};
  return plot;
}

// How the cost grows with the number of leaves, for every size of the detecting box.
Plot growthPlot(const Results& results, TreeKind tree) {
  Plot plot{.title = fmt::format("{}, {} triangles: boxes tested at worst",
                                 tree == TreeKind::Bsp ? "BSP tree" : "Octree", results.largest_model)};
  plot.x = {.label = "leaves of the tree, n", .scale = Scale::logarithmic};
  plot.y = {.label = "boxes tested", .scale = Scale::logarithmic};
  double most = 1.0;
  double least = 1e9;
  for (const int part : kParts) {
    Series series{.name = fmt::format("HDB 1/{}", part), .marker = Marker::circle};
    for (const Case* one : casesWhere(results, [&](const Case& a) {
           return a.tree == tree && a.part == part && a.model == results.largest_model;
         })) {
      series.x.push_back(one->sweep.leaves);
      series.y.push_back(one->sweep.worst.tested);
      most = std::max(most, one->sweep.leaves);
      least = std::min(least, one->sweep.leaves);
    }
    plot.series.push_back(series);
  }
  plot.series.push_back(straight("list of leaves: n", {least, least}, {most, most}));
  const double printed = printedCost(tree);
  plot.series.push_back(straight(tree == TreeKind::Bsp ? "(3.5): 0.8 n" : "(3.9): 0.4 n", {least, printed * least},
                                 {most, printed * most}));
  plot.series.back().stroke = Stroke::dashed;
  return plot;
}

// How many of the leaves a detecting box meets: the r that the text takes as 0.1.
Plot ratioPlot(const Results& results) {
  Plot plot{.title = "Share of the leaves that the HDB meets (octree, 1024)"};
  plot.x = {.label = "edge of the HDB over the model's longest edge"};
  for (const int part : kParts) plot.x.ticks.push_back({1.0 / part, fmt::format("1/{}", part)});
  plot.x.from = 0.0;
  plot.x.to = 0.55;
  plot.y = {.label = "r = m / n, mean", .from = 0.0, .to = 1.0};
  std::vector<std::string> names;
  for (const Case& one : results.cases) {
    if (std::find(names.begin(), names.end(), one.model) == names.end()) names.push_back(one.model);
  }
  for (const std::string& name : names) {
    Series series{.name = name, .marker = Marker::circle};
    for (const Case* one : casesWhere(results, [&](const Case& a) {
           return a.tree == TreeKind::Octree && a.model == name && a.threshold == kPrintedThreshold;
         })) {
      series.x.push_back(1.0 / one->part);
      series.y.push_back(one->sweep.mean.leaves_found / one->sweep.leaves);
    }
    plot.series.push_back(series);
  }
  plot.series.push_back(straight("3.3.4: 0.1", {0.0, 0.1}, {0.55, 0.1}));
  return plot;
}

std::vector<StudyFigure> figuresOf(const Results& results) {
  const Figure shares{.panels = {sharePlot(results, TreeKind::Bsp), sharePlot(results, TreeKind::Octree)},
                      .columns = 2,
                      .panel_height_px = 430.0};
  const Figure growth{.panels = {growthPlot(results, TreeKind::Bsp), growthPlot(results, TreeKind::Octree)},
                      .columns = 2,
                      .panel_height_px = 400.0};
  const Figure worst{.panels = {worstPlot(results), ratioPlot(results)}, .columns = 2};
  return {
      {"complexity_w",
       "Left: w of Tables 3.3 and 3.4, printed and counted. Right: the share of leaves that a search "
       "finds, which the text takes as 0.1 at most.",
       worst},
      {"complexity_share",
       "Every point is a search of a real model over thresholds and sizes of the detecting box; "
       "dashed: the most that a complete tree of the printed height can cost.",
       shares},
      {"complexity_growth", "The worst search over the number of leaves, by the size of the detecting box.", growth}};
}

// --- words

StudyTable wTable(const Results& results) {
  StudyTable table{"complexity_table_w", "Worst w: printed, closed form, counted on a complete tree.", {}};
  table.table.headings = {"tree", "height", "printed", "closed form", "counted", "verdict"};
  for (const WorstColumn& column : results.columns) {
    const bool same = fmt::format("{:.2f}", column.counted) == fmt::format("{:.2f}", column.printed);
    table.table.rows.push_back({nameOf(column.tree), fmt::format("{}", column.height),
                                fmt::format("{:.2f}", column.printed), fmt::format("{:.4f}", column.closed),
                                fmt::format("{:.4f}", column.counted), same ? "reproduced" : "misprint (E13)"});
  }
  return table;
}

StudyTable casesTable(const Results& results) {
  StudyTable table{"complexity_searches", "All counted searches.", {}, false};
  table.table.headings = {"model",       "tree",        "threshold",  "hdb_part",       "height",   "leaves",
                          "nodes",       "found_mean",  "found_max",  "ways_mean",      "ways_max", "entered_mean",
                          "entered_max", "tested_mean", "tested_max", "ways_over_bound"};
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  for (const Case& one : results.cases) {
    const SearchSweep& sweep = one.sweep;
    table.table.rows.push_back({one.model, nameOf(one.tree), fmt::format("{}", one.threshold),
                                fmt::format("1/{}", one.part), fmt::format("{}", sweep.height), number(sweep.leaves),
                                number(sweep.nodes), number(sweep.mean.leaves_found), number(sweep.worst.leaves_found),
                                number(sweep.mean.on_paths), number(sweep.worst.on_paths), number(sweep.mean.entered),
                                number(sweep.worst.entered), number(sweep.mean.tested), number(sweep.worst.tested),
                                number(sweep.worst_over_bound)});
  }
  return table;
}

StudyTable quarterTable(const Results& results) {
  StudyTable table{"complexity_quarter",
                   "Searches with the dissertation's box (1/4) and threshold (1024); cost over the number of leaves n. "
                   "Printed: c at most 0.8 n and 0.4 n.",
                   {}};
  table.table.headings = {"model",
                          "tree",
                          "height",
                          "leaves n",
                          "found, mean",
                          "found, most",
                          "nodes on ways, most",
                          "boxes tested, mean",
                          "boxes tested, most"};
  for (const Case* one :
       casesWhere(results, [](const Case& a) { return a.threshold == kPrintedThreshold && a.part == kPrintedPart; })) {
    const SearchSweep& sweep = one->sweep;
    const auto share = [&](double count) { return fmt::format("{:.2f} n", count / sweep.leaves); };
    table.table.rows.push_back({one->model, nameOf(one->tree), fmt::format("{}", sweep.height),
                                fmt::format("{:.0f}", sweep.leaves), share(sweep.mean.leaves_found),
                                share(sweep.worst.leaves_found), share(sweep.worst.on_paths), share(sweep.mean.tested),
                                share(sweep.worst.tested)});
  }
  return table;
}

// The share of found leaves from which a tree tests more boxes on average than a list of its leaves has.
double shareWhereListWins(const Results& results, TreeKind tree) {
  constexpr std::size_t kBins = 20;
  std::array<double, kBins> tested{};
  std::array<double, kBins> searches{};
  for (const Case& one : results.cases) {
    if (one.tree != tree || one.sweep.leaves < kFewestLeaves) continue;
    for (const SearchCount& query : one.sweep.queries) {
      const double share = query.leaves_found / one.sweep.leaves;
      const auto bin = std::min(kBins - 1, static_cast<std::size_t>(share * kBins));
      tested[bin] += query.tested / one.sweep.leaves;
      searches[bin] += 1.0;
    }
  }
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (tested[bin] > searches[bin]) return static_cast<double>(bin) / kBins;
  }
  return 1.0;
}

// The smallest tree from which on no search tested more than the printed worst case; 0 where the largest still does.
double leavesFromWhichPrintedHolds(const Results& results, TreeKind tree) {
  double from = 0.0;
  for (const Case* one : casesWhere(results, [&](const Case& a) {
         return a.tree == tree && a.part == kPrintedPart && a.model == results.largest_model;
       })) {  // large trees first
    if (one->sweep.worst.tested > printedCost(tree) * one->sweep.leaves) break;
    from = one->sweep.leaves;
  }
  return from;
}

double mostNodesPerLeaf(const Results& results, TreeKind tree) {
  double most = 0.0;
  for (const Case& one : results.cases) {
    if (one.tree == tree && one.sweep.leaves >= kFewestLeaves)
      most = std::max(most, one.sweep.nodes / one.sweep.leaves);
  }
  return most;
}

double worstBoundRatio(const Results& results) {
  double worst = 0.0;
  for (const Case& one : results.cases) worst = std::max(worst, one.sweep.worst_over_bound);
  return worst;
}

// The height from which the printed estimate r w nodes exceeds n by itself.
int heightAboveLinear(TreeKind tree) {
  const int arity = arityOf(tree);
  for (int height = 1; height < 20; ++height) {
    if (partition::visitedPerLeaf(arity, partition::kWorstLeafRatio, partition::worstSearch(arity, height).w) > 1.0) {
      return height;
    }
  }
  return 0;
}

// The exponent of the growth of the worst search with n, between the largest and the smallest threshold.
double growthExponent(const Results& results, TreeKind tree, int part) {
  const auto cases = casesWhere(
      results, [&](const Case& a) { return a.tree == tree && a.part == part && a.model == results.largest_model; });
  const SearchSweep& fine = cases.front()->sweep;
  const SearchSweep& coarse = cases.back()->sweep;
  return std::log(fine.worst.tested / coarse.worst.tested) / std::log(fine.leaves / coarse.leaves);
}

std::size_t reproducedColumns(const Results& results) {
  return static_cast<std::size_t>(
      std::count_if(results.columns.begin(), results.columns.end(), [](const WorstColumn& column) {
        return fmt::format("{:.2f}", column.counted) == fmt::format("{:.2f}", column.printed);
      }));
}

std::string holdsFrom(const Results& results, TreeKind tree) {
  const double leaves = leavesFromWhichPrintedHolds(results, tree);
  return leaves == 0.0 ? fmt::format("not even in the largest {}", nameOf(tree))
                       : fmt::format("from {:.0f} leaves on in the {}", leaves, nameOf(tree));
}

std::string costFinding(const Results& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  return fmt::format(
      "0.8 n and 0.4 n are no worst cases at the dissertation's own threshold. On the {} triangles (1024, box of 1/4) "
      "the "
      "nodes on the ways come to {:.2f} n at most in the BSP tree and {:.2f} n in the octree. A program must also test "
      "the other children of every node that it enters: up to {:.2f} n and {:.2f} n boxes, {:.2f} n and {:.2f} n on "
      "average. With smaller leaves the estimates do hold for the boxes tested, {} and {}.",
      results.largest_model, bsp.worst.on_paths / bsp.leaves, octree.worst.on_paths / octree.leaves,
      bsp.worst.tested / bsp.leaves, octree.worst.tested / octree.leaves, bsp.mean.tested / bsp.leaves,
      octree.mean.tested / octree.leaves, holdsFrom(results, TreeKind::Bsp), holdsFrom(results, TreeKind::Octree));
}

std::string shareFinding(const Results& results) {
  const SearchSweep& large = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  const SearchSweep& small = printedCase(results, results.cases.front().model, TreeKind::Octree).sweep;
  return fmt::format(
      "They assume that at most a tenth of the leaves meet the detecting box. With a box of 1/4 and leaves of 1024 it "
      "is "
      "{:.2f} of them on average and {:.2f} at most in the octree of the {} triangles, {:.2f} and {:.2f} for the {}. A "
      "back is a sheet, and leaves are as large as the box itself while there are few of them.",
      large.mean.leaves_found / large.leaves, large.worst.leaves_found / large.leaves, results.largest_model,
      small.mean.leaves_found / small.leaves, small.worst.leaves_found / small.leaves, results.cases.front().model);
}

std::string linearFinding(const Results& results) {
  return fmt::format(
      "\"Better than the n of linear searching\": on average until {} of the leaves are found in the BSP tree and {} "
      "in the "
      "octree; beyond, a list of the leaves would test fewer boxes. But no box is tested twice, so a search can never "
      "cost "
      "more than the tree has nodes (up to {:.2f} n and {:.2f} n here). It stays O(n); the worst case \"over O(n)\" of "
      "which "
      "3.4.2 warns cannot happen.",
      percent(shareWhereListWins(results, TreeKind::Bsp)), percent(shareWhereListWins(results, TreeKind::Octree)),
      mostNodesPerLeaf(results, TreeKind::Bsp), mostNodesPerLeaf(results, TreeKind::Octree));
}

std::string treesFinding(const Results& results) {
  const SearchSweep& bsp = printedCase(results, results.largest_model, TreeKind::Bsp).sweep;
  const SearchSweep& octree = printedCase(results, results.largest_model, TreeKind::Octree).sweep;
  return fmt::format(
      "\"0.4 n is better than 0.8 n\" compares different n: at the same threshold the octree of the {} triangles has "
      "{:.0f} "
      "leaves and the BSP tree {:.0f}, and a search tests {:.0f} boxes in the one and {:.0f} in the other.",
      results.largest_model, octree.leaves, bsp.leaves, octree.mean.tested, bsp.mean.tested);
}

std::vector<std::string> findingsOf(const Results& results) {
  return {
      fmt::format("Counted node by node on complete trees, w is what the closed form says, and {} of the {} printed "
                  "values come out; the others are misprints in the last digit (E13).",
                  reproducedColumns(results), results.columns.size()),
      costFinding(results),
      shareFinding(results),
      linearFinding(results),
      treesFinding(results),
      fmt::format(
          "The estimate r w nodes multiplies the worst r with the worst w, which never meet: w is that of a single "
          "leaf. So it passes n by itself from height {} of the BSP tree and {} of the octree on. The true most, "
          "the nodes on the ways to m leaves, was kept by every search counted (the nearest came to {:.2f} of "
          "it).",
          heightAboveLinear(TreeKind::Bsp), heightAboveLinear(TreeKind::Octree), worstBoundRatio(results)),
      fmt::format(
          "Over the thresholds the worst search grows with the leaves like n to the power {:.2f} (BSP) and {:.2f} "
          "(octree) for a box of 1/4, {:.2f} and {:.2f} for 1/16. The cost is that of the leaves found and the "
          "ways to them, m + m log(n / m), not that of the tree.",
          growthExponent(results, TreeKind::Bsp, 4), growthExponent(results, TreeKind::Octree, 4),
          growthExponent(results, TreeKind::Bsp, 16), growthExponent(results, TreeKind::Octree, 16))};
}

std::vector<std::pair<std::string, double>> numbersOf(const Results& results) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const TreeKind tree : kTrees) {
    const SearchSweep& sweep = printedCase(results, results.largest_model, tree).sweep;
    const std::string name = indexOf(tree) == 0 ? "bsp" : "octree";
    numbers.emplace_back(name + "_leaf_ratio_mean", sweep.mean.leaves_found / sweep.leaves);
    numbers.emplace_back(name + "_leaf_ratio_max", sweep.worst.leaves_found / sweep.leaves);
    numbers.emplace_back(name + "_ways_over_n_max", sweep.worst.on_paths / sweep.leaves);
    numbers.emplace_back(name + "_tested_over_n_max", sweep.worst.tested / sweep.leaves);
    numbers.emplace_back(name + "_list_wins_from_leaf_ratio", shareWhereListWins(results, tree));
  }
  numbers.emplace_back("ways_over_bound_max", worstBoundRatio(results));
  return numbers;
}

}  // namespace

StudyPage studyComplexity(const StudySettings& settings) {
  const Results results = measured(settings);
  StudyPage page;
  page.title = "What a search for the leaves costs";
  page.question =
      "Sections 3.3.4 and 3.4.2 estimate the cost of finding the leaves around the proxy as 0.8 n boxes for the BSP "
      "tree "
      "and 0.4 n for the octree, n being the leaves, from a worst case w (Tables 3.3 and 3.4) and a share r = 0.1 of "
      "leaves found. What do searches really visit, and where do the claims stand?";
  page.findings = findingsOf(results);
  page.method = {
      "Complete trees are made from small triangles in the cells of a regular division. Real models are the built-in "
      "back and hand, which stand in for the unpublished ones, with case C; the proxy stands on up to 1500 vertices "
      "each. A search enters a node whose tight box meets the detecting box. Counted are the nodes on the ways to the "
      "leaves found (the text's c) and the boxes tested (what a program does). Only trees of 30 leaves or more count "
      "where a list is compared."};
  page.figures = figuresOf(results);
  page.tables = {wTable(results), quarterTable(results), casesTable(results)};
  page.numbers = numbersOf(results);
  return page;
}

}  // namespace palpate::study
