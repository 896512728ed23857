// The numbers are the built world's own: nothing is computed a second time, so a map shows what a finger feels.
#include "report/map/map_sources.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/scene/skin_contact.h"
#include "report/charts/plot.h"

namespace palpate::app {

namespace {

MapKey drawnDysfunction(const maps::Dysfunction& dysfunction) {
  const Vec2 at(dysfunction.x_mm, dysfunction.y_mm);
  return {fmt::format("{:+.3g} %", dysfunction.change_percent), at,
          figures::ellipseOutline(at, dysfunction.radius_mm, dysfunction.radius_mm, 0.0)};
}

Json dysfunctionsJson(const scene::Scene& scene) {
  Json list = Json::array();
  for (const maps::Dysfunction& one : scene.dysfunctions) {
    list.push_back({{"x_mm", one.x_mm},
                    {"y_mm", one.y_mm},
                    {"radius_mm", one.radius_mm},
                    {"change_percent", one.change_percent},
                    {"edge_softness", one.edge_softness}});
  }
  return list;
}

/// Labels a map with its scene.
SkinMap inScene(SkinMap map, const scene::World& world) {
  map.note = "Scene: " + world.scene.title;
  map.summary["scene"] = world.scene.title;
  map.summary["dysfunctions"] = dysfunctionsJson(world.scene);
  for (const maps::Dysfunction& one : world.scene.dysfunctions) map.dysfunctions.push_back(drawnDysfunction(one));
  if (!world.notes.empty()) map.summary["notes"] = world.notes;
  return map;
}

/// The settings of the map as built: out of reach of every key point it is its basic circle.
maps::EllipseMapSettings settingsOf(const scene::World& world) {
  constexpr double kOutOfReachMm = 1e9;
  maps::EllipseMapSettings settings = world.scene.ellipses.map;
  constexpr double kDigits = 1e9;  // it went through a logarithm: 100 mm came back as 100.00000000000004
  settings.basic_radius_mm =
      std::round(kDigits * world.ellipses.at(kOutOfReachMm, kOutOfReachMm).half_major_mm) / kDigits;
  return settings;
}

/// The boundary of a drag up the spine at each vertex.
std::vector<maps::PolarContour> contoursAtVertices(const MapSkin& skin, const scene::World& world) {
  std::vector<maps::PolarContour> contours(skin.mesh.positions.size());
  for (Index triangle = 0; triangle < skin.mesh.triangles.size(); ++triangle) {
    for (const Index v : skin.mesh.triangles[triangle]) {
      if (contours[v].count > 0) continue;
      contact::FingerOutput finger;
      finger.triangle = finger.anchor_triangle = triangle;
      finger.anchor = skin.mesh.positions[v];
      finger.proxy = finger.anchor + Vec3::UnitY();
      finger.normal = skin.normals[v];
      finger.touch = contact::Touch::stick;
      const std::optional<deform::Contact> contact = scene::contactOf(world, finger);
      if (contact) contours[v] = contact->tangential_contour.contour;
    }
  }
  return contours;
}

double meanRadius(const maps::PolarContour& contour) {
  double sum = 0.0;
  for (std::size_t i = 0; i < contour.count; ++i) sum += contour.log_radii[i];
  return contour.count > 0 ? std::exp(sum / static_cast<double>(contour.count)) : 0.0;
}

}  // namespace

MapSkin skinOfScene(const scene::World& world) {
  return {world.body->name, world.body->skin, mesh::vertexNormals(world.body->skin), world.body->anatomy.depth_mm};
}

SkinMap stiffnessOfScene(const MapSkin& skin, const scene::World& world) {
  SkinMap map = makeStiffnessMap(skin, *world.surface.stiffness_n_per_mm);
  if (world.scene.stiffness.source == scene::StiffnessSource::points) {
    map.keys = drawnKeys(world.ellipses.keys());
    for (MapKey& key : map.keys) key.outline.clear();  // their ellipses do not show stiffness
  }
  return inScene(std::move(map), world);
}

SkinMap depthOfScene(const MapSkin& skin, const scene::World& world) { return inScene(depthOver(skin), world); }

SkinMap ellipsesOfScene(const MapSkin& skin, const scene::World& world, const std::string& quantity) {
  return inScene(ellipsesOver(skin, world.ellipses, settingsOf(world), quantity), world);
}

SkinMap contoursOfScene(const MapSkin& skin, const scene::World& world) {
  if (world.deformation.shape != deform::Shape::contour) {
    throw Error("map contours: the scene's drags have ellipses; set [deformation] shape = \"contour\"");
  }
  constexpr int kDirections = 12;
  SkinMap map;
  map.title = "Boundary of a drag: mean radius";
  map.shown = {.column = "mean_radius_mm", .label = "mean radius of the contour", .unit = "mm"};
  map.vertices.push_back({"mean_radius_mm", {}});
  for (int i = 0; i < kDirections; ++i) map.vertices.push_back({fmt::format("r{}_mm", i), {}});
  for (const maps::PolarContour& contour : contoursAtVertices(skin, world)) {
    map.vertices[0].values.push_back(meanRadius(contour));
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kDirections;
      map.vertices[static_cast<std::size_t>(i) + 1].values.push_back(maps::radiusAt(contour, angle));
    }
  }
  map.summary = {{"map", "contours"}, {"radii", kDirections}};
  return inScene(std::move(map), world);
}

}  // namespace palpate::app
