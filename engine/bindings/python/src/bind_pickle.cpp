// Pickles and copies of World, FingerSettings and Lump.
//
//   World ─ text of its scene, given mesh, hash of the forces ─► bytes ─► built again, once per process ─► compared
//
// Without the hash a file that differs elsewhere would silently be felt as another body. A copy of an immutable object
// is the object itself.
#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <deque>
#include <string>
#include <utility>

#include "bindings.h"
#include "interrupts.h"
#include "palpate/base/error.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

/// Pickled worlds that stay alive in a process: a pool of workers is sent the same one again and again.
constexpr std::size_t kKeptWorlds = 4;

struct KeptWorld {
  std::string key;
  WorldPointer world;
};

/// With the interpreter's lock held. Never freed: at exit Python's own order destroys the contents.
std::deque<KeptWorld>& keptWorlds() {
  static auto& kept = *new std::deque<KeptWorld>;
  return kept;
}

py::object bytesOf(const void* data, std::size_t bytes) { return py::bytes(static_cast<const char*>(data), bytes); }

/// None for a world without a mesh.
py::object packed(const std::shared_ptr<const SourceMaps>& maps) {
  if (!maps) return py::none();
  const GivenMesh& given = maps->given;
  return py::make_tuple(bytesOf(given.mesh.positions.data(), given.mesh.positions.size() * sizeof(Vec3)),
                        bytesOf(given.mesh.triangles.data(), given.mesh.triangles.size() * sizeof(Triangle)),
                        bytesOf(given.stiffness.data(), given.stiffness.size() * sizeof(double)), given.repair,
                        scene::sceneAsToml(given.scene), given.file_notes);
}

template <class Element>
std::vector<Element> unpackElements(const py::handle& bytes) {
  const auto text = bytes.cast<std::string>();
  if (text.size() % sizeof(Element) != 0) throw Error("World: not a valid pickle of a World");
  std::vector<Element> elements(text.size() / sizeof(Element));
  std::copy(text.begin(), text.end(), reinterpret_cast<char*>(elements.data()));
  return elements;
}

GivenMesh unpacked(const py::tuple& state) {
  GivenMesh given;
  given.mesh.positions = unpackElements<Vec3>(state[0]);
  given.mesh.triangles = unpackElements<Triangle>(state[1]);
  given.stiffness = unpackElements<double>(state[2]);
  given.repair = state[3].cast<bool>();
  given.scene = scene::parse(state[4].cast<std::string>(), "World");
  given.file_notes = state[5].cast<std::vector<std::string>>();
  for (const Triangle& triangle : given.mesh.triangles) {
    for (const Index vertex : triangle) {
      if (vertex >= given.mesh.positions.size()) throw Error("World: not a valid pickle of a World");
    }
  }
  return given;
}

/// For a mesh world it leaves out the body, which no file has.
std::string textOf(const WorldHandle& handle) {
  scene::Scene scene = handle.world->scene;
  if (handle.maps) scene.body = {};
  return scene::sceneAsToml(scene);
}

py::tuple reduced(const py::object& self) {
  const auto& handle = self.cast<const WorldHandle&>();
  const py::object rebuild = py::module_::import("palpate").attr("_unpickled_world");
  return py::make_tuple(rebuild, py::make_tuple(textOf(handle), packed(handle.maps),
                                                fmt::format("{:016x}", engine::hashOf(*handle.world))));
}

WorldPointer rebuildWorld(const std::string& toml, const py::object& mesh) {
  if (mesh.is_none()) return worldOfScene(scene::parse(toml, "World"));
  const WorldPointer made = worldOfMesh(unpacked(mesh));
  if (toml == textOf(*made)) return made;
  return worldUnder(*made, scene::parse(toml, "World"));
}

WorldPointer worldOfPickle(const std::string& toml, const py::object& mesh, const std::string& hash) {
  const std::string key = hash + toml;
  std::deque<KeptWorld>& kept = keptWorlds();
  for (const KeptWorld& one : kept) {
    // One skin may have been given in several orders: the hash does not show which vertex became which.
    if (one.key == key && packed(one.world->maps).equal(mesh)) return one.world;
  }
  WorldPointer world = rebuildWorld(toml, mesh);
  if (const std::string now = fmt::format("{:016x}", engine::hashOf(*world->world)); now != hash) {
    throw Error(
        fmt::format("World: {} differs from the pickled one (hash {}, expected {}); use the same files and release",
                    world->world->body->name, now, hash));
  }
  kept.push_front({key, world});
  if (kept.size() > kKeptWorlds) kept.pop_back();
  return world;
}

/// By the names of the constructor: the result is checked again.
py::tuple makeReduceTuple(const py::object& type, const py::dict& named) {
  const py::object partial = py::module_::import("functools").attr("partial");
  return py::make_tuple(partial(type, **named), py::tuple());
}

py::object itself(const py::object& self) { return self; }
py::object deepCopySelf(const py::object& self, const py::dict& /*memo*/) { return self; }

template <class Class>
void bindCopies(Class& bound) {
  bound.def("__copy__", &itself, "Itself: it never changes.");
  bound.def("__deepcopy__", &deepCopySelf, "Itself: it never changes.", py::arg("memo"));
}

}  // namespace

void bindPickle(py::module_& module) {
  module.def("_world_of", &worldOfPickle, "Rebuilds a World from its pickle.", py::arg("toml"), py::arg("mesh"),
             py::arg("hash"));
  auto world = py::reinterpret_borrow<py::class_<WorldHandle, WorldPointer>>(module.attr("World"));
  world.def("__reduce__", &reduced,
            "Its scene as text, the mesh it was made of, and its hash; files that the scene names stay files. Read "
            "again it is built once a process. Raises palpate.Error where it would be another body.");
  bindCopies(world);
  auto settings = py::reinterpret_borrow<py::class_<contact::FingerSettings>>(module.attr("FingerSettings"));
  settings.def(
      "__reduce__",
      [](const py::object& self) {
        return makeReduceTuple(py::type::of(self), numbersOf(self.cast<const contact::FingerSettings&>()));
      },
      "As the constructor would be called.");
  bindCopies(settings);
  auto lump = py::reinterpret_borrow<py::class_<scene::LumpSettings>>(module.attr("Lump"));
  lump.def(
      "__reduce__",
      [](const py::object& self) {
        return makeReduceTuple(py::type::of(self), numbersOf(self.cast<const scene::LumpSettings&>()));
      },
      "As the constructor would be called.");
  bindCopies(lump);
}

}  // namespace palpate::python
