// In this order: the anchor, the regions of press and drag there, the scene's contour there, and last the forms, which
// may change any of the regions. Each finger of each frame; a finger in free space costs nothing.
// Based on: Ji, dissertation 2008, (2.6), for the anchor as printed (E1).
#include "palpate/scene/skin_contact.h"

#include <algorithm>

#include "palpate/contact/friction.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/scene/tissue_of_body.h"

namespace palpate::scene {

namespace {

/// The finger with the anchor that (2.6) prints; the search for the region then starts under the proxy. // E1
contact::FingerOutput withLiteralAnchor(contact::FingerOutput finger) noexcept {
  finger.anchor = contact::literalAnchorOfForce(finger.proxy, finger.tip, finger.normal, finger.force);
  finger.anchor_triangle = finger.triangle;
  return finger;
}

/// The ellipse of the drag at the anchor, or that of the nearest corner of its triangle (5.2).
maps::SurfaceEllipse dragRegion(const World& world, const contact::FingerOutput& finger) noexcept {
  Vec3 place = finger.anchor;
  if (world.scene.ellipses.place == EllipsePlace::nearest_vertex &&
      finger.anchor_triangle < world.skin.triangles.size()) {
    const Triangle& corners = world.skin.triangles[finger.anchor_triangle];
    const auto distance2 = [&](Index v) { return (world.skin.positions[v] - finger.anchor).squaredNorm(); };
    place = world.skin.positions[*std::min_element(corners.begin(), corners.end(),
                                                   [&](Index a, Index b) { return distance2(a) < distance2(b); })];
  }
  return world.ellipses.on(place, finger.normal);
}

}  // namespace

std::optional<deform::Contact> contactOf(const World& world, const contact::FingerOutput& finger) noexcept {
  if (finger.touch == contact::Touch::free) return std::nullopt;
  const deform::FormSettings& forms = world.deformation;
  const contact::FingerOutput meant = forms.fidelity.literal(Erratum::E1_anchor) ? withLiteralAnchor(finger) : finger;
  std::optional<deform::Contact> contact = deform::contactOf(meant, dragRegion(world, meant), forms.common.tissue);
  if (!contact) return contact;
  if (world.contours) contact->tangential_contour = world.contours->on(meant.anchor, meant.normal);
  if (world.layered) return layeredContact(world, *contact);
  return deform::formedRegions(*contact, forms);
}

}  // namespace palpate::scene
