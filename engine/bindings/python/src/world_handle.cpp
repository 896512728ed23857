// Places by name or point, settings and touches out of Python's hands.
#include "world_handle.h"

#include <fmt/format.h>

#include "palpate/engine/fingers.h"
#include "palpate/engine/skin_place.h"

namespace palpate::python {

SkinPlace placeOn(const scene::World& world, py::handle place) {
  if (py::isinstance<py::str>(place)) return engine::skinPlace(world, place.cast<std::string>());
  const Vec3 point = asPoint(place, "place");
  if (!mesh::isUsable(point)) throw py::value_error("place: expected three finite numbers");
  const SkinPlace nearest = engine::nearestOnSkin(world, point);
  if (nearest.triangle == kNoIndex) throw py::value_error("place: too far from the body");
  return nearest;
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
      throw py::value_error(
          fmt::format("settings: {} given for {} fingers; expected one per finger", all.size(), fingers));
    }
  } else {
    throw py::type_error("settings: expected a FingerSettings, a sequence of them, or None");
  }
  engine::checkFingers(world, all);
  return all;
}

std::vector<contact::FingerOutput> asTouches(py::handle touches) {
  if (py::isinstance<contact::FingerOutput>(touches)) return {touches.cast<const contact::FingerOutput&>()};
  std::vector<contact::FingerOutput> all;
  try {
    for (const py::handle touch : py::reinterpret_borrow<py::object>(touches)) {
      all.push_back(touch.cast<const contact::FingerOutput&>());
    }
  } catch (const py::cast_error&) {
    throw py::type_error("touches: expected a Touch or a sequence of them");
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError)) throw;
    throw py::type_error("touches: expected a Touch or a sequence of them");
  }
  return all;
}

}  // namespace palpate::python
