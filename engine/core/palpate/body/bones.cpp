// The list of the 43 bones (drawn_bones.h), which are then warped and scaled, and their landmarks.
#include "palpate/body/bones.h"

#include "palpate/base/error.h"
#include "palpate/body/drawn_bones.h"
#include "palpate/body/tetrahedra_mesher.h"

namespace palpate::body {
namespace {

DrawnBones bonesOfBack() {
  DrawnBones bones{{}, "the bones need", kFewestBoneTriangles, 40000};
  for (const VertebraRow& row : spineRows()) bones.plans.push_back(vertebraPlan(row));
  for (int rib = 1; rib <= kRibCount; ++rib) bones.plans.push_back(ribPlan(rib, ribRows()[rib - 1]));
  bones.plans.push_back(scapulaPlan(kScapulaPlaceOfBack));
  return bones;
}

Vec3 placed(const Vec3& p, const BonesSettings& settings) {
  return settings.stature_mm / kTableStatureMm * (settings.warp ? settings.warp(p) : p);
}

void addScapulaLandmarks(std::vector<Landmark>& landmarks, const std::string& bone, const ScapulaPoints& points,
                         bool left) {
  const auto add = [&](const char* name, const Vec3& p) {
    landmarks.push_back({bone + "_" + name, bone, left ? mirrored(p) : p});
  };
  add("superior_angle", points.superior_angle);
  add("spine_root", points.spine_root);
  add("inferior_angle", points.inferior_angle);
  add("acromial_angle", points.acromial_angle);
}

}  // namespace

std::vector<std::size_t> shareTriangles(std::size_t total) { return bonesOfBack().share(total); }

std::vector<Bone> makeBones(const BonesSettings& settings) {
  if (!(settings.stature_mm >= 300.0 && settings.stature_mm <= 3000.0)) {
    throw Error("stature must be 300 to 3000 mm");
  }
  std::vector<Bone> bones = bonesOfBack().draw(settings.triangles, settings.cell_mm);
  for (Bone& bone : bones) {
    for (Vec3& p : bone.mesh.positions) p = placed(p, settings);
  }
  return bones;
}

std::vector<Landmark> boneLandmarks(const BonesSettings& settings) {
  std::vector<Landmark> landmarks;
  for (const VertebraRow& row : spineRows()) {
    landmarks.push_back({std::string("spinous_") + row.name, row.name, vertebraFrame(row) * spinousTip(row)});
  }
  for (const bool left : {false, true}) {
    for (int rib = 1; rib <= kRibCount; ++rib) {
      const std::string bone = "rib_" + std::to_string(rib) + (left ? "_left" : "_right");
      const Vec3 angle = rightRibAngle(rib, ribRows()[rib - 1]);
      landmarks.push_back({bone + "_angle", bone, left ? mirrored(angle) : angle});
    }
  }
  addScapulaLandmarks(landmarks, "scapula_right", rightScapulaPoints(), false);
  addScapulaLandmarks(landmarks, "scapula_left", rightScapulaPoints(), true);
  for (Landmark& landmark : landmarks) landmark.position = placed(landmark.position, settings);
  return landmarks;
}

}  // namespace palpate::body
