// Lump, and worlds with lumps: their settings are those of a scene file's [[lump]], checked by its reader.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <optional>

#include "bindings.h"
#include "dicts.h"
#include "interrupts.h"
#include "palpate/base/error.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

using scene::LumpSettings;

struct MaybeLumpsName {
  static constexpr auto name = py::detail::const_name("Optional[Sequence[palpate._core.Lump]]");
};
using MaybeLumps = Named<MaybeLumpsName>;
struct MaybeTripleName {
  static constexpr auto name = py::detail::const_name("Optional[numpy.typing.ArrayLike]");
};
using MaybeTriple = Named<MaybeTripleName>;

/// Checks it like one in a scene file. Throws Error naming the key.
LumpSettings checkedLump(const LumpSettings& lump) {
  scene::Scene scene;
  scene.lumps = {lump};
  try {
    LumpSettings read = scene::parse(scene::sceneAsToml(scene), "Lump").lumps.front();
    read.scene_file.clear();  // that file is not at hand
    read.line = read.depth_line = 0;
    return read;
  } catch (const Error& error) {
    constexpr std::string_view kTable = "[[lump]] ";
    std::string_view cause = error.cause();
    if (cause.starts_with(kTable)) cause.remove_prefix(kTable.size());
    throw Error(fmt::format("Lump: {}", cause));
  }
}

void putPlace(const PlaceLike& at, LumpSettings& lump) {
  if (py::isinstance<py::str>(at)) {
    lump.at = at.cast<std::string>();
    return;
  }
  const auto place = asFloats(at, "at");
  if (place.ndim() != 1 || (place.shape(0) != 2 && place.shape(0) != 3)) {
    throw py::value_error("at: expected a place by name, or x and y (z is ignored)");
  }
  lump.x_mm = place.at(0);
  lump.y_mm = place.at(1);
}

/// Throws where both kinds of hardness are given.
void putHardness(const std::optional<double>& ratio, const std::optional<double>& young_kpa, LumpSettings& lump) {
  if (ratio && young_kpa) throw Error("Lump: takes stiffness_ratio or young_kpa, not both");
  if (ratio) lump.stiffness_ratio = *ratio;
  if (!young_kpa) return;
  if (!(*young_kpa > 0.0))
    throw Error(fmt::format("Lump: young_kpa = {} is out of range: must be above 0", *young_kpa));
  lump.young_kpa = *young_kpa;
}

LumpSettings makeLump(const PlaceLike& at, double depth_mm, const std::optional<double>& diameter_mm,
                      const MaybeTriple& half_axes_mm, const std::optional<double>& ratio,
                      const std::optional<double>& young_kpa, double edge, double mobility_mm_per_n,
                      double mobility_limit_mm, double raise_mm, const std::string& name) {
  LumpSettings lump;
  lump.name = name;
  putPlace(at, lump);
  lump.depth_mm = depth_mm;
  if (diameter_mm && !half_axes_mm.is_none()) throw Error("Lump: takes diameter_mm or half_axes_mm, not both");
  if (diameter_mm) lump.diameter_mm = *diameter_mm;
  if (!half_axes_mm.is_none()) lump.half_axes_mm = asPoint(half_axes_mm, "half_axes_mm");
  putHardness(ratio, young_kpa, lump);
  lump.edge = edge;
  lump.mobility_mm_per_n = mobility_mm_per_n;
  lump.mobility_limit_mm = mobility_limit_mm;
  lump.raise_mm = raise_mm;
  return checkedLump(lump);
}

std::string lumpRepr(const LumpSettings& lump) {
  const LumpSettings usual;
  std::string text = lump.at.empty() ? fmt::format("at=({}, {})", lump.x_mm, lump.y_mm)
                                     : fmt::format("at={}", py::repr(py::str(lump.at)).cast<std::string>());
  const auto add = [&](const char* name, double value, double default_value) {
    if (value != default_value) text += fmt::format(", {}={}", name, value);
  };
  add("depth_mm", lump.depth_mm, usual.depth_mm);
  if (const auto& half = lump.half_axes_mm) {
    text += fmt::format(", half_axes_mm=({}, {}, {})", half->x(), half->y(), half->z());
  } else {
    add("diameter_mm", lump.diameter_mm, usual.diameter_mm);
  }
  if (lump.young_kpa > 0.0) {
    add("young_kpa", lump.young_kpa, usual.young_kpa);
  } else {
    add("stiffness_ratio", lump.stiffness_ratio, usual.stiffness_ratio);
  }
  add("edge", lump.edge, usual.edge);
  add("mobility_mm_per_n", lump.mobility_mm_per_n, usual.mobility_mm_per_n);
  add("mobility_limit_mm", lump.mobility_limit_mm, usual.mobility_limit_mm);
  add("raise_mm", lump.raise_mm, usual.raise_mm);
  if (!lump.name.empty()) text += fmt::format(", name={}", py::repr(py::str(lump.name)).cast<std::string>());
  return "Lump(" + text + ")";
}

void bindLump(py::module_& module) {
  const LumpSettings usual;
  py::class_<LumpSettings> lump(
      module, "Lump",
      "A lump under the skin: a node, a cyst, a hard band. Checked on creation; immutable.\n\nat: the skin over its "
      "middle, by name (\"T9 right 30 mm\") or x, y, mm, seen along z\ndepth_mm: of its top under the skin at rest, "
      "along the normal; at least 0.5 mm under the skin's own layer\ndiameter_mm: of a ball (2 to 40; 10), or "
      "half_axes_mm: across, across (the same), into the body (1 to 20)\nstiffness_ratio: over the layer at its centre "
      "(0.2 to 1,000; 5), or young_kpa: Young's modulus\nedge: share of the radius over which its modulus falls to the "
      "tissue's; 0 is sharp (0 to 1)\nmobility_mm_per_n: how far it moves under 1 N sideways (0.1 to 100); 0 is "
      "fixed\nmobility_limit_mm: it moves no farther from its place (above 0, to 100)\nraise_mm: how far the skin over "
      "it is raised at rest (0 to 10)\nname: different for each lump of a world; \"\": lump1, lump2, ...\n\nRaises "
      "palpate.Error for a number that is out of range. Whether there is room for it is known when a world is built.");
  lump.def(py::init(&makeLump), "Keyword arguments only. Raises palpate.Error, or ValueError for wrong shapes.",
           py::kw_only(), py::arg("at"), py::arg("depth_mm") = usual.depth_mm, py::arg("diameter_mm") = py::none(),
           py::arg("half_axes_mm") = py::none(), py::arg("stiffness_ratio") = py::none(),
           py::arg("young_kpa") = py::none(), py::arg("edge") = usual.edge,
           py::arg("mobility_mm_per_n") = usual.mobility_mm_per_n,
           py::arg("mobility_limit_mm") = usual.mobility_limit_mm, py::arg("raise_mm") = usual.raise_mm,
           py::arg("name") = "");
  lump.def_property_readonly(
      "name", [](const LumpSettings& self) { return self.name; }, "Name as given.");
  lump.def_property_readonly(
      "at",
      [](const LumpSettings& self) {
        return PlaceLike(self.at.empty() ? py::object(py::make_tuple(self.x_mm, self.y_mm)) : py::str(self.at));
      },
      "Place on the skin above its centre: a name, or x and y, mm.");
  lump.def_property_readonly(
      "depth_mm", [](const LumpSettings& self) { return self.depth_mm; },
      "Depth of its top below the skin at rest, mm.");
  lump.def_property_readonly(
      "half_axes_mm", [](const LumpSettings& self) { return toArray(self.halfAxes()); },
      "(3,) half axes: across, across, into the body, mm.");
  lump.def("__repr__", &lumpRepr, "The call of the constructor.");
  lump.def(
      "__eq__", [](const LumpSettings& self, const LumpSettings& other) { return lumpRepr(self) == lumpRepr(other); },
      py::is_operator(), "Whether all values are equal.");
  lump.def(
      "__hash__", [](const LumpSettings& self) { return py::hash(py::str(lumpRepr(self))); }, "Hash of all values.");
}

std::vector<LumpSettings> settingsOfLumps(const MaybeLumps& given) {
  std::vector<LumpSettings> lumps;
  if (given.is_none()) return lumps;
  if (!py::isinstance<py::sequence>(given)) throw py::type_error("lumps: expected a sequence of palpate.Lump");
  for (const py::handle lump : given) {
    if (!py::isinstance<LumpSettings>(lump)) throw py::type_error("lumps: expected a sequence of palpate.Lump");
    lumps.push_back(lump.cast<LumpSettings>());
  }
  return lumps;
}

WorldPointer newWorld(const MaybeLumps& lumps, const std::string& body, std::size_t triangles) {
  scene::Scene scene;
  if (body == "torso") {
    scene.body.kind = scene::BodyKind::torso;
  } else if (body == "trunk") {
    scene.body.kind = scene::BodyKind::trunk;
  } else {
    throw py::value_error("body: must be 'trunk' or 'torso'; use World.from_file or from_arrays for others");
  }
  scene.body.triangles = triangles;
  scene = scene::parse(scene::sceneAsToml(scene), "World");  // a pickle is such a text, with its limits
  scene.lumps = settingsOfLumps(lumps);
  return worldOfScene(scene);
}

WorldPointer withLumps(const WorldHandle& self, const MaybeLumps& lumps) {
  scene::Scene scene = self.world->scene;
  scene.lumps = settingsOfLumps(lumps);
  return worldUnder(self, std::move(scene));
}

Facts factsOfLump(const scene::PlacedLump& placed) {
  const contact::Lump& lump = placed.lump;
  Facts facts;
  facts["name"] = placed.name;
  facts["foot"] = toArray(lump.foot);
  facts["axis"] = toArray(lump.axis);
  facts["across"] = toArray(lump.across);
  facts["up"] = toArray(lump.up);
  facts["half_axes_mm"] = toArray(placed.settings.halfAxes());
  facts["depth_mm"] = placed.settings.depth_mm;
  facts["young_kpa"] = placed.young_kpa;
  facts["layer_kpa"] = placed.layer_kpa;
  facts["tissue_mm"] = placed.thickness_mm;
  facts["mobility_mm_per_n"] = placed.settings.mobility_mm_per_n;
  py::dict shares;
  for (std::size_t i = 0; i < scene::kToldDepthsMm.size(); ++i) {
    shares[py::float_(scene::kToldDepthsMm[i])] = placed.share[i];
  }
  facts["share"] = shares;
  facts["note"] = placed.note;
  return facts;
}

}  // namespace

py::dict numbersOf(const scene::LumpSettings& lump) {
  py::dict named;
  named["at"] = lump.at.empty() ? py::object(py::make_tuple(lump.x_mm, lump.y_mm)) : py::str(lump.at);
  named["depth_mm"] = lump.depth_mm;
  if (const auto& half = lump.half_axes_mm) {
    named["half_axes_mm"] = py::make_tuple(half->x(), half->y(), half->z());
  } else {
    named["diameter_mm"] = lump.diameter_mm;
  }
  if (lump.young_kpa > 0.0) {
    named["young_kpa"] = lump.young_kpa;
  } else {
    named["stiffness_ratio"] = lump.stiffness_ratio;
  }
  named["edge"] = lump.edge;
  named["mobility_mm_per_n"] = lump.mobility_mm_per_n;
  named["mobility_limit_mm"] = lump.mobility_limit_mm;
  named["raise_mm"] = lump.raise_mm;
  named["name"] = lump.name;
  return named;
}

void bindLumps(py::module_& module) {
  bindLump(module);
  auto world = py::reinterpret_borrow<py::class_<WorldHandle, WorldPointer>>(module.attr("World"));
  world.def(py::init(&newWorld),
            "A built-in body with lumps under its skin. body: 'trunk' or 'torso'; triangles: number in skin and bones, "
            "0 for the default. Raises palpate.Error for a lump that cannot be at its place.",
            py::kw_only(), py::arg("lumps") = py::none(), py::arg("body") = "trunk", py::arg("triangles") = 0);
  world.def(
      "with_lumps", &withLumps,
      "The same body with only these lumps, in about 30 ms per lump: the same triangles in the same order. Requires "
      "layered tissue: a built-in body, or a mesh under a scene with [tissue] layer_table. Raises palpate.Error.",
      py::arg("lumps"));
  world.def_property_readonly(
      "lumps",
      [](const WorldHandle& self) {
        py::list all;
        for (const auto& lump : self.world->lumps) all.append(factsOfLump(*lump));
        return FactsList(all);
      },
      "Lumps under the skin, one dict each: name; foot (3,) on the skin above its centre, axis (3,) out of the skin, "
      "across and up (3,), mm; half_axes_mm (3,), depth_mm of its top; young_kpa, layer_kpa of the tissue around it; "
      "tissue_mm over the bone; mobility_mm_per_n; share: what it adds to the force of a fingertip right over it, by "
      "the depth of the press, mm; note, all of this in a line.");
}

}  // namespace palpate::python
