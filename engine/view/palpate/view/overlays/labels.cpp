// Labels with fixed places come first (scale bar, directions, legends, title, section) and register them; the numbers
// of the fingers come last and find a free place (plates.h). Computed again for each picture.
#include "palpate/view/overlays/labels.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "palpate/base/language.h"
#include "palpate/view/layers/finger_layer.h"
#include "palpate/view/layers/skin_dents.h"
#include "palpate/view/overlays/legend.h"
#include "palpate/view/overlays/lens.h"
#include "palpate/view/overlays/plates.h"
#include "palpate/view/overlays/section.h"

namespace palpate::view {

namespace {

constexpr float kMargin = 14.0f;
/// Areas of labels that must stay readable: later labels keep out of them.
using Taken = std::vector<LabelBox>;

// ---- title

void drawTitle(Drawing& page, const std::string& title, const LabelInks& inks, Taken& taken) {
  if (title.empty()) return;
  const Vec2f corner(kMargin, kMargin - 3.0f);
  writeLabel(page, corner, title, inks, Align::left, TextSize::title);
  taken.push_back({corner, corner + page.measure(title, TextSize::title)});
}

// ---- colours

std::string lowWord(Colouring colouring) { return colouring == Colouring::strain ? tr("compression") : ""; }
std::string highWord(Colouring colouring) { return colouring == Colouring::strain ? tr("tension") : ""; }

Legend makeLegend(const LabelScene& scene, const ColourScale& scale) {
  const Look& look = scene.look;
  Legend legend{.title = std::string(scale.title),
                .unit = std::string(scale.unit),
                .low_word = lowWord(look.colouring),
                .high_word = highWord(look.colouring),
                .range = look.range(),
                .map = scale.map,
                .marks = {}};
  for (const FingerMark& finger : scene.frame.fingers) {
    const auto value = valueUnder(scene.world, scene.surface, look, finger.contact);
    if (value) legend.marks.push_back({*value, encodedColour(finger.colour)});
  }
  return legend;
}

void drawColours(Drawing& page, const LabelScene& scene, Taken& taken) {
  const auto scale = findColourScale(scene.look, scene.world);
  if (!scale) return;
  LegendPlace place;
  constexpr float kRoomForWords = 52.0f;
  constexpr float kRoomForNumbers = 46.0f;
  constexpr float kRoomBelow = 128.0f;  // the lower end's word, and the figure of directions
  const float free_height = page.size().y() - kMargin - kRoomForWords - kRoomBelow;
  place.size.y() = std::round(std::clamp(std::min(0.45f * page.size().y(), free_height), 60.0f, 260.0f));
  place.corner = {std::round(page.size().x() - kMargin - kRoomForNumbers - place.size.x()), kMargin + kRoomForWords};
  drawLegend(page, makeLegend(scene, *scale), place, inksFor(scene.look));
  constexpr float kRoomForMarks = 22.0f;  // the wedges at its left, and text wider than the bar
  constexpr float kRoomForLowWord = 34.0f;
  taken.push_back({{place.corner.x() - kRoomForMarks, 0.0f},
                   {page.size().x(), place.corner.y() + place.size.y() + kRoomForLowWord}});
}

// ---- size and direction

void drawScaleBar(Drawing& page, const Eyes& eyes, const LabelInks& inks, Taken& taken) {
  const double screen_mm = (eyes.screen.upper_left - eyes.screen.lower_left).norm();
  const double points_per_mm = page.size().y() / screen_mm;
  constexpr double kShareOfPage = 0.2;
  const double length_mm = roundStepDown(kShareOfPage * page.size().x() / points_per_mm);
  const auto length = static_cast<float>(length_mm * points_per_mm);
  const float y = page.size().y() - kMargin - 2.0f;
  constexpr float kEnd = 5.0f;
  for (const auto& [ink, thickness] : {std::pair{inks.rim, 4.0f}, {inks.letter, 2.0f}}) {
    page.line({kMargin, y}, {kMargin + length, y}, ink, thickness);
    page.line({kMargin, y - kEnd}, {kMargin, y + kEnd}, ink, thickness);
    page.line({kMargin + length, y - kEnd}, {kMargin + length, y + kEnd}, ink, thickness);
  }
  const std::string words =
      length_mm >= 1.0 ? fmt::format("{:.0f} mm", length_mm) : fmt::format("{:g} mm", WrittenNumber{length_mm});
  writeLabel(page, {kMargin + 0.5f * length, y - kEnd - 18.0f}, words, inks, Align::centre);
  taken.push_back({{kMargin, y - kEnd - 18.0f}, {kMargin + length, page.size().y()}});
}

/// An axis of the patient as the camera sees it: half of the figure's width and its letter at the end.
void drawAxis(Drawing& page, const Vec2f& middle, const Vec2f& end, std::string_view letter, const LabelInks& inks) {
  constexpr float kShortest = 7.0f;  ///< points; a shorter axis points at the eye
  if (end.norm() < kShortest) return;
  page.line(middle, middle + end, inks.rim, 3.5f);
  page.line(middle, middle + end, inks.letter, 1.5f);
  const Vec2f letter_place = middle + end + 9.0f * end.normalized();
  writeLabel(page, {letter_place.x(), letter_place.y() - 8.0f}, letter, inks, Align::centre);
}

void drawOrientation(Drawing& page, const Camera& camera, const LabelInks& inks, Taken& taken) {
  constexpr float kRadius = 24.0f;
  const Vec2f middle = page.size() - Vec2f(kMargin + kRadius + 20.0f, kMargin + kRadius - 4.0f);
  const auto seen = [&](const Vec3& direction) {
    return Vec2f(kRadius * static_cast<float>(direction.dot(camera.right())),
                 -kRadius * static_cast<float>(direction.dot(camera.up())));
  };
  drawAxis(page, middle, seen(Vec3::UnitX()), tr("R"), inks);
  drawAxis(page, middle, seen(-Vec3::UnitX()), tr("L"), inks);
  drawAxis(page, middle, seen(Vec3::UnitY()), tr("cranial"), inks);
  constexpr float kWithLetters = kRadius + 18.0f;
  taken.push_back({middle - Vec2f::Constant(kWithLetters), page.size()});
}

// ---- fingers

std::string nameOf(const LabelSettings& settings, std::size_t finger) {
  return finger < settings.finger_names.size() ? settings.finger_names[finger] : std::string();
}

/// Maps a place of the world to the page, seen from between the eyes.
Vec2f placeOnPage(const Drawing& page, const Eyes& eyes, const Vec3& place) {
  constexpr double kNearMm = 1.0;
  constexpr double kFarMm = 1e5;
  const Vec2 seen = seenAt(makeFrustum(eyes.screen, eyes.middle, kNearMm, kFarMm), place);
  return seen.cast<float>().cwiseProduct(page.size());
}

/// Largest drawn depth of the skin, mm.
double maxDrawnDepthMm(const scene::World& world) { return world.deformation.common.tissue.normal_cap_mm; }

Vec2f measureLines(const Drawing& page, const std::vector<std::string>& lines) {
  Vec2f extent = Vec2f::Zero();
  for (const std::string& line : lines) {
    const Vec2f size = page.measure(line, TextSize::small);
    extent = {std::max(extent.x(), size.x()), extent.y() + size.y() + 1.0f};
  }
  return extent;
}

/// Draws a plate next to the finger, never under it nor under another label, with a line to it; never off the page.
void drawNumbers(Drawing& page, const Vec2f& tip, const FingerMark& finger, const std::vector<std::string>& lines,
                 const LabelInks& inks, Taken& taken) {
  constexpr float kPad = 6.0f;
  constexpr float kStripe = 3.0f;
  const Vec2f size = measureLines(page, lines) + Vec2f(2.0f * kPad + kStripe, 2.0f * kPad);
  const Vec2f margin = Vec2f::Constant(kMargin);
  const LabelBox plate = placePlate(tip, size, {margin, page.size() - margin}, taken);
  taken.push_back(plate);
  const Vec2f corner = plate.corner;
  page.line(tip, nearestCorner(plate, tip), inks.letter, 1.2f);
  page.box(corner, corner + size, inks.plate, 4.0f);
  page.box(corner, corner + Vec2f(kStripe, size.y()), Ink{encodedColour(finger.colour)});
  float y = corner.y() + kPad;
  for (const std::string& line : lines) {
    page.text({corner.x() + kPad + kStripe, y}, line, inks.letter, Align::left, TextSize::small);
    y += page.measure(line, TextSize::small).y() + 1.0f;
  }
}

/// Size of the shape drawn for a finger, from its tip backwards: length, thickness at both ends, mm; and slope.
struct DrawnFinger {
  double length_mm = 0.0;
  double tip_mm = body::kFingertipMm;  ///< half of the thickness
  double end_mm = body::kFingertipMm;
  double steep_rad = 0.9;
};
DrawnFinger drawnAs(FingerShape shape, double radius_mm) {
  const double size = radius_mm / body::kFingertipMm;
  if (shape == FingerShape::hand) return {190.0 * size, radius_mm, 48.0 * size, 0.75};
  if (shape == FingerShape::finger || shape == FingerShape::automatic) return {44.0 * size, radius_mm, radius_mm};
  return {0.0, radius_mm, radius_mm};
}

/// Registers its boxes on the page, never smaller than the end of a plate's line.
void reserveFingerBoxes(const Drawing& page, const LabelScene& scene, const FingerMark& finger, Taken& taken) {
  constexpr int kSteps = 5;
  constexpr float kLeast = 14.0f;
  if (scene.look.finger == FingerShape::none) return;
  const DrawnFinger drawn = drawnAs(scene.look.finger, finger.radius_mm);
  const bool touches = finger.contact.touch != contact::Touch::free;
  const Vec3 up = touches ? finger.contact.normal : scene.camera.backward();
  const Vec3 backwards = std::sin(drawn.steep_rad) * up - std::cos(drawn.steep_rad) * fingerHeading(up, finger.left);
  const double screen_mm = (scene.eyes.screen.upper_left - scene.eyes.screen.lower_left).norm();
  const double points_per_mm = static_cast<double>(page.size().y()) / screen_mm;
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const Vec2f at = placeOnPage(page, scene.eyes, finger.contact.proxy + share * drawn.length_mm * backwards);
    const double half_mm = drawn.tip_mm + share * (drawn.end_mm - drawn.tip_mm);
    const Vec2f half = Vec2f::Constant(std::max(kLeast, static_cast<float>(points_per_mm * half_mm)));
    if (at.allFinite()) taken.push_back({at - half, at + half});
  }
}

/// Registers all fingers first, so that no plate covers any of them.
void drawFingers(Drawing& page, const LabelScene& scene, const LabelSettings& settings, Taken& taken) {
  std::vector<Vec2f> tips;
  for (const FingerMark& finger : scene.frame.fingers) {
    tips.push_back(placeOnPage(page, scene.eyes, finger.contact.proxy));
    reserveFingerBoxes(page, scene, finger, taken);
  }
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const FingerMark& finger = scene.frame.fingers[i];
    const bool speaks = finger.contact.touch != contact::Touch::free || finger.lifted;
    if (!speaks || !tips[i].allFinite()) continue;
    drawNumbers(page, tips[i], finger, fingerLabelLines(scene.world, finger, nameOf(settings, i)), inksFor(scene.look),
                taken);
  }
}

// ---- keys of overlays

constexpr float kScaleBarHeight = 46.0f;

Vec2f sectionSize(const Drawing& page) {
  return {std::round(std::clamp(0.32f * page.size().x(), 150.0f, 320.0f)),
          std::round(std::clamp(0.34f * page.size().y(), 92.0f, 180.0f))};
}

/// The finger whose cut is drawn as a chart, or null.
const FingerMark* chartedFinger(const LabelScene& scene, const LabelSettings& settings) {
  if (!settings.section || !scene.look.shows(Overlay::section)) return nullptr;
  const FingerMark* finger = sectionFinger(scene.frame.fingers);
  return finger == nullptr || finger->contact.touch == contact::Touch::free ? nullptr : finger;
}

/// Whether a press is so small in the picture that contours are drawn on its dent, and deep enough for one of them.
bool hasDentContours(const Drawing& page, const LabelScene& scene) {
  const bool deep = std::ranges::any_of(scene.frame.fingers, [](const FingerMark& finger) {
    return finger.contact.touch != contact::Touch::free && finger.contact.depth_mm > kOutermostContourMm;
  });
  if (!deep || scene.look.colouring != Colouring::plain || !(scene.look.dent_contrast > 0.0)) return false;
  const double mm_per_point = 2.0 * std::tan(0.5 * scene.camera.height_rad) / page.size().y();
  return std::ranges::any_of(collectDents(scene.frame.fingers, scene.world, scene.frame.lift_mm),
                             [&](const SkinDent& dent) {
                               const Vec3 place = scene.world.deformable->origin + dent.place.cast<double>();
                               const double away_mm = (scene.camera.eye() - place).dot(scene.camera.backward());
                               return dent.share > 0.5f && mm_per_point * away_mm > 0.5 * (kLeastHelpMm + kFullHelpMm);
                             });
}

/// The overlays that the look shows on this body: keys of missing ones would explain nothing.
std::vector<KeyEntry> keyOf(const Drawing& page, const LabelScene& scene) {
  const auto named = [&](bool muscle) {
    return std::ranges::any_of(scene.names, [&](const BodyName& n) { return (n.kind == NameKind::muscle) == muscle; });
  };
  Look look = scene.look;
  look.show(Overlay::names, look.shows(Overlay::names) && named(false));
  look.show(Overlay::muscles, look.shows(Overlay::muscles) && named(true));
  look.show(Overlay::lumps, look.shows(Overlay::lumps) && !scene.world.lumps.empty());
  return overlayKey(look, hasDentContours(page, scene));
}

/// Below the title, down to the scale bar or the chart over it.
void drawKey(Drawing& page, const LabelScene& scene, const LabelSettings& settings, Taken& taken) {
  const float above = settings.title.empty() ? 0.0f : page.measure(settings.title, TextSize::title).y();
  KeyPlace place;
  place.corner = {kMargin, kMargin + above};
  constexpr float kColours = 100.0f;  // the bar at the right
  const float chart = chartedFinger(scene, settings) != nullptr ? sectionSize(page).y() : 0.0f;
  const float right = findColourScale(scene.look.colouring) ? kColours : kMargin;
  place.room = page.size() - place.corner - Vec2f(right, kScaleBarHeight + chart);
  const LabelBox covered = drawOverlayKey(page, keyOf(page, scene), place, inksFor(scene.look));
  if (covered.opposite != covered.corner) taken.push_back(covered);
}

// ---- the close view from the side

/// Draws its frame, over the finished picture in it. Returns where its right neighbour may begin.
float drawLensFrame(Drawing& page, const LabelScene& scene, Taken& taken) {
  const auto place = lensPlace(scene.look, scene.frame.fingers, page.size());
  if (!place) return kMargin;
  const Vec2f opposite = place->corner + place->size;
  const LabelInks& inks = inksFor(scene.look);
  page.frame(place->corner, opposite, inks.letter);
  writeLabel(page, place->corner + Vec2f(8.0f, 5.0f), tr("from the side"), inks, Align::left, TextSize::small);
  taken.push_back({place->corner, opposite});
  return opposite.x() + kMargin;
}

// ---- the cut through the deepest contact

/// The letter of an end, where the line on the skin ends.
void drawEnd(Drawing& page, const LabelScene& scene, const Vec3& place, const std::string& name, Taken& taken) {
  const Vec2f at = placeOnPage(page, scene.eyes, place);
  if (!at.allFinite()) return;
  const std::string letter = name.substr(0, 1);
  const Vec2f half = 0.5f * page.measure(letter, TextSize::normal);
  writeLabel(page, at - half, letter, inksFor(scene.look), Align::left, TextSize::normal);
  taken.push_back({at - half, at + half});
}

/// Above the scale bar: fingers are mostly in the middle.
void drawCut(Drawing& page, const LabelScene& scene, const FingerMark* finger, float left, Taken& taken) {
  if (finger == nullptr) return;
  const SectionPlane plane = sectionPlane(scene.world, finger->contact);
  const auto curve = sectionCurve(scene.world, scene.surface, plane, kSectionHalfWidthMm);
  if (curve.empty()) return;
  SectionChart chart;
  chart.size = sectionSize(page);
  chart.corner = {left, page.size().y() - chart.size.y() - kScaleBarHeight};
  chart.ends = sectionEnds(plane);
  if (finger->contact.depth_mm > maxDrawnDepthMm(scene.world)) chart.cap_mm = maxDrawnDepthMm(scene.world);
  drawSection(page, curve, chart, inksFor(scene.look));
  taken.push_back({chart.corner, chart.corner + chart.size});
  drawEnd(page, scene, onPlane(plane, curve.front().deformed), chart.ends.low, taken);
  drawEnd(page, scene, onPlane(plane, curve.back().deformed), chart.ends.high, taken);
}

// ---- beneath the skin

/// The name of each lump on the side that is seen, over it.
void drawLumpNames(Drawing& page, const LabelScene& scene, Taken& taken) {
  const double screen_mm = (scene.eyes.screen.upper_left - scene.eyes.screen.lower_left).norm();
  const auto points_per_mm = static_cast<float>(static_cast<double>(page.size().y()) / screen_mm);
  for (const auto& placed : scene.world.lumps) {
    const contact::Lump& lump = placed->lump;
    if (!(lump.axis.dot(scene.eyes.middle - lump.foot) > 0.0)) continue;
    const Vec2f at = placeOnPage(page, scene.eyes, lump.foot - lump.shape.centreMm() * lump.axis);
    if (!at.allFinite()) continue;
    const Vec2f size = page.measure(placed->name, TextSize::normal);
    const float above = points_per_mm * static_cast<float>(lump.shape.half_axes_mm[0]) + size.y() + 3.0f;
    writeLabel(page, at - Vec2f(0.0f, above), placed->name, inksFor(scene.look), Align::centre, TextSize::normal);
    taken.push_back({at - Vec2f(0.5f * size.x(), above), at + Vec2f(0.5f * size.x(), above)});
  }
}

/// The letters of the chart's ends where the line on the skin ends.
void drawCutEnds(Drawing& page, const LabelScene& scene, const CutAway& cut, Taken& taken) {
  const SectionEnds ends = sectionEnds(cut.plane);
  const auto at = [&](double along_mm) {
    const auto nearest = std::min_element(cut.skin.begin(), cut.skin.end(), [&](const Vec2& a, const Vec2& b) {
      return std::abs(a.x() - along_mm) < std::abs(b.x() - along_mm);
    });
    return onPlane(cut.plane, *nearest);
  };
  drawEnd(page, scene, at(-kCutLineMm), ends.low, taken);
  drawEnd(page, scene, at(kCutLineMm), ends.high, taken);
}

/// Pads at the right, next to the figure of directions; the cut-away at the left, in place of the section. `left` then
/// begins next to it.
void drawBeneath(Drawing& page, const LabelScene& scene, const LabelSettings& settings, float& left, Taken& taken) {
  constexpr float kFigure = 90.0f;  // size of the figure of directions
  const LabelInks& inks = inksFor(scene.look);
  if (scene.look.shows(Overlay::lumps)) drawLumpNames(page, scene, taken);
  const float right = page.size().x() - kMargin - (settings.orientation ? kFigure : 0.0f);
  if (scene.cut != nullptr) {
    const float width = std::round(std::clamp(0.34f * page.size().x(), 150.0f, 330.0f));
    taken.push_back(drawCutAway(page, *scene.cut, {left, page.size().y() - kScaleBarHeight}, width, inks));
    left = taken.back().opposite.x() + kMargin;
    drawCutEnds(page, scene, *scene.cut, taken);
  }
  if (scene.pads.empty()) return;
  const Vec2f corner(right, page.size().y() - kMargin);
  for (const LabelBox& box : drawPads(page, scene.pads, corner, right - left, inks)) taken.push_back(box);
}

}  // namespace

std::vector<std::string> fingerLabelLines(const scene::World& world, const FingerMark& finger,
                                          const std::string& name) {
  std::vector<std::string> lines;
  if (!name.empty()) lines.push_back(name);
  const contact::FingerOutput& contact = finger.contact;
  const Peak now{contact.depth_mm, contact.force.norm()};
  const Peak& said = finger.lifted ? *finger.lifted : now;
  const bool most = finger.lifted.has_value();
  lines.push_back(most ? trf("most depth {:.1f} mm", said.depth_mm) : trf("depth {:.1f} mm", said.depth_mm));
  lines.push_back(most ? trf("most force {:.2f} N", said.force_n) : trf("force {:.2f} N", said.force_n));
  if (now.depth_mm > maxDrawnDepthMm(world)) lines.push_back(trf("skin drawn {:g} mm deep", maxDrawnDepthMm(world)));
  return lines;
}

void drawLabels(Drawing& page, const LabelScene& scene, const LabelSettings& settings) {
  Taken taken;
  const LabelInks& inks = inksFor(scene.look);
  if (settings.scale_bar) drawScaleBar(page, scene.eyes, inks, taken);
  if (settings.orientation) drawOrientation(page, scene.camera, inks, taken);
  if (settings.legend) drawColours(page, scene, taken);
  drawTitle(page, settings.title, inks, taken);
  if (settings.legend) drawKey(page, scene, settings, taken);
  float left = drawLensFrame(page, scene, taken);
  if (settings.beneath) drawBeneath(page, scene, settings, left, taken);
  drawCut(page, scene, chartedFinger(scene, settings), left, taken);
  if (!scene.names.empty()) drawNames(page, scene, taken);
  if (settings.numbers) drawFingers(page, scene, settings, taken);
}

}  // namespace palpate::view
