// Crosses, ties and an arrow of a length in proportion to the force, broken where it would be too long.
// Data flow: FingerOutput -> here -> Lines -> line_layer.h, in each picture with them.
#include "palpate/view/overlays/marks.h"

namespace palpate::view {

namespace {

constexpr double kCrossMm = 2.5;

/// Two strokes across the arrow: it would be longer.
void addBreak(const Vec3& at, const Vec3& direction, Lines& lines) {
  constexpr double kStrokeMm = 2.5;
  constexpr double kGapMm = 2.0;
  const Vec3 side = direction.unitOrthogonal();
  for (const Vec3& across : {side, Vec3(direction.cross(side))}) {
    for (const double shift : {0.0, kGapMm}) {
      const Vec3 middle = at + shift * direction;
      lines.add(middle - kStrokeMm * across, middle + kStrokeMm * across, kForcePaint);
    }
  }
}

void addForce(const contact::FingerOutput& contact, Lines& lines) {
  const double newton = contact.force.norm();
  constexpr double kMinN = 0.01;
  if (newton < kMinN) return;
  const Vec3 direction = contact.force / newton;
  const bool capped = kForceMmPerN * newton > kLongestForceMm;
  const double length = capped ? kLongestForceMm : kForceMmPerN * newton;
  lines.addArrow(contact.proxy, contact.proxy + length * direction, kForcePaint);
  constexpr double kBreakAt = 0.75;  // share of the arrow
  if (capped) addBreak(contact.proxy + kBreakAt * length * direction, direction, lines);
}

}  // namespace

void addContactMarks(const contact::FingerOutput& contact, Lines& lines) {
  lines.addCross(contact.tip, kCrossMm, kTipPaint);
  if (contact.touch == contact::Touch::free) return;
  lines.addCross(contact.anchor, kCrossMm, kAnchorPaint);
  lines.addCross(contact.proxy, kCrossMm, kProxyPaint);
  lines.add(contact.proxy, contact.tip, kTipPaint);
  lines.add(contact.anchor, contact.proxy, kAnchorPaint);
  addForce(contact, lines);
}

}  // namespace palpate::view
