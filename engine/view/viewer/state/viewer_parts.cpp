#include "view/viewer/state/viewer_parts.h"

#include <algorithm>

#include "palpate/base/language.h"
#include "palpate/body/torso.h"
#include "palpate/body/trunk/trunk.h"
#include "palpate/scene/world.h"

namespace palpate::viewer {

namespace {

/// The engine's name of the body, in the language of the window; a mesh is named by its file.
std::string nameOf(const scene::World& world) {
  const scene::BodySettings& body = world.scene.body;
  const auto triangles = [&](std::size_t by_itself) { return body.triangles != 0 ? body.triangles : by_itself; };
  switch (body.kind) {
    case scene::BodyKind::trunk:
      return trf("built-in trunk, {} triangles with bones", triangles(body::TrunkSettings().triangles));
    case scene::BodyKind::torso:
      return trf("built-in torso, {} triangles with bones", triangles(body::TorsoSettings().triangles));
    case scene::BodyKind::back:
      return trf("built-in back, {} triangles over {} bones", triangles(body::kDissertationBackTriangles),
                 world.body->anatomy.bones.size());
    case scene::BodyKind::mesh:
      break;
  }
  return world.body->name;
}

}  // namespace

WorldFacts collectWorldFacts(const scene::World& world) {
  const Vec3 size = mesh::boundingBox(world.body->skin).sizes();
  const auto [soft, stiff] =
      std::minmax_element(world.surface.stiffness_n_per_mm->begin(), world.surface.stiffness_n_per_mm->end());
  return {.name = nameOf(world),
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
          .tissue = scene::describe(world.tissue),
          .landmarks = world.body->anatomy.landmarks};
}

}  // namespace palpate::viewer
