// The places of a body that have a name, tied to the skin so that they go where it goes, and which of them an eye sees.
//
//   World::anatomy.landmarks ─ bodyNames ─► BodyName ─ namesSeen, each picture ─► SeenName ─ nameColumns ─► plates
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "palpate/base/skin_place.h"
#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"

namespace palpate::view {

/// Those that come first are the last to go where there is no room for all.
enum class NameKind : std::uint8_t { muscle, spine, girdle, site, rib };

struct BodyName {
  std::string words;  ///< as examiners say it (body/places.h)
  NameKind kind = NameKind::girdle;
  Index triangle = 0;  ///< of the skin; the place keeps these shares of its corners
  Vec3 shares = Vec3::Zero();
};

BodyName nameAt(const scene::World& world, std::string words, NameKind kind, const SkinPlace& place);

/// Of the landmarks and the training sites; none on a body without. Load time: a question to the tree for each.
std::vector<BodyName> bodyNames(const scene::World& world);

/// Where it is on the skin as it is now, mm; `lift_mm`: how far the breath has moved the body.
Vec3 placeOf(const BodyName& name, const scene::World& world, const deform::DeformedSurface& surface,
             double lift_mm = 0.0);

/// Those on skin that faces the eye and that no other skin at rest hides, in the order of the names. Some microseconds
/// a name.
std::vector<const BodyName*> namesSeen(std::span<const BodyName> names, const scene::World& world, const Vec3& eye);

}  // namespace palpate::view
