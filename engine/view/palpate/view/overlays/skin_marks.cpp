// Arrows: moved vertices sorted by their cube, the first of each cube gets one. Rings grow over sorted lists and not
// over a mark per vertex: a ring is small, the skin is not.
// Data flow: DrawnSkin -> here -> Lines -> line_layer.h, in each picture with them.
// Based on: Ji, dissertation 2008, section 4.5, for the rings.
#include "palpate/view/overlays/marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "palpate/view/overlays/section.h"

namespace palpate::view {

namespace {

using MarkCell = std::array<int, 3>;

struct Moved {
  MarkCell cell;
  Index vertex;
};

MarkCell cellAt(const Vec3& place, double size) {
  const Vec3 cell = (place / size).array().floor();
  return {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())};
}

std::vector<Moved> movedVertices(const deform::Skin& rest, const DrawnSkin& skin, double spacing) {
  constexpr double kMinMm = 0.3;
  std::vector<Moved> moved;
  for (const deform::VertexRange& range : skin.changed()) {
    for (Index v = range.first; v < range.end; ++v) {
      const Vec3 place = rest.restPlace(v);
      if ((skin.at(v) - place).norm() > kMinMm) moved.push_back({cellAt(place - rest.origin, spacing), v});
    }
  }
  return moved;
}

/// The vertices joined to `ring` but in neither of the two rings; all sorted.
std::vector<Index> nextRing(const mesh::IndexRows& neighbours, const std::vector<Index>& ring,
                            const std::vector<Index>& inner) {
  std::vector<Index> next;
  for (const Index v : ring) {
    for (const Index other : neighbours[v]) {
      const bool known =
          std::binary_search(ring.begin(), ring.end(), other) || std::binary_search(inner.begin(), inner.end(), other);
      if (!known) next.push_back(other);
    }
  }
  std::sort(next.begin(), next.end());
  next.erase(std::unique(next.begin(), next.end()), next.end());
  return next;
}

void addEdgesWithin(const std::vector<Index>& ring, const mesh::IndexRows& neighbours, const DrawnSkin& skin,
                    Paint paint, Lines& lines) {
  for (const Index v : ring) {
    for (const Index other : neighbours[v]) {
      if (other > v && std::binary_search(ring.begin(), ring.end(), other)) {
        lines.add(skin.at(v), skin.at(other), paint);
      }
    }
  }
}

/// A point of the deformed curve, a little above the skin, in which it would be drawn otherwise.
Vec3 liftedAt(const SectionPlane& plane, std::span<const SectionPoint> curve, std::size_t i) {
  constexpr double kLiftMm = 0.5;
  const Vec2 along = curve[std::min(i + 1, curve.size() - 1)].deformed - curve[i > 0 ? i - 1 : 0].deformed;
  const Vec2 outward = along.norm() > 0.0 ? Vec2(Vec2(-along.y(), along.x()).normalized()) : Vec2(Vec2::UnitY());
  return onPlane(plane, curve[i].deformed + kLiftMm * outward);
}

void addLifted(const SectionPlane& plane, std::span<const SectionPoint> curve, Paint paint, Lines& lines) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    lines.add(liftedAt(plane, curve, i - 1), liftedAt(plane, curve, i), paint);
  }
}

/// From the skin at rest to the present one. Seen along its axis it is a ring with a cross in it, as the feathers of an
/// arrow: a straight press points away from the eye.
void addDisplacement(const Vec3& from, const Vec3& to, Lines& lines) {
  constexpr double kRingShare = 0.3;  // share of the length
  constexpr double kLargestRingMm = 2.4;
  constexpr int kCorners = 10;
  lines.addArrow(from, to, kDisplacementPaint);
  const Vec3 along = to - from;
  const double radius = std::min(kRingShare * along.norm(), kLargestRingMm);
  const Vec3 side = radius * along.unitOrthogonal();
  const Vec3 other = along.normalized().cross(side);
  const auto corner = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    return Vec3(from + std::cos(angle) * side + std::sin(angle) * other);
  };
  for (int i = 0; i < kCorners; ++i) lines.add(corner(i), corner(i + 1), kDisplacementPaint);
  lines.add(from - side, from + side, kDisplacementPaint);
  lines.add(from - other, from + other, kDisplacementPaint);
}

}  // namespace

void addDisplacements(const scene::World& world, const DrawnSkin& skin, double spacing_mm, Lines& lines) {
  std::vector<Moved> moved = movedVertices(*world.deformable, skin, spacing_mm);
  std::stable_sort(moved.begin(), moved.end(), [](const Moved& a, const Moved& b) { return a.cell < b.cell; });
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (i > 0 && moved[i].cell == moved[i - 1].cell) continue;
    const Index v = moved[i].vertex;
    addDisplacement(world.deformable->restPlace(v), skin.at(v), lines);
  }
}

void addNormals(const DrawnSkin& skin, Index most, Lines& lines) {
  constexpr double kLengthMm = 5.0;
  const Index step = std::max<Index>(1, (skin.vertices() + most - 1) / most);
  for (Index v = 0; v < skin.vertices(); v += step) {
    lines.add(skin.at(v), skin.at(v) + kLengthMm * skin.normalAt(v), kNormalPaint);
  }
}

void addRings(const scene::World& world, const DrawnSkin& skin, Index triangle, int rings, Lines& lines) {
  if (triangle >= world.body->skin.triangles.size()) return;
  const mesh::IndexRows& neighbours = world.deformable->neighbours;
  const Triangle& corners = world.body->skin.triangles[triangle];
  std::vector<Index> inner;
  std::vector<Index> ring(corners.begin(), corners.end());
  std::sort(ring.begin(), ring.end());
  for (int i = 0; i <= rings; ++i) {
    addEdgesWithin(ring, neighbours, skin, kRingPaints[static_cast<std::size_t>(i) % kRingPaints.size()], lines);
    std::vector<Index> next = nextRing(neighbours, ring, inner);
    inner = std::exchange(ring, std::move(next));
  }
}

void addSection(const scene::World& world, const DrawnSkin& skin, const contact::FingerOutput& contact, Lines& lines) {
  constexpr double kApartMm = 0.3;  // nearer to each other the two lines would flicker through each other
  const SectionPlane plane = sectionPlane(world, contact);
  const auto curve = sectionCurve(
      world, [&](Index v) { return skin.at(v); }, plane, kSectionHalfWidthMm);
  const auto moved = [&](std::size_t i) { return (curve[i].deformed - curve[i].rest).norm() > kApartMm; };
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (!moved(i - 1) && !moved(i)) continue;
    lines.add(onPlane(plane, curve[i - 1].rest), onPlane(plane, curve[i].rest), kRestSectionPaint);
  }
  addLifted(plane, curve, kDeformedSectionPaint, lines);
}

void addCutLine(const scene::World& world, const DrawnSkin& skin, const SectionPlane& plane, double half_width_mm,
                Paint paint, Lines& lines) {
  const auto curve = sectionCurve(
      world, [&](Index v) { return skin.at(v); }, plane, half_width_mm);
  addLifted(plane, curve, paint, lines);
}

}  // namespace palpate::view
