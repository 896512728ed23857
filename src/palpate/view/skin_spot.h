// A place of the skin that moves with it: a triangle and the weights of its corners.
#pragma once

#include <optional>

#include "palpate/contact/surface.h"
#include "palpate/view/drawn_skin.h"

namespace palpate::view {

struct SkinSpot {
  Triangle vertices{};
  Vec3f weights = Vec3f::Zero();
};

/// Where a segment first enters the skin at rest.
std::optional<SkinSpot> spotBetween(const contact::Surface& surface, const Vec3& from, const Vec3& to);

inline Vec3 placeOf(const SkinSpot& spot, const DrawnSkin& skin) {
  Vec3 place = Vec3::Zero();
  for (int i = 0; i < 3; ++i) place += static_cast<double>(spot.weights[i]) * skin.at(spot.vertices[i]);
  return place;
}

}  // namespace palpate::view
