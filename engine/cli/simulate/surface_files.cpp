#include "cli/simulate/run_recorder.h"

#include "palpate/deform/strain.h"
#include "palpate/engine/living_skin.h"
#include "palpate/mesh/files/save.h"

namespace palpate::app {

namespace {

mesh::TriangleMesh deformedMesh(const scene::World& world, const engine::LivingSkin& skin) {
  const deform::DeformedSurface& surface = skin.surface();
  mesh::TriangleMesh mesh{std::vector<Vec3>(surface.vertices()), world.body->skin.triangles};
  for (Index v = 0; v < surface.vertices(); ++v) {
    mesh.positions[v] = surface.placeAt(v);
    if (world.breath) mesh.positions[v].z() += skin.lift() * world.breath->share(world.body->skin.positions[v]);
  }
  return mesh;
}

mesh::VertexChannels buildChannels(const scene::World& world, const deform::DeformedSurface& surface) {
  mesh::VertexChannels channels;
  channels.scalars = {
      {"displacement_mm", {}}, {"displacement_x_mm", {}}, {"displacement_y_mm", {}}, {"displacement_z_mm", {}},
      {"strain", {}},          {"stiffness_n_per_mm", {}}};
  for (Index v = 0; v < surface.vertices(); ++v) {
    const Vec3f moved = surface.displacementAt(v);
    channels.scalars[0].values.push_back(moved.norm());
    for (int axis = 0; axis < 3; ++axis)
      channels.scalars[1 + static_cast<std::size_t>(axis)].values.push_back(moved[axis]);
    channels.scalars[4].values.push_back(surface.strain()[v]);
    channels.scalars[5].values.push_back(static_cast<float>((*world.surface.stiffness_n_per_mm)[v]));
  }
  channels.colours.resize(surface.vertices());
  const double range = world.scene.strain.range_percent / 100.0;
  deform::colourByStrain(surface.strain(), static_cast<float>(range), channels.colours);
  return channels;
}

}  // namespace

void writeSurface(const std::filesystem::path& file, const scene::World& world, const servo::TickSamples& frame) {
  engine::LivingSkin skin(world);
  skin.follow(frame);
  mesh::save(file, deformedMesh(world, skin), buildChannels(world, skin.surface()));
}

}  // namespace palpate::app
