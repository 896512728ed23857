// In this order: the anchor, the regions of press and drag there, the scene's contour there, and last the forms, which
// may change any of the regions. Each finger of each frame; a finger in free space costs nothing.
// Based on: Ji, dissertation 2008, (2.6), for the anchor as printed (E1).
#include "palpate/scene/skin_contact.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "palpate/base/elementary.h"
#include "palpate/contact/friction.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/deform/shear_limit.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/place_curves.h"
#include "palpate/scene/tissue_of_body.h"
#include "palpate/tissue/force_law.h"
#include "palpate/tissue/profile.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::scene {

namespace {

/// The finger with the anchor that (2.6) derives from the force of this moment: as far from the proxy as the engine's
/// own, which is a state, but in the plane of contact instead of on the skin. Lumps push beside friction.  // E1
contact::FingerOutput withDerivedAnchor(const World& world, contact::FingerOutput finger) noexcept {
  const tissue::PressedPlace place{finger.tissue_mm, finger.finger_mm};
  const double ratio = world.scene.contact.finger.stiffness_ratio *
                       tissue::respond(world.surface.force_law, 1.0, finger.depth_mm, place).tangential;
  finger.anchor =
      contact::anchorOfForce(finger.proxy, finger.tip, finger.normal, finger.force - finger.lump_force, ratio);
  return finger;
}

/// The ellipse of the drag at the anchor, or that of the nearest corner of its triangle (5.2).
maps::SurfaceEllipse dragRegion(const World& world, const contact::FingerOutput& finger) noexcept {
  Vec3 place = finger.anchor;
  if (world.scene.ellipses.place == EllipsePlace::nearest_vertex &&
      finger.anchor_triangle < world.body->skin.triangles.size()) {
    const Triangle& corners = world.body->skin.triangles[finger.anchor_triangle];
    const auto distance2 = [&](Index v) { return (world.body->skin.positions[v] - finger.anchor).squaredNorm(); };
    place = world.body->skin.positions[*std::min_element(
        corners.begin(), corners.end(), [&](Index a, Index b) { return distance2(a) < distance2(b); })];
  }
  return world.ellipses.on(place, finger.normal);
}

/// mm: how deep skin is that stays at this effective depth by itself (contact/relaxation.h).
double depthAtRest(const World& world, double rest_mm, Index triangle, double finger_mm) noexcept {
  const std::vector<double>& tissue_mm = world.surface.tissue_mm;
  if (triangle >= world.body->skin.triangles.size()) return 0.0;
  const Index corner = world.body->skin.triangles[triangle][0];
  return tissue::depthOf(world.surface.force_law, rest_mm,
                         tissue::PressedPlace{tissue_mm.empty() ? 0.0 : tissue_mm[corner], finger_mm});
}

/// How much a place counts that faces the finger so far (cosine): all from the second on. What faces away more slides
/// along the part's flank and does not come out of it.
constexpr double kFlank = 0.5;
constexpr double kFacing = 0.7;
/// Where the part's thickness is asked for around a finger: rings at these location ratios, this many places each.
constexpr std::array<double, 4> kPartRings = {0.0, 0.2, 0.4, 0.6};
constexpr int kPlacesOfARing = 8;

/// The deepest press of which nothing comes out of the part beneath one place of its region; `share` of the press
/// arrives there.
double deepestAt(const tree::TriangleTree& tree, const Vec3& over, const Vec3& normal, double reach_mm, double share,
                 double depth_mm) noexcept {
  const Vec3 end = over - (reach_mm + share * depth_mm) * normal;
  const tree::Crossing entry = tree::firstFrontCrossing(tree, over + reach_mm * normal, end);
  if (entry.triangle == kNoIndex) return depth_mm;
  const auto& corners = tree.records[entry.triangle].corners;
  const double facing = mesh::areaVector2(corners[0], corners[1], corners[2]).normalized().dot(normal);
  const double counts = share * std::clamp((facing - kFlank) / (kFacing - kFlank), 0.0, 1.0);
  const double most_mm = counts * depth_mm / deform::ShearLimit::kShareOfThickness;
  if (!(most_mm > 0.0)) return depth_mm;
  const double way = tree::wayThrough(tree, entry.point, -normal, most_mm);
  return std::min(depth_mm, deform::ShearLimit::kShareOfThickness * way / counts);
}

/// A dent must not come out of the far side of a thin part: the press, shortened to what the part holds anywhere in its
/// core. Some 20 us.
double depthWithinPart(const World& world, const deform::Contact& contact) noexcept {
  const double reach_mm = contact.normal_region.half_major.norm();
  const Vec3 normal = contact.normal.normalized();
  const Vec3 first = normal.unitOrthogonal();
  const Vec3 second = normal.cross(first);
  double depth_mm = std::min(contact.depth_mm, world.deformation.common.tissue.normal_cap_mm);
  if (!(depth_mm > 0.0) || !normal.allFinite()) return contact.depth_mm;
  for (const double q : kPartRings) {
    const double r = q * reach_mm;
    for (int i = 0; i < (q > 0.0 ? kPlacesOfARing : 1); ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kPlacesOfARing;
      const Vec3 over = contact.anchor + r * (elementary::cos(angle) * first + elementary::sin(angle) * second);
      depth_mm = deepestAt(world.surface.geometry->tree, over, normal, std::max(r, 1.0), tissue::profile(q), depth_mm);
    }
  }
  return depth_mm;
}

std::optional<deform::Contact> contactOfTissue(const World& world, std::optional<deform::Contact> contact,
                                               const contact::FingerOutput& meant) noexcept {
  const deform::FormSettings& forms = world.deformation;
  if (world.contours) contact->tangential_contour = world.contours->on(meant.anchor, meant.normal);
  if (world.layered) return layeredContact(world, *contact);
  if (!world.deformable->thickness_mm.empty()) contact->depth_mm = depthWithinPart(world, *contact);
  if (forms.shape == deform::Shape::contour && world.reach)
    contact->tangential_contour = anatomicalContour(world, *contact);
  return deform::formedRegions(*contact, forms);
}

/// mm: how far the skin sinks under a tip at this depth.  // (2.3)
double sunkMm(const World& world, double depth_mm) noexcept {
  return world.scene.contact.haptic_surface == HapticSurface::rigid ? depth_mm : 0.5 * depth_mm;
}

std::optional<deform::Contact> contactAsFelt(const World& world, contact::FingerOutput meant) noexcept {
  meant.depth_mm = sunkMm(world, meant.depth_mm);
  const deform::FormSettings& forms = world.deformation;
  const auto plain = deform::contactOf(meant, dragRegion(world, meant), forms.common.tissue);
  if (!plain) return plain;
  const std::optional<deform::Contact> contact = contactOfTissue(world, plain, meant);
  if (!world.place_curves) return contact;
  return withPlaceCurve(*world.place_curves, deform::formedRegions(*plain, forms), *contact);
}

}  // namespace

std::optional<deform::Contact> contactOf(const World& world, const contact::FingerOutput& finger) noexcept {
  if (finger.touch == contact::Touch::free) return std::nullopt;
  const bool literal = world.deformation.fidelity.literal(Erratum::E1_anchor);
  contact::FingerOutput meant = literal ? withDerivedAnchor(world, finger) : finger;
  if (finger.rest_mm > 0.0) {
    meant.depth_mm = std::max(meant.depth_mm, depthAtRest(world, finger.rest_mm, finger.triangle, finger.finger_mm));
  }
  return contactAsFelt(world, meant);
}

std::optional<deform::Contact> dentOf(const World& world, const contact::FingerOutput& finger) noexcept {
  const contact::Dent& dent = finger.dent;
  if (!(dent.rest_mm > 0.0) || dent.triangle >= world.body->skin.triangles.size()) return std::nullopt;
  contact::FingerOutput left;
  left.tip = left.proxy = left.anchor = left.hold = dent.place;
  left.triangle = left.anchor_triangle = dent.triangle;
  left.normal = mesh::areaVector2(world.body->skin, world.body->skin.triangles[dent.triangle]).normalized();
  left.depth_mm = depthAtRest(world, dent.rest_mm, dent.triangle, finger.finger_mm);
  left.touch = contact::Touch::stick;
  return contactAsFelt(world, left);
}

}  // namespace palpate::scene
