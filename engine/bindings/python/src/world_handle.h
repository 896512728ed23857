// The World of Python: the engine's, and for one made of a mesh the map of its vertices. Immutable, shared by any
// number of threads; objects made on it keep it alive.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "palpate/base/skin_place.h"
#include "palpate/contact/finger.h"
#include "palpate/engine/felt_pressure.h"
#include "palpate/scene/world.h"

namespace palpate::python {

/// A mesh as passed in, to be pickled.
struct GivenMesh {
  mesh::TriangleMesh mesh;
  std::vector<double> stiffness;  ///< N/mm, one per vertex; empty: the scene's
  scene::Scene scene;
  bool repair = true;
  std::vector<std::string> file_notes;  ///< passed over or guessed while it was read
};

/// The maps of engine::WorldFromArrays.
struct SourceMaps {
  GivenMesh given;
  std::vector<Index> source_vertex;
  std::vector<Index> source_triangle;
  std::vector<Index> built_vertex;
  std::vector<Index> built_triangle;
};

struct WorldHandle {
  std::shared_ptr<const scene::World> world;
  std::shared_ptr<const SourceMaps> maps = nullptr;  ///< null where the body was not given as a mesh
  /// Made on first use (bind_pressure.cpp), with the interpreter's lock held.
  mutable std::shared_ptr<const engine::FeltPressure> pressure = nullptr;
};
using WorldPointer = std::shared_ptr<WorldHandle>;

// Functions shared by the makers of World and the reader of pickles. All release the interpreter's lock, throw Error.
WorldPointer worldOfScene(const scene::Scene& scene);
WorldPointer worldOfMesh(GivenMesh given);
/// The same body under another scene, whose body is not looked at.
WorldPointer worldUnder(const WorldHandle& self, scene::Scene scene);

/// The constructor's parameters, by name.
py::dict numbersOf(const contact::FingerSettings& settings);
py::dict numbersOf(const scene::LumpSettings& lump);

struct MaybeSettingsName {
  static constexpr auto name =
      py::detail::const_name("Optional[Union[palpate._core.FingerSettings, Sequence[palpate._core.FingerSettings]]]");
};
using MaybeSettings = Named<MaybeSettingsName>;
struct TouchesName {
  static constexpr auto name = py::detail::const_name("Union[palpate._core.Touch, Iterable[palpate._core.Touch]]");
};
using Touches = Named<TouchesName>;

/// The place of the skin at rest at a name ("T6 right 30 mm") or nearest to a point, with the normal and the number of
/// its triangle. Throws Error for an unknown name.
SkinPlace placeOn(const scene::World& world, py::handle place);

/// Settings of each finger: the scene's for None, one for all, or a sequence with one each. Checked against the world;
/// throws Error.
std::vector<contact::FingerSettings> settingsOf(const scene::World& world, py::handle settings, std::size_t fingers);

/// The outputs of fingers: a Touch or a sequence of them. Throws TypeError.
std::vector<contact::FingerOutput> asTouches(py::handle touches);

}  // namespace palpate::python
