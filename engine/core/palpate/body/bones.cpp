// Puts the 43 bones together: shape (bone_shapes.h), reduce (mesh/decimate.h), place, mirror, warp, scale. Only 12
// ribs, one scapula and 17 half vertebrae are ever built and reduced; the rest are mirror images.
#include "palpate/body/bones.h"

#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/body/bone_shapes.h"
#include "palpate/body/spine_line.h"
#include "palpate/body/tetrahedra_mesher.h"
#include "palpate/mesh/decimate.h"

namespace palpate::body {
namespace {

constexpr std::size_t kFirstRib = kVertebraCount;
constexpr std::size_t kScapulaRight = kBoneCount - 2;
// The default grid: a coarse result never shows a fine grid's detail, and the time goes with its square.
constexpr double kFineCellMm = 1.5;
constexpr double kCoarseCellMm = 2.0;
constexpr std::size_t kFineFrom = 40000;  // triangles
constexpr double kMinCellMm = 0.5;
constexpr double kLargestCellMm = 3.0;  // beyond it the mesher loses the thin parts

constexpr double kScapulaCell = 1.25;  // relative to the vertebrae: it is larger and smoother
constexpr double kRibEdgeMm = 2.2;     // ribs are swept without a grid; longer edges would cross in the neck's bend

// Share of a bone in the triangles, relative: chosen so that the visible error after reduction is alike.
constexpr double kVertebraWeight = 1.0;
constexpr double kRibWeight = 0.7;
constexpr double kShortRibWeight = 0.45;  // ribs 1, 2, 11 and 12
constexpr double kScapulaWeight = 2.2;

double boneWeight(std::size_t bone) {
  if (bone < kFirstRib) return kVertebraWeight;
  if (bone >= kScapulaRight) return kScapulaWeight;
  const std::size_t rib = (bone - kFirstRib) % kRibCount;
  return rib < 2 || rib >= 10 ? kShortRibWeight : kRibWeight;
}

std::string ribName(int number, const char* side) { return "rib_" + std::to_string(number) + "_" + side; }

void check(const BonesSettings& settings) {
  if (!(settings.stature_mm >= 300.0 && settings.stature_mm <= 3000.0)) {
    throw Error("stature must be 300 to 3000 mm");
  }
  if (settings.triangles % 2 != 0) throw Error("bones: the number of triangles must be even (closed surfaces)");
  if (settings.triangles < kFewestBoneTriangles) {
    throw Error("the bones need at least " + std::to_string(kFewestBoneTriangles) + " triangles");
  }
  if (settings.cell_mm != 0.0 && !(settings.cell_mm >= kMinCellMm && settings.cell_mm <= kLargestCellMm)) {
    throw Error("bones: the grid cell must be 0.5 to 3 mm");
  }
}

double cellSize(const BonesSettings& settings) {
  if (settings.cell_mm > 0.0) return settings.cell_mm;
  return settings.triangles < kFineFrom ? kCoarseCellMm : kFineCellMm;
}

// Throws when the mesh before the reduction has fewer triangles than requested.
mesh::TriangleMesh reduced(mesh::TriangleMesh mesh, std::size_t triangles, const mesh::DecimateOptions& options = {}) {
  if (mesh.triangles.size() < triangles)
    throw Error("bones: too many triangles for this grid cell; use fewer, or a smaller cell");
  return mesh::decimate(std::move(mesh), triangles, options);
}

mesh::TriangleMesh makeVertebra(const VertebraRow& row, std::size_t triangles, double cell_mm) {
  mesh::DecimateOptions options;
  options.mirrored_at_x0 = true;
  mesh::TriangleMesh whole = withMirrorImage(reduced(makeVertebraHalf(row, cell_mm), triangles / 2, options));
  const Eigen::Isometry3d frame = vertebraFrame(row);
  for (Vec3& p : whole.positions) p = frame * p;
  return whole;
}

void addVertebrae(std::vector<Bone>& bones, const std::vector<std::size_t>& counts, double cell_mm) {
  for (const VertebraRow& row : spineRows()) {
    bones.push_back({row.name, BoneKind::vertebra, makeVertebra(row, counts[bones.size()], cell_mm)});
  }
}

void addRibs(std::vector<Bone>& bones, const std::vector<std::size_t>& counts) {
  for (int rib = 1; rib <= kRibCount; ++rib) {
    bones.push_back({ribName(rib, "right"), BoneKind::rib,
                     reduced(makeRightRib(rib, ribRows()[rib - 1], kRibEdgeMm), counts[bones.size()])});
  }
  for (int rib = 1; rib <= kRibCount; ++rib) {
    bones.push_back({ribName(rib, "left"), BoneKind::rib, mirrored(bones[kFirstRib + rib - 1].mesh)});
  }
}

void addScapulae(std::vector<Bone>& bones, const std::vector<std::size_t>& counts, double cell_mm) {
  bones.push_back(
      {"scapula_right", BoneKind::scapula, reduced(makeRightScapula(kScapulaCell * cell_mm), counts[kScapulaRight])});
  bones.push_back({"scapula_left", BoneKind::scapula, mirrored(bones[kScapulaRight].mesh)});
}

Vec3 placed(const Vec3& p, const BonesSettings& settings) {
  return settings.stature_mm / kTableStatureMm * (settings.warp ? settings.warp(p) : p);
}

Vec3 mirrorToLeft(const Vec3& right) { return {-right.x(), right.y(), right.z()}; }

void addScapulaLandmarks(std::vector<Landmark>& landmarks, const std::string& bone, const ScapulaPoints& points,
                         bool left) {
  const auto add = [&](const char* name, const Vec3& p) {
    landmarks.push_back({bone + "_" + name, bone, left ? mirrorToLeft(p) : p});
  };
  add("superior_angle", points.superior_angle);
  add("spine_root", points.spine_root);
  add("inferior_angle", points.inferior_angle);
  add("acromial_angle", points.acromial_angle);
}

}  // namespace

std::vector<std::size_t> shareTriangles(std::size_t total) {
  double weights = 0.0;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) weights += boneWeight(bone);
  std::vector<std::size_t> counts;
  std::size_t given = 0;
  for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
    counts.push_back(2 * static_cast<std::size_t>(0.5 * static_cast<double>(total) * boneWeight(bone) / weights));
    given += counts.back();
  }
  // The remainder of rounding down, two triangles per vertebra, again from T1 on.
  for (std::size_t bone = 0; given + 1 < total; bone = (bone + 1) % kVertebraCount, given += 2) counts[bone] += 2;
  return counts;
}

std::vector<Bone> makeBones(const BonesSettings& settings) {
  check(settings);
  const std::vector<std::size_t> counts = shareTriangles(settings.triangles);
  std::vector<Bone> bones;
  const double cell_mm = cellSize(settings);
  addVertebrae(bones, counts, cell_mm);
  addRibs(bones, counts);
  addScapulae(bones, counts, cell_mm);
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
      const std::string bone = ribName(rib, left ? "left" : "right");
      const Vec3 angle = rightRibAngle(rib, ribRows()[rib - 1]);
      landmarks.push_back({bone + "_angle", bone, left ? mirrorToLeft(angle) : angle});
    }
  }
  addScapulaLandmarks(landmarks, "scapula_right", rightScapulaPoints(), false);
  addScapulaLandmarks(landmarks, "scapula_left", rightScapulaPoints(), true);
  for (Landmark& landmark : landmarks) landmark.position = placed(landmark.position, settings);
  return landmarks;
}

}  // namespace palpate::body
