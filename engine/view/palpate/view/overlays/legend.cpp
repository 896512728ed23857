// The bar is drawn in strips by the colour map of the skin. A finger's value is interpolated between the corners of its
// triangle at rest, as a pixel's is. Each picture.
#include "palpate/view/overlays/legend.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/language.h"
#include "palpate/scene/skin_channels.h"

namespace palpate::view {

namespace {

double valueAtVertex(const scene::World& world, const deform::DeformedSurface& surface, const Look& look, Index v) {
  const Colouring colouring = look.colouring;
  if (colouring == Colouring::scalar) return scene::scalarNamed(world.body->channels.get(), look.scalar)->values[v];
  if (colouring == Colouring::strain) return 100.0 * surface.strain()[v];
  if (colouring == Colouring::stiffness) return (*world.surface.stiffness_n_per_mm)[v];
  const Vec3& place = world.body->skin.positions[v];
  return world.ellipses.at(place.x(), place.y()).half_major_mm;
}

/// Shares of a triangle's corners in a place on it.
Vec3 cornerShares(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& place) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (!(area > 0.0)) return Vec3::Constant(1.0 / 3.0);
  const double at_b = (place - a).cross(c - a).dot(normal) / area;
  const double at_c = (b - a).cross(place - a).dot(normal) / area;
  return {1.0 - at_b - at_c, at_b, at_c};
}

}  // namespace

std::optional<ColourScale> findColourScale(Colouring colouring) {
  switch (colouring) {
    case Colouring::strain:
      return ColourScale{fieldColourMap(colouring), tr("strain"), "%"};
    case Colouring::stiffness:
      return ColourScale{fieldColourMap(colouring), tr("stiffness"), "N/mm"};
    case Colouring::ellipses:
      return ColourScale{fieldColourMap(colouring), tr("half-major"), "mm"};
    case Colouring::scalar:
      return ColourScale{fieldColourMap(colouring), tr("scalar"), ""};
    case Colouring::plain:
      break;
  }
  return std::nullopt;
}

std::optional<ColourScale> findColourScale(const Look& look, const scene::World& world) {
  if (look.colouring != Colouring::scalar) return findColourScale(look.colouring);
  const scene::SkinScalar* scalar = scene::scalarNamed(world.body->channels.get(), look.scalar);
  if (scalar == nullptr) return std::nullopt;
  return ColourScale{look.scalar_map, scalar->name, ""};
}

std::optional<double> valueUnder(const scene::World& world, const deform::DeformedSurface& surface, const Look& look,
                                 const contact::FingerOutput& finger) {
  const bool touches = finger.touch != contact::Touch::free && finger.triangle < world.body->skin.triangles.size();
  if (!touches || !findColourScale(look, world)) return std::nullopt;
  const auto& corners = world.body->skin.triangles[finger.triangle];
  const auto& places = world.body->skin.positions;
  const Vec3 shares = cornerShares(places[corners[0]], places[corners[1]], places[corners[2]], finger.proxy);
  double value = 0.0;
  for (int i = 0; i < 3; ++i) value += shares[i] * valueAtVertex(world, surface, look, corners[i]);
  return value;
}

namespace {

constexpr int kMaxNumbers = 5;
constexpr float kPoint = 9.0f;  ///< height of a pointed end
constexpr float kTick = 4.0f;

ColourBytes colourAt(const Legend& legend, double share) { return bytesOf(colourOf(legend.map, share)); }

/// The strips are too thin for visible steps.
void drawBar(Drawing& page, const Legend& legend, const LegendPlace& place) {
  const int strips = std::max(1, static_cast<int>(std::lround(place.size.y())));
  for (int i = 0; i < strips; ++i) {
    const float top = place.corner.y() + place.size.y() * static_cast<float>(i) / static_cast<float>(strips);
    const float below = place.corner.y() + place.size.y() * static_cast<float>(i + 1) / static_cast<float>(strips);
    const Ink ink{colourAt(legend, 1.0 - (i + 0.5) / strips)};
    page.box({place.corner.x(), top}, {place.corner.x() + place.size.x(), below}, ink);
  }
}

void drawPointedEnds(Drawing& page, const Legend& legend, const LegendPlace& place) {
  const float left = place.corner.x();
  const float right = left + place.size.x();
  const float middle = 0.5f * (left + right);
  const float top = place.corner.y() - 1.0f;
  const float below = place.corner.y() + place.size.y() + 1.0f;
  page.triangle({left, top}, {middle, top - kPoint}, {right, top}, {colourAt(legend, 1.0)});
  page.triangle({left, below}, {right, below}, {middle, below + kPoint}, {colourAt(legend, 0.0)});
}

float yOnBar(const Legend& legend, const LegendPlace& place, double value) {
  return place.corner.y() + place.size.y() * static_cast<float>(1.0 - heightOnBar(legend, value));
}

void drawNumbers(Drawing& page, const Legend& legend, const LegendPlace& place, const LabelInks& inks) {
  const std::vector<double> values = roundMarks(legend.range.low, legend.range.high, kMaxNumbers);
  const double step = values.size() > 1 ? values[1] - values[0] : 1.0;
  const float right = place.corner.x() + place.size.x();
  const float half_line = 0.5f * page.measure("0", TextSize::small).y();
  for (const double value : values) {
    const float y = yOnBar(legend, place, value);
    page.line({right, y}, {right + kTick, y}, inks.letter);
    writeLabel(page, {right + kTick + 3.0f, y - half_line}, markText(value, step), inks, Align::left, TextSize::small);
  }
}

void drawLegendLabels(Drawing& page, const Legend& legend, const LegendPlace& place, const LabelInks& inks) {
  const float middle = place.corner.x() + 0.5f * place.size.x();
  const float line = page.measure("0", TextSize::small).y();
  const float above = place.corner.y() - kPoint - line - 4.0f;
  const float below = place.corner.y() + place.size.y() + kPoint + 3.0f;
  if (!legend.high_word.empty())
    writeLabel(page, {middle, above}, legend.high_word, inks, Align::centre, TextSize::small);
  if (!legend.low_word.empty())
    writeLabel(page, {middle, below}, legend.low_word, inks, Align::centre, TextSize::small);
  const float title = above - (legend.high_word.empty() ? 0.0f : line + 3.0f) - 2.0f;
  const std::string words = legend.unit.empty() ? legend.title : legend.title + ", " + legend.unit;
  writeLabel(page, {middle, title}, words, inks, Align::centre);
}

/// A wedge at the bar's left that points at the value under a finger.
void drawMark(Drawing& page, const Legend& legend, const LegendPlace& place, const Legend::Mark& mark,
              const LabelInks& inks) {
  const float y = yOnBar(legend, place, mark.value);
  const float tip = place.corner.x() - 1.0f;
  page.triangle({tip + 1.5f, y}, {tip - 11.0f, y + 6.5f}, {tip - 11.0f, y - 6.5f}, inks.letter);
  page.triangle({tip, y}, {tip - 9.5f, y + 5.0f}, {tip - 9.5f, y - 5.0f}, {mark.colour});
}

}  // namespace

double heightOnBar(const Legend& legend, double value) {
  return std::clamp(rangeFraction(legend.range, value), 0.0, 1.0);
}

void drawLegend(Drawing& page, const Legend& legend, const LegendPlace& place, const LabelInks& inks) {
  drawPointedEnds(page, legend, place);
  drawBar(page, legend, place);
  drawNumbers(page, legend, place, inks);
  drawLegendLabels(page, legend, place, inks);
  for (const Legend::Mark& mark : legend.marks) drawMark(page, legend, place, mark, inks);
}

}  // namespace palpate::view
