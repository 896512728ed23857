// Own.
#include "palpate/body/fitting/template_body.h"

#include <cmath>

#include "palpate/body/bone_depth.h"
#include "palpate/body/spine_line.h"
#include "palpate/body/trunk/trunk_field.h"

namespace palpate::body {

namespace {

constexpr std::size_t kTemplateTriangles = 14000;
constexpr std::size_t kTemplateBoneTriangles = 6000;

/// The fitted body itself: no unevenness and no relief, which a scan shows at other places.
TrunkShape plainShape() {
  TrunkShape shape;
  shape.relief = ReliefSettings{.spine = 0, .ribs = 0, .scapulae = 0};
  shape.asymmetry = 0;
  return shape;
}

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
  static const TrunkField field;
  constexpr double kOutsideMm = 18;  // as in trunk.cpp: fat fills small hollows
  TrunkShape fatter;
  fatter.body_mass_index += 1;
  TrunkShape stronger;
  stronger.muscle += 1;
  return {.fitted = fitted,
          .normal = normal,
          .outward = field.at(fitted + kOutsideMm * normal).gradient.normalized(),
          .fat = softTissueGrowth(fatter, fitted),
          .muscle = softTissueGrowth(stronger, fitted),
          .depth_mm = depth_mm};
}

TemplateBody::TemplateBody() {
  Trunk trunk =
      makeTrunk({.triangles = kTemplateTriangles, .bone_triangles = kTemplateBoneTriangles, .shape = plainShape()});
  const std::vector<Vec3> normals = mesh::vertexNormals(trunk.skin);
  for (std::size_t v = 0; v < trunk.skin.positions.size(); ++v) {
    skin_.push_back(placeOf(trunk.skin.positions[v], normals[v], trunk.depth_mm[v]));
  }
  std::vector<Vec3> points;
  for (const SkinLandmark& landmark : trunk.landmarks) points.push_back(landmark.position);
  const BoneDepth depth = depthToBones(points, trunk.bones);
  for (std::size_t i = 0; i < points.size(); ++i) {
    on_landmarks_.push_back(placeOf(points[i], trunk.landmarks[i].normal, depth.depth_mm[i]));
  }
  triangles_ = std::move(trunk.skin.triangles);
  landmarks_ = std::move(trunk.landmarks);
  for (const Triangle& t : triangles_) {
    is_stump_.push_back(onStump((skin_[t[0]].fitted + skin_[t[1]].fitted + skin_[t[2]].fitted) / 3.0));
  }
}

TemplateBody::Shaped TemplateBody::shaped(const TrunkShape& shape) const {
  const BodyWarp warp(shape);
  const double mass = shape.body_mass_index - kFittedMassIndex;
  const double muscle = shape.muscle - 1;
  const auto at = [&](const Place& place) {
    const double out = keptOffBone(mass * place.fat + muscle * place.muscle, place.depth_mm);
    return warp(place.fitted + out * (out > 0 ? place.outward : place.normal));
  };
  Shaped result;
  result.skin.reserve(skin_.size());
  for (const Place& place : skin_) result.skin.push_back(at(place));
  for (const Place& place : on_landmarks_) result.landmarks.push_back(at(place));
  return result;
}

}  // namespace palpate::body
