// In this order: the anchor, the regions of press and drag there, the scene's contour there, and last the forms, which
// may change any of the regions. Each finger of each frame; a finger in free space costs nothing.
// Based on: Ji, dissertation 2008, (2.6), for the anchor as printed (E1).
#include "palpate/scene/skin_contact.h"

#include <algorithm>

#include "palpate/contact/friction.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/curves/place_curves.h"
#include "palpate/scene/tissue_of_body.h"
#include "palpate/tissue/law_inverse.h"

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

/// mm: how deep skin is that stays at this effective depth by itself (contact/relaxation.h).
double depthAtRest(const World& world, double rest_mm, Index triangle) noexcept {
  const std::vector<double>& tissue_mm = world.surface.tissue_mm;
  if (triangle >= world.skin.triangles.size()) return 0.0;
  const Index corner = world.skin.triangles[triangle][0];
  return tissue::depthOf(world.surface.force_law, rest_mm, tissue_mm.empty() ? 0.0 : tissue_mm[corner]);
}

std::optional<deform::Contact> contactOfTissue(const World& world, std::optional<deform::Contact> contact,
                                               const contact::FingerOutput& meant) noexcept {
  const deform::FormSettings& forms = world.deformation;
  if (world.contours) contact->tangential_contour = world.contours->on(meant.anchor, meant.normal);
  if (world.layered) return layeredContact(world, *contact);
  if (forms.shape == deform::Shape::contour && world.reach)
    contact->tangential_contour = anatomicalContour(world, *contact);
  return deform::formedRegions(*contact, forms);
}

std::optional<deform::Contact> contactAsFelt(const World& world, const contact::FingerOutput& meant) noexcept {
  const deform::FormSettings& forms = world.deformation;
  const auto plain = deform::contactOf(meant, dragRegion(world, meant), forms.common.tissue);
  if (!plain) return plain;
  const std::optional<deform::Contact> contact = contactOfTissue(world, plain, meant);
  if (!world.place_curves) return contact;
  return withPlaceCurve(*world.place_curves, deform::formedRegions(*plain, forms), *contact);
}

Vec3 normalOf(const mesh::TriangleMesh& skin, Index triangle) noexcept {
  const auto& [a, b, c] = skin.triangles[triangle];
  return mesh::areaVector2(skin.positions[a], skin.positions[b], skin.positions[c]).normalized();
}

}  // namespace

std::optional<deform::Contact> contactOf(const World& world, const contact::FingerOutput& finger) noexcept {
  if (finger.touch == contact::Touch::free) return std::nullopt;
  const bool literal = world.deformation.fidelity.literal(Erratum::E1_anchor);
  contact::FingerOutput meant = literal ? withLiteralAnchor(finger) : finger;
  if (finger.rest_mm > 0.0) {
    meant.depth_mm = std::max(meant.depth_mm, depthAtRest(world, finger.rest_mm, finger.triangle));
  }
  return contactAsFelt(world, meant);
}

std::optional<deform::Contact> dentOf(const World& world, const contact::FingerOutput& finger) noexcept {
  const contact::Dent& dent = finger.dent;
  if (!(dent.rest_mm > 0.0) || dent.triangle >= world.skin.triangles.size()) return std::nullopt;
  contact::FingerOutput left;
  left.tip = left.proxy = left.anchor = left.hold = dent.place;
  left.triangle = left.anchor_triangle = dent.triangle;
  left.normal = normalOf(world.skin, dent.triangle);
  left.depth_mm = depthAtRest(world, dent.rest_mm, dent.triangle);
  left.touch = contact::Touch::stick;
  return contactAsFelt(world, left);
}

}  // namespace palpate::scene
