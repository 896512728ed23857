// Force, depth and speed of the last seconds in three strips over one time axis; the newest sample is at the right.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "apps/viewer/panels.h"
#include "apps/viewer/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kHeight = 118.0f;
constexpr float kTitle = 20.0f;
constexpr std::array<double, 5> kWindows = {2.0, 5.0, 10.0, 30.0, 60.0};
constexpr ImU32 kLimit = IM_COL32(230, 160, 60, 200);
/// Left blue and right red, as the fingers; the tangential force is paler.
constexpr std::array<ImU32, 2> kFinger = {IM_COL32(110, 165, 255, 255), IM_COL32(255, 120, 105, 255)};
constexpr std::array<ImU32, 2> kFingerPale = {IM_COL32(110, 165, 255, 110), IM_COL32(255, 120, 105, 110)};

/// Of the theme's text, so that it is seen on light and dark.
ImU32 ink(float opacity = 1.0f) { return ImGui::GetColorU32(ImGuiCol_Text, opacity); }
constexpr float kFaint = 0.16f;
constexpr float kTouching = 0.06f;

struct Strip {
  const char* title;
  const char* unit;
  PlotValue value;
  double least;  ///< the axis never ends below this
};
constexpr std::array<Strip, 3> kStrips = {{{"force", "N", PlotValue::normal_force, 1.0},
                                           {"depth", "mm", PlotValue::depth, 5.0},
                                           {"speed", "mm/s", PlotValue::speed, 50.0}}};

struct Area {
  ImVec2 low;
  ImVec2 high;
  float width() const { return high.x - low.x; }
  float height() const { return high.y - low.y; }
};

/// Where the axes end now: they grow at once and shrink after three seconds of less.
double steadyEnd(std::size_t strip, double wanted, double now_s) {
  struct Axis {
    double end = 0.0;
    double since_s = 0.0;
  };
  static std::array<Axis, kStrips.size()> axes;  // of the display's thread
  constexpr double kPatienceS = 3.0;
  Axis& axis = axes[strip];
  if (wanted >= axis.end || now_s < axis.since_s) {
    axis = {wanted, now_s};
  } else if (now_s - axis.since_s > kPatienceS) {
    axis = {wanted, now_s};
  }
  return axis.end;
}

double greatest(const std::vector<Extent>& extents) {
  double most = 0.0;
  for (const Extent& extent : extents) most = std::max(most, extent.any ? static_cast<double>(extent.high) : 0.0);
  return most;
}

void drawExtents(const std::vector<Extent>& extents, const Area& area, double end, ImU32 colour) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
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
    const float x = area.low.x + static_cast<float>(i) + 0.5f;
    // From the nearest end of the column before, so that the line has no gaps.
    const float low = last == nullptr ? extent.low : std::min(extent.low, last->high);
    const float high = last == nullptr ? extent.high : std::max(extent.high, last->low);
    list.AddLine({x, y(low) + 0.6f}, {x, y(high) - 0.6f}, colour, 1.2f);
    last = &extent;
  }
}

void shadeContact(const SampleHistory& history, const Area& area, double end_s, double window_s) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto columns = static_cast<std::size_t>(area.width() / 4.0f);
  const auto depth = history.columns(PlotValue::normal_force, end_s, window_s, columns);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (!depth[i].any || depth[i].high <= 0.0f) continue;
    const float x = area.low.x + area.width() * static_cast<float>(i) / static_cast<float>(columns);
    list.AddRectFilled({x, area.low.y}, {x + 4.0f, area.high.y}, ink(kTouching));
  }
}

double endOfTime(const Session& session) {
  return session.plots_paused ? session.plot_end_s
                              : std::max(session.plots[0].newestTime(), session.plots[1].newestTime());
}

void drawAxis(const Area& area, const Strip& strip, double end) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine({area.low.x, area.high.y}, area.high, ink(kFaint));
  list.AddLine({area.low.x, area.low.y}, {area.high.x, area.low.y}, ink(kFaint));
  const float middle = 0.5f * (area.low.y + area.high.y);
  list.AddLine({area.low.x, middle}, {area.high.x, middle}, ink(kFaint));
  const std::string top = fmt::format("{:g}", end);
  const float small = ImGui::GetFontSize() * 0.8f;
  list.AddText(ImGui::GetFont(), small, {area.low.x + 3.0f, area.low.y + 1.0f}, ink(), top.c_str());
  const std::string title = fmt::format("{}, {}", strip.title, strip.unit);
  list.AddText({area.low.x, area.low.y - kTitle}, ink(), title.c_str());
}

void drawLimit(const Area& area, double limit, double end) {
  if (limit <= 0.0 || limit >= end) return;
  const float y = area.high.y - static_cast<float>(limit / end) * area.height();
  ImGui::GetWindowDrawList()->AddLine({area.low.x, y}, {area.high.x, y}, kLimit);
}

void drawNow(const Session& session, const Area& area, const Strip& strip, double time_s) {
  const PlotSample* sample = session.plots[session.active_finger].near(time_s);
  if (sample == nullptr) return;
  const std::string value = fmt::format("{:.2f}", valueOf(*sample, strip.value));
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::GetWindowDrawList()->AddText({area.high.x - width, area.low.y - kTitle}, ink(), value.c_str());
}

void drawStrip(Session& session, std::size_t index, const Area& area) {
  const Strip& strip = kStrips[index];
  const double end_s = endOfTime(session);
  const auto columns = static_cast<std::size_t>(std::max(1.0f, area.width()));
  std::array<std::vector<Extent>, 2> main;
  double most = 0.0;
  for (std::size_t f = 0; f < 2; ++f) {
    main[f] = session.plots[f].columns(strip.value, end_s, session.plot_window_s, columns);
    most = std::max(most, greatest(main[f]));
  }
  const double end = steadyEnd(index, axisEnd(1.05 * most, strip.least), session.now_s);
  for (const SampleHistory& history : session.plots) shadeContact(history, area, end_s, session.plot_window_s);
  drawAxis(area, strip, end);
  for (std::size_t f = 0; f < 2; ++f) {
    if (!session.finger_present[f]) continue;
    if (strip.value == PlotValue::normal_force) {
      drawExtents(session.plots[f].columns(PlotValue::tangential_force, end_s, session.plot_window_s, columns), area,
                  end, kFingerPale[f]);
    }
    drawExtents(main[f], area, end, kFinger[f]);
  }
  if (strip.value == PlotValue::normal_force) drawLimit(area, session.device_limit_n, end);
}

/// One line through all strips, and what they say there.
void drawCursor(Session& session, std::span<const Area> areas) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  double time_s = endOfTime(session);
  for (const Area& area : areas) {
    if (mouse.x < area.low.x || mouse.x > area.high.x || mouse.y < area.low.y || mouse.y > area.high.y) continue;
    const double share = (mouse.x - area.low.x) / area.width();
    time_s -= (1.0 - share) * session.plot_window_s;
    for (const Area& other : areas) {
      const float x = other.low.x + static_cast<float>(share) * other.width();
      ImGui::GetWindowDrawList()->AddLine({x, other.low.y}, {x, other.high.y}, ink());
    }
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      session.plot_end_s = endOfTime(session);
      session.plots_paused = !session.plots_paused;
    }
    if (session.plots_paused && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
      session.plot_end_s -= ImGui::GetIO().MouseDelta.x / area.width() * session.plot_window_s;
    }
  }
  for (std::size_t i = 0; i < areas.size(); ++i) drawNow(session, areas[i], kStrips[i], time_s);
}

void windowChoice(Session& session) {
  const std::string now = fmt::format("{:g} s", session.plot_window_s);
  ImGui::SetNextItemWidth(66.0f);
  if (ImGui::BeginCombo("##window", now.c_str())) {
    for (const double seconds : kWindows) {
      if (ImGui::Selectable(fmt::format("{:g} s", seconds).c_str(), seconds == session.plot_window_s)) {
        session.plot_window_s = seconds;
      }
    }
    ImGui::EndCombo();
  }
  notePlace("plots/window");
}

void buttons(Session& session) {
  windowChoice(session);
  if (buttonWidget("plots/pause", session.plots_paused ? "live" : "pause", "A click into a plot does the same.")) {
    session.plot_end_s = endOfTime(session);
    session.plots_paused = !session.plots_paused;
  }
  if (buttonWidget("plots/csv", "CSV", "Save what the plots show as a table.")) session.wish(Wish::Kind::plots_csv);
}

}  // namespace

void plotStrips(Session& session, const FreeArea& free) {
  ImGui::SetNextWindowPos({free.left, free.below});
  ImGui::SetNextWindowSize({free.right - free.left, kHeight});
  constexpr auto kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                          ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("plots", nullptr, kFixed)) {
    constexpr float kButtons = 78.0f;
    constexpr float kGap = 14.0f;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float width = (ImGui::GetContentRegionAvail().x - kButtons - 3.0f * kGap) / 3.0f;
    std::array<Area, kStrips.size()> areas;
    for (std::size_t i = 0; i < kStrips.size(); ++i) {
      const float left = from.x + static_cast<float>(i) * (width + kGap);
      areas[i] = {{left, from.y + kTitle}, {left + width, from.y + kHeight - 18.0f}};
      drawStrip(session, i, areas[i]);
    }
    drawCursor(session, areas);
    ImGui::SetCursorScreenPos({from.x + 3.0f * (width + kGap), from.y});
    ImGui::BeginGroup();
    buttons(session);
    ImGui::EndGroup();
  }
  ImGui::End();
}

}  // namespace palpate::viewer
