#include "view/viewer/state/session_parts.h"

#include <algorithm>

#include "palpate/scene/world.h"

namespace palpate::viewer {

WorldFacts factsOf(const scene::World& world) {
  const Vec3 size = mesh::boundingBox(world.skin).sizes();
  const auto [soft, stiff] = std::minmax_element(world.stiffness_n_per_mm.begin(), world.stiffness_n_per_mm.end());
  return {.name = world.body_name,
          .triangles = world.skin.triangles.size(),
          .vertices = world.skin.positions.size(),
          .width_mm = size.x(),
          .height_mm = size.y(),
          .depth_mm = size.z(),
          .closed = world.closed,
          .has_bones = !world.anatomy.bones.empty(),
          .softest_n_per_mm = *soft,
          .stiffest_n_per_mm = *stiff,
          .notes = world.notes,
          .has_picture = world.texture != nullptr,
          .channels = world.channels,
          .tissue = scene::inWords(world.tissue),
          .has_names = !world.anatomy.landmarks.empty()};
}

}  // namespace palpate::viewer
