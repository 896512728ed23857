// Bones, and the fitted skin cut into triangles -> soft tissue and relief along its normal -> both bent alike -> the
// table -> depth of the nearest bone under every vertex.
#include "palpate/body/trunk/trunk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/background.h"
#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/body/bones.h"
#include "palpate/body/skeleton/skeleton.h"
#include "palpate/body/skin_outline.h"
#include "palpate/body/skin_table.h"
#include "palpate/body/spine_line.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/body/trunk/above_bones.h"
#include "palpate/body/trunk/even_mesh.h"
#include "palpate/body/trunk/trunk_field.h"
#include "palpate/body/trunk/trunk_folds.h"

namespace palpate::body {

namespace {

constexpr double kTrunkBoneShare = 0.3;
constexpr std::size_t kMaxOfTrunkBones = 24000;  // more triangles do not make better bones
constexpr double kGlutealOfSitting = 0.15;       // share of the gluteal fold: bent hips stretch it
constexpr double kRoughCellMm = 14;              // finer than armpits, folds and the cleft are wide

std::size_t boneTriangles(const TrunkSettings& settings) {
  if (settings.triangles % 2 != 0) {
    throw Error("trunk: the number of triangles must be even (closed surface): " +
                std::to_string(settings.triangles - 1) + " or " + std::to_string(settings.triangles + 1));
  }
  if (settings.triangles < kFewestTrunkTriangles) {
    throw Error("a trunk needs at least " + std::to_string(kFewestTrunkTriangles) + " triangles");
  }
  if (settings.bone_triangles == 0) {
    const auto share = static_cast<std::size_t>(kTrunkBoneShare * static_cast<double>(settings.triangles));
    return std::clamp<std::size_t>(share / 2 * 2, kFewestSkeletonTriangles, kMaxOfTrunkBones);
  }
  if (settings.bone_triangles + kFewestTrunkSkinTriangles > settings.triangles)
    throw Error("torso: the bones leave too few triangles for the skin; use fewer for the bones, or more in total");
  return settings.bone_triangles;
}

mesh::TriangleMesh fittedSkin(const TrunkField& field, std::size_t triangles) {
  const Eigen::AlignedBox3d box = TrunkField::box();
  const Field distance = [&](const Vec3& p) { return field.at(p).distance; };
  const mesh::TriangleMesh rough =
      meshZeroSurface(distance, {.low = box.min(), .high = box.max(), .cell_mm = kRoughCellMm});
  return evenMesh(
      rough, [&](const Vec3& p) { return field.project(p); }, triangles);
}

FoldAmounts computeFoldAmounts(const TrunkShape& shape) {
  constexpr double kBellyWithin = 4.5;  // kg/m^2 from the fitted body
  constexpr double kFilledBy = 20.0;    // kg/m^2: fat fills the crease under the buttock
  constexpr double kLeastGluteal = 0.4;
  const double away = std::abs(shape.body_mass_index - kFittedMassIndex);
  constexpr double kThinnedBy = 36.0;  // kg/m^2: a thin buttock hangs over it less
  const double over = shape.body_mass_index - kFittedMassIndex;
  const double standing = std::max(kLeastGluteal, 1.0 - (over > 0.0 ? over / kFilledBy : -over / kThinnedBy));
  return {.gluteal = shape.posture == Posture::sitting ? kGlutealOfSitting : standing,
          .belly = std::max(0.0, 1.0 - away / kBellyWithin)};
}

/// Takes points of the fitted skin to where they are on this body.
class Shaper {
 public:
  Shaper(const TrunkField& field, const TrunkShape& shape, std::span<const Bone> fitted_bones)
      : field_(field),
        folds_(field, computeFoldAmounts(shape)),
        shape_(shape),
        warp_(shape),
        scale_(shape.stature_mm / kTableStatureMm) {
    if (shape.relief.any()) relief_ = skinDetail(fitted_bones, shape.relief, shape.asymmetry);
  }

  /// Whether growth depends on how deep the bone is.
  bool shrinks() const { return shape_.body_mass_index < kFittedMassIndex || shape_.muscle < 1; }

  Vec3 skin(const SkinPoint& fitted, double depth_mm) const {
    const double out = keptOffBone(softTissueGrowth(shape_, fitted.position), depth_mm);
    return warp_(fitted.position + folds_.at(fitted) + out * (out > 0 ? field_.outward(fitted) : fitted.normal) +
                 relief(fitted));
  }
  Vec3 bone(const Vec3& fitted) const { return warp_(fitted); }
  double scale() const { return scale_; }

 private:
  /// The relief of the dorsal bones is a change of the radius about the axis of the back's skin (skin_relief.h).
  Vec3 relief(const SkinPoint& fitted) const {
    const Vec3& p = fitted.position;
    const SkinAngle place{elementary::atan2(p.x(), p.z() - kSkinAxisZ), p.y()};
    const Vec2 unit = unitOfPlace(place);
    const bool on_back =
        (unit.array() >= 0).all() && (unit.array() <= 1).all() && std::abs(place.angle) < borderAngle(p.y());
    if (!relief_ || !on_back) return Vec3::Zero();
    // The table's skin ends at the sacrum with a cut; what shows there fades out above it.
    constexpr double kFadeMm = 40;
    const double inside = std::clamp((p.y() - kSkinLow) / kFadeMm, 0.0, 1.0);
    const double top = std::clamp((kSkinHigh - p.y()) / kFadeMm, 0.0, 1.0);
    const double fade = inside * inside * (3 - 2 * inside) * top * top * (3 - 2 * top);
    const Vec3 radial(elementary::sin(place.angle), 0, elementary::cos(place.angle));
    // At the root of the neck the front is dorsal of that axis too.
    constexpr double kFacesBack = 0.3;
    const double back = std::clamp(fitted.normal.dot(radial) / kFacesBack, 0.0, 1.0);
    return fade * back * back * (3 - 2 * back) * relief_->at(unit.x(), unit.y()).value * radial;
  }

  const TrunkField& field_;
  TrunkFolds folds_;
  TrunkShape shape_;
  BodyWarp warp_;
  double scale_;
  std::optional<BicubicSpline> relief_;
};

/// The fitted skin and data from its bones.
struct FittedTrunk {
  std::vector<Bone> bones;
  mesh::TriangleMesh skin;
};

FittedTrunk fittedTrunk(const TrunkField& field, const TrunkSettings& settings) {
  const std::size_t for_bones = boneTriangles(settings);
  FittedTrunk fitted;
  Background skeleton([&] { fitted.bones = makeSkeleton({.triangles = for_bones}); });
  fitted.skin = fittedSkin(field, settings.triangles - for_bones);
  skeleton.join();
  return fitted;
}

void shapeSkin(mesh::TriangleMesh& skin, const TrunkField& field, const Shaper& shaper, std::span<const Bone> bones) {
  BoneDepth depth;
  if (shaper.shrinks()) depth = depthToBones(skin.positions, bones);
  for (std::size_t v = 0; v < skin.positions.size(); ++v) {
    const SkinPoint fitted{skin.positions[v], field.at(skin.positions[v]).gradient.normalized()};
    skin.positions[v] = shaper.skin(fitted, depth.depth_mm.empty() ? 0 : depth.depth_mm[v]);
  }
}

/// The skin above the bones' landmarks. All at once, because every query of the depth of the bones sorts them again.
std::vector<SkinLandmark> skinLandmarks(const TrunkField& field, const Shaper& shaper, std::span<const Bone> bones) {
  std::vector<SkinLandmark> landmarks;
  std::vector<SkinPoint> places;
  for (const Landmark& point : skeletonLandmarks()) {
    landmarks.push_back({point.name, point.bone, {}, {}, shaper.bone(point.position)});
    places.push_back(field.project(point.position));
  }
  setAboveBones(field, std::move(places), landmarks, [&](const std::vector<SkinPoint>& fitted) {
    std::vector<Vec3> skin;
    for (const SkinPoint& place : fitted) skin.push_back(place.position);
    const std::vector<double> depth =
        shaper.shrinks() ? depthToBones(skin, bones).depth_mm : std::vector<double>(skin.size(), 0.0);
    for (std::size_t i = 0; i < skin.size(); ++i) skin[i] = shaper.skin(fitted[i], depth[i]);
    return skin;
  });
  return landmarks;
}

template <class Change>
void forEachPoint(Trunk& trunk, const Change& change) {
  for (Vec3& p : trunk.skin.positions) p = change(p);
  for (Bone& bone : trunk.bones) {
    for (Vec3& p : bone.mesh.positions) p = change(p);
  }
  for (SkinLandmark& landmark : trunk.landmarks) {
    landmark.position = change(landmark.position);
    landmark.bone_position = change(landmark.bone_position);
  }
}

double minCoordinate(const mesh::TriangleMesh& skin, int axis) {
  double least = skin.positions[0][axis];
  for (const Vec3& p : skin.positions) least = std::min(least, p[axis]);
  return least;
}

void flattenOntoTable(Trunk& trunk) {
  const double plane = tablePlane(minCoordinate(trunk.skin, 2));
  forEachPoint(trunk, [&](const Vec3& p) { return flattened(p, plane); });
  trunk.support = Support{{0, 0, plane}, Vec3::UnitZ()};
}

void setDown(Trunk& trunk) { trunk.support = Support{{0, minCoordinate(trunk.skin, 1), 0}, Vec3::UnitY()}; }

}  // namespace

Trunk makeTrunk(const TrunkSettings& settings) {
  check(settings.shape);
  const TrunkField field;
  FittedTrunk fitted = fittedTrunk(field, settings);
  const Shaper shaper(field, settings.shape, fitted.bones);
  Trunk trunk;
  trunk.landmarks = skinLandmarks(field, shaper, fitted.bones);
  trunk.skin = std::move(fitted.skin);
  shapeSkin(trunk.skin, field, shaper, fitted.bones);
  trunk.bones = std::move(fitted.bones);
  for (Bone& bone : trunk.bones) {
    for (Vec3& p : bone.mesh.positions) p = shaper.bone(p);
  }
  if (settings.shape.posture == Posture::prone) flattenOntoTable(trunk);
  if (settings.shape.posture == Posture::sitting) setDown(trunk);
  forEachPoint(trunk, [&](const Vec3& p) { return Vec3(shaper.scale() * p); });
  if (trunk.support) trunk.support->point *= shaper.scale();
  trunk.measureDepths(trunk.skin.positions);
  return trunk;
}

}  // namespace palpate::body
