#include "view/viewer/plots/plot_drawing.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kFaint = 0.16f;
constexpr float kTouching = 0.10f;
constexpr float kTick = 6.0f;   ///< length of an event's stroke, points
constexpr float kDot = 3.0f;    ///< length of a dot and of a gap
constexpr float kSign = 16.0f;  ///< length of a sign of the legend
constexpr float kSignGap = 5.0f;

ImDrawList& list() { return *ImGui::GetWindowDrawList(); }

float smallSize() { return 0.8f * ImGui::GetFontSize(); }

float smallWidth(const std::string& words) {
  return ImGui::GetFont()->CalcTextSizeA(smallSize(), 1e6f, 0.0f, words.c_str()).x;
}

/// `align` 0 puts the text to the right of the place, 1 to its left.
void smallText(const ImVec2& place, const std::string& words, float align = 0.0f) {
  list().AddText(ImGui::GetFont(), smallSize(), {place.x - align * smallWidth(words), place.y}, plotInk(),
                 words.c_str());
}

float columnAt(const PlotArea& area, std::size_t column, std::size_t columns) {
  return area.low.x + area.width() * static_cast<float>(column) / static_cast<float>(std::max<std::size_t>(1, columns));
}

// ---- the legend

using Sign = void (*)(const ImVec2& from, const ImVec2& to);
struct LegendEntry {
  const char* words;
  Sign sign;
  bool second_finger = false;  ///< only when there is one
};

void stroke(const ImVec2& from, const ImVec2& to, ImU32 ink) { list().AddLine(from, to, ink, 1.6f); }

void dots(const ImVec2& from, const ImVec2& to, ImU32 ink) {
  for (float x = from.x; x < to.x; x += 2.0f * kDot) list().AddLine({x, from.y}, {x + kDot, from.y}, ink, 1.6f);
}

void ticks(const ImVec2& from, const ImVec2& to, ImU32 ink) {
  for (const float x : {from.x + 3.0f, from.x + 7.0f, to.x - 3.0f}) {
    list().AddLine({x, from.y - 0.5f * kTick}, {x, from.y + 0.5f * kTick}, ink, 1.0f);
  }
}

constexpr LegendEntry kLegendEntries[] = {
    {toTranslate("left finger"), [](const ImVec2& a, const ImVec2& b) { stroke(a, b, fingerInk(0)); }},
    {toTranslate("right finger"), [](const ImVec2& a, const ImVec2& b) { stroke(a, b, fingerInk(1)); }, true},
    {toTranslate("normal force"), [](const ImVec2& a, const ImVec2& b) { stroke(a, b, fingerInk(0, kPartOpacity)); }},
    {toTranslate("sideways force"), [](const ImVec2& a, const ImVec2& b) { dots(a, b, fingerInk(0, kPartOpacity)); }},
    {toTranslate("touching"),
     [](const ImVec2& a, const ImVec2& b) {
       list().AddRectFilled({a.x, a.y - 5.0f}, {b.x, b.y + 5.0f}, plotInk(2.0f * kTouching));
     }},
    {toTranslate("slips"), [](const ImVec2& a, const ImVec2& b) { ticks(a, b, fingerInk(0)); }},
    {toTranslate("limit of the device"), [](const ImVec2& a, const ImVec2& b) { stroke(a, b, limitInk()); }},
    {toTranslate("beyond it"), [](const ImVec2& a, const ImVec2& b) { ticks(a, b, limitInk()); }},
    {toTranslate("moment read"),
     [](const ImVec2& a, const ImVec2& b) {
       const float x = 0.5f * (a.x + b.x);
       list().AddLine({x, a.y - kTick}, {x, b.y + kTick}, plotInk());
     }},
};

/// Calls `draw(entry, x, line)` for each entry in its place, line below line; returns the number of lines.
template <class Draw>
int layOutLegend(float width, bool both_fingers, const Draw& draw) {
  constexpr float kEntryGap = 14.0f;
  float x = 0.0f;
  int line = 0;
  for (const LegendEntry& entry : kLegendEntries) {
    if (entry.second_finger && !both_fingers) continue;
    const float needed = kSign + kSignGap + smallWidth(tr(entry.words));
    if (x > 0.0f && x + needed > width) {
      x = 0.0f;
      ++line;
    }
    draw(entry, x, line);
    x += needed + kEntryGap;
  }
  return line + 1;
}

}  // namespace

ImU32 fingerInk(std::size_t finger, float opacity) {
  const auto alpha = static_cast<int>(255.0f * opacity);
  if (isLightTheme()) return finger == 0 ? IM_COL32(20, 84, 200, alpha) : IM_COL32(196, 38, 24, alpha);
  return finger == 0 ? IM_COL32(110, 165, 255, alpha) : IM_COL32(255, 120, 105, alpha);
}

ImU32 limitInk() { return isLightTheme() ? IM_COL32(150, 88, 0, 255) : IM_COL32(230, 160, 60, 255); }

ImU32 plotInk(float opacity) { return ImGui::GetColorU32(ImGuiCol_Text, opacity); }

void drawExtents(std::span<const Extent> extents, const PlotArea& area, double end, const CurveLook& look) {
  const auto y = [&](float value) {
    const double share = std::clamp(value / end, 0.0, 1.0);
    return area.high.y - static_cast<float>(share) * area.height();
  };
  const Extent* last = nullptr;
  for (std::size_t i = 0; i < extents.size(); ++i) {
    const Extent& extent = extents[i];
    if (!extent.any) {
      last = nullptr;
      continue;
    }
    const float x = columnAt(area, i, extents.size()) + 0.5f;
    // From the nearest end of the column before, so that the line has no gaps.
    const float low = last == nullptr ? extent.low : std::min(extent.low, last->high);
    const float high = last == nullptr ? extent.high : std::max(extent.high, last->low);
    last = &extent;
    const bool gap = look.dotted && (i / static_cast<std::size_t>(kDot)) % 2 == 1;
    if (!gap) list().AddLine({x, y(low) + 0.6f}, {x, y(high) - 0.6f}, look.ink, 1.2f);
  }
}

void shadeTouching(std::span<const ColumnMarks> marks, const PlotArea& area) {
  for (std::size_t i = 0; i < marks.size();) {
    std::size_t end = i;
    while (end < marks.size() && marks[end].touching) ++end;
    if (end > i) {
      list().AddRectFilled({columnAt(area, i, marks.size()), area.low.y},
                           {columnAt(area, end, marks.size()), area.high.y}, plotInk(kTouching));
    }
    i = std::max(end, i + 1);
  }
}

void drawEvents(std::span<const ColumnMarks> marks, const PlotArea& area, std::size_t finger) {
  const float shift = static_cast<float>(finger) * (kTick + 1.0f);
  const float foot = area.high.y - shift;
  const float top = area.low.y + shift;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const float x = columnAt(area, i, marks.size()) + 0.5f;
    if (marks[i].slipping) list().AddLine({x, foot - kTick}, {x, foot}, fingerInk(finger), 1.0f);
    if (marks[i].limited) list().AddLine({x, top}, {x, top + kTick}, limitInk(), 1.0f);
  }
}

void drawPlotAxes(const PlotArea& area, double end, double window_s) {
  list().AddLine({area.low.x, area.high.y}, area.high, plotInk(kFaint));
  list().AddLine({area.low.x, area.low.y}, {area.high.x, area.low.y}, plotInk(kFaint));
  const float middle = 0.5f * (area.low.y + area.high.y);
  list().AddLine({area.low.x, middle}, {area.high.x, middle}, plotInk(kFaint));
  smallText({area.low.x + 3.0f, area.low.y + 1.0f}, fmt::format("{:g}", WrittenNumber{end}));
  smallText({area.low.x + 3.0f, middle + 1.0f}, fmt::format("{:g}", WrittenNumber{0.5 * end}));
  constexpr int kTimes = 2;  // besides the newest
  for (int i = 0; i <= kTimes; ++i) {
    const float share = static_cast<float>(i) / kTimes;
    const float x = area.low.x + share * area.width();
    list().AddLine({x, area.high.y}, {x, area.high.y + 3.0f}, plotInk(0.5f));
    const double ago_s = (1.0 - static_cast<double>(share)) * window_s;
    smallText({x, area.high.y + 3.0f},
              ago_s > 0.0 ? fmt::format("\u2212{:g} s", WrittenNumber{ago_s}) : std::string("0 s"), share);
  }
}

void drawPlotLimit(const PlotArea& area, double limit, double end) {
  if (limit <= 0.0 || limit >= end) return;
  const float y = area.high.y - static_cast<float>(limit / end) * area.height();
  list().AddLine({area.low.x, y}, {area.high.x, y}, limitInk());
}

int plotLegendLines(float width, bool both_fingers) {
  return layOutLegend(width, both_fingers, [](const LegendEntry&, float, int) {});
}

void drawPlotLegend(const ImVec2& corner, float width, bool both_fingers) {
  layOutLegend(width, both_fingers, [&](const LegendEntry& entry, float x, int line) {
    const float left = corner.x + x;
    const float top = corner.y + static_cast<float>(line) * kPlotLegendLine;
    const float middle = top + 0.5f * smallSize();
    entry.sign({left, middle}, {left + kSign, middle});
    smallText({left + kSign + kSignGap, top}, tr(entry.words));
  });
}

}  // namespace palpate::viewer
