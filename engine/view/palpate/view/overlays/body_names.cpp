// A landmark goes to the nearest triangle of the skin at rest and keeps its shares there. The tree decides visibility,
// by a segment from the eye to a little above the place: a dent uncovers nothing, so rest is good enough.
#include "palpate/view/overlays/body_names.h"

#include <array>
#include <string_view>
#include <utility>

#include "palpate/body/places.h"
#include "palpate/tree/triangle_tree.h"
#include "palpate/view/overlays/place_words.h"
#include "palpate/view/skin_place.h"

namespace palpate::view {

namespace {

/// Landmarks farther from the skin belong to another skin: a mesh may be a part of a body.
constexpr double kFarthestFromSkinMm = 25.0;
/// Cosine of the steepest skin that still shows a dot.
constexpr double kMinFacing = 0.12;
constexpr double kAboveSkinMm = 1.0;

NameKind classifyName(std::string_view landmark) {
  if (landmark.starts_with("spinous_") || landmark.starts_with("sacrum_") || landmark == "coccyx_tip")
    return NameKind::spine;
  const bool rib = landmark.starts_with("rib_") || landmark.starts_with("costochondral_");
  return rib ? NameKind::rib : NameKind::girdle;
}

std::array<Vec3, 3> restCorners(const scene::World& world, Index triangle) {
  const Triangle& t = world.body->skin.triangles[triangle];
  return {world.body->skin.positions[t[0]], world.body->skin.positions[t[1]], world.body->skin.positions[t[2]]};
}

Vec3 restTriangleNormal(const std::array<Vec3, 3>& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
}

}  // namespace

BodyName nameAt(const scene::World& world, std::string words, NameKind kind, const SkinPlace& place) {
  return {std::move(words), kind, place.triangle,
          tree::barycentricWeights(restCorners(world, place.triangle), place.point)};
}

std::vector<BodyName> bodyNames(const scene::World& world) {
  const auto& landmarks = world.body->anatomy.landmarks;
  std::vector<BodyName> names;
  for (const body::SkinLandmark& mark : landmarks) {
    const SkinPlace place = nearestOnSkin(world, mark.position);
    if ((place.point - mark.position).norm() > kFarthestFromSkinMm) continue;
    names.push_back(nameAt(world, placeInLanguage(body::spokenName(mark.name)), classifyName(mark.name), place));
  }
  const std::vector<std::string> all = body::placeNames(landmarks);
  for (std::size_t site = landmarks.size(); site < all.size(); ++site) {  // they follow the landmarks
    names.push_back(nameAt(world, placeInLanguage(all[site]), NameKind::site, skinPlace(world, all[site])));
  }
  return names;
}

Vec3 placeOf(const BodyName& name, const scene::World& world, const deform::DeformedSurface& surface, double lift_mm) {
  Vec3 place = Vec3::Zero();
  for (int corner = 0; corner < 3; ++corner) {
    place += name.shares[corner] * surface.placeAt(world.body->skin.triangles[name.triangle][corner]);
  }
  if (world.breath) place.z() += lift_mm * world.breath->share(place);
  return place;
}

std::vector<const BodyName*> namesSeen(std::span<const BodyName> names, const scene::World& world, const Vec3& eye) {
  std::vector<const BodyName*> seen;
  for (const BodyName& name : names) {
    const auto corners = restCorners(world, name.triangle);
    const Vec3 place = name.shares[0] * corners[0] + name.shares[1] * corners[1] + name.shares[2] * corners[2];
    const Vec3 normal = restTriangleNormal(corners);
    if (!(normal.dot((eye - place).normalized()) > kMinFacing)) continue;
    const auto skin = tree::firstFrontCrossing(world.surface.geometry->tree, eye, place + kAboveSkinMm * normal);
    if (skin.triangle == kNoIndex) seen.push_back(&name);
  }
  return seen;
}

}  // namespace palpate::view
