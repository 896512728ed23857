#include "view/viewer/state/vertex_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "palpate/body/places.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/view/scene_view.h"

namespace palpate::viewer {

namespace {

/// Tests all: 2 ms for a million, once a click.
Index nearestVertex(const std::vector<Vec3>& positions, const Vec3& place) {
  const auto nearer = [&](const Vec3& a, const Vec3& b) {
    return (a - place).squaredNorm() < (b - place).squaredNorm();
  };
  return static_cast<Index>(std::min_element(positions.begin(), positions.end(), nearer) - positions.begin());
}

}  // namespace

VertexReading readVertex(const scene::World& world, const Vec3& place) {
  VertexReading reading;
  const Index v = reading.vertex = nearestVertex(world.body->skin.positions, place);
  reading.place = world.body->skin.positions[v];
  reading.stiffness_n_per_mm = (*world.surface.stiffness_n_per_mm)[v];
  const scene::Anatomy& anatomy = world.body->anatomy;
  reading.where = body::describePlace(anatomy.landmarks, place);
  if (!anatomy.depth_mm.empty()) reading.bone_depth_mm = anatomy.depth_mm[v];
  if (!anatomy.nearest_bone.empty()) reading.bone = anatomy.bones[anatomy.nearest_bone[v]].name;
  if (!world.body->channels) return reading;
  reading.in_file = world.body->channels->source_vertex[v];
  for (const scene::SkinScalar& scalar : world.body->channels->scalars) {
    reading.scalars.push_back({scalar.name, scalar.values[v]});
  }
  return reading;
}

view::Lines vertexMark(const VertexReading& reading, const scene::World& world,
                       const deform::DeformedSurface& surface) {
  constexpr double kShareOfBody = 0.008;
  constexpr view::Paint kPaint{255, 225, 60, 255};
  view::Lines mark{2.0, {}};
  const double half_mm = kShareOfBody * mesh::boundingBox(world.body->skin).diagonal().norm();
  mark.addCross(surface.placeAt(reading.vertex), half_mm, kPaint);
  return mark;
}

std::string adoptChannels(const scene::World& world, view::Look& look) {
  const scene::SkinChannels* channels = world.body->channels.get();
  if (channels == nullptr) return {};
  const bool keeps = !look.scalar.empty() && scene::scalarNamed(channels, look.scalar) != nullptr;
  if (!keeps) view::showScalar(world, {}, look);
  std::string brings = channels->colours.empty() ? "" : tr("colours");
  if (!channels->scalars.empty()) {
    const std::string numbers = trf("numbers ({})", scene::scalarNames(channels));
    brings = brings.empty() ? numbers : fmt::format("{} {} {}", brings, tr("and"), numbers);
  }
  return brings.empty() ? brings : trf("The file has {} for its vertices: see Show", brings);
}

}  // namespace palpate::viewer
