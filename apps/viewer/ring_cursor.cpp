#include "apps/viewer/ring_cursor.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpate::viewer {

namespace {

constexpr int kPoints = 48;
constexpr double kNearMm = 1.0;
constexpr double kFarMm = 1e6;
/// Above the skin, so that it does not seem to sink in, mm.
constexpr double kLiftMm = 0.5;
constexpr double kPointRadiusMm = 2.0;  ///< of the ring of a finger without size
constexpr std::array<ImU32, kFingers> kColours = {IM_COL32(110, 165, 255, 220), IM_COL32(255, 120, 105, 220)};
constexpr ImU32 kShade = IM_COL32(0, 0, 0, 110);

void drawRing(const view::SkinPlace& place, double radius, const view::Frustum& frustum, ImU32 colour, float width) {
  const Vec3 u = place.normal.unitOrthogonal();
  const Vec3 v = place.normal.cross(u);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  std::array<ImVec2, kPoints> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    const Vec3 rim = radius * (std::cos(angle) * u + std::sin(angle) * v);
    const Vec2 seen = view::seenAt(frustum, place.point + kLiftMm * place.normal + rim);
    if (!seen.allFinite()) return;
    points[static_cast<std::size_t>(i)] = {static_cast<float>(seen.x()) * size.x,
                                           static_cast<float>(seen.y()) * size.y};
  }
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddPolyline(points.data(), kPoints, kShade, ImDrawFlags_Closed, width + 2.0f);
  list.AddPolyline(points.data(), kPoints, colour, ImDrawFlags_Closed, width);
}

}  // namespace

void ringCursor(const Session& session, const Pointer& pointer, const view::Eyes& eyes) {
  if (view::isStereo(session.state.stereo.mode)) return;
  const view::Frustum frustum = view::frustumOf(eyes.screen, eyes.middle, kNearMm, kFarMm);
  for (std::size_t i = 0; i < kFingers; ++i) {
    const auto& place = pointer.placeOf(i);
    if (!place) continue;
    const double radius = std::max(kPointRadiusMm, fingerRadius(session, i));
    const double depth = std::max(0.0, session.fingers[i].depth_mm);
    drawRing(*place, radius, frustum, kColours[i], 1.3f + 0.25f * static_cast<float>(std::min(depth, 10.0)));
  }
}

}  // namespace palpate::viewer
