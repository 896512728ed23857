// The module palpate._measure: from two pictures of a dotted back to the key ellipse, and pictures whose truth is
// known. palpate/measure.py is its face.
//
//   files or arrays (H, W, 3) ─► Photograph ─► measure::measurePair ─► Measurement: verdict, ellipse, dots as arrays
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <limits>

#include "arrays.h"
#include "dicts.h"
#include "interrupts.h"
#include "measure_bindings.h"
#include "palpate/base/error.h"
#include "palpate/measure/key_row.h"
#include "palpate/measure/measurement.h"
#include "palpate/scene/host.h"
#include "uninitialised.h"

namespace palpate::python {

namespace {

using measure::Estimate;
using measure::FieldFit;
using measure::KeyEllipse;
using measure::Measurement;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// With more drift, the breath was not held (docs/howto/measure-a-person.md).
constexpr double kMaxNullDriftMm = 0.3;

// --- pictures -------------------------------------------------------------------------------------------------------

measure::Photograph loadPhotograph(const py::object& given, const char* what) {
  if (!py::isinstance<py::array>(given)) return measure::readPhotograph(given.cast<std::filesystem::path>());
  const auto any = given.cast<py::array>();
  if (any.ndim() != 3 || any.shape(2) != 3 || any.dtype().kind() != 'u' || any.dtype().itemsize() != 1) {
    throw py::value_error(fmt::format("{}: expected a file name or an array (H, W, 3) of uint8", what));
  }
  if (any.shape(0) < 200 || any.shape(1) < 200 || any.shape(0) * any.shape(1) > measure::kMaxPixels) {
    throw Error(fmt::format("{}: {} x {} pixels; expected 200 x 200 pixels to 52 megapixels", what, any.shape(1),
                            any.shape(0)));
  }
  const auto bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>::ensure(any);
  measure::Photograph picture{
      .name = what, .width_px = static_cast<int>(any.shape(1)), .height_px = static_cast<int>(any.shape(0))};
  picture.rgb.assign(bytes.data(), bytes.data() + bytes.size());
  return picture;
}

measure::HeadTowards headNamed(const std::string& word) {
  constexpr std::array kWords = {"top", "left", "bottom", "right"};
  const auto found = std::find(kWords.begin(), kWords.end(), word);
  if (found == kWords.end())
    throw py::value_error("head: must be \"top\", \"left\", \"bottom\" or \"right\", not " + word);
  return static_cast<measure::HeadTowards>(found - kWords.begin());
}

struct Requests {
  measure::MeasureSettings settings;
  bool drift_given = false;
};

/// Like `palpate measure dots --null`.
void countNullDrift(const measure::Photograph& before, const measure::Photograph& again, Requests& requests,
                    std::vector<measure::Finding>& findings) {
  const auto drift = measure::nullDrift(before, again, requests.settings);
  if (!drift) {
    findings.push_back({measure::Severity::warning, "null_unread",
                        "How far the body moved by itself is unknown: the two pictures before show no common grid "
                        "of dots."});
    return;
  }
  if (!requests.drift_given) requests.settings.drift_mm = std::max(requests.settings.drift_mm, *drift);
  if (*drift < kMaxNullDriftMm + 0.005) return;
  findings.push_back({measure::Severity::warning, "null_drift",
                      fmt::format("The body moved {:.2f} mm between the two pictures before, more than {} mm: hold the "
                                  "breath and repeat.",
                                  *drift, kMaxNullDriftMm)});
}

Measurement measured(const PictureLike& before, const PictureLike& after, const MaybePicture& again, double spacing_mm,
                     const std::optional<double>& drift_mm, const std::string& head,
                     const std::optional<std::pair<double, double>>& contact_px, bool partial) {
  Requests requests;
  requests.settings.spacing_mm = spacing_mm;
  requests.drift_given = drift_mm.has_value();
  requests.settings.drift_mm = drift_mm.value_or(requests.settings.drift_mm);
  requests.settings.head = headNamed(head);
  requests.settings.partial = partial;
  if (contact_px) requests.settings.contact_px = Vec2(contact_px->first, contact_px->second);
  const measure::Photograph first = loadPhotograph(before, "before");
  const measure::Photograph second = loadPhotograph(after, "after");
  std::optional<measure::Photograph> null;
  if (!again.is_none()) null = loadPhotograph(again, "again");
  return unlocked([&](Interrupts& interrupts) {
    std::vector<measure::Finding> findings;
    if (null) countNullDrift(first, *null, requests, findings);
    Measurement result = measure::measurePair(first, second, requests.settings, interrupts.progress());
    result.findings.insert(result.findings.end(), findings.begin(), findings.end());
    return result;
  });
}

// --- what came out --------------------------------------------------------------------------------------------------

FloatArray pointsArray(std::size_t count, const std::function<Vec2(std::size_t)>& at) {
  py::array_t<double> points({static_cast<py::ssize_t>(count), py::ssize_t{2}});
  auto out = points.mutable_unchecked<2>();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 point = at(i);
    out(static_cast<py::ssize_t>(i), 0) = point.x();
    out(static_cast<py::ssize_t>(i), 1) = point.y();
  }
  return FloatArray(points);
}

Arrays dotArrays(const Measurement& m) {
  const auto& dots = m.dots;
  py::array_t<std::int32_t> sites({static_cast<py::ssize_t>(dots.size()), py::ssize_t{2}});
  py::array_t<double> residuals(static_cast<py::ssize_t>(dots.size()));
  for (std::size_t i = 0; i < dots.size(); ++i) {
    const auto row = static_cast<py::ssize_t>(i);
    sites.mutable_at(row, 0) = dots[i].site.column;
    sites.mutable_at(row, 1) = dots[i].site.row;
    residuals.mutable_at(row) = dots[i].residual_mm;
  }
  Arrays table;
  table["site"] = sites;
  table["before_px"] = pointsArray(dots.size(), [&](std::size_t i) { return dots[i].before_px; });
  table["after_px"] =
      pointsArray(dots.size(), [&](std::size_t i) { return dots[i].after_px.value_or(Vec2(kUnknown, kUnknown)); });
  table["skin_mm"] = pointsArray(dots.size(), [&](std::size_t i) { return dots[i].skin_mm; });
  table["moved_mm"] =
      pointsArray(dots.size(), [&](std::size_t i) -> Vec2 { return dots[i].moved_mm - dots[i].drift_mm; });
  table["residual_mm"] = residuals;
  return table;
}

FactsList listFindings(const Measurement& m) {
  FactsList all;
  for (const measure::Finding& finding : m.findings) {
    Facts one;
    one["severity"] = finding.severity == measure::Severity::refusal ? "refusal" : "warning";
    one["code"] = finding.code;
    one["text"] = finding.text;
    all.append(one);
  }
  return all;
}

template <class Value>
auto ofFit(Value FieldFit::*member) {
  return [member](const Measurement& m) { return m.fit ? std::optional<Value>((*m.fit).*member) : std::nullopt; };
}

Facts driftFacts(const Measurement& m) {
  Facts facts;
  if (!m.fit) return facts;
  const measure::Drift& drift = m.fit->drift;
  facts["right_mm"] = drift.right_mm.value;
  facts["headwards_mm"] = drift.headwards_mm.value;
  facts["length_mm"] = drift.length_mm;
  facts["turn_deg"] = drift.turn_deg;
  facts["scale_percent"] = drift.scale_percent;
  return facts;
}

std::string tableRow(const Measurement& m, const std::string& name, const std::pair<double, double>& place_mm) {
  if (const std::string fault = measure::faultOfKeyName(name); !fault.empty()) throw py::value_error("name: " + fault);
  return measure::keyRow(m, name, Vec2(place_mm.first, place_mm.second));
}

void bindEllipse(py::module_& module) {
  py::class_<Estimate>(module, "Estimate", "A number and its standard deviation. float() gives the number.")
      .def_readonly("value", &Estimate::value, "The value.")
      .def_readonly("sd", &Estimate::sd, "Standard deviation.")
      .def(
          "__float__", [](const Estimate& e) { return e.value; }, "The number.")
      .def("__repr__", [](const Estimate& e) { return fmt::format("Estimate({:.4g} +- {:.2g})", e.value, e.sd); });
  py::class_<KeyEllipse>(module, "KeyEllipse", "Ellipse through the places that move by level_mm.")
      .def_readonly("level_mm", &KeyEllipse::level_mm, "2 or 4.")
      .def_readonly("half_major_mm", &KeyEllipse::half_major_mm, "Half the major axis.")
      .def_readonly("half_minor_mm", &KeyEllipse::half_minor_mm, "Half the minor axis.")
      .def_readonly("major_over_minor", &KeyEllipse::major_over_minor, "Ratio of the axes.")
      .def_readonly("direction_deg", &KeyEllipse::direction_deg,
                    "Direction of the major axis, from the right towards the head, in (-90, 90].")
      .def("__repr__", [](const KeyEllipse& e) {
        return fmt::format("KeyEllipse({} mm: {:.1f} x {:.1f} mm at {:.0f} degrees)", e.level_mm, e.half_major_mm.value,
                           e.half_minor_mm.value, e.direction_deg.value);
      });
}

void bindMeasurement(py::module_& module) {
  py::class_<Measurement>(module, "Measurement",
                          "Measurement from two pictures, with its verdict. Values that were not fitted are None.")
      .def_property_readonly("accepted", &Measurement::accepted, "Whether no finding rejects it.")
      .def_property_readonly("findings", listFindings,
                             "Findings against it, one dict each: severity (\"refusal\", \"warning\"), code "
                             "(stable),\ntext (what was seen and what to do).")
      .def_property_readonly("ellipse", ofFit(&FieldFit::at_2_mm), "The key ellipse, of 2 mm; None without a fit.")
      .def_property_readonly("ellipse_4_mm", ofFit(&FieldFit::at_4_mm), "The ellipse of 4 mm.")
      .def_property_readonly("peak_mm", ofFit(&FieldFit::peak_mm), "Motion of the skin under the contact, mm.")
      .def_property_readonly("drag_deg", ofFit(&FieldFit::drag_deg),
                             "Direction in which it was pulled, in (-180, 180].")
      .def_property_readonly("residual_rms_mm", ofFit(&FieldFit::residual_rms_mm), "RMS residual of the dots, mm.")
      .def_property_readonly("inside_share", ofFit(&FieldFit::inside_share),
                             "Fraction of the ellipse inside the area of dots.")
      .def_property_readonly("drift", driftFacts,
                             "Motion of the body between the pictures: right_mm, headwards_mm, length_mm, "
                             "turn_deg,\nscale_percent; empty without a fit.")
      .def_property_readonly(
          "dots", dotArrays,
          "A dict of arrays, one row per dot: site (N, 2) column and row, before_px, after_px (NaN:\nhidden), skin_mm, "
          "moved_mm without the body's own motion (N, 2), residual_mm (N,).")
      .def_property_readonly(
          "contour_mm",
          [](const Measurement& m) {
            const auto* contour = m.contour ? &m.contour->contour_2_mm : nullptr;
            return pointsArray(contour ? contour->size() : 0, [&](std::size_t i) { return (*contour)[i]; });
          },
          "Traced 2 mm contour on the skin (N, 2), mm; empty if there is none.")
      .def_readonly("matched", &Measurement::matched, "Number of dots found in both pictures.")
      .def_readonly("seconds", &Measurement::seconds, "Computation time, s.")
      .def("row", tableRow, py::arg("name"), py::arg("place_mm"),
           "Row of a key point table under `row_header`, for maps; empty without a fit. Raises ValueError.")
      .def("__repr__", [](const Measurement& m) {
        return fmt::format("Measurement({}, {} dots, {} findings)", m.accepted() ? "accepted" : "refused", m.matched,
                           m.findings.size());
      });
}

}  // namespace

PYBIND11_MODULE(_measure, module) {
  installHost();
  module.doc() = "Photographs of dots; use palpate.measure.";
  py::module_::import("palpate._core");  // palpate.Error
  bindEllipse(module);
  bindMeasurement(module);
  module.def(
      "dots", measured, py::arg("before"), py::arg("after"), py::kw_only(), py::arg("again") = py::none(),
      py::arg("spacing_mm") = 30.0, py::arg("drift_mm") = py::none(), py::arg("head") = "top",
      py::arg("contact_px") = py::none(), py::arg("partial") = false,
      "Measures one press. before, after, again (a second picture before it, which tells how far the body moves\n"
      "by itself): files (JPEG, PNG, TIFF) or arrays (H, W, 3) of uint8. spacing_mm: of the stencil. drift_mm:\n"
      "how far the body may have moved, sd; None: 0.4 or what `again` shows. head: the pictures' edge that is\n"
      "towards it. contact_px: the marked contact. partial: the ellipse may leave the dots. Never raises for what\n"
      "the pictures show: see Measurement.accepted. Releases the GIL. Raises Error, ValueError.");
  module.def("row_header", measure::keyRowHeader, "The columns of Measurement.row, with a line end.");
  bindAverages(module);
  bindStencil(module);
  bindSynthesis(module);
  refuseUninitialised(module);
}

}  // namespace palpate::python
