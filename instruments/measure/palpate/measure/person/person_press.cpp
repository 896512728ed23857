// One press of a person's folder through the pipeline. The null drift: docs/howto/measure-a-person.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/measure/key_row.h"
#include "palpate/measure/person/person_folder.h"
#include "palpate/measure/photograph.h"

namespace palpate::measure {

namespace {

/// More between two pictures of nothing, and a long tail's axes are wrong by tens of percent.
constexpr double kMaxNullDriftMm = 0.3;
/// If the pull differs by this from the pictures' names, the names are wrong.
constexpr double kMaxAskewDeg = 45.0;

}  // namespace

PressOutcome assessPress(const Measurement& measurement, const PlannedPress& planned,
                         const std::optional<double>& null_drift_mm) {
  PressOutcome outcome{.accepted = measurement.accepted(), .null_drift_mm = null_drift_mm};
  outcome.row = keyRow(measurement, planned.point, planned.place_mm);
  while (!outcome.row.empty() && outcome.row.back() == '\n') outcome.row.pop_back();
  for (const Finding& finding : measurement.findings) {
    (finding.severity == Severity::refusal ? outcome.refusals : outcome.warnings).push_back(finding.text);
  }
  if (null_drift_mm && *null_drift_mm > kMaxNullDriftMm) {
    outcome.refusals.push_back(
        fmt::format("the body moved {:.2f} mm between the two pictures before, {:g} is the most: "
                    "breathe out, hold, wait, and take all of them in one hold",
                    *null_drift_mm, kMaxNullDriftMm));
  }
  if (outcome.accepted && measurement.fit) {
    const double askew = std::remainder(measurement.fit->drag_deg.value - planned.drag_deg, 360.0);
    if (std::abs(askew) > kMaxAskewDeg) {
      outcome.refusals.push_back(
          fmt::format("the skin was dragged {}, expected {}: pictures swapped or named wrongly, or the head is not "
                      "where the protocol says",
                      dragDirectionName(measurement.fit->drag_deg.value), dragDirectionName(planned.drag_deg)));
    }
  }
  outcome.accepted = outcome.accepted && outcome.refusals.empty();
  return outcome;
}

PressMeasured measurePress(const Protocol& protocol, const PlannedPress& planned, const PressPictures& pictures,
                           const Photograph& before, const Photograph& after, const Progress& progress) {
  MeasureSettings settings{.spacing_mm = protocol.spacing_mm,
                           .drift_mm = protocol.drift_mm,
                           .head = protocol.head,
                           .contact_px = pictures.contact_px,
                           .partial = protocol.partial};
  std::optional<double> null_drift_mm;
  if (!pictures.before2.empty()) {
    null_drift_mm = nullDrift(before, readPhotograph(pictures.before2), settings);
    settings.drift_mm = std::max(settings.drift_mm, null_drift_mm.value_or(0.0));
  }
  PressMeasured measured{.measurement = measurePair(before, after, settings, progress), .outcome = {}};
  measured.outcome = assessPress(measured.measurement, planned, null_drift_mm);
  return measured;
}

}  // namespace palpate::measure
