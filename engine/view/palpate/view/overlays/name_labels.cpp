// Visible names -> places on the page -> columns -> ink. The silhouette comes from a thousand vertices. Each picture:
// half a millisecond for the trunk's hundred names.
#include "palpate/view/overlays/labels.h"

#include <algorithm>

#include "palpate/view/overlays/body_names.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/overlays/plates.h"

namespace palpate::view {

namespace {

constexpr float kNamesMargin = 14.0f;
const Vec2f kNamePad(5.0f, 1.0f);

/// Places on the page as one eye sees them.
class PageSight {
 public:
  PageSight(const Drawing& page, const Eyes& eyes, const Vec3& eye)
      : page_(page.size()), frustum_(makeFrustum(eyes.screen, eye, kNearMm, kFarMm)) {}
  Vec2f of(const Vec3& place) const { return seenAt(frustum_, place).cast<float>().cwiseProduct(page_); }

 private:
  static constexpr double kNearMm = 1.0;
  static constexpr double kFarMm = 1e5;
  Vec2f page_;
  Frustum frustum_;
};

void findSilhouette(const deform::DeformedSurface& surface, const PageSight& sight, NameGround& ground) {
  constexpr Index kMax = 1000;
  const Index step = std::max<Index>(1, surface.vertices() / kMax);
  ground.body_left = ground.page.opposite.x();
  ground.body_right = ground.page.corner.x();
  for (Index v = 0; v < surface.vertices(); v += step) {
    const Vec2f at = sight.of(surface.placeAt(v));
    if (!at.allFinite() || at.y() < ground.page.corner.y() || at.y() > ground.page.opposite.y()) continue;
    ground.body_left = std::min(ground.body_left, at.x());
    ground.body_right = std::max(ground.body_right, at.x());
  }
}

void drawDot(Drawing& page, const Vec2f& place) {
  constexpr float kRadius = 2.6f;
  constexpr Ink kRim{{30, 20, 14}, 0.75};
  page.disc(place, kRadius + 1.2f, kRim);
  page.disc(place, kRadius, Ink{{kNamePaint[0], kNamePaint[1], kNamePaint[2]}});
}

void drawLine(Drawing& page, const Vec2f& from, const Vec2f& to, const LabelInks& inks) {
  constexpr double kRimShare = 0.5;
  page.line(from, to, Ink{inks.rim.colour, kRimShare * inks.rim.opacity}, 2.4f);
  page.line(from, to, Ink{inks.letter.colour, 0.7}, 1.0f);
}

}  // namespace

void drawNames(Drawing& page, const LabelScene& scene, std::vector<LabelBox>& taken) {
  const PageSight between(page, scene.eyes, scene.eyes.middle);
  const PageSight own(page, scene.eyes, scene.eye.value_or(scene.eyes.middle));
  const std::vector<const BodyName*> seen = namesSeen(scene.names, scene.world, scene.eyes.middle);
  std::vector<NameTag> tags;
  std::vector<Vec3> places;
  for (const BodyName* name : seen) {
    places.push_back(placeOf(*name, scene.world, scene.surface, scene.frame.lift_mm));
    // Laid out for a body that holds its breath: plates must not change their rows with each one.
    const Vec2f dot = between.of(placeOf(*name, scene.world, scene.surface, 0.0));
    const Vec2f size = page.measure(name->words, TextSize::small) + 2.0f * kNamePad;
    tags.push_back({dot, size, static_cast<int>(name->kind), name->kind == NameKind::spine});
  }
  const Vec2f margin = Vec2f::Constant(kNamesMargin);
  NameGround ground{.page = {margin, page.size() - margin}, .taken = taken};
  findSilhouette(scene.surface, between, ground);
  const std::vector<NamePlate> plates = nameColumns(tags, ground);
  const LabelInks& inks = inksFor(scene.look);
  for (const NamePlate& plate : plates) drawLine(page, plate.line_from, own.of(places[plate.tag]), inks);
  for (const NamePlate& plate : plates) drawDot(page, own.of(places[plate.tag]));
  for (const NamePlate& plate : plates) {
    page.box(plate.box.corner, plate.box.opposite, inks.plate, 3.0f);
    page.text(plate.box.corner + kNamePad, seen[plate.tag]->words, inks.letter, Align::left, TextSize::small);
    taken.push_back(plate.box);
  }
}

}  // namespace palpate::view
