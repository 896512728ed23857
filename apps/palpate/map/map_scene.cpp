// The numbers are the built world's own: nothing is computed a second time, so a map shows what a finger feels.
#include "apps/palpate/map/map_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "figures/plot.h"
#include "palpate/base/error.h"

namespace palpate::app {

namespace {

MapKey drawnDysfunction(const maps::Dysfunction& dysfunction) {
  const Vec2 at(dysfunction.x_mm, dysfunction.y_mm);
  return {fmt::format("{:+.3g} %", dysfunction.change_percent), at,
          figures::ellipseOutline(at, dysfunction.radius_mm, dysfunction.radius_mm, 0.0)};
}

nlohmann::ordered_json dysfunctionsJson(const scene::Scene& scene) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const maps::Dysfunction& one : scene.dysfunctions) {
    list.push_back({{"x_mm", one.x_mm},
                    {"y_mm", one.y_mm},
                    {"radius_mm", one.radius_mm},
                    {"change_percent", one.change_percent},
                    {"edge_softness", one.edge_softness}});
  }
  return list;
}

/// What every map of a scene says of it.
SkinMap inScene(SkinMap map, const scene::World& world) {
  map.note = "Scene: " + world.scene.title;
  map.summary["scene"] = world.scene.title;
  map.summary["dysfunctions"] = dysfunctionsJson(world.scene);
  for (const maps::Dysfunction& one : world.scene.dysfunctions) map.dysfunctions.push_back(drawnDysfunction(one));
  if (!world.notes.empty()) map.summary["notes"] = world.notes;
  return map;
}

/// Of the map as it was built: out of reach of every key point it is its basic circle.
maps::EllipseMapSettings settingsOf(const scene::World& world) {
  constexpr double kOutOfReachMm = 1e9;
  maps::EllipseMapSettings settings = world.scene.ellipses.map;
  constexpr double kDigits = 1e9;  // it went through a logarithm: 100 mm came back as 100.00000000000004
  settings.basic_radius_mm =
      std::round(kDigits * world.ellipses.at(kOutOfReachMm, kOutOfReachMm).half_major_mm) / kDigits;
  return settings;
}

}  // namespace

MapSkin skinOfScene(const scene::World& world) {
  return {world.body_name, world.skin, mesh::vertexNormals(world.skin), world.anatomy.depth_mm};
}

SkinMap stiffnessOfScene(const MapSkin& skin, const scene::World& world) {
  SkinMap map = stiffnessOver(skin, world.stiffness_n_per_mm);
  if (world.scene.stiffness.source == scene::StiffnessSource::points) {
    map.keys = drawnKeys(world.ellipses.keys());
    for (MapKey& key : map.keys) key.outline.clear();  // their ellipses say nothing about stiffness
  }
  return inScene(std::move(map), world);
}

SkinMap depthOfScene(const MapSkin& skin, const scene::World& world) { return inScene(depthOver(skin), world); }

SkinMap ellipsesOfScene(const MapSkin& skin, const scene::World& world, const std::string& quantity) {
  return inScene(ellipsesOver(skin, world.ellipses, settingsOf(world), quantity), world);
}

}  // namespace palpate::app
