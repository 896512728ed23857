// Each place moves out by what one unit of fat and of muscle add there, times the build, but never into the bone; then
// the warp of the trunk's shape moves skin and bones alike (trunk_shape.h).
#include "palpate/body/fitting/template_body.h"

#include <cmath>
#include <utility>

#include "palpate/body/bones.h"
#include "palpate/body/spine_line.h"
#include "palpate/body/trunk/above_bones.h"

namespace palpate::body {

namespace {

constexpr std::size_t kTemplateSkinTriangles = 8000;
constexpr std::size_t kTemplateBoneTriangles = 24000;

/// The fitted body itself: no unevenness and no relief, which a scan shows at other places.
TrunkShape plainShape() { return {.relief = ReliefSettings{.spine = 0, .ribs = 0, .scapulae = 0}, .asymmetry = 0}; }

// Stumps of a man of 1750 mm.
constexpr double kNeckStumpY = 215;
constexpr double kThighStumpY = -500;
constexpr double kArmStumpX = 205;
constexpr double kArmStumpY = 20;

bool onStump(const Vec3& place) {
  return place.y() > kNeckStumpY || place.y() < kThighStumpY ||
         (std::abs(place.x()) > kArmStumpX && place.y() < kArmStumpY);
}

}  // namespace

double BodyPlacement::scale() const { return shape.stature_mm / kTableStatureMm; }

TemplateBody::Place TemplateBody::placeOf(const Vec3& fitted, const Vec3& normal, double depth_mm) const {
  TrunkShape fatter;
  fatter.body_mass_index += 1;
  TrunkShape stronger;
  stronger.muscle += 1;
  return {.fitted = fitted,
          .normal = normal,
          .outward = field_.outward({fitted, normal}),
          .fat = softTissueGrowth(fatter, fitted),
          .muscle = softTissueGrowth(stronger, fitted),
          .depth_mm = depth_mm};
}

TemplateBody::TemplateBody() {
  Trunk trunk = makeTrunk({.triangles = kTemplateSkinTriangles + kTemplateBoneTriangles,
                           .bone_triangles = kTemplateBoneTriangles,
                           .shape = plainShape()});
  const std::vector<Vec3> normals = mesh::vertexNormals(trunk.skin);
  for (std::size_t v = 0; v < trunk.skin.positions.size(); ++v) {
    skin_.push_back(placeOf(trunk.skin.positions[v], normals[v], trunk.depth_mm[v]));
  }
  bones_ = std::move(trunk.bones);
  std::vector<SkinPoint> points;
  for (const SkinLandmark& landmark : trunk.landmarks) points.push_back({landmark.position, landmark.normal});
  on_landmarks_ = placesOf(points);
  triangles_ = std::move(trunk.skin.triangles);
  landmarks_ = std::move(trunk.landmarks);
  for (const Triangle& t : triangles_) {
    is_stump_.push_back(onStump((skin_[t[0]].fitted + skin_[t[1]].fitted + skin_[t[2]].fitted) / 3.0));
  }
}

std::vector<TemplateBody::Place> TemplateBody::placesOf(const std::vector<SkinPoint>& points) const {
  std::vector<Vec3> positions;
  for (const SkinPoint& point : points) positions.push_back(point.position);
  const BoneDepth depth = depthToBones(positions, bones_);
  std::vector<Place> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    places.push_back(placeOf(points[i].position, points[i].normal, depth.depth_mm[i]));
  }
  return places;
}

std::vector<Bone> TemplateBody::bonesOf(const TrunkShape& shape) const {
  const BodyWarp warp(shape);
  std::vector<Bone> bones = bones_;
  for (Bone& bone : bones) {
    for (Vec3& p : bone.mesh.positions) p = warp(p);
  }
  return bones;
}

std::vector<SkinLandmark> TemplateBody::landmarksOf(const TrunkShape& shape) const {
  const BodyWarp warp(shape);
  std::vector<SkinLandmark> landmarks = landmarks_;
  std::vector<SkinPoint> places;
  for (SkinLandmark& landmark : landmarks) {
    places.push_back({landmark.position, landmark.normal});
    landmark.bone_position = warp(landmark.bone_position);
  }
  setAboveBones(field_, std::move(places), landmarks, [&](const std::vector<SkinPoint>& fitted) {
    std::vector<Vec3> skin;
    for (const Place& place : placesOf(fitted)) skin.push_back(shapedPlace(place, shape, warp));
    return skin;
  });
  return landmarks;
}

Vec3 TemplateBody::shapedPlace(const Place& place, const TrunkShape& shape, const BodyWarp& warp) {
  const double out = keptOffBone(
      (shape.body_mass_index - kFittedMassIndex) * place.fat + (shape.muscle - 1) * place.muscle, place.depth_mm);
  return warp(place.fitted + out * (out > 0 ? place.outward : place.normal));
}

TemplateBody::Shaped TemplateBody::shaped(const TrunkShape& shape) const {
  const BodyWarp warp(shape);

  Shaped result;
  result.skin.reserve(skin_.size());
  for (const Place& place : skin_) result.skin.push_back(shapedPlace(place, shape, warp));
  for (const Place& place : on_landmarks_) result.landmarks.push_back(shapedPlace(place, shape, warp));
  return result;
}

}  // namespace palpate::body
