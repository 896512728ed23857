// Force, depth and speed of the last seconds in three strips over one time axis; the newest sample is at the right.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "palpate/base/language.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"
#include "view/viewer/plots/plot_drawing.h"

namespace palpate::viewer {

namespace {

constexpr float kTitle = 20.0f;    ///< above each strip
constexpr float kTimes = 18.0f;    ///< below it
constexpr float kPadding = 16.0f;  ///< window padding, above and below together
constexpr std::array<double, 5> kWindows = {2.0, 5.0, 10.0, 30.0, 60.0};

struct Strip {
  const char* title;
  const char* unit;
  PlotValue value;
  double least;  ///< the axis never ends below this
};
constexpr std::array<Strip, 3> kStrips = {{{toTranslate("force"), "N", PlotValue::force, 1.0},
                                           {toTranslate("depth"), "mm", PlotValue::depth, 5.0},
                                           {toTranslate("speed"), "mm/s", PlotValue::speed, 50.0}}};

/// Both fingers in one frame: the same columns in every strip.
struct Columns {
  double end_s = 0.0;
  double window_s = 10.0;
  std::size_t count = 1;
  std::array<std::vector<ColumnMarks>, 2> marks;
};

/// The present ends of the axes: they grow immediately and shrink after three seconds of less.
double steadyEnd(std::size_t strip, double wanted, double now_s) {
  struct Axis {
    double end = 0.0;
    double since_s = 0.0;
  };
  static std::array<Axis, kStrips.size()> axes;  // used on the display's thread
  constexpr double kPatienceS = 3.0;
  Axis& axis = axes[strip];
  if (wanted >= axis.end || now_s < axis.since_s || now_s > axis.since_s + kPatienceS) axis = {wanted, now_s};
  return axis.end;
}

double greatest(const std::vector<Extent>& extents) {
  double most = 0.0;
  for (const Extent& extent : extents) most = std::max(most, extent.any ? static_cast<double>(extent.high) : 0.0);
  return most;
}

Columns gatherColumns(const PlotStrips& panel, float width) {
  Columns columns{panel.plots.shownEnd(), panel.plots.window_s, static_cast<std::size_t>(std::max(1.0f, width)), {}};
  for (std::size_t f = 0; f < 2; ++f) {
    columns.marks[f] = panel.plots.fingers[f].marks(columns.end_s, columns.window_s, columns.count);
  }
  return columns;
}

/// One finger's sample at a time; null without one, or where the history has lost it.
const PlotSample* findSample(const PlotStrips& panel, std::size_t finger, double time_s) {
  return panel.present[finger] ? panel.plots.felt(finger, time_s) : nullptr;
}

/// Above the strip: the numbers of the picture's moment, of every finger in its colour; right-aligned.
void drawReadouts(const PlotStrips& panel, const PlotArea& area, PlotValue value) {
  float right = area.high.x;
  for (std::size_t f = panel.present.size(); f-- > 0;) {
    const PlotSample* sample = findSample(panel, f, panel.timeShown());
    if (sample == nullptr) continue;
    const std::string words = fmt::format("{:.2f}", WrittenNumber{valueOf(*sample, value)});
    right -= ImGui::CalcTextSize(words.c_str()).x;
    ImGui::GetWindowDrawList()->AddText({right, area.low.y - kTitle}, fingerInk(f), words.c_str());
    right -= 10.0f;
  }
}

/// Names the moment of the numbers, unless it is the present.
void drawTitle(const PlotStrips& panel, const PlotArea& area, const Strip& strip) {
  std::string title = fmt::format("{}, {}", tr(strip.title), strip.unit);
  if (const double ago_s = panel.plots.pausedFor(); ago_s > 0.0 && !panel.frozen_at_s) {
    title += trf(", {:.1f} s ago", ago_s);
  }
  ImGui::GetWindowDrawList()->AddText({area.low.x, area.low.y - kTitle}, plotInk(), title.c_str());
}

/// A strip's curve of each finger.
using Curves = std::array<std::vector<Extent>, 2>;

Curves collectCurves(const PlotStrips& panel, PlotValue value, const Columns& columns) {
  Curves curves;
  for (std::size_t f = 0; f < 2; ++f) {
    curves[f] = panel.plots.fingers[f].columns(value, columns.end_s, columns.window_s, columns.count);
  }
  return curves;
}

struct CurvesLook {
  float opacity = 1.0f;
  bool dotted = false;
};

/// Whether a finger is present or was: another body lifts it, and its past stays visible.
bool isPlotted(const PlotStrips& panel, const Columns& columns, std::size_t finger) {
  return panel.present[finger] || std::ranges::any_of(columns.marks[finger], &ColumnMarks::touching);
}

void drawCurves(const PlotStrips& panel, const Columns& columns, const Curves& curves, const CurvesLook& look,
                const PlotArea& area, double end) {
  for (std::size_t f = 0; f < 2; ++f) {
    if (isPlotted(panel, columns, f)) drawExtents(curves[f], area, end, {fingerInk(f, look.opacity), look.dotted});
  }
}

void drawStrip(const PlotStrips& panel, std::size_t index, const Columns& columns, const PlotArea& area) {
  const Strip& strip = kStrips[index];
  const bool force = strip.value == PlotValue::force;
  const Curves main = collectCurves(panel, strip.value, columns);
  double most = 0.0;
  for (const auto& curve : main) most = std::max(most, greatest(curve));  // a force's parts are no greater
  const double end = steadyEnd(index, axisEnd(1.05 * most, strip.least), panel.now_s);
  for (const auto& marks : columns.marks) shadeTouching(marks, area);
  drawPlotAxes(area, end, columns.window_s);
  if (force) {
    drawCurves(panel, columns, collectCurves(panel, PlotValue::tangential_force, columns), {kPartOpacity, true}, area,
               end);
    drawCurves(panel, columns, collectCurves(panel, PlotValue::normal_force, columns), {kPartOpacity, false}, area,
               end);
    drawPlotLimit(area, panel.device_limit_n, end);
    for (std::size_t f = 0; f < 2; ++f) drawEvents(columns.marks[f], area, f);
  }
  drawCurves(panel, columns, main, {}, area, end);
}

void pausePlots(Plots& plots, bool pause) {
  plots.end_s = plots.shownEnd();
  plots.paused = pause;
}

/// A click pauses or resumes; dragging scrolls back; the wheel changes the length of the window.
void useMouse(const PlotStrips& panel, const PlotArea& area) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    if (!panel.plots.paused) pausePlots(panel.plots, true);
    panel.plots.end_s -= io.MouseDelta.x / area.width() * panel.plots.window_s;
  } else if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::GetMouseDragDelta().x == 0.0f &&
             area.holds(io.MouseClickedPos[ImGuiMouseButton_Left])) {
    pausePlots(panel.plots, !panel.plots.paused);
  }
  if (io.MouseWheel == 0.0f) return;
  const auto* now = std::find(kWindows.begin(), kWindows.end(), panel.plots.window_s);
  const auto* last = std::prev(kWindows.end());
  if (io.MouseWheel > 0.0f && now != kWindows.begin()) panel.plots.window_s = *std::prev(now);
  if (io.MouseWheel < 0.0f && now < last) panel.plots.window_s = *std::next(now);
}

/// The time under the mouse; empty outside the strips.
std::optional<double> timeUnderMouse(const PlotStrips& panel, std::span<const PlotArea> areas) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (const PlotArea& area : areas) {
    if (!area.holds(mouse)) continue;
    const double share = (mouse.x - area.low.x) / area.width();
    return panel.plots.shownEnd() - (1.0 - share) * panel.plots.window_s;
  }
  return std::nullopt;
}

std::optional<float> placeOfTime(const PlotStrips& panel, const PlotArea& area, double time_s) {
  const double ago_s = panel.plots.shownEnd() - time_s;
  if (ago_s <= 0.0 || ago_s > panel.plots.window_s) return std::nullopt;
  return area.high.x - static_cast<float>(ago_s / panel.plots.window_s) * area.width();
}

/// One line through all strips.
void drawMoment(const PlotStrips& panel, std::span<const PlotArea> areas, double time_s) {
  for (const PlotArea& area : areas) {
    const auto x = placeOfTime(panel, area, time_s);
    if (x) ImGui::GetWindowDrawList()->AddLine({*x, area.low.y}, {*x, area.high.y}, plotInk());
  }
}

/// The values of the curves there, on plates at the line, on the side with more room.
void drawValuesAt(const PlotStrips& panel, std::span<const PlotArea> areas, double time_s) {
  constexpr float kAway = 4.0f;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const PlotArea& area = areas[i];
    const auto x = placeOfTime(panel, area, time_s);
    if (!x) continue;
    float top = area.low.y + kAway;
    for (std::size_t f = 0; f < panel.present.size(); ++f) {
      const PlotSample* sample = findSample(panel, f, time_s);
      if (sample == nullptr) continue;
      const std::string words = fmt::format("{:.2f}", WrittenNumber{valueOf(*sample, kStrips[i].value)});
      const ImVec2 size = ImGui::CalcTextSize(words.c_str());
      const bool to_left = *x > 0.5f * (area.low.x + area.high.x);
      const ImVec2 low(to_left ? *x - kAway - size.x : *x + kAway, top);
      ImDrawList& list = *ImGui::GetWindowDrawList();
      list.AddRectFilled({low.x - 2.0f, low.y}, {low.x + size.x + 2.0f, low.y + size.y},
                         ImGui::GetColorU32(ImGuiCol_WindowBg));
      list.AddText(low, fingerInk(f), words.c_str());
      top += size.y;
    }
  }
}

void windowChoice(Plots& plots) {
  const std::string now = fmt::format("{:g} s", WrittenNumber{plots.window_s});
  ImGui::SetNextItemWidth(66.0f);
  const bool open = ImGui::BeginCombo("##window", now.c_str());
  open ? notePlaceOnly("plots/window") : notePlace("plots/window");
  if (open) {
    for (const double seconds : kWindows) {
      if (ImGui::Selectable(fmt::format("{:g} s", WrittenNumber{seconds}).c_str(), seconds == plots.window_s)) {
        plots.window_s = seconds;
      }
    }
    ImGui::EndCombo();
  }
}

void buttons(const PlotStrips& panel, UiOutput& output) {
  windowChoice(panel.plots);
  if (buttonWidget("plots/pause", panel.plots.paused ? "live" : "pause",
                   "Clicking a plot does the same; drag to scroll back, the wheel zooms.")) {
    pausePlots(panel.plots, !panel.plots.paused);
  }
  if (buttonWidget("plots/csv", "CSV", "Save the data of the plots as a table.")) output.request(SavePlots{});
}

constexpr float kGap = 14.0f;  ///< between strips

/// Strips side by side, as many as have room: in a narrow window the last ones are left out.
std::vector<PlotArea> areasIn(const ImVec2& corner, float width, int legend_lines) {
  constexpr float kMinStrip = 150.0f;
  const auto count = static_cast<std::size_t>(
      std::clamp((width + kGap) / (kMinStrip + kGap), 1.0f, static_cast<float>(kStrips.size())));
  const auto gaps = static_cast<float>(count - 1);
  const float each = (width - gaps * kGap) / static_cast<float>(count);
  const float legend = static_cast<float>(legend_lines) * kPlotLegendLine;
  const float foot = corner.y + kPlotsHeight - kPadding - kTimes - legend;
  std::vector<PlotArea> areas;
  for (std::size_t i = 0; i < count; ++i) {
    const float left = corner.x + static_cast<float>(i) * (each + kGap);
    areas.push_back({{left, corner.y + kTitle}, {left + each, foot}});
  }
  return areas;
}

void strips(const PlotStrips& panel, std::span<const PlotArea> areas) {
  for (const PlotArea& area : areas) {
    if (ImGui::IsWindowHovered() && area.holds(ImGui::GetIO().MousePos)) useMouse(panel, area);
  }
  const Columns columns = gatherColumns(panel, areas.front().width());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    drawStrip(panel, i, columns, areas[i]);
    drawTitle(panel, areas[i], kStrips[i]);
    drawReadouts(panel, areas[i], kStrips[i].value);
  }
  if (const auto time_s = timeUnderMouse(panel, areas)) {
    drawMoment(panel, areas, *time_s);
    drawValuesAt(panel, areas, *time_s);
  } else {
    drawMoment(panel, areas, panel.timeShown());
  }
}

}  // namespace

void plotStrips(const PlotStrips& panel, const FreeArea& free, UiOutput& output) {
  ImGui::SetNextWindowPos({free.left, free.below});
  ImGui::SetNextWindowSize({free.right - free.left, kPlotsHeight});
  constexpr auto kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                          ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                          ImGuiWindowFlags_NoScrollWithMouse;
  if (ImGui::Begin("plots", nullptr, kFixed)) {
    constexpr float kButtons = 78.0f;
    constexpr float kMinWithButtons = 300.0f;  // narrower strips need the place; the mouse does the same
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float whole = ImGui::GetContentRegionAvail().x;
    const bool has_buttons = whole > kMinWithButtons;
    const float width = has_buttons ? whole - kButtons - kGap : whole;
    const int lines = plotLegendLines(whole, panel.present[1]);
    strips(panel, areasIn(from, width, lines));
    const float legend = static_cast<float>(lines) * kPlotLegendLine;
    drawPlotLegend({from.x, from.y + kPlotsHeight - kPadding - legend + 4.0f}, whole, panel.present[1]);
    if (has_buttons) {
      ImGui::SetCursorScreenPos({from.x + width + kGap, from.y});
      ImGui::BeginGroup();
      buttons(panel, output);
      ImGui::EndGroup();
    }
  }
  ImGui::End();
}

}  // namespace palpate::viewer
