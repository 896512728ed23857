// What a strip of the plots is made of: curves, shades of contact, ticks of events, axes, a legend. Needs a window of
// Dear ImGui that has begun.
#pragma once

#include <imgui.h>

#include <array>
#include <span>
#include <vector>

#include "apps/viewer/plots/sample_history.h"

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

/// Left blue and right red, as the fingers; the tangential force is paler.
inline constexpr std::array<ImU32, 2> kFingerInk = {IM_COL32(110, 165, 255, 255), IM_COL32(255, 120, 105, 255)};
inline constexpr std::array<ImU32, 2> kFingerPaleInk = {IM_COL32(110, 165, 255, 110), IM_COL32(255, 120, 105, 110)};
inline constexpr ImU32 kLimitInk = IM_COL32(230, 160, 60, 255);

/// Of the theme's text, so that it is seen on light and dark.
ImU32 plotInk(float opacity = 1.0f);

/// A curve by the least and the greatest of each column, from 0 to `end`.
void drawExtents(std::span<const Extent> extents, const PlotArea& area, double end, ImU32 ink);
/// The background of the columns in which the finger touched.
void shadeTouching(std::span<const ColumnMarks> marks, const PlotArea& area);
/// Short strokes at the foot where the finger slipped, at the top where its force was limited. Those of the second
/// finger stand beside those of the first.
void drawEvents(std::span<const ColumnMarks> marks, const PlotArea& area, std::size_t finger);
/// Frame, the value at the top and in the middle, seconds before now below.
void drawPlotAxes(const PlotArea& area, double end, double window_s);
/// A horizontal line at a value that lies within the axis.
void drawPlotLimit(const PlotArea& area, double limit, double end);
/// One line that explains all the above, as far as there is room.
void drawPlotLegend(const ImVec2& corner, float width, bool both_fingers);

}  // namespace palpate::viewer
