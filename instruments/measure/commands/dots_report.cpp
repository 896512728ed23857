#include "measure/commands/dots_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/kit/json.h"
#include "palpate/base/json.h"
#include "palpate/base/nearest_name.h"
#include "palpate/measure/field/field_form.h"
#include "palpate/measure/key_row.h"
#include "palpate/measure/overlay.h"
#include "palpate/measure/skin_chart.h"

namespace palpate::app {

namespace {

using measure::Estimate;
using measure::FieldFit;
using measure::KeyEllipse;
using measure::Measurement;

std::string words(const Estimate& estimate, int digits) {
  return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, digits, estimate.sd, digits);
}

std::string ellipseLine(const KeyEllipse& key) {
  if (!(key.half_major_mm.value > 0.0)) return fmt::format("  {:g} mm      nowhere: the peak is lower\n", key.level_mm);
  return fmt::format("  {:g} mm      half axes {} and {} mm, ratio {}, direction {} degrees\n", key.level_mm,
                     words(key.half_major_mm, 1), words(key.half_minor_mm, 1), words(key.major_over_minor, 3),
                     words(key.direction_deg, 1));
}

std::string describeTail(const FieldFit& fit) {
  const Estimate& k = fit.inverse_tail;
  if (fit.field.form != measure::FieldForm::smooth)
    return fmt::format("{} of the form \"{}\"", words(k, 2), measure::nameOf(fit.field.form));
  std::string text = fmt::format("1/P = {}", words(k, 2));
  if (k.value > 0.01) text += fmt::format(" (P {:.2f})", 1.0 / k.value);
  if (fit.gaussian_rim_mm) text += fmt::format(", rim of the half Gaussian {:.0f} mm", *fit.gaussian_rim_mm);
  return text;
}

std::string fitText(const Measurement& m) {
  const FieldFit& fit = *m.fit;
  std::string text = ellipseLine(fit.at_2_mm) + ellipseLine(fit.at_4_mm);
  if (m.chart && fit.at_2_mm.half_major_mm.value > 0.0) {
    const Vec2 contact_px = m.chart->pictureAt(fit.field.contact_mm);
    text += fmt::format("  contact   at {:.1f},{:.1f} px of the first picture, ± {:.1f} and {:.1f} mm\n",
                        contact_px.x(), contact_px.y(), fit.contact_x_mm.sd, fit.contact_y_mm.sd);
  }
  text += fmt::format("  peak      {}, dragged towards {} degrees; tail {}\n",
                      fit.peak_mm ? words(*fit.peak_mm, 1) + " mm" : "not seen by any dot", words(fit.drag_deg, 1),
                      describeTail(fit));
  text += fmt::format(
      "  body      moved {:.2f} mm between the pictures, turned {:.2f} degrees, {:+.2f} % in size; {:.1f} of "
      "the sd allowed\n",
      fit.drift.length_mm, fit.drift.turn_deg, fit.drift.scale_percent, fit.drift.in_sd);
  return text;
}

std::string contourText(const measure::ContourReading& contour) {
  std::string text = fmt::format("  contour   half chord {:.1f}, across it {:.1f} mm, {:.1f} degrees",
                                 contour.half_chord_mm, contour.half_across_mm, contour.chord_deg);
  if (contour.ellipse) {
    text += fmt::format("; its ellipse {:.1f} and {:.1f} mm", contour.ellipse->half_major_mm,
                        contour.ellipse->half_major_mm * contour.ellipse->aspect);
  }
  text += fmt::format("; {:.0f} % within the dots (the dissertation's reading){}\n", 100.0 * contour.inside_share,
                      contour.differs ? " * differs by more than 2 sd" : "");
  return text;
}

std::string dotsText(const Measurement& m) {
  std::string text =
      fmt::format("  dots      {} in order, {} found again, {} hidden, {} strays", m.grid.dots.size(), m.matched,
                  m.grid.dots.size() - std::min(m.grid.dots.size(), m.matched), m.grid.strays.size());
  if (m.fit) text += fmt::format("; {:.2f} mm unexplained", m.fit->residual_rms_mm);
  return text + "\n";
}

Json json(const Estimate& estimate) { return {{"value", estimate.value}, {"sd", estimate.sd}}; }
Json json(const Vec2& v) { return {v.x(), v.y()}; }

Json json(const KeyEllipse& key) {
  return {{"level_mm", key.level_mm},
          {"half_major_mm", json(key.half_major_mm)},
          {"half_minor_mm", json(key.half_minor_mm)},
          {"major_over_minor", json(key.major_over_minor)},
          {"direction_deg", json(key.direction_deg)}};
}

Json json(const measure::Drift& drift) {
  return {{"right_mm", json(drift.right_mm)},     {"headwards_mm", json(drift.headwards_mm)},
          {"scale_percent", drift.scale_percent}, {"turn_deg", drift.turn_deg},
          {"length_mm", drift.length_mm},         {"in_sd", drift.in_sd}};
}

Json json(const measure::SkinField& field) {
  return {{"contact_mm", json(field.contact_mm)},
          {"log_shape", {field.log_shape.x(), field.log_shape.y(), field.log_shape.z()}},
          {"peak_mm", json(field.peak_mm)},
          {"inverse_tail", field.inverse_tail},
          {"sideways", field.sideways},
          {"form", measure::nameOf(field.form)}};
}

Json formsJson(const FieldFit& fit) {
  Json forms = Json::object();
  for (const measure::FormShare& form : fit.forms) forms[measure::nameOf(form.form)] = form.share;
  return forms;
}

Json json(const Measurement& m, const FieldFit& fit) {
  Json fitted = {{"at_2_mm", json(fit.at_2_mm)},
                 {"at_4_mm", json(fit.at_4_mm)},
                 {"contact_x_mm", json(fit.contact_x_mm)},
                 {"contact_y_mm", json(fit.contact_y_mm)},
                 {"peak_mm", fit.peak_mm ? json(*fit.peak_mm) : Json(nullptr)},
                 {"drag_deg", json(fit.drag_deg)},
                 {"inverse_tail", json(fit.inverse_tail)},
                 {"sideways", json(fit.sideways)},
                 {"drift", json(fit.drift)},
                 {"residual_rms_mm", fit.residual_rms_mm},
                 {"residual_pattern", fit.residual_pattern},
                 {"forms", formsJson(fit)},
                 {"gaussian_rim_mm", orNull(fit.gaussian_rim_mm)},
                 {"inside_share", fit.inside_share},
                 {"field", json(fit.field)}};
  if (m.chart) fitted["contact_px"] = json(m.chart->pictureAt(fit.field.contact_mm));
  return fitted;
}

Json json(const std::vector<Vec2>& places) {
  auto list = Json::array();
  for (const Vec2& place : places) list.push_back(json(place));
  return list;
}

Json json(const measure::ContourReading& contour) {
  Json read = {{"half_chord_mm", contour.half_chord_mm},
               {"half_across_mm", contour.half_across_mm},
               {"chord_deg", contour.chord_deg},
               {"inside_share", contour.inside_share},
               {"differs", contour.differs},
               {"ellipse", nullptr}};
  if (contour.ellipse) {
    read["ellipse"] = {{"half_major_mm", contour.ellipse->half_major_mm},
                       {"aspect", contour.ellipse->aspect},
                       {"direction_deg", contour.ellipse->direction_rad * 180.0 / std::numbers::pi}};
  }
  read["contour_2_mm"] = json(contour.contour_2_mm);
  read["contour_4_mm"] = json(contour.contour_4_mm);
  return read;
}

Json json(const measure::MeasuredDot& dot) {
  return {{"column", dot.site.column},        {"row", dot.site.row},
          {"before_px", json(dot.before_px)}, {"after_px", dot.after_px ? json(*dot.after_px) : Json(nullptr)},
          {"skin_mm", json(dot.skin_mm)},     {"moved_mm", json(dot.moved_mm)},
          {"drift_mm", json(dot.drift_mm)},   {"residual_mm", dot.residual_mm}};
}

Json settingsJson(const measure::MeasureSettings& settings) {
  const char* const head[] = {"top", "left", "bottom", "right"};
  return {{"spacing_mm", settings.spacing_mm},
          {"drift_mm", settings.drift_mm},
          {"up", head[static_cast<std::size_t>(settings.head)]},
          {"contact_px", settings.contact_px ? json(*settings.contact_px) : Json(nullptr)},
          {"partial", settings.partial}};
}

Json findingsJson(const Measurement& m) {
  auto list = Json::array();
  for (const measure::Finding& finding : m.findings) {
    const char* severity = finding.severity == measure::Severity::refusal ? "refusal" : "warning";
    list.push_back({{"severity", severity}, {"code", finding.code}, {"text", finding.text}});
  }
  return list;
}

}  // namespace

std::string reportText(const Measurement& measurement, const MeasuredPair& pair) {
  const Measurement& m = measurement;
  std::string text = fmt::format("{}: {}\n", pair.name, m.accepted() ? "accepted" : "REFUSED, not to be used");
  if (m.fit) text += fitText(m);
  if (m.contour) text += contourText(*m.contour);
  text += dotsText(m);
  if (pair.null_drift_mm) {
    text += fmt::format("  null      the body moved {:.2f} mm between two pictures before the press\n",
                        *pair.null_drift_mm);
  }
  if (pair.seconds_between) text += fmt::format("  time      {:.1f} s between the pictures\n", *pair.seconds_between);
  if (!pair.place_mm && m.fit) text += "  place     not given (--at): the row of key points says 0,0\n";
  for (const std::string& note : pair.notes) text += fmt::format("  note: {}\n", note);
  for (const std::string& finding : measure::buildOverlay(m).findings) text += fmt::format("  {}\n", finding);
  return text;
}

Json reportJson(const Measurement& measurement, const MeasuredPair& pair) {
  const Measurement& m = measurement;
  Json report = {{"name", pair.name}, {"accepted", m.accepted()}, {"input", pair.files}};
  report["place_mm"] = pair.place_mm ? json(*pair.place_mm) : Json(nullptr);
  report["findings"] = findingsJson(m);
  report["fit"] = m.fit ? json(m, *m.fit) : Json(nullptr);
  report["contour"] = m.contour ? json(*m.contour) : Json(nullptr);
  report["settings"] = settingsJson(m.settings);
  report["null_drift_mm"] = orNull(pair.null_drift_mm);
  report["seconds_between"] = orNull(pair.seconds_between);
  report["notes"] = pair.notes;
  report["width_px"] = m.width_px;
  report["height_px"] = m.height_px;
  report["ink"] = {{"hue_deg", m.ink.hue_rad * 180.0 / std::numbers::pi}, {"peak_chroma", m.ink.peak_chroma}};
  report["grid"] = {
      {"dots", m.grid.dots.size()},      {"strays", m.grid.strays.size()},      {"matched", m.matched},
      {"spacing_px", m.grid.spacing_px}, {"irregularity", m.grid.irregularity}, {"roll_deg", m.grid.roll_deg}};
  report["dots"] = Json::array();
  for (const measure::MeasuredDot& dot : m.dots) report["dots"].push_back(json(dot));
  report["seconds"] = m.seconds;
  return report;
}

std::string keyTable(const Measurement& measurement, const MeasuredPair& pair) {
  std::string table = measure::keyRowHeader();
  const std::string row = measure::keyRow(measurement, pair.name, pair.place_mm.value_or(Vec2::Zero()));
  if (measurement.accepted()) return table + row;
  table += fmt::format("# {}\n", oneLine(measure::buildOverlay(measurement).verdict, 1000));
  return row.empty() ? table : table + "# " + row;
}

}  // namespace palpate::app
