// Fills in the sentences of search_findings.txt and the verdicts that the numbers decide.
#include "dissertation/search/search_measurement.h"

#include <algorithm>

#include "dissertation_findings_texts.h"

namespace palpate::study {

namespace {

/// Extent over the rows of one threshold.
template <class Value>
Extent extentAt(const SearchMeasurement& found, Index threshold, const Value& value) {
  Extent extent;
  for (const SearchRow& row : found.rows) {
    if (row.threshold == threshold) extent.add(value(row));
  }
  return extent;
}

using Duration = double SearchRow::*;

/// The octree's time of a search against testing everything and against our own way, for each threshold.
FindingValues octreeAgainst(const SearchMeasurement& found, Duration all, Duration octree, Duration ours) {
  FindingValues leaves = FindingValues::array();
  for (const Index threshold : found.plan.thresholds) {
    leaves.push_back(
        {{"threshold", threshold},
         {"gain", extentAt(found, threshold, [&](const SearchRow& row) { return row.*all / row.*octree; })},
         {"behind", extentAt(found, threshold, [&](const SearchRow& row) { return row.*octree / row.*ours; })}});
  }
  return leaves;
}

FindingValues touchPoints(const SearchMeasurement& found) {
  int wrong = 0;
  for (const SearchRow& row : found.rows) wrong += row.touch_wrong;
  return {{"leaves",
           octreeAgainst(found, &SearchRow::touch_all_us, &SearchRow::touch_octree_us, &SearchRow::touch_ours_us)},
          {"wrong", wrong}};
}

FindingValues strayVertices(const SearchMeasurement& found) {
  double back = 0.0;
  double hand = 0.0;
  int missed = 0;
  for (const SearchRow& row : found.rows) {
    double& most = row.model == "back" ? back : hand;
    most = std::max(most, row.region_stray / std::max(1.0, row.region_vertices));
    missed += row.region_missed;
  }
  return {{"back", back}, {"hand", hand}, {"missed", missed}};
}

}  // namespace

std::vector<std::string> searchFindings(const SearchMeasurement& found) {
  const FindingValues regions =
      octreeAgainst(found, &SearchRow::region_all_us, &SearchRow::region_octree_us, &SearchRow::region_rings_us);
  return formatFindings(
      texts::search_findings,
      {{"touch", touchPoints(found)}, {"region", {{"leaves", regions}}}, {"stray", strayVertices(found)}});
}

}  // namespace palpate::study
