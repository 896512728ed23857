// Cones of normals and widest angles, block by block when a skin is built, and the test against them.
//
// Data flow: triangles of the rest shape -> Skin::fold_bounds; these and the contacts' slopes -> mayFold, for each
// block that moves, 60 times a second -> which blocks shear_limit.cpp looks into.
#include "palpate/deform/fold_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/deform/kernels/kernels.h"
#include "palpate/deform/skin.h"

namespace palpate::deform {

namespace {

/// Share of 1, the slope at which a triangle has no area left, that is certain: room for rounding.
constexpr double kCertain = 0.95;
/// Share of the least height h of a triangle of which a corner stays: if no other moves by more, at least 1 - 2 share -
/// share^2 of its area (h times its longest side) is left.
constexpr double kUnfoldedShare = 0.4;
/// Room for the rounding of a float, mm.
constexpr double kRoundingMm = 1e-5;
/// The profile's slope at q = 1, over its largest: 0.0262 / 2.133.
constexpr double kSlopeAtRim = 0.0123;

struct TriangleShape {
  Vec3 normal = Vec3::Zero();  ///< unit; zero for a triangle without area
  double spread = 0.0;
  double gradient_mm = 0.0;
  double longest_mm = 0.0;
};

TriangleShape shapeOf(const Skin& skin, const Triangle& triangle) {
  Vec3 corner[3];
  for (std::size_t i = 0; i < 3; ++i) corner[i] = skin.restPosition(triangle[i]).cast<double>();
  const Vec3 area = mesh::areaVector2(corner[0], corner[1], corner[2]);
  if (!area.allFinite() || !(area.norm() > 0.0)) return {};
  double widest_cosine = 1.0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = corner[(i + 1) % 3] - corner[i];
    const Vec3 b = corner[(i + 2) % 3] - corner[i];
    widest_cosine = std::min(widest_cosine, a.dot(b) / (a.norm() * b.norm()));
  }
  const Vec3 sides((corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(), (corner[0] - corner[2]).norm());
  // cos(w / 2) by the half angle; at least what a float can distinguish from a flat triangle
  const double spread = 1.0 / std::sqrt(std::max(0.5 * (1.0 + widest_cosine), 1e-12));
  const double radius_mm = 0.5 * sides.prod() / area.norm();
  const double gradient_mm = radius_mm + 2.0 * sides.prod() / (sides.minCoeff() * sides.sum());
  return {area.normalized(), spread, gradient_mm, sides.maxCoeff()};
}

/// Over any of its sides; 0 where it has no area.
double leastHeight(const Skin& skin, const Triangle& triangle) {
  Vec3 corner[3];
  for (std::size_t i = 0; i < 3; ++i) corner[i] = skin.restPosition(triangle[i]).cast<double>();
  const double area2 = mesh::areaVector2(corner[0], corner[1], corner[2]).norm();
  const double longest =
      std::max({(corner[1] - corner[0]).norm(), (corner[2] - corner[1]).norm(), (corner[0] - corner[2]).norm()});
  return area2 > 0.0 && std::isfinite(area2) ? area2 / longest : 0.0;
}

/// Calls `visit(triangle, vertex)`.
template <class Visit>
void forEachTriangleAt(const Skin& skin, Index block, const Visit& visit) {
  const Index end = std::min((block + 1) * kBlockVertices, skin.vertices);
  for (Index v = block * kBlockVertices; v < end; ++v) {
    for (const Index t : skin.triangles_of_vertex[v]) visit(t, v);
  }
}

void raise(float& most, double value) { most = std::max(most, static_cast<float>(value)); }

/// Shapes of the triangles at the vertices of one block, each once. Those of a whole body would need 48 bytes a
/// triangle.
class ShapesOfBlock {
 public:
  explicit ShapesOfBlock(const Skin& skin) : skin_(skin), slot_(skin.triangles.size(), 0) {}

  void loadBlock(Index block) {
    triangles_.clear();
    shapes_.clear();
    forEachTriangleAt(skin_, block, [&](Index t, Index) {
      if (slot_[t] < triangles_.size() && triangles_[slot_[t]] == t) return;
      slot_[t] = static_cast<Index>(triangles_.size());
      triangles_.push_back(t);
      shapes_.push_back(shapeOf(skin_, skin_.triangles[t]));
    });
  }
  const TriangleShape& operator[](Index triangle) const { return shapes_[slot_[triangle]]; }

 private:
  const Skin& skin_;
  std::vector<Index> slot_;  ///< per triangle: where it was in the last block that had it
  std::vector<Index> triangles_;
  std::vector<TriangleShape> shapes_;
};

FoldBound computeFoldBound(const Skin& skin, const ShapesOfBlock& shapes, Index block) {
  FoldBound bound;
  Vec3 sum = Vec3::Zero();
  forEachTriangleAt(skin, block, [&](Index t, Index) { sum += shapes[t].normal; });
  if (sum.norm() > 0.0) bound.axis = sum.normalized().cast<float>();
  double cos_cone = 1.0;
  forEachTriangleAt(skin, block, [&](Index t, Index) {
    raise(bound.longest_mm, shapes[t].longest_mm);
    if (shapes[t].spread == 0.0) return;
    cos_cone = std::min(cos_cone, shapes[t].normal.dot(bound.axis.cast<double>()));
    raise(bound.spread, shapes[t].spread);
    raise(bound.gradient_mm, shapes[t].gradient_mm);
  });
  bound.cos_cone = static_cast<float>(cos_cone) - 1e-6f;  // rounding
  return bound;
}

/// The largest sine between a direction and the normals of a cone.
double largestSine(const FoldBound& block, const Vec3& direction) noexcept {
  const double cone = block.cos_cone;
  const double towards = block.axis.cast<double>().dot(direction);
  // Beyond 90 degrees from the direction, or in a cone wider than that, nothing is known.
  const double sin_towards = std::sqrt(std::max(0.0, 1.0 - towards * towards));
  const double sin_cone = std::sqrt(std::max(0.0, 1.0 - cone * cone));
  const double cosine = towards * cone - sin_towards * sin_cone;
  if (!(towards > 0.0) || !(cone > 0.0) || !(cosine > 0.0)) return 1.0;
  return std::min(1.0, sin_towards * cone + towards * sin_cone);
}

/// Whether area is certainly left: at least 1 - (slopes) - (the product of each two) of it.
bool keepsItsArea(double press, double drag, bool is_one) noexcept {
  const double both = press + drag;
  return both + (is_one ? press * drag : 0.5 * both * both) < kCertain;
}

}  // namespace

void setFoldBounds(Skin& skin) {
  ShapesOfBlock shapes(skin);
  skin.fold_bounds.clear();
  skin.fold_gradient_mm.assign(std::size_t{skin.blocks} * kBlockVertices, 0.0f);
  skin.fold_crease.assign(std::size_t{skin.blocks} * kBlockVertices, 0.0f);
  for (Index block = 0; block < skin.blocks; ++block) {
    shapes.loadBlock(block);
    skin.fold_bounds.push_back(computeFoldBound(skin, shapes, block));
    forEachTriangleAt(skin, block, [&](Index t, Index v) {
      if (shapes[t].spread == 0.0) return;
      raise(skin.fold_gradient_mm[v], shapes[t].gradient_mm);
      raise(skin.fold_crease[v], (shapes[t].normal - skin.restNormal(v).cast<double>()).norm());
    });
  }
}

double certainSpread(const ShearBound& shear) noexcept {
  // keepsItsArea solved for what stretches both slopes; not a number where a slope has no bound
  const double both = shear.press + shear.drag;
  const double product = shear.is_one ? shear.press * shear.drag : 0.5 * both * both;
  return 2.0 * kCertain / (both + std::sqrt(both * both + 4.0 * kCertain * product));
}

bool mayFold(const FoldBound& block, const ShearBound& shear) noexcept {
  // The second bound holds within a region; where it ends the slope drops by kSlopeAtRim of the largest at once.
  const auto across = [&](double slope, double bend) {
    const double curved = (1.0 + kSlopeAtRim * block.spread) * slope + block.gradient_mm * bend;
    return std::min(block.spread * slope, curved);
  };
  const double press = across(shear.press, shear.press_bend);
  const double drag = across(shear.drag, shear.drag_bend);
  if (keepsItsArea(press, drag, shear.is_one)) return false;
  return !keepsItsArea(press * largestSine(block, shear.towards), drag, shear.is_one);
}

std::uint64_t doubtfulVertices(const Skin& skin, Index block, const ShearBound& shear, const float* area) noexcept {
  // A triangle's F is within `off` of that at its corner. In its area, the determinant of F in its plane, motion along
  // the press counts by its sine to the normal only. Between the vertex's normal and the triangle's, cof(F) - I is at
  // most the slopes and their products, and no more than the sine of a press is seen along either.
  ShearLanes lanes;
  lanes.press = static_cast<float>(shear.press);
  lanes.drag = static_cast<float>(shear.drag);
  lanes.press_bend = static_cast<float>(shear.press_bend);
  lanes.drag_bend = static_cast<float>(shear.drag_bend);
  for (int i = 0; i < 3; ++i) lanes.towards[i] = static_cast<float>(shear.towards[i]);
  lanes.jump = static_cast<float>(kSlopeAtRim * (1.0 + skin.fold_bounds[block].spread));
  lanes.least_area = static_cast<float>(1.0 - kCertain);
  return doubtfulVertices(lanes, skin.foldBlock(block, area));
}

AlignedVector<float> roomBesideStaying(const Skin& skin) {
  AlignedVector<float> room(std::size_t{skin.blocks} * kBlockVertices, std::numeric_limits<float>::max());
  for (const Triangle& triangle : skin.triangles) {
    const double mm = kUnfoldedShare * leastHeight(skin, triangle) - kRoundingMm;
    for (const Index v : triangle) room[v] = std::min(room[v], static_cast<float>(std::max(0.0, mm)));
  }
  return room;
}

}  // namespace palpate::deform
