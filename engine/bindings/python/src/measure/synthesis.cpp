#include "measure_bindings.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>

#include "arrays.h"
#include "dicts.h"
#include "interrupts.h"
#include "palpate/measure/synthesis/synthetic_files.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::python {

namespace {

using measure::TailFamily;
constexpr std::array kFamilies = {TailFamily::compact, TailFamily::long_tail, TailFamily::half_space,
                                  TailFamily::windowed_half_space};

TailFamily familyNamed(const std::string& word) {
  for (const TailFamily family : kFamilies) {
    if (nameOf(family) == word) return family;
  }
  throw py::value_error("tail: must be \"compact\", \"long\", \"half-space\" or \"windowed\", not " + word);
}

void applyRequest(double& value, const std::optional<double>& request, const char* what, double least, double most,
                  double factor = 1.0) {
  if (!request) return;
  if (!(*request >= least && *request <= most)) {
    throw py::value_error(fmt::format("{} = {:g} is out of range: {:g} to {:g}", what, *request, least, most));
  }
  value = *request * factor;
}

/// Options of the press; the rest is drawn from the seed.
struct PressRequests {
  std::optional<std::string> tail;
  std::optional<double> half_major_mm, ratio, direction_deg, drag_deg, peak_mm;
};

measure::SyntheticCase drawRequestedCase(std::uint64_t seed, double megapixels, double drift_mm,
                                         const PressRequests& requests) {
  if (!(megapixels >= 0.5 && megapixels <= 48.0)) throw py::value_error("megapixels: must be 0.5 to 48");
  if (!(drift_mm >= 0.0 && drift_mm <= 20.0)) throw py::value_error("drift_mm: must be 0 to 20");
  measure::CaseRequests drawn{.megapixels = megapixels, .drift_mm = drift_mm};
  if (requests.tail) drawn.family = familyNamed(*requests.tail);
  measure::SyntheticCase made = measure::drawCase(seed, drawn);
  applyRequest(made.press.half_major_mm, requests.half_major_mm, "half_major_mm", 20, 300);
  applyRequest(made.press.ratio, requests.ratio, "ratio", 1, 4);
  applyRequest(made.press.direction_rad, requests.direction_deg, "direction_deg", -180, 180, kRadPerDeg);
  applyRequest(made.press.drag_rad, requests.drag_deg, "drag_deg", -180, 180, kRadPerDeg);
  applyRequest(made.press.peak_mm, requests.peak_mm, "peak_mm", 0, 40);
  if (made.press.peak_mm == 0.0) {  // nothing is pressed: no stick is held
    made.press.dent_mm = 0.0;
    made.press.stick = false;
  }
  return made;
}

PixelArray toPixelArray(const measure::Photograph& picture) {
  py::array_t<std::uint8_t> pixels({picture.height_px, picture.width_px, 3});
  std::copy(picture.rgb.begin(), picture.rgb.end(), pixels.mutable_data());
  return PixelArray(pixels);
}

Facts truthFacts(const measure::SyntheticTruth& truth) {
  Facts facts;
  facts["half_major_mm"] = truth.at_2_mm.half_major_mm.value;
  facts["half_minor_mm"] = truth.at_2_mm.half_minor_mm.value;
  facts["major_over_minor"] = truth.at_2_mm.major_over_minor.value;
  facts["direction_deg"] = truth.at_2_mm.direction_deg.value;
  facts["drag_deg"] = truth.drag_deg;
  facts["peak_mm"] = truth.field.peak_mm.norm();
  facts["contact_px"] = py::make_tuple(truth.contact_px.x(), truth.contact_px.y());
  facts["px_per_mm"] = truth.px_per_mm;
  return facts;
}

using Synthesized = std::tuple<PixelArray, PixelArray, PixelArray, Facts>;

Synthesized synthesized(std::uint64_t seed, double megapixels, double drift_mm, const std::optional<std::string>& tail,
                        const std::optional<double>& half_major_mm, const std::optional<double>& ratio,
                        const std::optional<double>& direction_deg, const std::optional<double>& drag_deg,
                        const std::optional<double>& peak_mm) {
  const measure::SyntheticCase made =
      drawRequestedCase(seed, megapixels, drift_mm, {tail, half_major_mm, ratio, direction_deg, drag_deg, peak_mm});
  measure::SyntheticPair pair;
  measure::Photograph again;
  unlocked([&](Interrupts& interrupts) {
    pair = measure::renderPair(made);
    interrupts.check();
    again = measure::throughJpeg(measure::renderPicture(made, measure::Moment::again), made.look.jpeg_quality);
  });
  return {toPixelArray(pair.before), toPixelArray(again), toPixelArray(pair.after), truthFacts(pair.truth)};
}

}  // namespace

void bindSynthesis(py::module_& module) {
  module.def("synthesize", synthesized, py::arg("seed"), py::kw_only(), py::arg("megapixels") = 2.0,
             py::arg("drift_mm") = 0.3, py::arg("tail") = py::none(), py::arg("half_major_mm") = py::none(),
             py::arg("ratio") = py::none(), py::arg("direction_deg") = py::none(), py::arg("drag_deg") = py::none(),
             py::arg("peak_mm") = py::none(),
             "Pictures before, again before and after a press, arrays (H, W, 3) of uint8, and the truth as a "
             "dict;\npalpate.measure.synthesize names them. Releases the GIL. Raises ValueError.");
}

}  // namespace palpate::python
