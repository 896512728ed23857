// A figure: one or several panels, written as PNG and as SVG by the same drawing code.
//
// Based on: cairo, https://www.cairographics.org (the only place of this project that uses it).
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "report/charts/mesh_view.h"
#include "report/charts/plot.h"

namespace palpate::figures {

using Panel = std::variant<Plot, MeshView>;

struct Figure {
  std::string title{};  ///< above all panels
  std::vector<Panel> panels{};
  int columns = 1;
  /// Size of one panel, in CSS pixels (1/96 inch); text is 12 of them high.
  double panel_width_px = 520.0;
  double panel_height_px = 380.0;
  std::string note{};  ///< below all panels, wrapped
};

/// PNG pixels a CSS pixel: sharp on today's screens and on paper.
inline constexpr double kPngScale = 2.0;

/// The file's bytes. Equal figures give equal bytes on the same machine (fonts are the system's).
std::string renderPng(const Figure& figure, double scale = kPngScale);
std::string renderSvg(const Figure& figure);

/// Throw Error naming the file when it cannot be written.
void writePng(const Figure& figure, const std::filesystem::path& file, double scale = kPngScale);
void writeSvg(const Figure& figure, const std::filesystem::path& file);

/// A drawn text, with the box it fills, in CSS pixels from the top left corner.
struct DrawnText {
  std::string text{};
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;
};

/// Every text of the drawing, in the order of painting: lets a test check that none covers another.
std::vector<DrawnText> collectDrawnTexts(const Figure& figure);

}  // namespace palpate::figures
