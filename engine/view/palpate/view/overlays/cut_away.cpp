// The skin's curve by section.h; below each of its points the stack of the place, along the normal of the curve at
// rest, then squeezed by the depth of the skin. Some tenths of a millisecond a picture.
#include "palpate/view/overlays/cut_away.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/scene/healthy_tissue.h"
#include "palpate/tissue/layered_table.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/overlays/lump_marks.h"

namespace palpate::view {

namespace {

/// A lump whose foot is nearer to the finger than this is under it, mm: the plane need not be turned.
constexpr double kUnderFingerMm = 2.0;

Vec3 lumpFoot(const scene::World& world, std::size_t lump, std::span<const FingerMark> fingers) {
  const contact::Lump& placed = world.lumps[lump]->lump;
  const Vec2 moved = lumpShift(lump, fingers);
  return placed.foot + moved.x() * placed.across + moved.y() * placed.up;
}

std::optional<std::size_t> nearestLump(const scene::World& world, const Vec3& place,
                                       std::span<const FingerMark> fingers) {
  std::optional<std::size_t> nearest;
  double least_mm = kCutHalfWidthMm;
  for (std::size_t i = 0; i < world.lumps.size(); ++i) {
    const double away_mm = (lumpFoot(world, i, fingers) - place).norm();
    if (away_mm >= least_mm) continue;
    least_mm = away_mm;
    nearest = i;
  }
  return nearest;
}

SectionPlane planeThrough(const scene::World& world, const FingerMark& finger, std::optional<std::size_t> lump,
                          std::span<const FingerMark> fingers) {
  SectionPlane plane = sectionPlane(world, finger.contact);
  const Vec3 way = lump ? Vec3(lumpFoot(world, *lump, fingers) - plane.origin) : Vec3(Vec3::Zero());
  const Vec3 in_skin = way - way.dot(plane.upward) * plane.upward;
  if (in_skin.norm() >= kUnderFingerMm) plane.along = in_skin.normalized();
  // The right of the body, or its head, is at the right of the picture.
  const bool sideways = std::abs(plane.along.x()) > std::abs(plane.along.y());
  if ((sideways ? plane.along.x() : plane.along.y()) < 0.0) plane.along = -plane.along;
  return plane;
}

Vec2 projectToPlane(const SectionPlane& plane, const Vec3& place) {
  const Vec3 from = place - plane.origin;
  return {from.dot(plane.along), from.dot(plane.upward)};
}

/// The column below a point of the curve.
struct CutColumn {
  Vec2 rest = Vec2::Zero();
  Vec2 shift = Vec2::Zero();     ///< shift of the skin from rest
  Vec2 inward = -Vec2::UnitY();  ///< unit
  double bone_mm = 0.0;
  tissue::LayerStack stack = {};

  /// The present place of a point at this depth at rest.
  Vec2 at(double depth_mm) const {
    const double share = bone_mm > 0.0 ? std::max(0.0, 1.0 - depth_mm / bone_mm) : 1.0;
    return rest + depth_mm * inward + share * shift;
  }
};

/// Averaged over some millimetres of the curve, so that the facets of the skin do not fan the layers out.
Vec2 inwardAt(std::span<const SectionPoint> curve, std::size_t i) {
  constexpr double kSmoothMm = 6.0;
  std::size_t from = i, to = i;
  while (from > 0 && (curve[i].rest - curve[from].rest).norm() < kSmoothMm) --from;
  while (to + 1 < curve.size() && (curve[to].rest - curve[i].rest).norm() < kSmoothMm) ++to;
  const Vec2 along = curve[to].rest - curve[from].rest;
  return along.norm() > 0.0 ? Vec2(Vec2(along.y(), -along.x()).normalized()) : Vec2(-Vec2::UnitY());
}

double thicknessAt(const scene::World& world, const Vec3& place) {
  constexpr double kReachMm = 5.0;
  const tree::TriangleTree& tree = world.surface.geometry->tree;
  const auto nearest = tree::nearestPoint(tree, place, kReachMm);
  if (nearest.triangle == kNoIndex) return 0.0;
  return scene::thicknessOverBone(*world.healthy, tree.records[nearest.triangle], nearest.closest.point);
}

std::vector<CutColumn> buildCutColumns(const scene::World& world, const scene::LumpGround* ground,
                                       const SectionPlane& plane, std::span<const SectionPoint> curve) {
  std::vector<CutColumn> columns;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    CutColumn column{.rest = curve[i].rest, .shift = curve[i].deformed - curve[i].rest};
    column.inward = inwardAt(curve, i);
    column.bone_mm = thicknessAt(world, onPlane(plane, curve[i].rest));
    if (ground != nullptr) {
      if (!(column.bone_mm > 0.0)) column.bone_mm = ground->thickest();
      column.stack = ground->stackAt(column.bone_mm);
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

/// The lower border of layer `k`; of a stack with fewer layers its last one.
double layerBottomMm(const tissue::LayerStack& stack, std::size_t k) {
  double bottom_mm = 0.0;
  for (std::size_t i = 0; i <= k && i < stack.layers.size(); ++i) bottom_mm += stack.layers[i].thickness_mm;
  return bottom_mm;
}

std::vector<CutAway::Layer> buildCutLayers(std::span<const CutColumn> columns, const CutColumn& over) {
  std::vector<CutAway::Layer> layers;
  const tissue::LayerStack& middle = over.stack;
  if (middle.layers.empty() && over.bone_mm > 0.0) {
    layers.emplace_back();
    for (const CutColumn& column : columns) layers.back().below.push_back(column.at(column.bone_mm));
  }
  for (std::size_t k = 0; k < middle.layers.size(); ++k) {
    CutAway::Layer layer{.name = middle.layers[k].name, .below = {}};
    for (const CutColumn& column : columns) layer.below.push_back(column.at(layerBottomMm(column.stack, k)));
    layers.push_back(std::move(layer));
  }
  return layers;
}

const CutColumn& columnAt(std::span<const CutColumn> columns, double along_mm) {
  return *std::min_element(columns.begin(), columns.end(), [&](const CutColumn& a, const CutColumn& b) {
    return std::abs(a.rest.x() - along_mm) < std::abs(b.rest.x() - along_mm);
  });
}

CutAway::Lump lumpIn(const SectionPlane& plane, const scene::PlacedLump& placed, const Vec2& moved,
                     std::span<const CutColumn> columns) {
  const contact::Lump& lump = placed.lump;
  const std::array<Vec3, 3> axes = {lump.across, lump.up, lump.axis};
  const Vec3 rest = lump.foot - lump.shape.centreMm() * lump.axis;
  const Vec3 now = rest + moved.x() * lump.across + moved.y() * lump.up;
  CutAway::Lump cut{.name = placed.name, .young_kpa = placed.young_kpa};
  cut.moved_mm = moved.norm();
  cut.placed = ellipsoidIn(plane, rest, axes, lump.shape.half_axes_mm);
  cut.rim = ellipsoidIn(plane, now, axes, lump.shape.half_axes_mm);
  cut.middle = projectToPlane(plane, now);
  const CutColumn& over = columnAt(columns, cut.middle.x());
  const double share = over.bone_mm > 0.0 ? std::max(0.0, 1.0 - lump.shape.centreMm() / over.bone_mm) : 1.0;
  for (Vec2& point : cut.rim) point += share * over.shift;
  cut.middle += share * over.shift;
  return cut;
}

/// The drawn tip rests on the deformed skin: lifted until no point of the curve is in it.
Vec2 restingOn(std::span<const Vec2> skin, Vec2 middle, double radius_mm) {
  for (const Vec2& point : skin) {
    const double aside = point.x() - middle.x();
    if (std::abs(aside) >= radius_mm) continue;
    middle.y() = std::max(middle.y(), point.y() + std::sqrt(radius_mm * radius_mm - aside * aside));
  }
  return middle;
}

Vec2 tipIn(const CutAway& cut, const FingerMark& finger) {
  const Vec2 middle =
      projectToPlane(cut.plane, finger.contact.tip) + Vec2(0.0, finger.radius_mm - finger.haptic_radius_mm);
  return finger.contact.touch == contact::Touch::free ? middle : restingOn(cut.skin, middle, finger.radius_mm);
}

/// The finger, the lump between it and the edge, and the bone below both, unless it is far deeper than the lump.
void frameCutAway(CutAway& cut) {
  constexpr double kLeastHalfMm = 22.0;
  constexpr double kRoomMm = 9.0;      // on both sides of a lump
  constexpr double kOverBoneMm = 3.0;  // visible part of the bone
  constexpr double kDeepestMm = 45.0;
  constexpr double kLeastDeepMm = 18.0;
  double left = -cut.finger_mm, right = cut.finger_mm, deep = kLeastDeepMm;
  if (cut.nearest) {
    for (const Vec2& point : cut.lumps[*cut.nearest].rim) {
      left = std::min(left, point.x());
      right = std::max(right, point.x());
      deep = std::max(deep, kOverBoneMm - point.y());
    }
  }
  deep = std::max(deep, std::min(kDeepestMm, cut.bone_mm + kOverBoneMm));
  const double top = std::max(cut.finger.y(), 0.0) + 0.5 * cut.finger_mm;
  const double middle = 0.5 * (left + right);
  const double half = std::max({kLeastHalfMm, 0.5 * (right - left) + kRoomMm, 0.5 * kCutAspect * (top + deep)});
  cut.low = {middle - half, top - 2.0 * half / kCutAspect};
  cut.high = {middle + half, top};
}

}  // namespace

std::vector<Vec2> ellipsoidIn(const SectionPlane& plane, const Vec3& middle, const std::array<Vec3, 3>& axes,
                              const std::array<double, 3>& half_mm) {
  // (x - m)' M (x - m) = 1 with x = o + B p becomes (p - c)' N (p - c) = size.
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) form += axes[i] * axes[i].transpose() / (half_mm[i] * half_mm[i]);
  Eigen::Matrix<double, 3, 2> basis;
  basis << plane.along, plane.upward;
  const Eigen::Matrix2d flat = basis.transpose() * form * basis;
  const Vec3 away = plane.origin - middle;
  const Vec2 linear = basis.transpose() * form * away;
  const double determinant = flat(0, 0) * flat(1, 1) - flat(0, 1) * flat(1, 0);
  Eigen::Matrix2d inverse;
  inverse << flat(1, 1), -flat(0, 1), -flat(1, 0), flat(0, 0);
  inverse /= determinant;
  const Vec2 centre = -inverse * linear;
  const double size = 1.0 - away.dot(form * away) + linear.dot(inverse * linear);
  if (!(size > 0.0)) return {};
  // N = L L': p = c + sqrt(size) L'^-1 (cos, sin).
  const double l00 = std::sqrt(flat(0, 0));
  const double l10 = flat(1, 0) / l00;
  const double l11 = std::sqrt(flat(1, 1) - l10 * l10);
  constexpr int kPoints = 48;
  std::vector<Vec2> rim;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    const double y = std::sin(angle) / l11;
    rim.push_back(centre + std::sqrt(size) * Vec2((std::cos(angle) - l10 * y) / l00, y));
  }
  return rim;
}

std::optional<SectionPlane> cutPlane(const scene::World& world, std::span<const FingerMark> fingers) {
  const FingerMark* finger = sectionFinger(fingers);
  if (finger == nullptr) return std::nullopt;
  const Vec3 place = sectionPlane(world, finger->contact).origin;
  return planeThrough(world, *finger, nearestLump(world, place, fingers), fingers);
}

CutMaker::CutMaker(const scene::World& world) : world_(world) {
  if (!world.healthy) return;
  try {
    ground_.emplace(world.scene, *world.healthy, world.tissue.model == scene::TissueModel::layered, "cut-aways");
  } catch (const Error&) {
    ground_.reset();  // skin and bone alone
  }
}

std::optional<CutAway> CutMaker::cut(std::span<const FingerMark> fingers,
                                     const std::function<Vec3(Index)>& deformed) const {
  const FingerMark* finger = sectionFinger(fingers);
  const auto plane = cutPlane(world_, fingers);
  if (finger == nullptr || !plane) return std::nullopt;
  const auto curve = sectionCurve(world_, deformed, *plane, kCutHalfWidthMm);
  if (curve.size() < 2) return std::nullopt;
  CutAway cut{.plane = *plane};
  for (const SectionPoint& point : curve) {
    cut.rest.push_back(point.rest);
    cut.skin.push_back(point.deformed);
  }
  const auto columns = buildCutColumns(world_, ground_ ? &*ground_ : nullptr, *plane, curve);
  const CutColumn& middle = columnAt(columns, 0.0);
  cut.bone_mm = middle.bone_mm;
  cut.layers = buildCutLayers(columns, middle);
  cut.nearest = nearestLump(world_, plane->origin, fingers);
  for (std::size_t i = 0; i < world_.lumps.size(); ++i) {
    cut.lumps.push_back(lumpIn(*plane, *world_.lumps[i], lumpShift(i, fingers), columns));
  }
  cut.finger_mm = finger->radius_mm;
  cut.finger = tipIn(cut, *finger);
  cut.colour = finger->colour;
  frameCutAway(cut);
  return cut;
}

}  // namespace palpate::view
