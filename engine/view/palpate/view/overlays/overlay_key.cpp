// The rows are a table by overlay; a sign is on a chip of the colour of skin, so that white lines and yellow ones are
// visible on a light plate too. Laid out again for each picture.
#include "palpate/base/language.h"
#include "palpate/view/overlays/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/view/overlays/marks.h"

namespace palpate::view {

namespace {

using Sign = KeyEntry::Sign;

struct KeyRow {
  Overlay overlay;
  Sign sign;
  Paint paint;
  const char* words;
};
// clang-format off
constexpr KeyRow kOverlayKeyRows[] = {
    {Overlay::wireframe, Sign::line, kWireframePaint, toTranslate("edges of the mesh")},
    {Overlay::haptic_triangles, Sign::patch, kHapticTrianglePaint, toTranslate("triangles looked at")},
    {Overlay::leaf_boxes, Sign::line, kLeafBoxPaint, toTranslate("leaf of the partition")},
    {Overlay::planes, Sign::line, kPlanePaints[0], toTranslate("plane across x")},
    {Overlay::planes, Sign::line, kPlanePaints[1], toTranslate("plane across y")},
    {Overlay::planes, Sign::line, kPlanePaints[2], toTranslate("plane across z")},
    {Overlay::detecting_box, Sign::line, kDetectingBoxPaint, toTranslate("detecting box")},
    {Overlay::ellipses, Sign::line, kNormalRegionPaint, toTranslate("skin that a press moves")},
    {Overlay::ellipses, Sign::line, kTangentialRegionPaint, toTranslate("skin that a pull moves")},
    {Overlay::ellipses, Sign::line, kKeyEllipsePaint, toTranslate("ellipse of a key point")},
    {Overlay::rings, Sign::line, kRingPaints[0], toTranslate("neighbours, every second ring")},
    {Overlay::rings, Sign::line, kRingPaints[1], toTranslate("the rings between")},
    {Overlay::arrows, Sign::arrow, kDisplacementPaint, toTranslate("displacement")},
    {Overlay::contact, Sign::cross, kTipPaint, toTranslate("tip of the finger")},
    {Overlay::contact, Sign::cross, kProxyPaint, toTranslate("proxy, on the skin")},
    {Overlay::contact, Sign::cross, kAnchorPaint, toTranslate("anchor of friction")},
    {Overlay::contact, Sign::arrow, kForcePaint, toTranslate("force, 10 mm/N")},
    {Overlay::normals, Sign::line, kNormalPaint, toTranslate("normal of the skin")},
    {Overlay::section, Sign::line, kDeformedSectionPaint, toTranslate("section, deformed")},
    {Overlay::section, Sign::line, kRestSectionPaint, toTranslate("section, at rest")},
    {Overlay::names, Sign::cross, kNamePaint, toTranslate("place with a name")},
    {Overlay::pressure, Sign::patch, kPadPaint, toTranslate("pressure under the fingertip")},
    {Overlay::lumps, Sign::patch, kLumpPaint, toTranslate("lump under the skin")},
    {Overlay::cut, Sign::line, kCutPaint, toTranslate("where the cut-away is")},
    {Overlay::muscles, Sign::patch, kTrapeziusPaint, toTranslate("trapezius (drawing)")},
    {Overlay::muscles, Sign::patch, kLatissimusPaint, toTranslate("latissimus dorsi (drawing)")},
    {Overlay::muscles, Sign::patch, kErectorPaint, toTranslate("erector spinae (drawing)")},
};
// clang-format on
static_assert(kForceMmPerN == 10.0, "the words say so");

constexpr Paint kDentPaint = {70, 52, 42, 255};

constexpr float kKeyPad = 6.0f;
constexpr float kChip = 18.0f;  ///< length of a sign
constexpr Ink kChipInk{{128, 104, 90}};

Ink toInk(const Paint& paint) { return {{paint[0], paint[1], paint[2]}, paint[3] / 255.0}; }

void drawSign(Drawing& page, const KeyEntry& entry, const Vec2f& corner, float height) {
  const Vec2f opposite = corner + Vec2f(kChip, height);
  const Ink ink = toInk(entry.paint);
  page.box(corner, opposite, kChipInk, 2.0f);
  const Vec2f middle = 0.5f * (corner + opposite);
  const Vec2f half(0.5f * kChip - 2.0f, 0.0f);
  constexpr float kArm = 4.0f;
  if (entry.sign == Sign::patch) return page.box(corner, opposite, ink, 2.0f);
  if (entry.sign == Sign::cross) {
    page.line(middle - Vec2f(kArm, 0.0f), middle + Vec2f(kArm, 0.0f), ink, 2.0f);
    page.line(middle - Vec2f(0.0f, kArm), middle + Vec2f(0.0f, kArm), ink, 2.0f);
    return;
  }
  page.line(middle - half, middle + half, ink, 2.0f);
  if (entry.sign != Sign::arrow) return;
  page.line(middle + half, middle + half - Vec2f(kArm, kArm), ink, 2.0f);
  page.line(middle + half, middle + half - Vec2f(kArm, -kArm), ink, 2.0f);
}

}  // namespace

std::vector<KeyEntry> overlayKey(const Look& look, bool dent_contours) {
  std::vector<KeyEntry> entries;
  for (const KeyRow& row : kOverlayKeyRows) {
    if (look.shows(row.overlay)) entries.push_back({row.sign, row.paint, tr(row.words)});
  }
  if (look.colouring == Colouring::plain && look.dent_contrast > 1.0) {
    entries.push_back({Sign::patch, kDentPaint, trf("dent contrast x{:g}", look.dent_contrast)});
  }
  if (dent_contours) entries.push_back({Sign::line, kDentPaint, tr("dent 0.5, 2.5, 4.5 ... mm deep")});
  return entries;
}

LabelBox drawOverlayKey(Drawing& page, const std::vector<KeyEntry>& entries, const KeyPlace& place,
                        const LabelInks& inks) {
  LabelBox covered{place.corner, place.corner};
  if (entries.empty()) return covered;
  const float line = page.measure("0", TextSize::small).y() + 3.0f;
  const auto rows = static_cast<std::size_t>(std::max(1.0f, std::floor((place.room.y() - 2.0f * kKeyPad) / line)));
  float left = place.corner.x();
  for (std::size_t first = 0; first < entries.size(); first += rows) {
    const std::size_t end = std::min(entries.size(), first + rows);
    float words = 0.0f;
    for (std::size_t i = first; i < end; ++i) {
      words = std::max(words, page.measure(entries[i].words, TextSize::small).x());
    }
    const Vec2f size(3.0f * kKeyPad + kChip + words, 2.0f * kKeyPad + static_cast<float>(end - first) * line);
    const Vec2f corner(left, place.corner.y());
    if (first > 0 && left + size.x() > place.corner.x() + place.room.x()) break;
    page.box(corner, corner + size, inks.plate, 4.0f);
    for (std::size_t i = first; i < end; ++i) {
      const Vec2f row = corner + Vec2f(kKeyPad, kKeyPad + static_cast<float>(i - first) * line);
      drawSign(page, entries[i], row + Vec2f(0.0f, 1.0f), line - 3.0f);
      page.text(row + Vec2f(kChip + kKeyPad, 0.0f), entries[i].words, inks.letter, Align::left, TextSize::small);
    }
    covered.opposite = covered.opposite.cwiseMax(corner + size);
    left += size.x() + kKeyPad;
  }
  return covered;
}

}  // namespace palpate::view
