// Data of the vertices in the body's file: the number that colours the skin, with its histogram, and the clicked
// vertex.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/body/places.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/view/overlays/place_words.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr auto kColourMaps = enumNames<ColourMap>();

ImU32 barColour(const view::Look& look, double value) {
  const view::ColourRange& range = look.scalar_range;
  const auto [red, green, blue] = bytesOf(colourOf(look.scalar_map, (value - range.low) / (range.high - range.low)));
  return IM_COL32(red, green, blue, 255);
}

/// A bar for each part of the values, in the colour that the skin has there; the highest fills the height.
void histogram(const view::Look& look, const scene::SkinScalar& scalar) {
  constexpr float kHeight = 56.0f;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const auto highest = static_cast<float>(*std::max_element(scalar.histogram.begin(), scalar.histogram.end()));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float step = width / static_cast<float>(scalar.histogram.size());
  for (std::size_t i = 0; i < scalar.histogram.size(); ++i) {
    if (scalar.histogram[i] == 0) continue;
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(scalar.histogram.size());
    const double value = scalar.least + share * (scalar.greatest - scalar.least);
    const float height = std::max(1.0f, kHeight * static_cast<float>(scalar.histogram[i]) / highest);
    const float left = corner.x + step * static_cast<float>(i);
    list.AddRectFilled({left, corner.y + kHeight - height}, {left + std::max(1.0f, step - 1.0f), corner.y + kHeight},
                       barColour(look, value));
  }
  ImGui::Dummy({width, kHeight});
  notePlace("show/histogram");
  remark(trf("vertices by value, {:.4g} to {:.4g}", scalar.least, scalar.greatest));
}

void endWidgets(view::Look& look, const scene::SkinScalar& scalar) {
  view::ColourRange& range = look.scalar_range;
  const double width = std::max(scalar.greatest - scalar.least, 1e-9);
  const double low = scalar.least - 0.5 * width;
  const double high = scalar.greatest + 0.5 * width;
  numberWidget(range.low, {"show/low", "from", "%.4g", low, high, scalar.least, "The value of the lowest colour."});
  numberWidget(range.high, {"show/high", "to", "%.4g", low, high, scalar.greatest, "The value of the highest colour."});
  if (buttonWidget("show/fit", "Fit to the body")) range = {scalar.least, scalar.greatest};
  range.high = std::max(range.high, range.low + 1e-3 * width);
}

}  // namespace

void scalarWidgets(view::Look& look, const WorldFacts& world) {
  const scene::SkinChannels* channels = world.channels.get();
  const scene::SkinScalar* shown = scene::scalarNamed(channels, look.scalar);
  if (shown == nullptr) return remark("The body's file has no numbers for its vertices; PLY files can have them.");
  std::vector<std::string_view> names;
  for (const scene::SkinScalar& scalar : channels->scalars) names.push_back(scalar.name);
  auto chosen = static_cast<std::size_t>(shown - channels->scalars.data());
  if (choiceWidget("show/scalar", "number", chosen, names, "A property of the file's vertices.")) {
    shown = &channels->scalars[chosen];
    look.scalar = shown->name;
    look.scalar_range = {shown->least, std::max(shown->greatest, shown->least + 1e-9)};
  }
  choiceWidget("show/scalar_map", "colours", look.scalar_map, kColourMaps, "From the lowest to the highest value.");
  endWidgets(look, *shown);
  histogram(look, *shown);
}

void vertexPanel(const VertexPanel& panel) {
  panel.open = true;
  flagWidget("vertex/mark", "cross on the skin", panel.marked, "Mark the vertex that was read.");
  if (!panel.reading) return remark("Press on the skin: the nearest vertex is read here.");
  const VertexReading& reading = *panel.reading;
  if (!reading.where.empty()) ImGui::TextWrapped("%s", view::placeInLanguage(reading.where).c_str());
  valueLine("vertex of the skin", fmt::format("{}", reading.vertex));
  if (reading.in_file) valueLine("in the file", fmt::format("{}", *reading.in_file));
  valueLine("x, y, z",
            fmt::format("{:.1f}, {:.1f}, {:.1f} mm", reading.place.x(), reading.place.y(), reading.place.z()));
  valueLine("stiffness", fmt::format("{:.3f} N/mm", reading.stiffness_n_per_mm));
  if (reading.bone_depth_mm) {
    const std::string bone = reading.bone.empty() ? "" : ", " + view::placeInLanguage(body::spokenName(reading.bone));
    valueLine("skin to bone", fmt::format("{:.1f} mm{}", *reading.bone_depth_mm, bone));
  }
  for (const VertexReading::Scalar& scalar : reading.scalars) {
    valueLine(scalar.name.c_str(), std::isfinite(scalar.value) ? fmt::format("{:.5g}", scalar.value) : tr("none"));
  }
}

}  // namespace palpate::viewer
