// The sheet to punch, at true size: holes where the dots go, as SVG in millimetres.
//
//   StencilSettings ─ stencilSheets ─► one SVG a sheet of paper ─► printed at 100 %, laid over plastic, punched
//
// Holes lie on columns and rows; the marks for the contact lie between four of them, where no dot touches the stick's.
#pragma once

#include <string>
#include <vector>

#include "palpate/base/vec.h"

namespace palpate::measure {

enum class StencilPage : unsigned char {
  fitting,  ///< the smallest of A4, A3, A2 that holds it, else sheets of A4
  a4,
  a3,
  a2,
  tiled_a4,  ///< as many sheets of A4 as are needed, to be glued at their crosses
};

struct StencilSettings {
  double spacing_mm = 30.0;  ///< 5 to 100
  int columns = 11;          ///< 2 to 60
  int rows = 13;
  double hole_mm = 8.0;  ///< across; less than half the spacing
  StencilPage page = StencilPage::fitting;
  bool scale_target = false;  ///< a ruler of 100 mm to cut out and tape onto the skin next to the dots
};

/// Holes and contact marks, mm from the stencil's lower left hole, x to the right, y towards the head.
std::vector<Vec2> stencilHoles(const StencilSettings& settings);
/// In the middle of a mesh: that of the whole stencil, and two further ones above and below it where there is room.
std::vector<Vec2> contactMarks(const StencilSettings& settings);

struct StencilSheet {
  std::string name;  ///< name of a tile: "r1c2", row from the top, column from the left; empty: the only sheet
  std::string svg;
};

/// Throws Error for settings out of range, and for a page that does not hold the stencil, naming what would.
std::vector<StencilSheet> stencilSheets(const StencilSettings& settings);

}  // namespace palpate::measure
