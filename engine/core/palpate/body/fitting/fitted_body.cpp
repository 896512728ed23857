// The template's bones in that build -> the scan's frame -> the residual warp -> landmarks down on the scan's skin,
// bones pushed below it where they come too near.
#include "palpate/body/fitting/fitted_body.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/body/bones.h"
#include "palpate/body/places.h"
#include "palpate/mesh/nearest.h"
#include "palpate/mesh/topology.h"

namespace palpate::body {

namespace {

constexpr double kUnderMm = 70;     // a bone deeper than this is not of the side that was scanned
constexpr double kOntoMm = 25;      // a landmark farther from the scan is not on it
constexpr double kMaxOffsetMm = 5;  // nor one that is outside its border

/// Queries on the scan's skin.
class ScannedSkin {
 public:
  explicit ScannedSkin(const mesh::TriangleMesh& mesh)
      : mesh_(mesh), normals_(mesh::vertexNormals(mesh)), nearest_(mesh) {
    on_border_.assign(mesh.positions.size(), false);
    mesh::forEachEdge(mesh::edgeUses(mesh), [&](Index a, Index b, std::span<const mesh::EdgeUse> uses) {
      if (uses.size() % 2 != 0) on_border_[a] = on_border_[b] = true;
    });
  }

  struct Place {
    Vec3 point, normal;
    double out;     // height of the queried point, along the normal
    double beside;  // across it
    bool at_border;
  };
  /// Nothing within reach: at_border and infinitely far.
  Place near(const Vec3& point, double reach_mm) const {
    const auto hit = nearest_.find(point, reach_mm);
    if (hit.triangle == kNoIndex) return {point, Vec3::UnitZ(), 1e9, 1e9, true};
    const Triangle& t = mesh_.triangles[hit.triangle];
    Vec3 normal = Vec3::Zero();
    for (const Index v : t) normal += normals_[v] / std::max((mesh_.positions[v] - hit.point).norm(), 1e-3);
    normal.normalize();
    const Vec3 off = point - hit.point;
    const double out = off.dot(normal);
    return {hit.point, normal, out, (off - out * normal).norm(),
            on_border_[t[0]] || on_border_[t[1]] || on_border_[t[2]]};
  }

 private:
  const mesh::TriangleMesh& mesh_;
  std::vector<Vec3> normals_;
  mesh::NearestTriangle nearest_;
  std::vector<bool> on_border_;
};

/// The corrected depth: the same where there is room, kMinFittedCoverMm at least.
double coveredDepth(double depth_mm) {
  constexpr double kSoftMm = 1.2;
  const double over = (depth_mm - kMinFittedCoverMm) / kSoftMm;
  if (over > 8) return depth_mm;
  return kMinFittedCoverMm + kSoftMm * elementary::log1p(elementary::exp(over));
}

/// False where the bone is not under this skin, or more outside it than under it.
bool pushUnder(const ScannedSkin& skin, Bone& bone) {
  std::size_t under = 0;
  std::size_t beside = 0;
  for (Vec3& p : bone.mesh.positions) {
    const ScannedSkin::Place place = skin.near(p, kUnderMm);
    if (place.out > 1e8) continue;
    if (place.at_border && place.beside > 1) {
      ++beside;
      continue;
    }
    ++under;
    p += (coveredDepth(-place.out) + place.out) * -place.normal;
  }
  return under > beside;
}

ResidualWarp makeWarp(const BodyFit& fit, std::span<const SkinLandmark> landmarks) {
  std::vector<Move> exact;
  for (const NamedPoint& point : fit.points) {
    for (const SkinLandmark& landmark : landmarks) {
      if (spokenName(landmark.name) != point.name) continue;
      const Vec3 place = fit.placement.toScan(landmark.position);
      exact.push_back({place, point.position - place});
    }
  }
  return {fit.skin_moves, exact};
}

/// The skin that the fit met must still be there.
void requireSameScan(const BodyFit& fit, const ScannedSkin& skin) {
  constexpr double kMovedMm = 5;
  constexpr std::size_t kAsked = 40;
  std::size_t moved = 0;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < fit.skin_moves.size(); i += fit.skin_moves.size() / kAsked + 1) {
    const Move& move = fit.skin_moves[i];
    ++asked;
    if (!(std::abs(skin.near(move.place + move.by, kUnderMm).out) < kMovedMm)) ++moved;
  }
  if (2 * moved > asked)
    throw Error("the fit does not match this scan; it was made from another scan, or another unit or position of it");
}

}  // namespace

FittedBody fittedBody(const TemplateBody& body, const BodyFit& fit, const mesh::TriangleMesh& scan) {
  const ScannedSkin skin(scan);
  requireSameScan(fit, skin);
  std::vector<SkinLandmark> landmarks = body.landmarksOf(fit.placement.shape);
  const ResidualWarp warp = makeWarp(fit, landmarks);
  const auto onto = [&](const Vec3& p) { return warp(fit.placement.toScan(p)); };
  FittedBody result;
  for (Bone& bone : body.bonesOf(fit.placement.shape)) {
    for (Vec3& p : bone.mesh.positions) p = onto(p);
    if (pushUnder(skin, bone)) result.bones.push_back(std::move(bone));
  }
  if (result.bones.empty()) throw Error("the fit puts no bone under this mesh; it was made from another scan");
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    SkinLandmark& landmark = landmarks[i];
    const ScannedSkin::Place place = skin.near(onto(landmark.position), kOntoMm);
    const bool facing = place.normal.dot(fit.placement.rotation * landmark.normal) > 0;
    if (place.out > 1e8 || !facing || (place.at_border && place.beside > kMaxOffsetMm)) continue;
    landmark.position = place.point;
    landmark.normal = place.normal;
    landmark.bone_position = onto(landmark.bone_position);
    result.expected_mm.push_back(i < fit.expected_mm.size() ? fit.expected_mm[i] : 0);
    result.landmarks.push_back(std::move(landmark));
  }
  result.measureDepths(scan.positions);
  return result;
}

}  // namespace palpate::body
