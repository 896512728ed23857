// The study of the profile's array: sweep the sizes, look at the skin, time the look-up, state the findings.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dissertation/profile/array_quality.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

using tissue::TableLookup;

SkinSection sectionWith(double spacing_mm) { return {.spacing_mm = spacing_mm}; }

ArraySweep sweep(TableLookup lookup, double spacing_mm) {
  ArraySweep all;
  for (const int entries : kArraySizes) all.push_back(arrayQuality(entries, lookup, sectionWith(spacing_mm)));
  return all;
}

LookupTimes timings(bool quick) {
  LookupTimes timing;
  for (const int entries : kArraySizes) {
    timing.nearest.push_back(lookupNanoseconds(entries, TableLookup::nearest, quick));
    timing.linear.push_back(lookupNanoseconds(entries, TableLookup::linear, quick));
  }
  timing.closed = closedFormNanoseconds(quick);
  return timing;
}

ProfileResults measuredProfiles(const StudySettings& settings) {
  ProfileResults results;
  for (std::size_t i = 0; i < kVertexSpacings.size(); ++i) {
    report(settings.progress, "pressing skin through arrays", static_cast<double>(i) / kVertexSpacings.size());
    results.nearest[i] = sweep(TableLookup::nearest, kVertexSpacings[i]);
    results.linear[i] = sweep(TableLookup::linear, kVertexSpacings[i]);
  }
  report(settings.progress, "timing look-ups", 0.9);
  results.timing = timings(settings.quick);
  return results;
}

// --- figures

Series skinSeries(const std::string& name, const tissue::ProfileCurve& curve, double from, double to) {
  const SkinSection section;
  constexpr int kPoints = 1500;
  Series series{.name = name};
  for (int i = 0; i <= kPoints; ++i) {
    const double r = from + (to - from) * i / kPoints;
    series.x.push_back(r);
    series.y.push_back(-section.depth_mm * curve.at(r / section.radius_mm).value);
  }
  return series;
}

Plot skinPlot(const std::string& title, double from, double to) {
  Plot plot{.title = title};
  plot.x = {.label = "distance from the finger", .unit = "mm", .from = from, .to = to};
  plot.y = {.label = "height of the skin", .unit = "mm"};
  return plot;
}

// The whole section with the smallest array, and a few millimetres of the wall with the others.
Figure sectionFigure() {
  Plot whole = skinPlot("20 entries, from the finger to the rim", 0.0, 150.0);
  whole.series = {skinSeries("nearest (4.3)", arrayProfile(20, TableLookup::nearest), 0.0, 150.0),
                  skinSeries("linear", arrayProfile(20, TableLookup::linear), 0.0, 150.0),
                  skinSeries("half Gaussian", closedProfile(), 0.0, 150.0)};
  Plot near = skinPlot("Eight millimetres of the steepest wall", 39.0, 47.0);
  near.series = {skinSeries("130, nearest", arrayProfile(130, TableLookup::nearest), 39.0, 47.0),
                 skinSeries("700, nearest", arrayProfile(700, TableLookup::nearest), 39.0, 47.0),
                 skinSeries("130, linear", arrayProfile(130, TableLookup::linear), 39.0, 47.0)};
  for (Plot* plot : {&whole, &near}) {
    plot->series[2].stroke = Stroke::dashed;
    plot->series[2].colour = figures::kInk;
    plot->series[2].width_px = 1.2;
  }
  return {.panels = {whole, near}, .columns = 2};
}

// A square of skin pressed in the middle.
figures::MeshView pressedPatch(const std::string& title, const tissue::ProfileCurve& curve, double spacing_mm) {
  const SkinSection section;
  const int cells = static_cast<int>(2.0 * 1.1 * section.radius_mm / spacing_mm);
  figures::MeshView view{.title = title};
  view.towards_viewer = Vec3(0.35, -1.0, 0.55);
  view.up = Vec3::UnitZ();
  view.ambient = 0.1;
  view.scale_bar = false;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      const Vec2 at = spacing_mm * (Vec2(column, row) - Vec2::Constant(0.5 * cells));
      const double height = -4.0 * section.depth_mm * curve.at(at.norm() / section.radius_mm).value;
      view.positions.emplace_back(at.x(), at.y(), height);
    }
  }
  const auto corner = [cells](int row, int column) { return static_cast<Index>(row * (cells + 1) + column); };
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      view.triangles.push_back({corner(row, column), corner(row, column + 1), corner(row + 1, column + 1)});
      view.triangles.push_back({corner(row, column), corner(row + 1, column + 1), corner(row + 1, column)});
    }
  }
  return view;
}

Figure surfaceFigure(bool quick) {
  const double spacing = quick ? 15.0 : 2.5;
  Figure figure{.columns = 2, .panel_width_px = 460.0, .panel_height_px = 300.0};
  for (const int entries : kPrintedArrays) {
    figure.panels.emplace_back(pressedPatch(fmt::format("{} entries, nearest", entries),
                                            arrayProfile(entries, TableLookup::nearest), spacing));
  }
  figure.panels.emplace_back(pressedPatch("130 entries, linear", arrayProfile(130, TableLookup::linear), spacing));
  figure.note = "Heights four times enlarged; flat triangles of 2.5 mm, so that every step is seen.";
  return figure;
}

template <class Value>
Series sweepSeries(const std::string& name, const ArraySweep& all, Marker marker, const Value& value) {
  Series series{.name = name, .marker = marker};
  for (const ArrayQuality& one : all) {
    series.x.push_back(one.entries);
    series.y.push_back(value(one));
  }
  return series;
}

Plot sizePlot(const std::string& title, const std::string& label, const std::string& unit) {
  Plot plot{.title = title};
  plot.x = {.label = "entries of the array", .scale = figures::Scale::logarithmic};
  plot.y = {.label = label, .unit = unit, .scale = figures::Scale::logarithmic};
  return plot;
}

Series level(const std::string& name, double value) {
  return {.name = name,
          .x = {static_cast<double>(kArraySizes.front()), static_cast<double>(kArraySizes.back())},
          .y = {value, value},
          .stroke = Stroke::dotted,
          .colour = figures::kInk,
          .width_px = 1.2};
}

// The sizes that the dissertation compares, on a curve.
Series printedSizes(const ArraySweep& all) {
  Series printed{.name = "sizes of Figure 4.9", .stroke = Stroke::none, .marker = Marker::diamond};
  printed.colour = figures::kInk;
  for (const int entries : kPrintedArrays) {
    printed.x.push_back(entries);
    printed.y.push_back(ofSize(all, entries).error_mm);
  }
  return printed;
}

Plot errorPlot(const ProfileResults& results) {
  const auto error = [](const ArrayQuality& one) { return one.error_mm; };
  Plot plot = sizePlot("Largest error, pressed 10 mm deep", "error", "mm");
  plot.series = {sweepSeries("nearest (4.3)", results.nearest[0], Marker::circle, error),
                 sweepSeries("linear", results.linear[0], Marker::square, error), printedSizes(results.nearest[0]),
                 level(fmt::format("a pixel, life-size: {} mm", kPixelMm), kPixelMm)};
  return plot;
}

Plot turnPlot(const ProfileResults& results) {
  const auto turn = [](const ArrayQuality& one) { return one.turn_deg; };
  Plot plot = sizePlot("Turn of the normal that the array adds", "turn", "degree");
  for (std::size_t i = 0; i < kVertexSpacings.size(); ++i) {
    const std::string vertices = fmt::format("vertices every {} mm", kVertexSpacings[i]);
    Series nearest = sweepSeries("nearest, " + vertices, results.nearest[i], Marker::circle, turn);
    Series linear = sweepSeries("linear, " + vertices, results.linear[i], Marker::square, turn);
    nearest.colour = linear.colour = figures::seriesColour(i);
    linear.stroke = Stroke::dashed;
    plot.series.push_back(nearest);
    plot.series.push_back(linear);
  }
  plot.series.push_back(level("1 % of brightness", kVisibleTurnDeg));
  return plot;
}

Plot timePlot(const LookupTimes& timing) {
  Plot plot = sizePlot("One look-up", "time", "ns");
  plot.y.scale = figures::Scale::linear;
  plot.y.from = 0.0;
  const std::vector<double> sizes(kArraySizes.begin(), kArraySizes.end());
  plot.series = {{.name = "nearest (4.3)", .x = sizes, .y = timing.nearest, .marker = Marker::circle},
                 {.name = "linear", .x = sizes, .y = timing.linear, .marker = Marker::square},
                 level("no array: the exponential", timing.closed)};
  return plot;
}

Figure sweepFigure(const ProfileResults& results) {
  return {.panels = {errorPlot(results), turnPlot(results), timePlot(results.timing)},
          .columns = 3,
          .panel_width_px = 400.0,
          .panel_height_px = 400.0};
}

// --- words

StudyTable qualityTable(const ProfileResults& results) {
  StudyTable table{"profile_arrays", "What each array does to skin pressed 10 mm deep over a radius of 150 mm:", {}};
  table.table.headings = {"entries",
                          "look-up",
                          "largest error mm",
                          "largest step mm",
                          "second difference mm",
                          "turn of the normal, 9.7 mm mesh",
                          "1 mm mesh",
                          "0.25 mm mesh",
                          "ns"};
  for (const bool linear : {false, true}) {
    const auto& sweeps = linear ? results.linear : results.nearest;
    const auto& times = linear ? results.timing.linear : results.timing.nearest;
    for (std::size_t i = 0; i < kArraySizes.size(); ++i) {
      const ArrayQuality& fine = sweeps[1][i];
      table.table.rows.push_back(
          {fmt::format("{}", kArraySizes[i]), linear ? "linear" : "nearest", rounded(fine.error_mm, 3),
           rounded(fine.step_mm, 3), rounded(fine.second_difference_mm, 3), rounded(sweeps[0][i].turn_deg) + " deg",
           rounded(fine.turn_deg) + " deg", rounded(sweeps[2][i].turn_deg) + " deg", fmt::format("{:.2f}", times[i])});
    }
  }
  const ArrayQuality own = curveQuality(sectionWith(1.0));
  table.table.rows.push_back({"none", "exponential", "0", "0", rounded(own.second_difference_mm, 3), "", "", "",
                              fmt::format("{:.2f}", results.timing.closed)});
  return table;
}

std::vector<std::pair<std::string, double>> numbersOf(const ProfileResults& results) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const int entries : kPrintedArrays) {
    const std::string size = fmt::format("{}", entries);
    numbers.emplace_back("error_mm_nearest_" + size, ofSize(results.nearest[0], entries).error_mm);
    numbers.emplace_back("error_mm_linear_" + size, ofSize(results.linear[0], entries).error_mm);
    numbers.emplace_back("turn_deg_nearest_" + size, ofSize(results.nearest[1], entries).turn_deg);
    numbers.emplace_back("turn_deg_linear_" + size, ofSize(results.linear[1], entries).turn_deg);
    numbers.emplace_back("lookup_ns_nearest_" + size, results.timing.nearest[indexOf(entries)]);
    numbers.emplace_back("lookup_ns_linear_" + size, results.timing.linear[indexOf(entries)]);
  }
  numbers.emplace_back("closed_form_ns", results.timing.closed);
  numbers.emplace_back("order_nearest", -convergenceSlope(results.nearest[0]));
  numbers.emplace_back("order_linear", -convergenceSlope(results.linear[0]));
  return numbers;
}

}  // namespace

StudyPage studyProfile(const StudySettings& settings) {
  const ProfileResults results = measuredProfiles(settings);
  return {
      .title = "The array of the half Gaussian",
      .question =
          "The dissertation stores the half Gaussian in an array and takes the nearest entry (4.3). Figure 4.9 "
          "compares 20, 130 and 700 entries by eye and chooses 700. How large must the array be, and is the nearest "
          "entry the right one?",
      .findings = profileFindings(results),
      .method = {"A section of skin from the finger to the rim, 150 mm long as the measured half axes are, is pressed "
                 "10 mm deep with the array and with the curve itself. The error is the largest distance between the "
                 "two; the step is what two neighbouring vertices differ beyond the curve's own slope; the turn is the "
                 "change of the normal from facet to facet beyond the curve's own. The vertices are shifted by eighths "
                 "of their distance and the worst counts.",
                 "Times are of a bare look-up at 4096 scattered places, best of nine runs; they vary with the machine. "
                 "Figure 4.9 prints no numbers: its sizes are marked on our curves."},
      .tables = {qualityTable(results)},
      .figures =
          {{"profile_sweep", "Error, turn of the normal and time over the size of the array.", sweepFigure(results)},
           {"profile_surfaces",
            "Figure 4.9 again: pressed skin through the three arrays, and through 130 entries read between them.",
            surfaceFigure(settings.quick)},
           {"profile_sections", "Sections of the same skin: what a step is.", sectionFigure()}},
      .numbers = numbersOf(results)};
}

}  // namespace palpate::study
