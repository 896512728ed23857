// Times over all models, what was found twice over, and what was found too much, put into words.
#include "dissertation/search/search_measurement.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/page/study_page.h"

namespace palpate::study {

namespace {

/// Of the rows of one threshold.
template <class Value>
Extent extentAt(const SearchMeasurement& found, Index threshold, const Value& value) {
  Extent extent;
  for (const SearchRow& row : found.rows) {
    if (row.threshold == threshold) extent.add(value(row));
  }
  return extent;
}

std::string times(const Extent& extent) { return fmt::format("{} to {}", rounded(extent.least), rounded(extent.most)); }

/// Of one search: the times of three ways to do it, and what those beside the octree are called.
struct ThreeWays {
  double SearchRow::*all;
  double SearchRow::*octree;
  double SearchRow::*ours;
  const char* all_name;
  const char* ours_name;
};

std::string octreesBeside(const SearchMeasurement& found, const ThreeWays& way) {
  std::string octrees;
  for (const Index threshold : found.plan.thresholds) {
    const Extent gain =
        extentAt(found, threshold, [&](const SearchRow& row) { return row.*way.all / row.*way.octree; });
    const Extent behind =
        extentAt(found, threshold, [&](const SearchRow& row) { return row.*way.octree / row.*way.ours; });
    octrees +=
        fmt::format("{}with leaves of {} it is {} times as fast as {} and takes {} times as long as {}",
                    octrees.empty() ? "" : "; ", threshold, times(gain), way.all_name, times(behind), way.ours_name);
  }
  return octrees;
}

std::string touchFinding(const SearchMeasurement& found) {
  int wrong = 0;
  for (const SearchRow& row : found.rows) wrong += row.touch_wrong;
  return fmt::format(
      "The touch point by the octree: {}. It finds {}.",
      octreesBeside(found, {&SearchRow::touch_all_us, &SearchRow::touch_octree_us, &SearchRow::touch_ours_us,
                            "testing every triangle", "the engine's triangle tree"}),
      wrong == 0 ? "the same point everywhere" : fmt::format("another point at {} places", wrong));
}

std::string searchRegionFinding(const SearchMeasurement& found) {
  return fmt::format(
      "The vertices of an ellipse of 60 x 45 mm by the octree, for graphics: {}.",
      octreesBeside(found, {&SearchRow::region_all_us, &SearchRow::region_octree_us, &SearchRow::region_rings_us,
                            "asking every vertex", "our rings of neighbours"}));
}

std::string strayFinding(const SearchMeasurement& found) {
  double back = 0.0;
  double hand = 0.0;
  int missed = 0;
  for (const SearchRow& row : found.rows) {
    double& most = row.model == "back" ? back : hand;
    most = std::max(most, row.region_stray / std::max(1.0, row.region_vertices));
    missed += row.region_missed;
  }
  const char* which = hand > 0.0 ? " (other fingers and the far side, which must not move: E23)" : "";
  return fmt::format(
      "The octree knows places, not neighbours. On the back it finds {} more vertices than hang together with the "
      "contact and face it, on the hand {}{}. It misses {} of ours.",
      percent(back), percent(hand), which, missed == 0 ? "none" : counted(missed));
}

}  // namespace

std::vector<std::string> searchFindings(const SearchMeasurement& found) {
  return {touchFinding(found), searchRegionFinding(found), strayFinding(found)};
}

}  // namespace palpate::study
