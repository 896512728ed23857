// Outline in the plane -> exact number of triangles -> lifted onto the smooth skin: skin_outline.h, outline_mesher.h,
// skin_surface.h. The bones are made only where their relief is wanted.
#include "palpate/body/back.h"

#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/body/bones.h"

namespace palpate::body {

namespace {

void check(const SkinSettings& settings) {
  if (!(settings.stature_mm >= 300 && settings.stature_mm <= 3000)) throw Error("stature must be 300 to 3000 mm");
  for (const double factor :
       {settings.relief.spine, settings.relief.ribs, settings.relief.scapulae, settings.asymmetry}) {
    // Beyond 5 the skin would fold over itself.
    if (!(factor >= 0 && factor <= 5)) throw Error("relief and asymmetry factors must be 0 to 5");
  }
  const ReliefSettings& relief = settings.relief;
  for (const LevelWeights* weights : {&relief.spine_level, &relief.rib_level, &relief.scapula_level}) {
    for (const double weight : *weights) {
      if (!(weight >= 0 && weight <= 5)) throw Error("relief weights of the levels must be 0 to 5");
    }
  }
}

}  // namespace

SkinSurface makeSkinSurface(const SkinSettings& settings) {
  check(settings);
  const std::vector<Bone> bones =
      settings.relief.any() ? makeBones({.triangles = kReliefBoneTriangles, .warp = {}}) : std::vector<Bone>{};
  return makeSkinSurface(settings, bones);
}

SkinSurface makeSkinSurface(const SkinSettings& settings, std::span<const Bone> bones) {
  check(settings);
  BicubicSpline detail;
  if (settings.relief.any() || settings.asymmetry != 0) detail = skinDetail(bones, settings.relief, settings.asymmetry);
  return {settings.stature_mm, std::move(detail), {.amount = settings.asymmetry}};
}

Skin meshSkin(const SkinSurface& surface, SkinExtent extent, std::size_t triangles) {
  const auto lift = [&](const Vec2& flat) { return surface.at(placeOfFlat(flat)).position; };
  FlatMesh flat = meshOutline(skinOutline(extent), triangles, lift);
  Skin skin;
  skin.border = flat.border;
  skin.mesh.triangles = std::move(flat.triangles);
  skin.mesh.positions.reserve(flat.points.size());
  skin.normals.reserve(flat.points.size());
  for (const Vec2& point : flat.points) {
    const SkinPoint lifted = surface.at(placeOfFlat(point));
    skin.mesh.positions.push_back(lifted.position);
    skin.normals.push_back(lifted.normal);
  }
  return skin;
}

Skin makeBackSkin(const BackSettings& settings) {
  return meshSkin(makeSkinSurface(settings.shape), SkinExtent::patch, settings.triangles);
}

mesh::TriangleMesh makeBack(const BackSettings& settings) { return makeBackSkin(settings).mesh; }

}  // namespace palpate::body
