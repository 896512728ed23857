// Figure 3.11: the search that ends in one leaf of a complete tree.
#include <fmt/format.h>

#include "dissertation/cost/complexity.h"
#include "dissertation/figures/dissertation_figures.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

constexpr int kHeight = 3;

// Nodes of a level are in the middle of the leaves below them.
Vec2 nodePlace(int level, int index) {
  const double width = static_cast<double>(1 << (kHeight - level));
  return {width * (index + 0.5), static_cast<double>(kHeight - level)};
}

bool isVisited(int level, int index) { return index == (5 >> (kHeight - level)); }  // the way to leaf 5

Plot treePlot() {
  const WorstSearch search = worstSearch(kBspArity, kHeight);
  Plot plot{.title = fmt::format("{:g} of {:g} nodes for one of {:g} leaves: w = {:.2f}", search.visited, search.nodes,
                                 search.leaves, search.w)};
  plot.x = {.from = 0.0, .to = 8.0, .hidden = true};
  plot.y = {.from = -0.5, .to = 3.5, .hidden = true};
  figures::Shape edges{.closed = false, .colour = figures::kInk};
  figures::Series visited{.name = "visited",
                          .stroke = figures::Stroke::none,
                          .marker = figures::Marker::circle,
                          .colour = figures::kVermilion};
  figures::Series others{.name = "not visited",
                         .stroke = figures::Stroke::none,
                         .marker = figures::Marker::circle,
                         .colour = figures::kBlue};
  for (int level = 0; level <= kHeight; ++level) {
    for (int index = 0; index < (1 << level); ++index) {
      const Vec2 at = nodePlace(level, index);
      figures::Series& series = isVisited(level, index) ? visited : others;
      series.x.push_back(at.x());
      series.y.push_back(at.y());
      if (level > 0) edges.paths.push_back({nodePlace(level - 1, index / 2), at});
    }
  }
  plot.shapes = {edges};
  plot.series = {visited, others};
  return plot;
}

Plot worstPlot() {
  Plot plot{.title = "w by the height of the tree"};
  plot.x = {.label = "height"};
  plot.y = {.label = "w", .from = 0.0};
  figures::Series bsp{.name = "BSP tree (Table 3.3)", .marker = figures::Marker::circle};
  for (const int height : kTable33Heights) {
    bsp.x.push_back(height);
    bsp.y.push_back(worstSearch(kBspArity, height).w);
  }
  figures::Series octree{.name = "octree (Table 3.4)", .marker = figures::Marker::square};
  for (const int height : kTable34Heights) {
    octree.x.push_back(height);
    octree.y.push_back(worstSearch(kOctreeArity, height).w);
  }
  plot.series = {bsp, octree};
  return plot;
}

Figure figure311() { return {.panels = {treePlot(), worstPlot()}, .columns = 2}; }

}  // namespace

std::vector<DissertationFigure> searchFigures() {
  return {{"3.11", "Nodes on the way to a single leaf, and w for the heights of Tables 3.3 and 3.4",
           "The right panel is added.", figure311}};
}

}  // namespace palpate::study
