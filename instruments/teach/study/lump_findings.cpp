// Fills in the sentences of lump_findings.txt and the verdicts that the numbers decide.
#include <algorithm>
#include <cmath>

#include "teach/study/lump_measurement.h"
#include "teach_findings_texts.h"

namespace palpate::study {

namespace {

FindingValues groupValues(const ExaminedGroup& group, double bar_points) {
  FindingValues found = FindingValues::array();
  std::vector<double> fitted;
  for (const DetectionFigure& figure : group.figures) {
    if (figure.fitted) {
      fitted.push_back(figure.printed);
    } else if (std::isfinite(figure.printed)) {
      found.push_back({{"words", figure.words}, {"found", figure.found}, {"printed", figure.printed}});
    }
  }
  const double worst = group.worstPoints();
  return {{"words", group.words},
          {"fitted", fitted},
          {"found", found},
          {"near", worst <= bar_points},
          {"worst", worst},
          {"bar", bar_points},
          {"weber", group.observer.pattern_weber},
          {"spread", group.observer.spread}};
}

FindingValues depthOf1985(const ExaminedGroup& group) {
  constexpr double kNoticed = 10.0;  // points: less would hardly be an effect among 80 people
  const double medium = group.figure("medium").found;
  const double deep = group.figure("deep").found;
  return {{"medium", medium}, {"deep", deep}, {"missed", std::abs(medium - deep) > kNoticed}};
}

FindingValues twoThresholds(const ExaminedGroup& later) {
  constexpr double kSame = 10.0;  // points
  const bool same = std::abs(later.expected_easiest - 94.0) < kSame && std::abs(later.expected_hardest - 4.0) < kSame;
  return {{"apart", !same}, {"easy", later.expected_easiest}, {"hard", later.expected_hardest}};
}

FindingValues forceAlone(const ExaminedGroup& later, const ExaminedGroup& earlier) {
  const double shortfall = std::min(later.expected_mean - later.force_only_mean,  //
                                    earlier.expected_mean - earlier.force_only_mean);
  constexpr double kFarOff = 15.0;  // points
  return {{"mean", {later.force_only_mean, earlier.force_only_mean}},
          {"smallest", {later.force_only_smallest, earlier.force_only_smallest}},
          {"with", {later.expected_mean, earlier.expected_mean}},
          {"small_printed", {later.figure("size_0_3").printed, earlier.figure("size_0_3").printed}},
          {"explains", shortfall < kFarOff}};
}

const CueRow& findCueRow(const LumpMeasurement& found, double diameter_mm, double young_kpa) {
  const auto row = std::find_if(found.cues.begin(), found.cues.end(), [&](const CueRow& one) {
    return one.diameter_mm == diameter_mm && one.young_kpa == young_kpa;
  });
  return row != found.cues.end() ? *row : found.cues.front();
}

FindingValues hardnessAndSize(const LumpMeasurement& found) {
  const SiliconeSet& set = found.set;
  const auto pattern = [&](std::size_t size, std::size_t hardness) {
    return findCueRow(found, set.diameters_mm[size], set.young_kpa[hardness]).by_depth[0].pattern;
  };
  const double hardness = pattern(1, 2) / pattern(1, 0);
  const double size = pattern(2, 1) / pattern(0, 1);
  return {{"hardness", hardness}, {"size", size}, {"saturates", 3.0 * hardness < size}};
}

FindingValues presses(const std::vector<TwoPresses>& rows, double most_by_force, double least_by_pattern) {
  FindingValues told = FindingValues::array();
  for (const TwoPresses& row : rows) {
    const bool printed = std::isfinite(row.printed);
    told.push_back({{"words", row.words}, {"found", row.found}, {"printed", printed ? row.printed : 0.0}});
  }
  const auto taxels4 = std::find_if(rows.begin(), rows.end(), [](const TwoPresses& row) { return row.taxels == 4; });
  return {{"told", told}, {"contrast", rows.front().found <= most_by_force && taxels4->found >= least_by_pattern}};
}

FindingValues assumptions(const LumpMeasurement& found) {
  if (found.otherwise.empty()) return nullptr;
  constexpr double kFirm = 5.0;  // points
  struct Change {
    double points = 0.0;
    std::string words;
  };
  std::vector<Change> changes;
  const ExaminedGroup& later = found.groups.front();
  for (const AssumedOtherwise& row : found.otherwise) {
    Change change{.words = row.words};
    for (std::size_t i = 0; i < row.expected.size(); ++i) {
      change.points = std::max(change.points, std::abs(row.expected[i] - later.figures[i].expected));
    }
    changes.push_back(std::move(change));
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.points > b.points; });
  return {{"cases", changes.size()},
          {"worst", changes[0].points},
          {"which", changes[0].words},
          {"others", changes.size() > 1 ? changes[1].points : 0.0},
          {"firm", changes[0].points < kFirm}};
}

}  // namespace

std::vector<std::string> lumpFindings(const LumpMeasurement& found) {
  const ExaminedGroup& later = found.groups.at(0);
  const ExaminedGroup& earlier = found.groups.at(1);
  return formatFindings(
      texts::lump_findings,
      {{"group",
        {groupValues(later, LumpMeasurement::kLaterBarPoints), groupValues(earlier, LumpMeasurement::k1985BarPoints)}},
       {"depth", depthOf1985(earlier)},
       {"two", twoThresholds(later)},
       {"force", forceAlone(later, earlier)},
       {"hardness", hardnessAndSize(found)},
       {"presses", presses(found.detection, 65.0, 90.0)},
       {"sizes", presses(found.sizes, 70.0, 85.0)},
       {"otherwise", assumptions(found)}});
}

}  // namespace palpate::study
