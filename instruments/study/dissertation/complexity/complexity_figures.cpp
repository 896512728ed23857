// The pictures of the complexity study.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "dissertation/complexity/complexity_results.h"
#include "dissertation/cost/complexity.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using hdb::TreeKind;

Series worstSeries(const ComplexityResults& results, TreeKind tree, const std::string& name,
                   double WorstColumn::*value) {
  Series series{.name = name};
  for (const WorstColumn& column : results.columns) {
    if (column.tree != tree) continue;
    series.x.push_back(column.height);
    series.y.push_back(column.*value);
  }
  return series;
}

Plot worstPlot(const ComplexityResults& results) {
  Plot plot{.title = "w on complete trees, one leaf found"};
  plot.x = {.label = "height of the tree", .from = 1.0, .to = 11.0};
  plot.y = {.label = "w", .from = 0.0};
  for (const TreeKind tree : kTrees) {
    const bool bsp = tree == TreeKind::Bsp;
    Series counted = worstSeries(results, tree, fmt::format("{}, counted", titleOf(tree)), &WorstColumn::counted);
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

// Largest cost of m of n leaves on a complete tree: nodes on paths, and boxes tested.
Series boundSeries(const std::string& name, TreeKind tree, int height, bool tested) {
  Series bound{.name = name, .stroke = Stroke::dashed, .colour = tested ? figures::kVermilion : figures::kBlue};
  const double leaves = static_cast<double>(leavesOfCompleteTree(treeArity(tree), height));
  for (double found = 1.0; found <= leaves; found += std::max(1.0, leaves / 200.0)) {
    const auto m = static_cast<std::uint64_t>(found);
    const auto nodes =
        tested ? mostNodesTested(treeArity(tree), height, m) : mostNodesOnPaths(treeArity(tree), height, m);
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

// Every search of the largest model: its share of leaves found and its cost.
Plot sharePlot(const ComplexityResults& results, TreeKind tree) {
  const int height = tree == TreeKind::Bsp ? kBspWorstHeight : kOctreeWorstHeight;
  const double steepness = printedCost(tree) / kWorstLeafRatio;
  Plot plot{.title = fmt::format("The {}: cost over the leaves found", titleOf(tree))};
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
  for (const SearchCase* one :
       casesWhere(results, [&](const SearchCase& a) { return a.tree == tree && a.sweep.leaves >= kFewestLeaves; })) {
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {  // shares of the queries ordered by leaves: a few of the many
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
  plot.places = {{{kWorstLeafRatio, printedCost(tree)}, "printed worst case", Marker::diamond}};
  return plot;
}

// How the cost grows with the number of leaves, for every size of the detecting box.
Plot growthPlot(const ComplexityResults& results, TreeKind tree) {
  std::string name = titleOf(tree);
  name[0] = static_cast<char>(std::toupper(name[0]));
  Plot plot{.title = fmt::format("{}, {} triangles: boxes tested at worst", name, results.largest_model)};
  plot.x = {.label = "leaves of the tree, n", .scale = Scale::logarithmic};
  plot.y = {.label = "boxes tested", .scale = Scale::logarithmic};
  Extent leaves;
  for (const int part : kBoxParts) {
    Series series{.name = fmt::format("HDB 1/{}", part), .marker = Marker::circle};
    for (const SearchCase* one : casesWhere(results, [&](const SearchCase& a) {
           return a.tree == tree && a.part == part && a.model == results.largest_model;
         })) {
      series.x.push_back(one->sweep.leaves);
      series.y.push_back(one->sweep.worst.tested);
      leaves.add(one->sweep.leaves);
    }
    plot.series.push_back(series);
  }
  const auto [least, most] = leaves;
  plot.series.push_back(straight("list of leaves: n", {least, least}, {most, most}));
  const double printed = printedCost(tree);
  plot.series.push_back(straight(tree == TreeKind::Bsp ? "(3.5): 0.8 n" : "(3.9): 0.4 n", {least, printed * least},
                                 {most, printed * most}));
  plot.series.back().stroke = Stroke::dashed;
  return plot;
}

// How many of the leaves a detecting box meets: the r that the text takes as 0.1.
Plot ratioPlot(const ComplexityResults& results) {
  Plot plot{.title = "Share of the leaves that the HDB meets (octree, 1024)"};
  plot.x = {.label = "edge of the HDB over the model's longest edge"};
  for (const int part : kBoxParts) plot.x.ticks.push_back({1.0 / part, fmt::format("1/{}", part)});
  plot.x.from = 0.0;
  plot.x.to = 0.55;
  plot.y = {.label = "r = m / n, mean", .from = 0.0, .to = 1.0};
  std::vector<std::string> names;
  for (const SearchCase& one : results.cases) {
    if (std::find(names.begin(), names.end(), one.model) == names.end()) names.push_back(one.model);
  }
  for (const std::string& name : names) {
    Series series{.name = name, .marker = Marker::circle};
    for (const SearchCase* one : casesWhere(results, [&](const SearchCase& a) {
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

}  // namespace

std::vector<StudyFigure> complexityFigures(const ComplexityResults& results) {
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
}  // namespace palpate::study
