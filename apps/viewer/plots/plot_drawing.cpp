#include "apps/viewer/plots/plot_drawing.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::viewer {

namespace {

constexpr float kFaint = 0.16f;
constexpr float kTouching = 0.10f;
constexpr float kTick = 6.0f;  ///< length of an event's stroke, points

ImDrawList& list() { return *ImGui::GetWindowDrawList(); }

float smallSize() { return 0.8f * ImGui::GetFontSize(); }

float smallWidth(const std::string& words) {
  return ImGui::GetFont()->CalcTextSizeA(smallSize(), 1e6f, 0.0f, words.c_str()).x;
}

/// `align` 0 puts the words to the right of the place, 1 to its left.
void smallText(const ImVec2& place, const std::string& words, float align = 0.0f) {
  list().AddText(ImGui::GetFont(), smallSize(), {place.x - align * smallWidth(words), place.y}, plotInk(),
                 words.c_str());
}

float columnAt(const PlotArea& area, std::size_t column, std::size_t columns) {
  return area.low.x + area.width() * static_cast<float>(column) / static_cast<float>(std::max<std::size_t>(1, columns));
}

/// A line of the legend: how it looks, what it means. Returns where the next may begin.
template <class Sign>
float entry(float x, float y, float end, const std::string& words, const Sign& sign) {
  constexpr float kSign = 16.0f;
  constexpr float kGap = 14.0f;
  const float next = x + kSign + 5.0f + smallWidth(words) + kGap;
  if (next - kGap > end) return end;
  sign(ImVec2(x, y + 0.5f * smallSize()), ImVec2(x + kSign, y + 0.5f * smallSize()));
  smallText({x + kSign + 5.0f, y}, words);
  return next;
}

}  // namespace

ImU32 plotInk(float opacity) { return ImGui::GetColorU32(ImGuiCol_Text, opacity); }

void drawExtents(std::span<const Extent> extents, const PlotArea& area, double end, ImU32 ink) {
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
    list().AddLine({x, y(low) + 0.6f}, {x, y(high) - 0.6f}, ink, 1.2f);
    last = &extent;
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
    if (marks[i].slipping) list().AddLine({x, foot - kTick}, {x, foot}, kFingerInk[finger], 1.0f);
    if (marks[i].limited) list().AddLine({x, top}, {x, top + kTick}, kLimitInk, 1.0f);
  }
}

void drawPlotAxes(const PlotArea& area, double end, double window_s) {
  list().AddLine({area.low.x, area.high.y}, area.high, plotInk(kFaint));
  list().AddLine({area.low.x, area.low.y}, {area.high.x, area.low.y}, plotInk(kFaint));
  const float middle = 0.5f * (area.low.y + area.high.y);
  list().AddLine({area.low.x, middle}, {area.high.x, middle}, plotInk(kFaint));
  smallText({area.low.x + 3.0f, area.low.y + 1.0f}, fmt::format("{:g}", end));
  smallText({area.low.x + 3.0f, middle + 1.0f}, fmt::format("{:g}", 0.5 * end));
  constexpr int kTimes = 2;  // beside the newest
  for (int i = 0; i <= kTimes; ++i) {
    const float share = static_cast<float>(i) / kTimes;
    const float x = area.low.x + share * area.width();
    list().AddLine({x, area.high.y}, {x, area.high.y + 3.0f}, plotInk(0.5f));
    const double ago_s = (1.0 - static_cast<double>(share)) * window_s;
    smallText({x, area.high.y + 3.0f}, ago_s > 0.0 ? fmt::format("\u2212{:g} s", ago_s) : std::string("0 s"), share);
  }
}

void drawPlotLimit(const PlotArea& area, double limit, double end) {
  if (limit <= 0.0 || limit >= end) return;
  const float y = area.high.y - static_cast<float>(limit / end) * area.height();
  list().AddLine({area.low.x, y}, {area.high.x, y}, kLimitInk);
}

void drawPlotLegend(const ImVec2& corner, float width, bool both_fingers) {
  const float y = corner.y;
  const float end = corner.x + width;
  const auto stroke = [](ImU32 ink) {
    return [ink](const ImVec2& from, const ImVec2& to) { list().AddLine(from, to, ink, 1.6f); };
  };
  const auto ticks = [](ImU32 ink) {
    return [ink](const ImVec2& from, const ImVec2& to) {
      for (const float x : {from.x + 3.0f, from.x + 7.0f, to.x - 3.0f}) {
        list().AddLine({x, from.y - 0.5f * kTick}, {x, from.y + 0.5f * kTick}, ink, 1.0f);
      }
    };
  };
  const auto shade = [](const ImVec2& from, const ImVec2& to) {
    list().AddRectFilled({from.x, from.y - 5.0f}, {to.x, to.y + 5.0f}, plotInk(2.0f * kTouching));
  };
  float x = entry(corner.x, y, end, "left finger", stroke(kFingerInk[0]));
  if (both_fingers) x = entry(x, y, end, "right finger", stroke(kFingerInk[1]));
  x = entry(x, y, end, "sideways force", stroke(kFingerPaleInk[0]));
  x = entry(x, y, end, "touching", shade);
  x = entry(x, y, end, "slips", ticks(kFingerInk[0]));
  x = entry(x, y, end, "limit of the device", stroke(kLimitInk));
  entry(x, y, end, "beyond it", ticks(kLimitInk));
}

}  // namespace palpate::viewer
