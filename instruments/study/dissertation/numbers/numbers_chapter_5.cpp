// Chapter 5 and Appendix C: the interpolation and the measured ellipses.
#include <fmt/format.h>

#include <array>

#include "dissertation/numbers/numbers_study.h"
#include "dissertation/numbers/table_5_1.h"
#include "palpate/base/error.h"
#include "palpate/maps/literal_interpolation.h"
#include "palpate/maps/measured_data.h"
#include "palpate/scene/words.h"

namespace palpate::study {

namespace {

constexpr double kMmPerCm = 10.0;

Vec2 keyPlace(int key) { return {0.0, kTable51Y[static_cast<std::size_t>(key - 1)]}; }

void addFigure59(const PrintedNumbers& printed, const std::string& how, double effect_radius, Rows& rows) {
  const std::string where = "Figure 5.9, e = 400 as " + how;
  const std::string reason = fmt::format("(5.7) over Table 5.1, effect radius {:g} mm (E28)", effect_radius);
  rows.push_back(judged(where, "R(E1)", printed.literal_r_e1, naiveHalfMajor(keyPlace(1), effect_radius), reason));
  rows.push_back(judged(where, "R(E2)", printed.literal_r_e2, naiveHalfMajor(keyPlace(2), effect_radius), reason));
}

void addFigure510(const PrintedNumbers& printed, Rows& rows) {
  for (const double radius : {0.5 * kTable51Diameter, kTable51Diameter}) {
    for (int key = 1; key <= 3; ++key) {
      rows.push_back(judged(fmt::format("Figure 5.10, effect radius {:g} mm", radius), fmt::format("R(E{})", key),
                            printed.exact_r, exactHalfMajor(keyPlace(key), radius), "(5.16) as w = a / (1 - a) (E27)"));
    }
  }
}

// The example in the text: a1 = 1 at P1 itself, 0.26 and 0.18 from the others.
double exampleAtP1() {
  constexpr std::array kLevels{1.0, 0.26, 0.18};
  constexpr std::array kValues{kTable51HalfMajor, kTable51HalfMajor, kTable51HalfMajor};
  return maps::literalBlend(maps::LiteralWeights::single_effects, kLevels, kValues, kTable51Basic).value_or(0.0);
}

void addRatios(const PrintedNumbers& printed, Rows& rows) {
  const auto measured = maps::appendixC();
  if (printed.appendix_c_ratios.size() != measured.size())
    throw Error("Appendix C: expected one printed ratio per row");
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const maps::MeasuredEllipse& row = measured[i];
    const bool swapped = row.major_cm < row.minor_cm;
    rows.push_back(judged(fmt::format("Appendix C, {} P{} subject {}", wordFor(row.force), row.point, row.subject),
                          "ratio", printed.appendix_c_ratios[i], row.majorOverMinor(),
                          swapped ? "the \"major\" axis is the shorter one (E30)" : "major over minor",
                          Source::printed));
  }
}

// The subjects' rows are printed as well: a mean of them is the text's own, though it is the engine that takes it.
void addFromPrinted(const std::string& where, const std::string& what, const std::string& printed, double ours,
                    const std::string& reason, Rows& rows) {
  rows.push_back(judged(where, what, printed, ours, reason, Source::printed));
}

void addMean(const std::string& where, const PrintedMean& printed, const maps::PlainMean& ours, Rows& rows) {
  addFromPrinted(where, "major axis, cm", printed.major_cm, ours.major_cm, "mean of the subjects", rows);
  addFromPrinted(where, "minor axis, cm", printed.minor_cm, ours.minor_cm, "mean of the subjects", rows);
  addFromPrinted(where, "ratio", printed.ratio, ours.major_over_minor, "mean of the unrounded ratios", rows);
  addFromPrinted(where, "degree", printed.degree, ours.direction_deg, "arithmetic mean (E30)", rows);
}

void addMeans(const PrintedNumbers& printed, Rows& rows) {
  std::size_t i = 0;
  for (const auto force : {maps::ForceDirection::up, maps::ForceDirection::down}) {
    for (int point = 1; point <= maps::kMeasuredPoints; ++point) {
      const std::string where = fmt::format("Appendix C, {} P{} Ave", wordFor(force), point);
      addMean(where, printed.appendix_c_means.at(i++), maps::plainMean(maps::measuredAt(force, point)), rows);
    }
  }
}

void addKeys(const PrintedNumbers& printed, Rows& rows) {
  for (int point = 1; point <= maps::kMeasuredPoints; ++point) {
    const PrintedKey& key = printed.keys.at(static_cast<std::size_t>(point - 1));
    const maps::PlainMean mean = maps::plainMean(maps::measuredAt(maps::ForceDirection::up, point));
    const std::string figure = fmt::format("Figure 5.3, P{}", point);
    const std::string of_up = "mean of \"up\"";
    addFromPrinted(figure, "2l, cm", key.figure_major_cm, mean.major_cm, "full axis (E16), " + of_up, rows);
    addFromPrinted(figure, "r", key.figure_ratio, mean.major_over_minor, of_up, rows);
    addFromPrinted(figure, "d, degree", key.figure_degree, mean.direction_deg, of_up, rows);
    const std::string table = fmt::format("Appendix C, last table, P{}", point);
    addFromPrinted(table, "major axis, mm", key.table_major_mm, kMmPerCm * mean.major_cm, "full axis (E16)", rows);
    addFromPrinted(table, "ratio", key.table_ratio, mean.major_over_minor, of_up, rows);
    addFromPrinted(table, "degree", key.table_degree, mean.direction_deg, of_up, rows);
  }
}

}  // namespace

void addInterpolation(const PrintedNumbers& printed, Rows& rows) {
  rows.push_back(judged("5.2.2, (5.10) at P1", "R for the levels 1, 0.26, 0.18", printed.effect_levels_r, exampleAtP1(),
                        "(5.7) with half axes of 120 over a circle of 90"));
  addFigure59(printed, "diameter", 0.5 * kTable51Diameter, rows);
  addFigure59(printed, "radius", kTable51Diameter, rows);
  addFigure510(printed, rows);
}

void addMeasuredEllipses(const PrintedNumbers& printed, Rows& rows) {
  addKeys(printed, rows);
  addRatios(printed, rows);
  addMeans(printed, rows);
}

}  // namespace palpate::study
