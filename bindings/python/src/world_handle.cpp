// Words and points to places of the skin, as the view does it (view/skin_place.cpp), which is not linked here.
#include "world_handle.h"

#include <fmt/format.h>

#include "palpate/body/places.h"
#include "palpate/engine/fingers.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::python {

namespace {

SkinPlace onTriangle(const scene::World& world, Index record, const Vec3& point) {
  const auto& corners = world.surface.tree.records[record].corners;
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  return {point, normal, world.surface.tree.source_triangle[record]};
}

SkinPlace nearestPlace(const scene::World& world, const Vec3& point) {
  if (!mesh::isUsable(point)) throw py::value_error("place: three finite numbers are wanted");
  const auto& tree = world.surface.tree;
  const auto nearest = tree::nearestPoint(tree, point, 2.0 * tree.diagonal + (point - tree.center).norm());
  if (nearest.triangle == kNoIndex) throw py::value_error("place: absurdly far from the body");
  return onTriangle(world, nearest.triangle, nearest.closest.point);
}

SkinPlace placeInWords(const scene::World& world, const std::string& words) {
  const body::NamedPlace place = body::placeNamed(world.anatomy.landmarks, words);
  const SkinPlace nearest = nearestPlace(world, place.point);
  if (!place.moved) return nearest;
  // Moved along x and y, and back to the skin along z, on the landmark's side of the body.
  const double far = nearest.normal.z() < 0.0 ? -world.surface.tree.diagonal : world.surface.tree.diagonal;
  const Vec3 out(0.0, 0.0, far);
  const auto crossing = tree::firstFrontCrossing(world.surface.tree, place.point + out, place.point - out);
  return crossing.triangle == kNoIndex ? nearest : onTriangle(world, crossing.triangle, crossing.point);
}

}  // namespace

SkinPlace placeOn(const scene::World& world, py::handle place) {
  if (py::isinstance<py::str>(place)) return placeInWords(world, place.cast<std::string>());
  return nearestPlace(world, pointOf(place, "place"));
}

std::vector<contact::FingerSettings> settingsOf(const scene::World& world, py::handle settings, std::size_t fingers) {
  std::vector<contact::FingerSettings> all;
  if (settings.is_none()) {
    all = engine::fingerSettings(world.scene, fingers);
  } else if (py::isinstance<contact::FingerSettings>(settings)) {
    all.assign(fingers, settings.cast<contact::FingerSettings>());
  } else if (py::isinstance<py::sequence>(settings) && !py::isinstance<py::str>(settings)) {
    for (const py::handle one : settings) all.push_back(one.cast<contact::FingerSettings>());
    if (all.size() != fingers) {
      throw py::value_error(fmt::format("settings: {} given for {} fingers", all.size(), fingers));
    }
  } else {
    throw py::type_error("settings: a FingerSettings, a sequence of them, or None");
  }
  engine::checkFingers(world, all);
  return all;
}

std::vector<contact::FingerOutput> touchesOf(py::handle touches) {
  if (py::isinstance<contact::FingerOutput>(touches)) return {touches.cast<const contact::FingerOutput&>()};
  std::vector<contact::FingerOutput> all;
  try {
    for (const py::handle touch : py::reinterpret_borrow<py::object>(touches)) {
      all.push_back(touch.cast<const contact::FingerOutput&>());
    }
  } catch (const py::cast_error&) {
    throw py::type_error("touches: a Touch or a sequence of them");
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError)) throw;
    throw py::type_error("touches: a Touch or a sequence of them");
  }
  return all;
}

}  // namespace palpate::python
