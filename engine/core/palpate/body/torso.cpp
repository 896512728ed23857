// Bones -> relief on the skin -> both bent and scaled alike -> skin cut into what triangles are left -> depth of the
// nearest bone under every vertex, from which the stiffness map is made (maps/stiffness_map.h).
#include "palpate/body/torso.h"

#include <algorithm>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/body/bones.h"
#include "palpate/body/skin_table.h"
#include "palpate/body/spine_line.h"

namespace palpate::body {

namespace {

constexpr double kBoneShare = 0.44;  // leaves skin and bones triangles of about the same size

std::size_t boneTriangles(const TorsoSettings& settings) {
  if (settings.triangles < kFewestTorsoTriangles) {
    throw Error("a torso needs at least " + std::to_string(kFewestTorsoTriangles) + " triangles");
  }
  if (settings.bone_triangles == 0) {
    const auto share = static_cast<std::size_t>(kBoneShare * static_cast<double>(settings.triangles));
    // The bones get at most what their grid has; the skin takes the rest.
    return std::clamp<std::size_t>(share / 2 * 2, kFewestBoneTriangles, kMaxBoneTriangles);
  }
  if (settings.bone_triangles + kFewestTriangles > settings.triangles)
    throw Error("torso: the bones leave too few triangles for the skin; use fewer for the bones, or more in total");
  return settings.bone_triangles;
}

/// Bends a point with the body's asymmetry and scales it, as SkinSurface does with the skin.
class Shape {
 public:
  explicit Shape(const SkinSettings& settings)
      : asymmetry_{.amount = settings.asymmetry}, scale_(settings.stature_mm / kTableStatureMm) {}
  Vec3 operator()(const Vec3& point) const { return scale_ * warp(asymmetry_, point).position; }

 private:
  Asymmetry asymmetry_;
  double scale_;
};

/// The skin above a bone's landmark is where the ray from the axis of the skin through it comes out.
std::vector<SkinLandmark> skinLandmarks(const SkinSurface& surface, const Shape& shape) {
  std::vector<SkinLandmark> landmarks;
  for (const Landmark& point : boneLandmarks()) {
    const double angle = elementary::atan2(point.position.x(), point.position.z() - kSkinAxisZ);
    const SkinPoint above = surface.at({angle, point.position.y()});
    landmarks.push_back({point.name, point.bone, above.position, above.normal, shape(point.position)});
  }
  return landmarks;
}

/// Without depths.
Torso makeBody(const SkinSettings& skin, SkinExtent extent, std::size_t skin_triangles, std::size_t bone_triangles) {
  BonesSettings bones;  // at 1750 mm and symmetric: the relief is computed there, before both are shaped alike
  bones.triangles = bone_triangles;
  Torso body;
  body.bones = makeBones(bones);
  const SkinSurface surface =
      bones.triangles >= kReliefBoneTriangles ? makeSkinSurface(skin, body.bones) : makeSkinSurface(skin);
  const Shape shape(skin);
  for (Bone& bone : body.bones) {
    for (Vec3& point : bone.mesh.positions) point = shape(point);
  }
  body.skin = meshSkin(surface, extent, skin_triangles);
  body.landmarks = skinLandmarks(surface, shape);
  return body;
}

/// Leaves out the bones whose middle is below this height, and the landmarks named after them.
void removeBonesBelow(double y, Torso& body) {
  std::erase_if(body.bones, [&](const Bone& bone) { return mesh::boundingBox(bone.mesh).center().y() < y; });
  const auto is_gone = [&](const SkinLandmark& landmark) {
    return std::ranges::find(body.bones, landmark.bone, &Bone::name) == body.bones.end();
  };
  std::erase_if(body.landmarks, is_gone);
}

/// The piece is cut narrower than the shoulders and through the third lumbar vertebra of the man under it. His shoulder
/// blades are scaled to this share of their width, from their medial edge, and bone near the lower edge is moved up
/// over it: by some millimetres, so that none is seen beyond the skin.
constexpr double kScapulaWidth = 0.93;
constexpr double kLowEdgeMm = 45.0;  ///< for a man of 1750 mm: how far above the edge bones are moved
constexpr double kEdgeMarginMm = 4.0;

void setInside(const mesh::TriangleMesh& skin, double scale, Torso& body) {
  const double edge = mesh::boundingBox(skin).min().y();
  double lowest = edge;
  for (const Bone& bone : body.bones) lowest = std::min(lowest, mesh::boundingBox(bone.mesh).min().y());
  const double from = edge + scale * kLowEdgeMm;
  const double shrink = (from - edge - scale * kEdgeMarginMm) / (from - lowest);
  for (Bone& bone : body.bones) {
    const Eigen::AlignedBox3d box = mesh::boundingBox(bone.mesh);
    const double medial = box.center().x() > 0.0 ? box.min().x() : box.max().x();
    for (Vec3& point : bone.mesh.positions) {
      if (bone.kind == BoneKind::scapula) point.x() = medial + kScapulaWidth * (point.x() - medial);
      if (point.y() < from) point.y() = from + shrink * (point.y() - from);
    }
  }
}

}  // namespace

void BonesUnderSkin::measureDepths(std::span<const Vec3> skin) {
  BoneDepth depth = depthToBones(skin, bones);
  depth_mm = std::move(depth.depth_mm);
  nearest_bone = std::move(depth.bone);
}

Torso makeTorso(const TorsoSettings& settings) {
  const std::size_t bone_triangles = boneTriangles(settings);
  Torso torso = makeBody(settings.shape, SkinExtent::torso, settings.triangles - bone_triangles, bone_triangles);
  torso.measureDepths(torso.skin.mesh.positions);
  return torso;
}

Torso makeBackOverBones(const BackSettings& settings) {
  // As fine as the skin, and never so few that the relief of the skin would need others.
  const auto as_fine =
      static_cast<std::size_t>(kBoneShare / (1.0 - kBoneShare) * static_cast<double>(settings.triangles));
  const std::size_t bone_triangles = std::clamp<std::size_t>(as_fine / 2 * 2, kReliefBoneTriangles, kMaxBoneTriangles);
  Torso back = makeBody(settings.shape, SkinExtent::patch, settings.triangles, bone_triangles);
  removeBonesBelow(mesh::boundingBox(back.skin.mesh).min().y(), back);
  setInside(back.skin.mesh, settings.shape.stature_mm / 1750.0, back);
  back.measureDepths(back.skin.mesh.positions);
  return back;
}

const SkinLandmark& landmark(const Torso& torso, std::string_view name) {
  if (const SkinLandmark* found = findLandmark(torso.landmarks, name)) return *found;
  throw Error("the body has no landmark '" + std::string(name) + "'");
}

}  // namespace palpate::body
