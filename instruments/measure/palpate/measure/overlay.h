// The overlay of a measurement's pictures, as plain lines, marks and texts: the command paints it with cairo, the
// window with its own lists, both the same.
//
//   Measurement ─ buildOverlay ─► Overlay (three panels, places in px of the pictures)
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/measure/measurement.h"

namespace palpate::measure {

/// Red, green, blue, 0 to 1, by role; distinguished also without colour (form of the mark, dashes).
struct OverlayColour {
  float red = 0.0f;
  float green = 0.0f;
  float blue = 0.0f;
  float opacity = 1.0f;
};

enum class MarkForm : unsigned char { ring, square, cross, star, dot };

struct OverlayLine {
  std::vector<Vec2> places_px;
  OverlayColour colour;
  float width = 1.0f;  ///< on a panel 400 wide
  bool dashed = false;
  bool closed = false;
  bool filled = false;  ///< its inside too, at a quarter of the opacity (a band: outer line, then inner reversed)
};

struct OverlayMark {
  Vec2 place_px = Vec2::Zero();
  MarkForm form = MarkForm::ring;
  OverlayColour colour;
  float radius = 4.0f;  ///< on a panel 400 wide
};

struct OverlayArrow {
  Vec2 from_px = Vec2::Zero();
  Vec2 to_px = Vec2::Zero();
  OverlayColour colour;
};

struct LegendEntry {
  std::string words;
  OverlayColour colour;
  bool is_line = false;  ///< else a mark
  bool dashed = false;
  MarkForm form = MarkForm::ring;
};

enum class PanelPicture : unsigned char { before, after, before_faded };

struct OverlayPanel {
  std::string title;
  PanelPicture picture = PanelPicture::before;
  std::vector<OverlayLine> lines;
  std::vector<OverlayMark> marks;
  std::vector<OverlayArrow> arrows;
  std::vector<LegendEntry> legend;
  /// A bar of 50 mm, as long as the skin's millimetres are in the middle of the dots; 0: not known.
  double scale_bar_px = 0.0;
};

struct Overlay {
  std::vector<OverlayPanel> panels;  ///< before: the grid; after: matched and hidden; displacement and ellipse
  std::string verdict;               ///< one line: accepted with the numbers, or refused
  bool accepted = false;
  std::vector<std::string> findings;  ///< one per line, after "refused:" or "warning:"
};

/// `arrow_scale`: how much longer than the true motion arrows are drawn.
Overlay buildOverlay(const Measurement& measurement, double arrow_scale = 3.0);

}  // namespace palpate::measure
