// World: made of a scene, of text, of a built-in body, of a mesh file or of arrays; views of its skin, and its places
// by name. Rollout is in bind_rollout.cpp.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "bindings.h"
#include "interrupts.h"
#include "palpate/base/error.h"
#include "palpate/body/places.h"
#include "palpate/engine/arrays.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/validate.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "palpate/tree/closest_on_triangle.h"
#include "palpate/tree/triangle_tree.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

struct LandmarksName {
  static constexpr auto name = py::detail::const_name("dict[str, numpy.typing.NDArray[numpy.float64]]");
};
using Landmarks = Named<LandmarksName>;
struct ManyPlacesName {
  static constexpr auto name = py::detail::const_name("Union[str, Sequence[str], numpy.typing.ArrayLike]");
};
using ManyPlaces = Named<ManyPlacesName>;

// ---- made

WorldPointer load(const std::filesystem::path& file) { return worldOfScene(scene::load(file)); }

WorldPointer parse(const std::string& toml, const std::string& name) { return worldOfScene(scene::parse(toml, name)); }

/// Limits of scene files hold here too: a pickle is such a text.
WorldPointer builtIn(scene::BodyKind kind, std::size_t triangles) {
  scene::Scene scene;
  scene.body.kind = kind;
  scene.body.triangles = triangles;
  return parse(scene::sceneAsToml(scene), "World");
}

/// Reads everything but the mesh. One stiffness is the scene's, an array has one per vertex.
GivenMesh stiffnessIn(const ArrayLike& given, const std::string& toml, const std::string& name) {
  GivenMesh result;
  result.scene = scene::parse(toml, name);
  const auto numbers = asFloats(given, "stiffness");
  if (numbers.ndim() > 1) throw py::value_error("stiffness: expected one number, or one per vertex (V,)");
  if (numbers.ndim() == 1) {
    result.stiffness.assign(numbers.data(), numbers.data() + numbers.size());
    if (result.stiffness.empty()) throw py::value_error("stiffness: expected one number, or one per vertex (V,)");
    return result;
  }
  result.scene.stiffness.source = scene::StiffnessSource::constant;
  result.scene.stiffness.constant_n_per_mm = *numbers.data();
  if (!std::isfinite(*numbers.data()) || *numbers.data() < 0.0) {
    throw py::value_error("stiffness: expected finite numbers >= 0 (N/mm)");
  }
  return result;
}

/// Throws Error with what is wrong.
void requireSound(const mesh::TriangleMesh& mesh, const Progress& progress) {
  const mesh::ValidationReport found = mesh::validate(mesh, {}, progress);
  if (found.sound()) return;
  std::string traits;
  for (const std::string& trait : mesh::describe(found)) traits += (traits.empty() ? "" : "; ") + trait;
  throw Error("arrays: not fit for contact and repair is off: " + traits);
}

/// (N, 3) of whole numbers as int64: unsigned ones would make 4,294,967,295 of -1, and mending would drop the triangle
/// in silence.
py::array_t<std::int64_t, py::array::c_style> asFaces(const ArrayLike& given) {
  const py::array any = py::array::ensure(given);
  if (!any || (any.dtype().kind() != 'i' && any.dtype().kind() != 'u')) {
    PyErr_Clear();
    throw py::type_error("faces: expected integers");
  }
  auto faces = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(any);
  if (!faces) throw py::error_already_set();
  if (faces.ndim() != 2 || faces.shape(1) != 3) throw py::value_error("faces: must be (F, 3)");
  return py::reinterpret_borrow<py::array_t<std::int64_t, py::array::c_style>>(faces);
}

WorldPointer fromArrays(const ArrayLike& vertices, const ArrayLike& faces, const ArrayLike& stiffness, bool repair,
                        const std::string& scene) {
  const auto places = asFloats(vertices, "vertices", 3);
  if (places.ndim() != 2) throw py::value_error("vertices: must be (V, 3)");
  const auto corners = asFaces(faces);
  GivenMesh given = stiffnessIn(stiffness, scene, "scene");
  given.repair = repair;
  given.mesh =
      engine::meshFromArrays(std::span<const double>(places.data(), static_cast<std::size_t>(places.size())),
                             std::span<const std::int64_t>(corners.data(), static_cast<std::size_t>(corners.size())));
  return worldOfMesh(std::move(given));
}

WorldPointer fromFile(const std::filesystem::path& file, double scale, const ArrayLike& stiffness, bool repair,
                      const std::string& scene) {
  if (!std::isfinite(scale) || scale <= 0.0) throw py::value_error("scale: expected a finite number > 0");
  GivenMesh given = stiffnessIn(stiffness, scene, "scene");
  given.repair = repair;
  mesh::MeshWithChannels loaded = unlocked([&](Interrupts& interrupts) {
    return mesh::loadWithChannels(file, {.keep_wrong_indices = repair}, interrupts.progress());
  });
  given.mesh = std::move(loaded.mesh);
  given.file_notes = std::move(loaded.notes);
  for (Vec3& position : given.mesh.positions) position *= scale;
  try {
    return worldOfMesh(std::move(given));
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
}

WorldPointer rebuiltFrom(const WorldHandle& self, const std::string& toml, const std::string& name) {
  return worldUnder(self, scene::parse(toml, name));
}

void bindMakers(py::class_<WorldHandle, WorldPointer>& world) {
  world.def_static("load", &load,
                   "A world from a scene file (docs/reference/scene-files.md). Raises palpate.Error with file and "
                   "line. Releases the GIL, like everything that builds a world; Ctrl-C interrupts.",
                   py::arg("file"));
  world.def_static("parse", &parse,
                   "A world from the text of a scene file. name: shown as the file in messages; its folder is the base "
                   "of relative file names in the text. Raises palpate.Error with name and line.",
                   py::arg("toml"), py::arg("name") = "scene");
  world.def_static(
      "torso", [](std::size_t triangles) { return builtIn(scene::BodyKind::torso, triangles); },
      "The dissertation's open back with 43 bones. triangles: number in skin and bones. Raises palpate.Error for too "
      "few. Takes 0.6 s.",
      py::kw_only(), py::arg("triangles") = body::TorsoSettings().triangles);
  world.def_static(
      "trunk", [](std::size_t triangles) { return builtIn(scene::BodyKind::trunk, triangles); },
      "The closed body from neck to thighs. triangles: number in skin and bones, even. Raises palpate.Error for too "
      "few. Takes 1 to 2 s.",
      py::kw_only(), py::arg("triangles") = body::TrunkSettings().triangles);
  world.def_static(
      "from_file", &fromFile,
      "A world from a mesh file: OBJ, STL, PLY, OFF, glTF, GLB.\n\n"
      "scale: factor on its size; files are in mm, glTF and GLB in m\n"
      "stiffness: N/mm at 1 mm depth, one number or one a vertex of the file (V,)\n"
      "repair: False refuses a mesh that is not fit instead of mending it\n"
      "scene: text of a scene file for everything else, friction, force law ...; its body is not looked "
      "at\n\nVertices and triangles change their order; source_vertex and source_triangle lead back. Raises "
      "palpate.Error naming the file.",
      py::arg("file"), py::kw_only(), py::arg("scale") = 1.0, py::arg("stiffness") = 0.5, py::arg("repair") = true,
      py::arg("scene") = "");
  world.def_static(
      "from_arrays", &fromArrays,
      "A world from vertices (V, 3), mm, and faces (F, 3) of whole numbers, counted from 0, counter-clockwise "
      "seen from outside.\n\n"
      "stiffness: N/mm at 1 mm depth, one number or one a vertex (V,)\n"
      "repair: False refuses a mesh that is not fit instead of mending it\n"
      "scene: text of a scene file for everything else; its body is not looked at\n\n"
      "Vertices and triangles change their order; source_vertex and source_triangle lead back. Raises "
      "palpate.Error naming the first wrong vertex or face, TypeError for faces that are no whole numbers, "
      "ValueError for shapes.",
      py::arg("vertices"), py::arg("faces"), py::kw_only(), py::arg("stiffness") = 0.5, py::arg("repair") = true,
      py::arg("scene") = "");
  world.def("rebuilt", &rebuiltFrom,
            "The same body with another scene's force law, stiffness, maps and friction: the same triangles in the "
            "same order, in milliseconds. toml: text of a whole scene; its [body] is ignored. Raises palpate.Error "
            "with name and line.",
            py::arg("toml"), py::arg("name") = "scene");
}

// ---- its skin

const scene::World& worldFrom(const py::object& self) { return *self.cast<const WorldHandle&>().world; }

Int32Array indexMapView(const py::object& self, std::vector<Index> SourceMaps::*map) {
  const auto& maps = self.cast<const WorldHandle&>().maps;
  if (!maps) throw Error("this World has no index maps; only worlds from from_arrays and from_file have them");
  return arrayView((*maps).*map, self);
}

void bindWorldSkin(py::class_<WorldHandle, WorldPointer>& world) {
  world.def_property_readonly(
      "positions",
      [](const py::object& self) { return FloatArray(arrayView(worldFrom(self).body->skin.positions, self)); },
      "(V, 3) vertices of the skin at rest, mm; a read-only view, like all arrays of a World.");
  world.def_property_readonly(
      "normals",
      [](const py::object& self) {
        return FloatArray(arrayView(worldFrom(self).surface.geometry->vertex_normals, self));
      },
      "(V, 3) unit vertex normals, pointing outwards, weighted by angle.");
  world.def_property_readonly(
      "triangles",
      [](const py::object& self) {
        const auto& triangles = worldFrom(self).body->skin.triangles;
        const auto* corners = reinterpret_cast<const std::int32_t*>(triangles.data());
        return Int32Array(arrayView(corners, {static_cast<py::ssize_t>(triangles.size()), 3}, self));
      },
      "(F, 3) int32: three vertices each, counter-clockwise seen from outside.");
  world.def_property_readonly(
      "stiffness",
      [](const py::object& self) {
        const auto& stiffness = *worldFrom(self).surface.stiffness_n_per_mm;
        return FloatArray(arrayView(stiffness.data(), {static_cast<py::ssize_t>(stiffness.size())}, self));
      },
      "(V,) stiffness per vertex, N/mm.");
  world.def_property_readonly(
      "source_vertex", [](const py::object& self) { return indexMapView(self, &SourceMaps::source_vertex); },
      "(V,) int32: index of the given vertex for each vertex. Raises palpate.Error unless the world was made from a "
      "mesh.");
  world.def_property_readonly(
      "source_triangle", [](const py::object& self) { return indexMapView(self, &SourceMaps::source_triangle); },
      "(F,) int32: index of the given triangle for each triangle; -1 for one made by repair. Raises like "
      "`source_vertex`.");
  world.def_property_readonly(
      "built_vertex", [](const py::object& self) { return indexMapView(self, &SourceMaps::built_vertex); },
      "Index of the world's vertex for each given vertex; -1 for one that the world lacks. Raises like "
      "`source_vertex`.");
  world.def_property_readonly(
      "built_triangle", [](const py::object& self) { return indexMapView(self, &SourceMaps::built_triangle); },
      "Index of the world's triangle for each given triangle, or -1. Raises like `source_vertex`.");
}

// ---- its places

template <Vec3 body::SkinLandmark::*Member>
Landmarks landmarksOf(const py::object& self) {
  py::dict all;
  for (const body::SkinLandmark& landmark : worldFrom(self).body->anatomy.landmarks) {
    all[landmark.name.c_str()] = arrayView((landmark.*Member).data(), {3}, self);
  }
  return {std::move(all)};
}

double stiffnessAt(const WorldHandle& self, const PlaceLike& where) {
  const scene::World& world = *self.world;
  const SkinPlace place = placeOn(world, where);
  const Triangle& corners = world.body->skin.triangles[place.triangle];
  const auto& at = world.body->skin.positions;
  const Vec3 weights = tree::barycentricWeights({at[corners[0]], at[corners[1]], at[corners[2]]}, place.point);
  double stiffness = 0.0;
  for (int i = 0; i < 3; ++i) {
    stiffness += weights[i] * (*world.surface.stiffness_n_per_mm)[corners[static_cast<std::size_t>(i)]];
  }
  return stiffness;
}

/// Points of the map plane: from names, or unchanged.
std::vector<Vec2> asMapPoints(const scene::World& world, const ManyPlaces& given) {
  std::vector<Vec2> points;
  const auto addNamed = [&](py::handle words) { points.push_back(placeOn(world, words).point.head<2>()); };
  if (py::isinstance<py::str>(given)) {
    addNamed(given);
    return points;
  }
  const bool is_list = py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given);
  if (is_list && py::len(given) > 0 && py::isinstance<py::str>(py::object(given[py::int_(0)]))) {
    for (const py::handle words : given) addNamed(words);
    return points;
  }
  const auto xy = asFloats(given, "xy", 2);
  if (xy.ndim() != 2) throw py::value_error("xy: must be (N, 2), or names");
  for (py::ssize_t i = 0; i < xy.shape(0); ++i) points.emplace_back(xy.at(i, 0), xy.at(i, 1));
  return points;
}

FloatArray ellipses(const WorldHandle& self, const ManyPlaces& given) {
  const std::vector<Vec2> points = asMapPoints(*self.world, given);
  py::array_t<double> result({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  double* to = result.mutable_data();
  for (const Vec2& point : points) {
    const maps::Ellipse ellipse = self.world->ellipses.at(point.x(), point.y());
    *to++ = ellipse.half_major_mm;
    *to++ = ellipse.half_major_mm * ellipse.aspect;
    *to++ = ellipse.direction_rad;
  }
  return {std::move(result)};
}

FloatArray tipsAt(const WorldHandle& self, const PlaceLike& where, const ArrayLike& depths) {
  const SkinPlace place = placeOn(*self.world, where);
  const auto depth = asFloats(depths, "depth_mm");
  if (depth.ndim() != 1) throw py::value_error("depth_mm: must be (T,)");
  py::array_t<double> tips({depth.shape(0), py::ssize_t{3}});
  for (py::ssize_t i = 0; i < depth.shape(0); ++i) {
    Eigen::Map<Vec3>(tips.mutable_data(i, 0)) = place.point - depth.at(i) * place.normal;
  }
  return {std::move(tips)};
}

void bindPlaces(py::class_<WorldHandle, WorldPointer>& world) {
  world.def_property_readonly(
      "landmarks", &landmarksOf<&body::SkinLandmark::position>,
      "Named points on the skin, (3,) mm, by the names of the bones (\"spinous_T6\"); {} for a mesh.");
  world.def_property_readonly("landmark_normals", &landmarksOf<&body::SkinLandmark::normal>,
                              "Normals of the skin at the landmarks, (3,), by the same names.");
  world.def(
      "place",
      [](const WorldHandle& self, const PlaceLike& place) { return toArray(placeOn(*self.world, place).point); },
      "(3,) mm: the point of the skin at rest for a name (\"T6\", \"left PSIS\", \"T6 right 30 mm\"; "
      "docs/reference/names.md), or the one nearest to a point (3,). Raises palpate.Error, which suggests the name "
      "nearest in spelling.",
      py::arg("place"));
  world.def(
      "normal_at",
      [](const WorldHandle& self, const PlaceLike& place) { return toArray(placeOn(*self.world, place).normal); },
      "(3,) unit normal of the triangle at a place, pointing outwards. Raises like `place`.", py::arg("place"));
  world.def(
      "triangle_at",
      [](const WorldHandle& self, const PlaceLike& place) { return placeOn(*self.world, place).triangle; },
      "Triangle at a place, as a row of `triangles`. Raises like `place`.", py::arg("place"));
  world.def("stiffness_at", &stiffnessAt,
            "Stiffness at a place, N/mm, interpolated between the vertices. Raises like `place`.", py::arg("place"));
  world.def("tips", &tipsAt,
            "(T, 3) mm: a path along the normal of a place, at these depths (T,) below the skin, mm; negative is above "
            "it. Raises like `place`.",
            py::arg("place"), py::arg("depth_mm"));
  world.def(
      "words",
      [](const WorldHandle& self, const ArrayLike& point) {
        return body::describePlace(self.world->body->anatomy.landmarks, asPoint(point, "point"));
      },
      "A point (3,) in an examiner's words: \"T6, 12 mm right and 8 mm up\"; \"\" for a body without names.",
      py::arg("point"));
  world.def_property_readonly(
      "place_names", [](const WorldHandle& self) { return body::placeNames(self.world->body->anatomy.landmarks); },
      "All names accepted by `place`; [] for a mesh.");
  world.def("ellipses", &ellipses,
            "(N, 3): half axes, mm, the longer first, and direction of the longer against x, rad in [0, pi), of the "
            "deformation ellipses at xy (N, 2), mm, or at named places.",
            py::arg("xy"));
}

std::string worldRepr(const WorldHandle& self) {
  return fmt::format("<World: {}, {} vertices, {} triangles>", self.world->body->name,
                     self.world->body->skin.positions.size(), self.world->body->skin.triangles.size());
}

}  // namespace

WorldPointer worldOfScene(const scene::Scene& scene) {
  return unlocked([&](Interrupts& interrupts) {
    return std::make_shared<WorldHandle>(WorldHandle{scene::build(scene, interrupts.progress())});
  });
}

WorldPointer worldOfMesh(GivenMesh given) {
  return unlocked([&](Interrupts& interrupts) {
    if (!given.repair) requireSound(given.mesh, interrupts.progress());
    engine::WorldFromArrays made =
        engine::worldFromMesh(given.mesh, given.stiffness, given.scene, interrupts.progress(), given.file_notes);
    auto maps = std::make_shared<SourceMaps>();
    maps->given = std::move(given);
    maps->source_vertex = std::move(made.source_vertex);
    maps->source_triangle = std::move(made.source_triangle);
    maps->built_vertex = std::move(made.built_vertex);
    maps->built_triangle = std::move(made.built_triangle);
    return std::make_shared<WorldHandle>(WorldHandle{std::move(made.world), std::move(maps)});
  });
}

WorldPointer worldUnder(const WorldHandle& self, scene::Scene scene) {
  scene.body = self.world->scene.body;  // the kind of body decides which stiffness is meant
  return unlocked([&](Interrupts& interrupts) {
    return std::make_shared<WorldHandle>(
        WorldHandle{scene::rebuilt(*self.world, scene, interrupts.progress()), self.maps});
  });
}

void bindWorld(py::module_& module) {
  py::class_<WorldHandle, WorldPointer> world(
      module, "World",
      "A touchable body, made by load, parse, torso, trunk, from_file or from_arrays. Immutable; any number of threads "
      "may share it.\n\nmm, N, s; x to the patient's right seen from behind, y to the head, z out of the back.");
  bindMakers(world);
  bindWorldSkin(world);
  bindPlaces(world);
  world.def_property_readonly(
      "notes", [](const WorldHandle& self) { return self.world->notes; },
      "Notes for the user: ignored parts of a file, repairs, a doubtful unit.");
  world.def_property_readonly(
      "name", [](const WorldHandle& self) { return self.world->body->name; }, "Name of the body.");
  world.def_property_readonly(
      "closed", [](const WorldHandle& self) { return self.world->body->closed; }, "Whether the skin has no border.");
  world.def_property_readonly(
      "fingers", [](const WorldHandle& self) { return self.world->scene.fingers.size(); },
      "Number of fingers in the scene.");
  world.def("__repr__", &worldRepr, "Short description.");
}

}  // namespace palpate::python
