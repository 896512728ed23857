// Tissue for Python: force laws, layered tissue and what is published, as functions of arrays.
//
//   numbers or arrays that broadcast ─► tissue::respond, LayeredTissue ─► arrays
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <memory>
#include <tuple>

#include "arrays.h"
#include "bindings.h"
#include "palpate/base/error.h"
#include "palpate/tissue/force_law.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/profile.h"
#include "palpate/tissue/published.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

using tissue::ForceLaw;
using Floats = py::array_t<double>;

/// A number or an array for each argument, and an array of their common shape back; () for numbers alone.
template <class Function, class... Given>
FloatArray overAll(const Function& function, const Given&... given) {
  py::object result = py::vectorize(function)(Floats(asFloats(given.second, given.first))...);
  return FloatArray(Floats::ensure(result));
}
std::pair<const char*, py::handle> named(const char* name, const ArrayLike& value) { return {name, value}; }

// --- laws -----------------------------------------------------------------------------------------------------------

constexpr std::array kLawNames = {"linear", "power", "stiffening", "table", "layered"};

ForceLaw checkedLaw(const ForceLaw& law) {
  tissue::check(law);
  return law;
}

ForceLaw powerLaw(double exponent, double reference_depth_mm) {
  return checkedLaw({.kind = ForceLaw::Kind::power, .exponent = exponent, .reference_depth_mm = reference_depth_mm});
}

ForceLaw stiffeningLaw(double ratio, double depth_mm, double reference_depth_mm) {
  return checkedLaw({.kind = ForceLaw::Kind::stiffening,
                     .reference_depth_mm = reference_depth_mm,
                     .stiffening_ratio = ratio,
                     .stiffening_depth_mm = depth_mm});
}

ForceLaw tableLaw(const ArrayLike& depth_mm, const ArrayLike& force_n, double reference_depth_mm) {
  const auto depths = asFloats(depth_mm, "depth_mm");
  const auto forces = asFloats(force_n, "force_n");
  if (depths.ndim() != 1 || forces.ndim() != 1 || depths.size() != forces.size()) {
    throw py::value_error("depth_mm, force_n: expected two arrays (R,) of the same length");
  }
  ForceLaw law{.kind = ForceLaw::Kind::table, .reference_depth_mm = reference_depth_mm};
  const py::ssize_t first = depths.size() > 0 && depths.at(0) == 0.0 && forces.at(0) == 0.0 ? 1 : 0;
  if (depths.size() - first > static_cast<py::ssize_t>(tissue::ForceTable::kMaxRows)) {
    throw py::value_error("depth_mm: expected at most 64 rows; palpate.fit.force averages more");
  }
  for (py::ssize_t row = first; row < depths.size(); ++row) {
    law.table.depth_mm[law.table.rows] = depths.at(row);
    law.table.effective_mm[law.table.rows++] = forces.at(row);
  }
  return checkedLaw(law);
}

FloatArray lawForce(const ForceLaw& law, const ArrayLike& depth, const ArrayLike& stiffness, const ArrayLike& tissue) {
  return overAll([&](double d, double k, double t) { return tissue::normalForce(law, k, d, t); },
                 named("depth_mm", depth), named("stiffness", stiffness), named("tissue_mm", tissue));
}

FloatArray lawTangent(const ForceLaw& law, const ArrayLike& depth, const ArrayLike& stiffness,
                      const ArrayLike& tissue) {
  return overAll([&](double d, double k, double t) { return tissue::tangentStiffness(law, k, d, t); },
                 named("depth_mm", depth), named("stiffness", stiffness), named("tissue_mm", tissue));
}

FloatArray lawDepth(const ForceLaw& law, const ArrayLike& force, const ArrayLike& stiffness, const ArrayLike& tissue) {
  return overAll([&](double f, double k, double t) { return tissue::depthOf(law, f / k, t); }, named("force_n", force),
                 named("stiffness", stiffness), named("tissue_mm", tissue));
}

void bindLaws(py::module_& module) {
  py::class_<ForceLaw>(module, "Law",
                       "A force law, from depth to force: F = k h(depth), where k is the stiffness of the place at "
                       "the\nreference depth (8 mm). Immutable. Made by `linear`, `power`, `stiffening`, `table`, "
                       "`layered`,\nor `of` a world. Depths in mm under the skin, stiffness in N/mm, forces in N.")
      .def_static(
          "linear", [] { return ForceLaw{}; }, "Hooke's law, h = depth.")
      .def_static("power", powerLaw, py::arg("exponent") = 1.6,
                  py::arg("reference_depth_mm") = tissue::kReferenceDepthMm,
                  "h = d_ref (d / d_ref)^exponent, with an exponent of 1 to 3. Raises Error.")
      .def_static(
          "stiffening", stiffeningLaw, py::arg("ratio") = 5.0, py::arg("depth_mm") = 12.0,
          py::arg("reference_depth_mm") = tissue::kReferenceDepthMm,
          "The slope grows along a half Gaussian to `ratio` times that of a light touch, reached at `depth_mm`.\n"
          "Raises Error.")
      .def_static("table", tableLaw, py::arg("depth_mm"), py::arg("force_n"),
                  py::arg("reference_depth_mm") = tissue::kReferenceDepthMm,
                  "A measured law: arrays (R,) of at most 64 rows, increasing depths, non-decreasing forces; scaled "
                  "so\nthat it agrees with the map at the reference depth. Raises ValueError, Error.")
      .def_static(
          "layered",
          [](double fat_mm) {
            return ForceLaw{.kind = ForceLaw::Kind::layered,
                            .layers = tissue::LayeredTissue(tissue::libraryNodes(fat_mm)).forceRows()};
          },
          py::arg("fat_mm") = 8.0,
          "Skin, fat of this thickness (mm) and muscle over bone, solved by finite elements; depends on `tissue_mm`.")
      .def_static(
          "of", [](const WorldHandle& world) { return world.world->surface.force_law; }, py::arg("world"),
          "The force law of a world.")
      .def_property_readonly(
          "kind", [](const ForceLaw& law) { return kLawNames[static_cast<std::size_t>(law.kind)]; },
          "\"linear\", \"power\", \"stiffening\", \"table\" or \"layered\".")
      .def_readonly("exponent", &ForceLaw::exponent, "Exponent of the power law.")
      .def_readonly("reference_depth_mm", &ForceLaw::reference_depth_mm,
                    "Depth at which every law agrees with Hooke's, mm.")
      .def("force", lawForce, py::arg("depth_mm"), py::arg("stiffness") = 1.0, py::arg("tissue_mm") = 0.0,
           "Normal force, N, in the broadcast shape of the arguments; 0 above the skin. `tissue_mm`: thickness "
           "over\nthe bone, which only the layered law asks for.")
      .def("tangent", lawTangent, py::arg("depth_mm"), py::arg("stiffness") = 1.0, py::arg("tissue_mm") = 0.0,
           "dF/dd, N/mm, for depths >= 0: the stiffness for small changes of depth. Shapes as for `force`.")
      .def("depth", lawDepth, py::arg("force_n"), py::arg("stiffness") = 1.0, py::arg("tissue_mm") = 0.0,
           "Smallest depth with this force, mm; 0 for a force that is not positive. Shapes as for `force`.")
      .def("__repr__", [](const ForceLaw& law) {
        return std::string("Law(") + kLawNames[static_cast<std::size_t>(law.kind)] + ")";
      });
}

// --- layered tissue -------------------------------------------------------------------------------------------------

/// Immutable.
struct Layers {
  tissue::LayeredTissue tissue;
};

FloatArray pressedSkin(const Layers& layers, double thickness_mm, double depth_mm, const ArrayLike& r_mm) {
  const auto radii = asFloats(r_mm, "r_mm");
  if (radii.ndim() != 1) throw py::value_error("r_mm: expected an array (N,)");
  const tissue::PressCurves press = layers.tissue.pressAt(thickness_mm, depth_mm);
  py::array_t<double> moved({radii.shape(0), py::ssize_t{2}});
  auto out = moved.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < radii.shape(0); ++i) {
    const double q = std::abs(radii.at(i)) / press.radius_mm;
    out(i, 0) = depth_mm * tissue::curveAt(press.down, tissue::kPressBend, q * q).value;
    out(i, 1) = depth_mm * q * tissue::curveAt(press.outward, tissue::kPressBend, q * q).value;
  }
  return FloatArray(moved);
}

void bindLayers(py::module_& module) {
  py::class_<Layers>(module, "LayeredTissue",
                     "Skin, fat and muscle over bone, solved by finite elements for a fingertip of 8 mm: what the\n"
                     "bodies are made of. Immutable. Thicknesses beyond the solved ones count as the nearest.")
      .def(py::init([](double fat_mm) { return Layers{tissue::LayeredTissue(tissue::libraryNodes(fat_mm))}; }),
           py::arg("fat_mm") = 8.0, "fat_mm: thickness of the fat, 0 to 60 mm, less where there is no room.")
      .def_static(
          "from_table",
          [](const std::filesystem::path& file) {
            return Layers{tissue::LayeredTissue({tissue::nodeOf(tissue::readLayeredTable(file))})};
          },
          py::arg("file"),
          "Reads a table written by `palpate tissue solve` or `palpate tissue fit profile`. Raises Error.")
      .def_property_readonly(
          "thinnest_mm", [](const Layers& l) { return l.tissue.thinnest(); },
          "Thickness of the thinnest solved stack, mm.")
      .def_property_readonly(
          "thickest_mm", [](const Layers& l) { return l.tissue.thickest(); },
          "Thickness of the thickest solved stack, mm.")
      .def(
          "secant",
          [](const Layers& layers, const ArrayLike& thickness, const ArrayLike& depth) {
            return overAll([&](double t, double d) { return layers.tissue.secantAt(t, d); },
                           named("thickness_mm", thickness), named("depth_mm", depth));
          },
          py::arg("thickness_mm"), py::arg("depth_mm"),
          "Force divided by depth, N/mm, in the broadcast shape of the arguments; depths > 0.")
      .def(
          "force",
          [](const Layers& layers, const ArrayLike& thickness, const ArrayLike& depth) {
            return overAll([&](double t, double d) { return d > 0.0 ? d * layers.tissue.secantAt(t, d) : 0.0; },
                           named("thickness_mm", thickness), named("depth_mm", depth));
          },
          py::arg("thickness_mm"), py::arg("depth_mm"),
          "Normal force on the fingertip, N, in the broadcast shape of the arguments.")
      .def(
          "deepest",
          [](const Layers& layers, const ArrayLike& thickness) {
            return overAll([&](double t) { return layers.tissue.deepestAt(t); }, named("thickness_mm", thickness));
          },
          py::arg("thickness_mm"),
          "Maximum depth of the skin, mm: the deepest that was solved, never down to the bone.")
      .def("pressed", pressedSkin, py::arg("thickness_mm"), py::arg("depth_mm"), py::arg("r_mm"),
           "Motion of pressed skin at these distances from the axis (N,): an array (N, 2), mm, into the body and "
           "away\nfrom the axis.")
      .def(
          "law",
          [](const Layers& layers) {
            return ForceLaw{.kind = ForceLaw::Kind::layered, .layers = layers.tissue.forceRows()};
          },
          "The force law of this tissue, for Law's functions with `tissue_mm`.");
}

// --- what is published ----------------------------------------------------------------------------------------------

using Modulus = std::tuple<std::string, double, double, std::string, std::string, std::string, bool>;

std::vector<Modulus> modulusRows() {
  std::vector<Modulus> rows;
  for (const tissue::PublishedModulus& m : tissue::publishedModuli()) {
    rows.emplace_back(m.tissue, m.low_kpa, m.high_kpa, m.how, m.source, m.doubt, m.is_default);
  }
  return rows;
}

}  // namespace

void bindTissue(py::module_& module) {
  bindLaws(module);
  bindLayers(module);
  module.def("published_moduli", modulusRows,
             "Rows (tissue, low_kpa, high_kpa, how, source, doubt, is_default); palpate.tissue.moduli names them.");
  module.def("default_modulus", tissue::defaultModulus, py::arg("tissue"),
             "Young's modulus (kPa) of \"skin\", \"fat\" or \"muscle\" in the solved stacks. Raises Error for any "
             "other word.");
  module.def(
      "profile",
      [](const ArrayLike& q) {
        return overAll([](double ratio) { return tissue::profile(std::abs(ratio)); }, named("q", q));
      },
      py::arg("q"),
      "The dissertation's half Gaussian: the share of the finger's motion at location ratio q, 1 under it, 0 from 1\n"
      "on. An array of q's shape.");
  bindFits(module);
}

}  // namespace palpate::python
