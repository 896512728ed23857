// Tables of presses ─► measure::averagePresses ─► Averages: an ellipse a point, key points for the maps; and the sheet
// that the dots are punched with.
#include "measure_bindings.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <map>
#include <string>
#include <variant>

#include "palpate/measure/average.h"
#include "palpate/measure/stencil.h"

namespace py = pybind11;

namespace palpate::python {

namespace {

using measure::Averages;
using measure::AverageSettings;
using measure::DragMean;
using measure::MeanEllipse;
using measure::PointMean;
using measure::PressRow;

// --- what goes in ---------------------------------------------------------------------------------------------------

/// A file's name, or a table itself: a text with a line's end.
using Table = std::variant<std::string, std::filesystem::path>;

std::vector<PressRow> loadPresses(const Table& table) {
  const auto* words = std::get_if<std::string>(&table);
  if (words && words->find('\n') != std::string::npos) return measure::parsePresses(*words, "table");
  return measure::readPresses(words ? std::filesystem::path(*words) : std::get<std::filesystem::path>(table));
}

/// Each of several tables is one person's where its rows do not name a person.
std::vector<PressRow> loadPresses(const std::vector<Table>& tables) {
  std::vector<PressRow> all;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    for (PressRow& press : loadPresses(tables[i])) {
      if (press.subject.empty() && tables.size() > 1) press.subject = fmt::format("table {}", i);
      all.push_back(std::move(press));
    }
  }
  return all;
}

using Drag = std::variant<double, std::string>;

double dragDegrees(const Drag& drag) {
  if (const auto* degrees = std::get_if<double>(&drag)) return *degrees;
  const auto named = measure::dragNamed(std::get<std::string>(drag));
  if (!named)
    throw py::value_error("drag: must be degrees, or \"up\", \"left\" and so on, not " + std::get<std::string>(drag));
  return *named;
}

Averages averaged(const std::vector<Table>& tables, const std::optional<Drag>& drag,
                  const std::map<std::string, std::string>& mirrors, const std::string& averaging) {
  AverageSettings settings;
  if (averaging != "tensorial" && averaging != "plain") {
    throw py::value_error("averaging: must be \"tensorial\" or \"plain\", not " + averaging);
  }
  if (averaging == "plain") settings.averaging = maps::Averaging::plain;
  if (drag) settings.drag_deg = dragDegrees(*drag);
  settings.mirrors.assign(mirrors.begin(), mirrors.end());
  return measure::averagePresses(loadPresses(tables), settings);
}

std::vector<measure::StencilSheet> stencil(double spacing_mm, int columns, int rows, double hole_mm,
                                           const std::string& page, bool scale_target) {
  using measure::StencilPage;
  static const std::map<std::string, StencilPage> pages = {{"auto", StencilPage::fitting},
                                                           {"a4", StencilPage::a4},
                                                           {"a3", StencilPage::a3},
                                                           {"a2", StencilPage::a2},
                                                           {"tiled-a4", StencilPage::tiled_a4}};
  const auto found = pages.find(page);
  if (found == pages.end()) {
    throw py::value_error("page: must be \"auto\", \"a4\", \"a3\", \"a2\" or \"tiled-a4\", not " + page);
  }
  return measure::stencilSheets({.spacing_mm = spacing_mm,
                                 .columns = columns,
                                 .rows = rows,
                                 .hole_mm = hole_mm,
                                 .page = found->second,
                                 .scale_target = scale_target});
}

// --- what comes out -------------------------------------------------------------------------------------------------

void bindMeans(py::module_& module) {
  py::class_<MeanEllipse>(module, "MeanEllipse", "Mean of several presses. An unknown standard error is NaN.")
      .def_readonly("half_major_mm", &MeanEllipse::half_major_mm, "Half the major axis.")
      .def_readonly("major_over_minor", &MeanEllipse::major_over_minor, "Ratio of the axes.")
      .def_readonly("direction_deg", &MeanEllipse::direction_deg,
                    "Direction of the major axis, from the right towards the head, in (-90, 90]; with an sd of 52 it "
                    "is undetermined.")
      .def_readonly("hardly_determined", &MeanEllipse::hardly_determined,
                    "Whether the direction's standard error is above 10 degrees, or the presses disagree on it.")
      .def_readonly("resultant", &MeanEllipse::resultant,
                    "Agreement of the directions, from 0 (none) to 1 (all equal).")
      .def_readonly("freedom", &MeanEllipse::freedom, "Degrees of freedom of the errors; 0 if unknown.")
      .def_readonly("subjects", &MeanEllipse::subjects, "Number of people.")
      .def_readonly("presses", &MeanEllipse::presses, "Number of presses.")
      .def("__repr__", [](const MeanEllipse& m) {
        return fmt::format("MeanEllipse({:.1f} mm, ratio {:.2f}, {:.0f} degrees, {} presses of {})",
                           m.half_major_mm.value, m.major_over_minor.value, m.direction_deg.value, m.presses,
                           m.subjects);
      });
  py::class_<DragMean>(module, "DragMean", "Mean of the presses pulled in one direction.")
      .def_readonly("drag_deg", &DragMean::drag_deg,
                    "Direction of the pull, from the right towards the head; None if unknown.")
      .def_readonly("mean", &DragMean::mean, "Mean of these presses.")
      .def("__repr__", [](const DragMean& d) {
        return fmt::format("DragMean({}, {} presses)",
                           d.drag_deg ? measure::dragDirectionName(*d.drag_deg) : "not said", d.mean.presses);
      });
}

void bindPoints(py::module_& module) {
  py::class_<PointMean>(module, "PointMean", "Mean of all presses at a point.")
      .def_readonly("name", &PointMean::name, "Name of the point.")
      .def_property_readonly(
          "place_mm", [](const PointMean& p) { return std::pair(p.place_mm.x(), p.place_mm.y()); },
          "Place on the map, mm: right, headwards.")
      .def_readonly("drags", &PointMean::drags, "Means by direction of the pull; at least one.")
      .def_readonly("mean", &PointMean::mean, "Mean over the drags; the tissue's own if `along_drag` is known.")
      .def_readonly("along_drag", &PointMean::along_drag,
                    "Factor by which a drag stretches the ellipse along itself; None unless two drags 60 degrees or "
                    "more\napart were measured.")
      .def_readonly("half_major_4_mm", &PointMean::half_major_4_mm,
                    "Half the major axis of the 4 mm ellipse; None if not measured.")
      .def_readonly("peak_mm", &PointMean::peak_mm, "Motion under the contact, mm; None if not measured.")
      .def_readonly("stiffness_n_per_mm", &PointMean::stiffness_n_per_mm, "Stiffness; None if not measured.")
      .def_readonly("mirrored_from", &PointMean::mirrored_from,
                    "Name of the point that this one mirrors; empty if measured.")
      .def_property_readonly("remark", measure::dragRemark,
                             "Reason why the direction may not be the tissue's own; empty for none.")
      .def("__repr__",
           [](const PointMean& p) { return fmt::format("PointMean({}, {} drags)", p.name, p.drags.size()); });
  py::class_<Averages>(module, "Averages", "One ellipse per point, averaged over presses and people.")
      .def_readonly("points", &Averages::points, "Points in the order of the tables, then the mirrored ones.")
      .def("key_points", measure::keyPointTable, py::arg("by_drag") = false,
           "Table of key points for maps, as text; by_drag: one row per point and drag.")
      .def("__repr__", [](const Averages& a) { return fmt::format("Averages({} points)", a.points.size()); });
}

}  // namespace

void bindAverages(py::module_& module) {
  bindMeans(module);
  bindPoints(module);
  module.def("average", averaged, py::arg("tables"), py::kw_only(), py::arg("drag") = py::none(),
             py::arg("mirrors") = std::map<std::string, std::string>(), py::arg("averaging") = "tensorial",
             "Averages presses. tables: files (CSV), or texts of such tables; each of several is one person's if "
             "its\nrows do not say. drag: only presses pulled that way, degrees or a word (\"up\"). mirrors: points "
             "that were not\nmeasured as mirror images, {from: to}. averaging: \"tensorial\", or \"plain\" as the "
             "dissertation prints.\nRaises Error with file and line, ValueError.");
}

void bindStencil(py::module_& module) {
  py::class_<measure::StencilSheet>(module, "StencilSheet", "A sheet of paper.")
      .def_readonly("name", &measure::StencilSheet::name,
                    "Row and column of a tile, e.g. \"r1c2\"; empty for a single sheet.")
      .def_readonly("svg", &measure::StencilSheet::svg, "The drawing, in mm; print it at 100 %.")
      .def("__repr__", [](const measure::StencilSheet& s) { return "StencilSheet('" + s.name + "')"; });
  module.def("stencil", stencil, py::kw_only(), py::arg("spacing_mm") = 30.0, py::arg("columns") = 11,
             py::arg("rows") = 13, py::arg("hole_mm") = 8.0, py::arg("page") = "auto", py::arg("scale_target") = false,
             "Stencil sheet for the dots, at true size. spacing_mm: 5 to 100; columns, rows: 2 to 60; hole_mm:\nless "
             "than half the spacing; page: \"auto\", \"a4\", \"a3\", \"a2\" or \"tiled-a4\"; scale_target: with "
             "a\nruler of 100 mm. Raises Error for what is out of range or does not fit, ValueError.");
}

}  // namespace palpate::python
