#include "view/viewer/state/viewer_parts.h"

#include <algorithm>

#include "palpate/scene/world.h"

namespace palpate::viewer {

WorldFacts factsOf(const scene::World& world) {
  const Vec3 size = mesh::boundingBox(world.body->skin).sizes();
  const auto [soft, stiff] =
      std::minmax_element(world.surface.stiffness_n_per_mm->begin(), world.surface.stiffness_n_per_mm->end());
  return {.name = world.body->name,
          .triangles = world.body->skin.triangles.size(),
          .vertices = world.body->skin.positions.size(),
          .width_mm = size.x(),
          .height_mm = size.y(),
          .depth_mm = size.z(),
          .closed = world.body->closed,
          .has_bones = !world.body->anatomy.bones.empty(),
          .softest_n_per_mm = *soft,
          .stiffest_n_per_mm = *stiff,
          .notes = world.notes,
          .has_picture = world.body->texture != nullptr,
          .channels = world.body->channels,
          .tissue = scene::inWords(world.tissue),
          .landmarks = world.body->anatomy.landmarks};
}

}  // namespace palpate::viewer
