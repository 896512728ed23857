// Sizes of an overlay are those of a panel 400 wide: here they grow with the panel, not with the zoom.
#include "measure/window/photo_frame.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpate::viewer {

namespace {

using measure::MarkForm;
using measure::OverlayColour;

constexpr float kPanelOfSizes = 400.0f;
constexpr double kDash = 7.0;
constexpr double kGap = 5.0;

ImVec2 point(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

ImU32 packedColour(const OverlayColour& colour, float opacity = 1.0f) {
  return ImGui::ColorConvertFloat4ToU32({colour.red, colour.green, colour.blue, opacity * colour.opacity});
}

float sizeFactor(const PhotoFrame& frame) {
  return std::clamp(static_cast<float>(frame.size.minCoeff()) / kPanelOfSizes, 0.7f, 1.8f);
}

void drawDashes(ImDrawList& list, const std::vector<ImVec2>& places, ImU32 colour, float width) {
  double along = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vec2 from(places[i - 1].x, places[i - 1].y);
    const Vec2 to(places[i].x, places[i].y);
    const double length = (to - from).norm();
    const Vec2 step = length > 0.0 ? Vec2((to - from) / length) : Vec2::Zero();
    for (double at = 0.0; at < length;) {
      const double phase = std::fmod(along + at, kDash + kGap);
      const double until = std::min(length, at + (phase < kDash ? kDash : kDash + kGap) - phase);
      if (phase < kDash) list.AddLine(point(from + at * step), point(from + until * step), colour, width);
      at = std::max(until, at + 1e-3);
    }
    along += length;
  }
}

/// A band is its outer line, then its inner one backwards; anything else that is filled is taken as convex.
void fill(ImDrawList& list, const std::vector<ImVec2>& places, ImU32 colour) {
  const std::size_t half = places.size() / 2;
  const auto distance = [&](std::size_t a, std::size_t b) {
    return std::hypot(places[a].x - places[b].x, places[a].y - places[b].y);
  };
  if (half < 3) return;
  if (places.size() % 2 == 1 || distance(0, half - 1) > 0.5f * distance(0, half / 2)) {
    return list.AddConvexPolyFilled(places.data(), static_cast<int>(places.size()), colour);
  }
  for (std::size_t i = 1; i <= half; ++i) {
    const std::size_t a = i - 1;
    const std::size_t b = i % half;
    list.AddQuadFilled(places[a], places[b], places[places.size() - 1 - b], places[places.size() - 1 - a], colour);
  }
}

void drawLine(ImDrawList& list, const measure::OverlayLine& line, const PhotoFrame& frame) {
  std::vector<ImVec2> places;
  places.reserve(line.places_px.size() + 1);
  for (const Vec2& place : line.places_px) places.push_back(point(frame.toScreen(place)));
  if (places.size() < 2) return;
  if (line.filled) return fill(list, places, packedColour(line.colour, 0.25f));
  if (line.closed) places.push_back(places.front());
  const float width = std::max(1.0f, line.width * sizeFactor(frame));
  if (line.dashed) return drawDashes(list, places, packedColour(line.colour), width);
  list.AddPolyline(places.data(), static_cast<int>(places.size()), packedColour(line.colour), ImDrawFlags_None, width);
}

void drawArrow(ImDrawList& list, const measure::OverlayArrow& arrow, const PhotoFrame& frame) {
  const Vec2 from = frame.toScreen(arrow.from_px);
  const Vec2 to = frame.toScreen(arrow.to_px);
  const ImU32 colour = packedColour(arrow.colour);
  const float width = 1.3f * sizeFactor(frame);
  list.AddLine(point(from), point(to), colour, width);
  const double length = (to - from).norm();
  if (length < 1.0) return;
  const Vec2 back = (from - to) / length * std::min(6.0 * static_cast<double>(sizeFactor(frame)), 0.6 * length);
  const Vec2 aside(-0.5 * back.y(), 0.5 * back.x());
  list.AddLine(point(to), point(to + back + aside), colour, width);
  list.AddLine(point(to), point(to + back - aside), colour, width);
}

void drawLegend(ImDrawList& list, const measure::OverlayPanel& panel, const PhotoFrame& frame, float top) {
  constexpr float kSign = 22.0f;
  const float line = ImGui::GetTextLineHeight() + 2.0f;
  float width = 0.0f;
  for (const measure::LegendEntry& entry : panel.legend) {
    width = std::max(width, ImGui::CalcTextSize(entry.words.c_str()).x);
  }
  const float height = line * static_cast<float>(panel.legend.size()) + 6.0f;
  const auto room = static_cast<float>(frame.size.y());
  if (panel.legend.empty() || width + kSign + 18.0f > static_cast<float>(frame.size.x()) || height > 0.4f * room)
    return;
  const ImVec2 corner(static_cast<float>(frame.corner.x()) + 6.0f, top);
  list.AddRectFilled(corner, {corner.x + width + kSign + 12.0f, corner.y + height}, IM_COL32(255, 255, 255, 215), 3.0f);
  for (std::size_t i = 0; i < panel.legend.size(); ++i) {
    const measure::LegendEntry& entry = panel.legend[i];
    const float y = corner.y + 3.0f + line * static_cast<float>(i);
    const ImVec2 left(corner.x + 5.0f, y + 0.5f * line);
    if (entry.is_line) {
      const std::vector<ImVec2> stroke = {left, {left.x + kSign - 5.0f, left.y}};
      if (entry.dashed) drawDashes(list, stroke, packedColour(entry.colour), 2.0f);
      if (!entry.dashed) list.AddLine(stroke[0], stroke[1], packedColour(entry.colour), 2.0f);
    } else {
      drawMark(list, Vec2(left.x + 8.0f, left.y), entry.form, entry.colour, 5.0f);
    }
    list.AddText({left.x + kSign, y}, IM_COL32(20, 20, 20, 255), entry.words.c_str());
  }
}

void drawBar(ImDrawList& list, double bar_px, const PhotoFrame& frame) {
  const auto length = static_cast<float>(bar_px * frame.pointsPerPx());
  if (length < 8.0f || length > 0.9f * static_cast<float>(frame.size.x())) return;
  const ImVec2 left(static_cast<float>(frame.corner.x()) + 12.0f,
                    static_cast<float>(frame.corner.y() + frame.size.y()) - 14.0f);
  constexpr const char* kWords = "50 mm";
  const float right = left.x + std::max(length, ImGui::CalcTextSize(kWords).x) + 5.0f;
  list.AddRectFilled({left.x - 5.0f, left.y - 22.0f}, {right, left.y + 7.0f}, IM_COL32(255, 255, 255, 200), 3.0f);
  list.AddRectFilled({left.x, left.y - 2.0f}, {left.x + length, left.y + 2.0f}, IM_COL32(0, 0, 0, 255));
  list.AddText({left.x, left.y - 20.0f}, IM_COL32(0, 0, 0, 255), kWords);
}

}  // namespace

void drawMark(ImDrawList& list, const Vec2& at, MarkForm form, const OverlayColour& colour, float radius) {
  const ImU32 packed = packedColour(colour);
  const ImVec2 p = point(at);
  const float width = std::max(1.2f, 0.3f * radius);
  const auto stroke = [&](float x, float y) { list.AddLine({p.x - x, p.y - y}, {p.x + x, p.y + y}, packed, width); };
  switch (form) {
    case MarkForm::ring:
      return list.AddCircle(p, radius, packed, 0, width);
    case MarkForm::square:
      return list.AddRect({p.x - radius, p.y - radius}, {p.x + radius, p.y + radius}, packed, 0.0f, 0, width);
    case MarkForm::dot:
      return list.AddCircleFilled(p, radius, packed);
    case MarkForm::star:
      stroke(1.3f * radius, 0.0f);
      stroke(0.0f, 1.3f * radius);
      [[fallthrough]];
    case MarkForm::cross:
      stroke(0.8f * radius, 0.8f * radius);
      stroke(0.8f * radius, -0.8f * radius);
  }
}

void drawOverlay(ImDrawList& list, const measure::OverlayPanel& panel, const PhotoFrame& frame) {
  for (const measure::OverlayLine& line : panel.lines) drawLine(list, line, frame);
  for (const measure::OverlayArrow& arrow : panel.arrows) drawArrow(list, arrow, frame);
  for (const measure::OverlayMark& mark : panel.marks) {
    drawMark(list, frame.toScreen(mark.place_px), mark.form, mark.colour, mark.radius * sizeFactor(frame));
  }
}

void drawOverlayLabels(ImDrawList& list, const measure::OverlayPanel& panel, const PhotoFrame& frame) {
  const auto left = static_cast<float>(frame.corner.x()) + 6.0f;
  const auto top = static_cast<float>(frame.corner.y()) + 4.0f;
  const float wrap = static_cast<float>(frame.size.x()) - 12.0f;
  const ImVec2 size = ImGui::CalcTextSize(panel.title.c_str(), nullptr, false, wrap);
  list.AddRectFilled({left - 3.0f, top - 1.0f}, {left + size.x + 3.0f, top + size.y + 2.0f},
                     IM_COL32(255, 255, 255, 215), 3.0f);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {left, top}, IM_COL32(20, 20, 20, 255), panel.title.c_str(),
               nullptr, wrap);
  if (frame.zoom == 1.0) drawLegend(list, panel, frame, top + size.y + 6.0f);  // else it would cover the marks
  if (panel.scale_bar_px > 0.0) drawBar(list, panel.scale_bar_px, frame);
}

}  // namespace palpate::viewer
