// The look of the picture and its overlays.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "palpate/base/language.h"
#include "palpate/view/overlays/muscle_marks.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

/// Titles in place of the words of scene files.
constexpr std::string_view titleOf(view::Shading shading) {
  return shading == view::Shading::gouraud ? toTranslate("smooth (Gouraud)") : wordFor(shading);
}
constexpr std::string_view titleOf(view::FingerShape shape) {
  return shape == view::FingerShape::automatic ? toTranslate("hand where it is fast") : wordFor(shape);
}

/// In the order of the names, which is that of the enumerators.
template <class E>
constexpr auto allTitles() {
  std::array<std::string_view, WordsOf<E>::kAll.size()> titles;
  for (std::size_t i = 0; i < titles.size(); ++i) titles[i] = titleOf(WordsOf<E>::kAll[i].value);
  return titles;
}
constexpr auto kShadings = allTitles<view::Shading>();
constexpr auto kFingerShapes = allTitles<view::FingerShape>();

void lookWidgets(const ShowPanel& panel) {
  view::Look& look = panel.look;
  if (choiceWidget("show/shading", "shading", look.shading, kShadings,
                   "Light at the vertices, as in the dissertation (fastest), or at each pixel, like skin.")) {
    panel.simpler_when_slow = false;  // an explicit choice stays
  }
  flagWidget("show/simpler", "smooth while it is slow", panel.simpler_when_slow,
             "Below 20 pictures a second the skin is drawn smooth, until pictures are fast again.");
  if (panel.simple_now) {
    remark("Drawn smooth for now: pictures came too slowly.");
    if (buttonWidget("show/all_the_same", "Draw skin all the same")) panel.simpler_when_slow = false;
  }
  choiceWidget("show/finger", "finger", look.finger, kFingerShapes, "What is drawn in place of the finger.");
  numberWidget(look.skin_opacity,
               {"show/opacity", "skin opacity", "%.2f", 0.0, 1.0, 1.0, "Below 1 the bones show through (key O)."});
  numberWidget(look.skin_tone, {"show/tone", "skin tone", "%.1f", 1.0, 6.0, 3.0,
                                "From 1, very light, to 6, very dark, about as Fitzpatrick's types."});
  numberWidget(
      look.dent_contrast,
      {"show/dents", "dent contrast", "%.1f x", 0.0, 5.0, 1.0,
       "1 looks as from nearby, with contours on small dents; above 1, dents are drawn deeper than light shows them."});
  const bool has_colours = panel.world.channels && !panel.world.channels->colours.empty();
  if (panel.world.has_picture) {
    flagWidget("show/picture", "picture on the skin", look.texture, "The picture that the scene names.");
  } else if (has_colours) {
    flagWidget("show/colours", "colours of the file", look.texture, "The colours of the mesh file's vertices.");
  }
  flagWidget("show/white", "white background", look.white_background, "For use in papers.");
}

view::ColourRange& shownRange(view::Look& look) {
  if (look.colouring == view::Colouring::stiffness) return look.stiffness_n_per_mm;
  return look.colouring == view::Colouring::ellipses ? look.half_major_mm : look.strain_percent;
}

/// The range keeps the user's setting until another is chosen: colours must mean the same before and after.
void rangeWidgets(view::Look& look, const WorldFacts& world) {
  if (look.colouring == view::Colouring::plain) return;
  if (look.colouring == view::Colouring::scalar) return scalarWidgets(look, world);
  view::ColourRange& range = shownRange(look);
  const bool strain = look.colouring == view::Colouring::strain;
  if (strain) {
    double end = range.high;
    if (numberWidget(end, {"show/range", "to", "%.1f %%", 0.5, 100.0, 20.0, "Symmetric about zero strain."})) {
      range = {-end, end};
    }
    return;
  }
  const bool stiffness = look.colouring == view::Colouring::stiffness;
  const char* format = stiffness ? "%.2f N/mm" : "%.0f mm";
  const double most = stiffness ? 5.0 : 400.0;
  numberWidget(range.low,
               {"show/low", "from", format, 0.0, most, stiffness ? 0.3 : 100.0, "The value of the lowest colour."});
  numberWidget(range.high,
               {"show/high", "to", format, 0.0, most, stiffness ? 1.2 : 200.0, "The value of the highest colour."});
  if (stiffness && buttonWidget("show/fit", "Fit to the body")) {
    range = {world.softest_n_per_mm, world.stiffest_n_per_mm};
  }
  range.high = std::max(range.high, range.low + 1e-3);
}

void overlayWidget(view::Look& look, view::Overlay overlay) {
  const window::KeyBinding& binding = window::findBinding(window::actionFor(overlay));
  bool on = look.shows(overlay);
  const std::string path = fmt::format("show/{}", view::kOverlayNames[static_cast<std::size_t>(overlay)]);
  const std::string label =
      fmt::format("{}  ({})", tr(std::string(binding.name).c_str()), window::localisedChordName(binding.chord));
  if (flagWidget(path.c_str(), label.c_str(), on, std::string(binding.does).c_str())) {
    look.show(overlay, on);
  }
}

void viewButtons(UiOutput& output) {
  constexpr std::array<view::StandardView, 7> kOrder = {
      view::StandardView::back,  view::StandardView::front, view::StandardView::left, view::StandardView::right,
      view::StandardView::above, view::StandardView::below, view::StandardView::table};
  for (const view::StandardView side : kOrder) {
    const std::string name(wordFor(side));
    // "table" is also a law of the tissue, and another word in other languages.
    const std::string label = side == view::StandardView::table ? toTranslate("on a table") : name;
    const float width = ImGui::CalcTextSize(tr(label.c_str())).x + 8.0f;
    const float left = ImGui::GetItemRectMax().x + 3.0f;
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (side != kOrder.front() && left + width <= end) ImGui::SameLine(0.0f, 3.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {4.0f, 2.0f});
    if (buttonWidget(fmt::format("view/{}", name).c_str(), label.c_str(), "See the whole body from this side.")) {
      output.request(SetView{side});
    }
    ImGui::PopStyleVar();
  }
}

void colouringFlag(view::Look& look, view::Colouring colouring, const char* path, const char* label,
                   const char* meaning) {
  bool on = look.colouring == colouring;
  if (flagWidget(path, label, on, meaning)) look.colouring = on ? colouring : view::Colouring::plain;
}

}  // namespace

void viewRow(view::Look& look, const WorldFacts& world, UiOutput& output) {
  constexpr double kSeeThrough = 0.4;  // bones are visible, and so is the skin
  viewButtons(output);
  bool bones = look.skin_opacity < 1.0;
  if (world.has_bones) {
    if (flagWidget("quick/bones", "bones", bones, "Through half-transparent skin (key O has more steps).")) {
      look.skin_opacity = bones ? kSeeThrough : 1.0;
    }
    ImGui::SameLine();
  }
  bool names = look.shows(view::Overlay::names);
  if (!world.landmarks.empty()) {
    if (flagWidget("quick/names", "names", names, "Names of the body's places (key I).")) {
      look.show(view::Overlay::names, names);
    }
  }
  colouringFlag(look, view::Colouring::strain, "quick/strain", "strain", "Where the skin is stretched (key S).");
  ImGui::SameLine();
  colouringFlag(look, view::Colouring::stiffness, "quick/stiffness", "stiffness",
                "How hard each place pushes back, N/mm (key M).");
  ImGui::SameLine();
  flagWidget("quick/lens", "lens", look.lens, "The pressing finger from the side, close, in a corner of the picture.");
  ImGui::Separator();
}

void showPanel(const ShowPanel& panel) {
  lookWidgets(panel);
  ImGui::Separator();
  choiceWidget("show/colour", "colour by", panel.look.colouring, view::kColouringNames,
               "What the skin's colour shows.");
  rangeWidgets(panel.look, panel.world);
  ImGui::Separator();
  for (const view::Overlay overlay : view::kBodyOverlays) overlayWidget(panel.look, overlay);
  for (const view::Overlay overlay : view::kTouchOverlays) overlayWidget(panel.look, overlay);
  for (const view::Overlay overlay : view::kLumpOverlays) overlayWidget(panel.look, overlay);
  const bool engine = ImGui::TreeNode(tr("Engine"));
  notePlace("show/engine");
  if (engine) {
    for (const view::Overlay overlay : view::kEngineOverlays) overlayWidget(panel.look, overlay);
    flagWidget("show/adapts", "adapt the picture's resolution", panel.adapts_resolution,
               "While a finger touches or the view turns, the body is drawn with fewer pixels if 20 pictures a second "
               "need it, at least 50 % along each side. At rest, and in saved pictures, it has full resolution.");
    ImGui::TreePop();
  }
  if (panel.look.shows(view::Overlay::names) && panel.world.landmarks.empty()) remark("This body has no named places.");
  if (panel.look.shows(view::Overlay::muscles) && !view::hasMuscles(panel.world.landmarks)) {
    remark("This body lacks places that muscles are drawn between.");
  }
}

}  // namespace palpate::viewer
