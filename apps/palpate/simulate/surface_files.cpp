#include "apps/palpate/simulate/surface_files.h"

#include "palpate/deform/strain.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/skin_contact.h"

namespace palpate::app {

namespace {

mesh::TriangleMesh deformedMesh(const scene::World& world, const deform::DeformedSurface& surface) {
  mesh::TriangleMesh mesh{std::vector<Vec3>(surface.vertices()), world.skin.triangles};
  for (Index v = 0; v < surface.vertices(); ++v) mesh.positions[v] = surface.positionAt(v).cast<double>();
  return mesh;
}

mesh::VertexChannels channelsOf(const scene::World& world, const deform::DeformedSurface& surface) {
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
    channels.scalars[5].values.push_back(static_cast<float>(world.stiffness_n_per_mm[v]));
  }
  channels.colours.resize(surface.vertices());
  const double range = world.scene.strain.range_percent / 100.0;
  deform::colourByStrain(surface.strain(), static_cast<float>(range), channels.colours);
  return channels;
}

}  // namespace

std::vector<deform::Contact> contactsOf(const scene::World& world, const Frame& frame) {
  std::vector<deform::Contact> contacts;
  for (const trace::Sample& sample : frame) {
    const auto contact = scene::contactOf(world, sample.contact);
    if (contact) contacts.push_back(*contact);
  }
  return contacts;
}

deform::FormSettings formsForDisplay(const scene::World& world, std::size_t fingers) {
  deform::FormSettings forms = world.deformation;
  forms.common.strain = true;
  forms.common.max_contacts = std::max(forms.common.max_contacts, fingers);
  return forms;
}

void writeSurface(const std::filesystem::path& file, const scene::World& world, const Frame& frame) {
  deform::AnyDeformer deformer(world.deformable, formsForDisplay(world, frame.size()));
  deform::DeformedSurface surface(world.deformable);
  deformer.apply(contactsOf(world, frame), surface);
  mesh::save(file, deformedMesh(world, surface), channelsOf(world, surface));
}

}  // namespace palpate::app
