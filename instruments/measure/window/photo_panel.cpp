// The mouse on a photograph: left by the tool, right and middle (with the tool "look" left, too) shift it, the wheel
// zooms about the cursor.
#include "measure/window/measuring_window.h"

#include <imgui.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "measure/window/photo_frame.h"
#include "palpate/base/language.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr double kReachPoints = 10.0;  ///< distance of a click to a mark
constexpr double kSlackPoints = 3.0;   ///< a click that moves less is a click
constexpr double kZoomPerNotch = 1.2;
constexpr ImU32 kBesidePhoto = IM_COL32(46, 46, 48, 255);

PhotoFrame frameOf(const MeasuringView& view, const ShownPhoto& photo, const Vec2& corner, const Vec2& size) {
  return {corner, size, Vec2(photo.width_px, photo.height_px), view.zoom, view.middle};
}

Vec2 vec(const ImVec2& v) { return {v.x, v.y}; }
ImVec2 imVec(const Vec2& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

void drawTexture(ImDrawList& list, const ShownPhoto& photo, const PhotoFrame& frame, bool faded) {
  const ImVec2 low = imVec(frame.toScreen(Vec2::Constant(-0.5)));
  const ImVec2 high = imVec(frame.toScreen(frame.photo_px - Vec2::Constant(0.5)));
  // ImGui's OpenGL renderer takes the texture's number as if it were a pointer.
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(photo.texture));
  list.AddImage(texture, low, high);
  if (faded) list.AddRectFilled(low, high, IM_COL32(255, 255, 255, 110));
}

/// Draws the marks that may be corrected, also before they have been measured.
void drawMarks(ImDrawList& list, const MeasuringView& view, Photo which, const PhotoFrame& frame) {
  constexpr measure::OverlayColour kShadow{0.0f, 0.0f, 0.0f, 0.8f};
  constexpr measure::OverlayColour kMark{1.0f, 1.0f, 1.0f, 1.0f};
  constexpr measure::OverlayColour kSelected{1.0f, 0.85f, 0.0f, 1.0f};
  const std::vector<measure::Dot>& marks = view.photoMarks(which);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Vec2 at = frame.toScreen(marks[i].place_px);
    const bool selected = view.selected == ChosenMark{which, i};
    drawMark(list, at, measure::MarkForm::ring, kShadow, selected ? 9.0f : 6.5f);
    drawMark(list, at, measure::MarkForm::ring, selected ? kSelected : kMark, selected ? 8.0f : 5.5f);
  }
}

void drawContact(ImDrawList& list, const MeasuringView& view, Photo which, const PhotoFrame& frame) {
  if (which != Photo::before || !view.settings.contact_px) return;
  constexpr measure::OverlayColour kShadow{0.0f, 0.0f, 0.0f, 1.0f};
  constexpr measure::OverlayColour kContact{0.3f, 1.0f, 1.0f, 1.0f};
  const Vec2 at = frame.toScreen(*view.settings.contact_px);
  drawMark(list, at + Vec2::Ones(), measure::MarkForm::cross, kShadow, 8.0f);
  drawMark(list, at, measure::MarkForm::cross, kContact, 8.0f);
}

void zoomByWheel(MeasuringView& view, const PhotoFrame& frame, const Vec2& mouse) {
  const auto notches = static_cast<double>(ImGui::GetIO().MouseWheel);
  if (notches != 0.0) zoomAbout(view, frame.share(mouse), std::pow(kZoomPerNotch, notches));
}

void shift(MeasuringView& view, const PhotoFrame& frame) {
  const bool by_left = view.tool == MeasuringTool::look && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (!by_left && !ImGui::IsMouseDown(ImGuiMouseButton_Right) && !ImGui::IsMouseDown(ImGuiMouseButton_Middle)) return;
  panBy(view, -vec(ImGui::GetIO().MouseDelta).cwiseQuotient(frame.photo_px * frame.pointsPerPx()));
}

void useMouse(MeasuringView& view, const PhotoPanel& panel, const PhotoFrame& frame) {
  const Photo which = panel.photo;
  const Vec2 mouse = vec(ImGui::GetIO().MousePos);
  const Vec2 at_px = frame.toPhoto(mouse);
  const double px = 1.0 / frame.pointsPerPx();
  if (ImGui::IsItemHovered()) zoomByWheel(view, frame, mouse);
  const bool takes = !panel.faded || view.tool == MeasuringTool::contact;  // marks are not shown on a faded one
  if (takes && ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && frame.holds(at_px)) {
    pressPhoto(view, which, at_px, kReachPoints * px, ImGui::GetIO().KeyShift);
  }
  if (!ImGui::IsItemActive()) return;
  if (view.drag && view.drag->photo == which) dragPhoto(view, at_px, kSlackPoints * px);
  shift(view, frame);
}

void drawMissingPhotoText(ImDrawList& list, const MeasuringView& view, Photo which, const Vec2& corner,
                          const Vec2& size) {
  const std::string name = tr(std::string(kPhotoNames[static_cast<std::size_t>(which)]).c_str());
  const std::string words = view.photo(which).file.empty() ? trf("No photograph {}", name)
                            : view.working                 ? trf("Reading {}", name)
                                                           : trf("Not read: {}", name);
  const auto wrap = static_cast<float>(size.x());
  const ImVec2 room = ImGui::CalcTextSize(words.c_str(), nullptr, false, wrap);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), imVec(corner + 0.5 * (size - vec(room))),
               IM_COL32(220, 220, 220, 255), words.c_str(), nullptr, wrap);
}

}  // namespace

void photoPanel(MeasuringView& view, const PhotoPanel& panel, const Vec2& size) {
  const ShownPhoto& photo = view.photo(panel.photo);
  const Vec2 corner = vec(ImGui::GetCursorScreenPos());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(imVec(corner), imVec(corner + size), kBesidePhoto);
  ImGui::InvisibleButton(
      panel.path, imVec(size),
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  notePlace(panel.path);
  if (photo.texture == 0) return drawMissingPhotoText(list, view, panel.photo, corner, size);
  const PhotoFrame before = frameOf(view, photo, corner, size);
  useMouse(view, panel, before);
  const PhotoFrame frame = frameOf(view, photo, corner, size);
  list.PushClipRect(imVec(corner), imVec(corner + size), true);
  drawTexture(list, photo, frame, panel.faded);
  if (panel.overlay != nullptr) drawOverlay(list, *panel.overlay, frame);
  if (view.tool == MeasuringTool::dots && !panel.faded) drawMarks(list, view, panel.photo, frame);
  drawContact(list, view, panel.photo, frame);
  if (panel.overlay != nullptr) drawOverlayLabels(list, *panel.overlay, frame);
  list.PopClipRect();
}

}  // namespace palpate::viewer
