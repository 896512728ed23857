// Parts of a plot strip: curves, shades of contact, ticks of events, axes, a legend. Needs a window of Dear ImGui that
// has begun.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <span>
#include <vector>

#include "view/viewer/state/sample_history.h"

namespace palpate::viewer {

/// The field of a strip, points of the screen.
struct PlotArea {
  ImVec2 low;   ///< upper left
  ImVec2 high;  ///< lower right
  float width() const { return high.x - low.x; }
  float height() const { return high.y - low.y; }
  bool holds(const ImVec2& place) const {
    return place.x >= low.x && place.x <= high.x && place.y >= low.y && place.y <= high.y;
  }
};

// Inks of the theme, readable on light and dark.

/// Left blue and right red, as the fingers.
ImU32 fingerInk(std::size_t finger, float opacity = 1.0f);
inline constexpr float kPartOpacity = 0.6f;  ///< for the curves of a force's two parts
ImU32 limitInk();
/// Ink of the text.
ImU32 plotInk(float opacity = 1.0f);

struct CurveLook {
  ImU32 ink = 0;
  bool dotted = false;
};
/// A curve by the least and the greatest of each column, from 0 to `end`.
void drawExtents(std::span<const Extent> extents, const PlotArea& area, double end, const CurveLook& look);
/// The background of the columns in which the finger touched.
void shadeTouching(std::span<const ColumnMarks> marks, const PlotArea& area);
/// Short strokes at the foot where the finger slipped, at the top where its force was limited. Those of the second
/// finger are next to those of the first.
void drawEvents(std::span<const ColumnMarks> marks, const PlotArea& area, std::size_t finger);
/// Frame, the value at the top and in the middle, seconds before now below.
void drawPlotAxes(const PlotArea& area, double end, double window_s);
/// A horizontal line at a value within the axis.
void drawPlotLimit(const PlotArea& area, double limit, double end);
/// The number of lines of the legend in this width, and the height of one.
int plotLegendLines(float width, bool both_fingers);
inline constexpr float kPlotLegendLine = 18.0f;
void drawPlotLegend(const ImVec2& corner, float width, bool both_fingers);

}  // namespace palpate::viewer
