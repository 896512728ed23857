// Writes a map over a skin by the file's extension: .csv numbers, .ply the coloured surface, .png and .svg a picture of
// the map plane with contour lines, the key points, axes in mm and a legend.
#pragma once

#include <filesystem>
#include <utility>

#include "report/map/map_sources.h"

namespace palpate::app {

struct MapOutput {
  double grid_mm = 0.0;    ///< CSV: spacing of the rows on the map plane; 0: one row per vertex
  double png_scale = 2.0;  ///< PNG: pixels a CSS pixel
};

/// The range of the shown quantity: as requested, else that of the vertices; for a diverging map both ends equally far
/// from its middle, at most from 0 to twice of it.
std::pair<double, double> shownRange(const SkinMap& map);

/// Throws Error for another extension and for a file that cannot be written.
void writeMap(const std::filesystem::path& file, const MapSkin& skin, const SkinMap& map, const MapOutput& output);

/// Throws Error unless writeMap could write a file with this name.
void requireMapFile(const std::filesystem::path& file);

}  // namespace palpate::app
