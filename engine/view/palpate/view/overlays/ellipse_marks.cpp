// 96 points of an ellipse are projected along its normal onto the skin at rest, by a segment through the tree each;
// triangle and weights then move with the skin. A gap in the skin splits the curve. Key points keep theirs; a contact's
// are made again for each picture.
// Data flow: regions of contacts, key points -> here -> Lines -> line_layer.h.
#include "palpate/view/overlays/overlays.h"

#include <cmath>
#include <numbers>

#include "palpate/scene/skin_contact.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/overlays/marks.h"

namespace palpate::view {

namespace {

constexpr int kSamples = 96;
/// The skin is looked for this far (mm) above and below the ellipse's plane: a back curves less over its ellipses.
constexpr double kMarkReachMm = 150.0;

}  // namespace

std::optional<SkinSpot> spotBetween(const contact::Surface& surface, const Vec3& from, const Vec3& to) {
  const auto crossing = tree::firstFrontCrossing(surface.geometry->tree, from, to);
  if (crossing.triangle == kNoIndex) return std::nullopt;
  const tree::TriangleRecord& record = surface.geometry->tree.records[crossing.triangle];
  return SkinSpot{record.vertices, tree::barycentricWeights(record.corners, crossing.point).cast<float>()};
}

Outline outlineOf(const scene::World& world, const maps::SurfaceEllipse& ellipse, const Vec3& centre,
                  const Vec3& normal) {
  Outline outline(1);
  const Vec3 minor = ellipse.aspect * normal.cross(ellipse.half_major);
  for (int i = 0; i <= kSamples; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSamples;
    const Vec3 place = centre + std::cos(angle) * ellipse.half_major + std::sin(angle) * minor;
    const auto spot = spotBetween(world.surface, place + kMarkReachMm * normal, place - kMarkReachMm * normal);
    if (spot) {
      outline.back().push_back(*spot);
    } else if (!outline.back().empty()) {
      outline.emplace_back();
    }
  }
  return outline;
}

std::vector<Outline> keyOutlines(const scene::World& world) {
  std::vector<Outline> outlines;
  const Eigen::AlignedBox3d box = mesh::boundingBox(world.body->skin);
  for (const maps::KeyPoint& key : world.ellipses.keys()) {
    const Vec3 above(key.position_mm.x(), key.position_mm.y(), box.max().z());
    const maps::SurfaceEllipse flat = maps::liftedOntoSurface(key.ellipse, Vec3::UnitZ());
    outlines.push_back(outlineOf(world, flat, above, Vec3::UnitZ()));
  }
  return outlines;
}

void addOutline(const Outline& outline, const DrawnSkin& skin, Paint paint, Lines& lines) {
  for (const std::vector<SkinSpot>& piece : outline) {
    for (std::size_t i = 1; i < piece.size(); ++i) {
      lines.add(placeOf(piece[i - 1], skin), placeOf(piece[i], skin), paint);
    }
  }
}

void addContactEllipses(const scene::World& world, const contact::FingerOutput& contact, const DrawnSkin& skin,
                        Lines& lines) {
  const auto pressed = scene::contactOf(world, contact);
  if (!pressed) return;
  const Vec3 normal = pressed->normal.normalized();
  addOutline(outlineOf(world, pressed->normal_region, pressed->anchor, normal), skin, kNormalRegionPaint, lines);
  addOutline(outlineOf(world, pressed->tangential_region, pressed->anchor, normal), skin, kTangentialRegionPaint,
             lines);
}

}  // namespace palpate::view
