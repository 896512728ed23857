#include "picture_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "arrays.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

std::string text(py::handle value, const char* key) {
  if (!py::isinstance<py::str>(value)) throw py::type_error(fmt::format("{}: a word is wanted", key));
  return value.cast<std::string>();
}

template <class Value>
Value word(py::handle value, const char* key) {
  const std::string name = text(value, key);
  if (const auto found = valueNamed<Value>(name)) return *found;
  throw py::value_error(std::string(key) + ": " + unknownName("word", name, "", wordList<Value>()));
}

double number(py::handle value, const char* key, double least, double most) {
  const double given = py::float_(py::reinterpret_borrow<py::object>(value));
  if (given >= least && given <= most) return given;
  throw py::value_error(fmt::format("{} = {:g} is out of range: {:g} to {:g}", key, given, least, most));
}

bool truth(py::handle value) { return py::bool_(py::reinterpret_borrow<py::object>(value)); }

/// One word or several.
std::vector<scene::Overlay> overlays(py::handle value, const char* key) {
  if (py::isinstance<py::str>(value)) return {word<scene::Overlay>(value, key)};
  std::vector<scene::Overlay> all;
  for (const py::handle one : py::reinterpret_borrow<py::object>(value)) all.push_back(word<scene::Overlay>(one, key));
  return all;
}

Vec2 range(py::handle value, const char* key) {
  const auto ends = floatsOf(value, key);
  if (ends.ndim() != 1 || ends.size() != 2 || !(ends.at(0) < ends.at(1))) {
    throw py::value_error(std::string(key) + ": two rising numbers are wanted");
  }
  return {ends.at(0), ends.at(1)};
}

struct Option {
  const char* key;
  void (*set)(PictureOptions& options, const scene::World& world, py::handle value, const char* key);
};

constexpr std::array kOptions = {
    Option{"side",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.side = word<scene::StandardView>(v, key); }},
    Option{"yaw_deg",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.yaw_deg = number(v, key, -180, 180); }},
    Option{"pitch_deg",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.pitch_deg = number(v, key, -89, 89); }},
    Option{"zoom", [](auto& o, const auto&, py::handle v, auto* key) { o.view.zoom = number(v, key, 0.01, 1000); }},
    Option{"distance_mm",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.distance_mm = number(v, key, 0, 1e6); }},
    Option{"look_at",
           [](auto& o, const auto& world, py::handle v, auto*) { o.view.look_at_mm = placeOn(world, v).point; }},
    Option{"colours",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.colours = word<scene::Colouring>(v, key); }},
    Option{"show", [](auto& o, const auto&, py::handle v, auto* key) { o.view.show = overlays(v, key); }},
    Option{"shading",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.shading = word<scene::Shading>(v, key); }},
    Option{"opacity", [](auto& o, const auto&, py::handle v, auto* key) { o.view.opacity = number(v, key, 0, 1); }},
    Option{"skin_tone", [](auto& o, const auto&, py::handle v, auto* key) { o.view.skin_tone = number(v, key, 1, 6); }},
    Option{"dent_contrast",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.dent_contrast = number(v, key, 0, 10); }},
    Option{"finger",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.finger = word<scene::FingerShape>(v, key); }},
    Option{"stereo",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.stereo = word<scene::StereoMode>(v, key); }},
    Option{"stiffness_range",
           [](auto& o, const auto&, py::handle v, auto* key) { o.view.stiffness_range_n_per_mm = range(v, key); }},
    Option{"scalar", [](auto& o, const auto&, py::handle v, auto* key) { o.view.scalar = text(v, key); }},
    Option{"white_background", [](auto& o, const auto&, py::handle v, auto*) { o.view.white_background = truth(v); }},
    Option{"labels", [](auto& o, const auto&, py::handle v, auto*) { o.labels = truth(v); }},
    Option{"title", [](auto& o, const auto&, py::handle v, auto* key) { o.title = text(v, key); }},
    Option{"radius_mm", [](auto& o, const auto&, py::handle v, auto* key) { o.radius_mm = number(v, key, 0, 1000); }},
};

}  // namespace

PictureOptions pictureOptions(const scene::World& world, const py::dict& options) {
  PictureOptions all;
  all.view = world.scene.view;
  for (const auto& [key, value] : options) {
    const auto name = key.cast<std::string>();
    const auto option =
        std::find_if(kOptions.begin(), kOptions.end(), [&](const Option& one) { return one.key == name; });
    if (option == kOptions.end()) {
      std::vector<std::string> known;
      for (const Option& one : kOptions) known.emplace_back(one.key);
      throw py::value_error(unknownName("option", name, "", known));
    }
    if (!value.is_none()) option->set(all, world, value, option->key);
  }
  return all;
}

}  // namespace palpate::python
