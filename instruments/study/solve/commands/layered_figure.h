// Tables of layered tissue as pictures: the pressed skin, its sideways motion, the force, the width of the dent.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/tissue/layered_table.h"
#include "report/charts/figure.h"

namespace palpate::app {

struct NamedTable {
  std::string name;
  tissue::LayeredTable table;
};

struct LayeredFigureSettings {
  std::string title;
  std::optional<double> depth_mm;  ///< shapes' depth; none: every depth of one table, the deepest that several share
  double to_radius_mm = 60.0;
};

/// Plots over the distance from the axis at rest: the skin's height, and its way outwards.
figures::Plot skinDownPlot();
figures::Plot skinSidewaysPlot();

/// Colours depth `i` of `count`, from dark to light; the lightest of the map cannot be read on white.
figures::Colour depthColour(std::size_t i, std::size_t count);

/// One table: its shapes by depth. Several: all of them at one depth, and their forces by depth.
figures::Figure layeredFigure(const std::vector<NamedTable>& tables, const LayeredFigureSettings& settings);

}  // namespace palpate::app
