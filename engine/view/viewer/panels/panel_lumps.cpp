// Lumps under the skin: the list, the editor's switch, and the properties of the selected one.
#include <algorithm>

#include "view/viewer/editing/lump_editor.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/place_widgets.h"

namespace palpate::viewer {

namespace {

void drawLumpList(const LumpEdit& edit) {
  const auto& items = edit.items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double wide_mm = 2.0 * items[i].halfAxes().x();
    const std::string what = trf("{}: {:.0f} mm at {}", items[i].name, wide_mm, placeOf(items[i]));
    const bool chosen = edit.editor.selected == static_cast<int>(i);
    if (ImGui::Selectable(fmt::format("{}##{}", what, i).c_str(), chosen)) edit.editor.selected = static_cast<int>(i);
    notePlace(fmt::format("lumps/{}", i + 1), "Select this lump; then the wheel sizes it and Delete removes it.");
  }
  if (items.empty()) remark("None: there is nothing to be found under the skin.");
}

/// A ball has one size; another ellipsoid keeps its shape.
void sizeField(const LumpEdit& edit, scene::LumpSettings& item, const std::string& name) {
  double wide_mm = 2.0 * item.halfAxes().x();
  const double before_mm = wide_mm;
  if (!slider(edit, wide_mm,
              {"lumps/size", "size", "%.1f mm", kMinLumpMm, kMaxLumpMm, 10.0, "Its diameter, as seen from the skin."},
              trf("resize {}", name))) {
    return;
  }
  if (!item.half_axes_mm) {
    item.diameter_mm = wide_mm;
    return;
  }
  const double factor = wide_mm / before_mm;
  item.half_axes_mm = item.half_axes_mm->unaryExpr(
      [&](double half) { return std::clamp(factor * half, 0.5 * kMinLumpMm, 0.5 * kMaxLumpMm); });
}

void hardnessField(const LumpEdit& edit, scene::LumpSettings& item, const std::string& name) {
  const std::string words = trf("change {}", name);
  if (item.young_kpa > 0.0) {
    slider(edit, item.young_kpa, {"lumps/young", "hardness", "%.1f kPa", 0.1, 1000.0, 60.0, "Its Young's modulus."},
           words);
  } else {
    slider(edit, item.stiffness_ratio,
           {"lumps/hardness", "hardness", "%.1f x", kMinLumpRatio, 50.0, 5.0,
            "How many times as stiff as the tissue around it; below 1 it is softer, such as a cyst."},
           words);
  }
}

void mobilityField(const LumpEdit& edit, scene::LumpSettings& item, const std::string& name) {
  constexpr double kLeastMobility = 0.1;  // least in a scene file; below, it is fixed
  if (!slider(edit, item.mobility_mm_per_n,
              {"lumps/mobility", "mobility", "%.1f mm/N", 0.0, 100.0, 0.0, "Sideways motion under 1 N; 0 is fixed."},
              trf("loosen {}", name))) {
    return;
  }
  if (item.mobility_mm_per_n < kLeastMobility) item.mobility_mm_per_n = 0.0;
}

void drawFields(const LumpEdit& edit, scene::LumpSettings& item, const std::string& name) {
  placeField("lumps", edit, item, name);
  sizeField(edit, item, name);
  slider(edit, item.depth_mm,
         {"lumps/depth", "depth", "%.1f mm", 2.5, 60.0, 8.0,
          "Depth of its top; it must be below the skin layer and above the bone."},
         trf("sink {}", name));
  hardnessField(edit, item, name);
  slider(edit, item.edge,
         {"lumps/edge", "soft edge", "%.2f", 0.0, 1.0, 0.0,
          "Share of the radius over which it softens to the tissue; 0 is a sharp edge."},
         trf("soften {}", name));
  mobilityField(edit, item, name);
  slider(edit, item.raise_mm,
         {"lumps/swelling", "swelling", "%.1f mm", 0.0, 10.0, 0.0,
          "How far the skin over it is raised at rest; the body is rebuilt."},
         trf("raise {}", name));
  placeNumbers("lumps/x", "lumps/y", edit, item, name);
}

}  // namespace

void lumpPanel(const LumpPanel& panel) {
  const LumpEdit& edit = panel.edit;
  editorSwitch("lumps/edit", edit,
               toTranslate("Click the skin to place one, drag to move it, wheel for its size, Shift and wheel for its "
                           "hardness, Delete to remove it."));
  drawLumpList(edit);
  newField("lumps", edit,
           trf("Where: {}, or a distance in mm from it. Enter places a lump of 10 mm.", examplePlaces(edit.landmarks)));
  if (scene::LumpSettings* item = selectedItem(edit)) {
    drawFields(edit, *item, nameOfSelected(edit));
    if (buttonWidget("lumps/delete", "Delete")) deleteSelected(edit);
    ImGui::SameLine();
  }
  historyButtons("lumps", {panel.undo_words, panel.redo_words}, edit.output);
}

}  // namespace palpate::viewer
