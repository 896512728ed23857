// The named places of the body, attached to the skin so that they move with it, and which of them an eye sees.
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

/// In order of priority: the last kinds go first where space is short.
enum class NameKind : std::uint8_t { muscle, spine, girdle, site, rib };

struct BodyName {
  std::string words;  ///< in an examiner's terms (body/places.h)
  NameKind kind = NameKind::girdle;
  Index triangle = 0;  ///< in the skin; the place keeps these shares of its corners
  Vec3 shares = Vec3::Zero();
};

BodyName nameAt(const scene::World& world, std::string words, NameKind kind, const SkinPlace& place);

/// The landmarks and the training sites; none on a body without. Load time: a query of the tree for each.
std::vector<BodyName> bodyNames(const scene::World& world);

/// Its present place on the skin, mm; `lift_mm`: how far the breath has moved the body.
Vec3 placeOf(const BodyName& name, const scene::World& world, const deform::DeformedSurface& surface,
             double lift_mm = 0.0);

/// Those on skin that faces the eye and that no other skin at rest hides, in the order of the names. Some microseconds
/// per name.
std::vector<const BodyName*> namesSeen(std::span<const BodyName> names, const scene::World& world, const Vec3& eye);

}  // namespace palpate::view
