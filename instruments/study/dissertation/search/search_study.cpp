// The study of the octree as a search: table, plots and findings out of one measurement.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <algorithm>

#include "dissertation/search/search_measurement.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

std::vector<SearchRow> withThreshold(const SearchMeasurement& found, Index threshold, const std::string& model) {
  std::vector<SearchRow> rows;
  for (const SearchRow& row : found.rows) {
    if (row.threshold == threshold && row.model == model) rows.push_back(row);
  }
  return rows;
}

Series searchSeries(const SearchMeasurement& found, const std::string& name, Index threshold, Marker marker,
                    double SearchRow::*us) {
  const auto rows = withThreshold(found, threshold, "back");
  return measuredSeries(name, column(rows, &SearchRow::triangles), column(rows, us), marker);
}

Plot searchPlot(const SearchMeasurement& found, const std::string& title, double SearchRow::*all,
                double SearchRow::*octree, double SearchRow::*ours) {
  Plot plot{.title = title};
  plot.x = {.label = "triangles of the back", .scale = Scale::logarithmic, .from = 2000.0, .to = 60000.0};
  plot.y = {.label = "time", .unit = "us", .scale = Scale::logarithmic};
  const Index printed = found.plan.thresholds.front();
  plot.series = {searchSeries(found, "everything", printed, Marker::cross, all)};
  constexpr Marker kMarkers[] = {Marker::square, Marker::triangle, Marker::diamond};
  for (std::size_t i = 0; i < found.plan.thresholds.size(); ++i) {
    const Index threshold = found.plan.thresholds[i];
    plot.series.push_back(
        searchSeries(found, fmt::format("octree, leaves of {}", threshold), threshold, kMarkers[i % 3], octree));
  }
  plot.series.push_back(searchSeries(found, "ours", printed, Marker::circle, ours));
  return plot;
}

TextTable searchTable(const SearchMeasurement& found) {
  TextTable table{
      {"model", "vertices", "triangles", "leaves of", "touch: all (us)", "octree (us)", "ours (us)", "triangles tested",
       "wrong", "region: all (us)", "octree (us)", "rings (us)", "vertices moved", "stray", "missed"},
      {}};
  for (const SearchRow& row : found.rows) {
    table.rows.push_back({row.model, fmt::format("{}", row.vertices), fmt::format("{}", row.triangles),
                          fmt::format("{}", row.threshold), rounded(row.touch_all_us), rounded(row.touch_octree_us),
                          rounded(row.touch_ours_us), rounded(row.touch_tested), fmt::format("{}", row.touch_wrong),
                          rounded(row.region_all_us), rounded(row.region_octree_us), rounded(row.region_rings_us),
                          rounded(row.region_vertices), rounded(row.region_stray),
                          fmt::format("{}", row.region_missed)});
  }
  return table;
}

std::vector<std::pair<std::string, double>> searchNumbers(const SearchMeasurement& found) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const SearchRow& row : found.rows) {
    const std::string key = fmt::format("{}_{}_leaves_{}", row.model, row.triangles, row.threshold);
    numbers.emplace_back(key + "_touch_octree_us", row.touch_octree_us);
    numbers.emplace_back(key + "_touch_ours_us", row.touch_ours_us);
    numbers.emplace_back(key + "_region_octree_us", row.region_octree_us);
    numbers.emplace_back(key + "_region_rings_us", row.region_rings_us);
    numbers.emplace_back(key + "_stray_vertices", row.region_stray);
  }
  return numbers;
}

}  // namespace

StudyPage studySearch(const StudySettings& settings) {
  const SearchMeasurement found = measureSearches(searchPlan(settings.quick), settings.progress);
  return {
      .title = "The octree as a search",
      .question =
          "Objective 2 of the text wants the octree \"in detecting the touch point\" and in graphics. What does it "
          "find, and how long does it take, beside the engine's own searches?",
      .findings = searchFindings(found),
      .method =
          {fmt::format("{} places of each model. Touch: the nearest point of the skin within 10 mm for a tip 5 mm "
                       "below it; the octree tests all triangles of the leaves that a sphere of 10 mm meets (3.4.1, "
                       "E11). Region: the vertices of an ellipse no farther than 60 mm; the octree lists the "
                       "triangles of the box around it. Each time is the fastest of some runs.",
                       found.plan.places),
           "Models: the built-in back, and hands with the counts of Appendix A: 1418 vertices with 2818 triangles, "
           "and the nameless one of 1401 with 2786; both counts make a sheet with a border (16 and 14 edges), so "
           "ours is cut open at the wrist. A finger is felt through the octree with contact.source = \"hdb\" in a "
           "scene (`palpate study hdb`) and deformed through it with deformation.search = \"octree\"; by default the "
           "deformation searches along neighbours."},
      .tables = {{"search_table", "Every model and octree.", searchTable(found)}},
      .figures = {{"search_times", "Time of a search over the size of the back.",
                   Figure{.panels = {searchPlot(found, "Touch point", &SearchRow::touch_all_us,
                                                &SearchRow::touch_octree_us, &SearchRow::touch_ours_us),
                                     searchPlot(found, "Vertices of a region", &SearchRow::region_all_us,
                                                &SearchRow::region_octree_us, &SearchRow::region_rings_us)},
                          .columns = 2}}},
      .numbers = searchNumbers(found)};
}

}  // namespace palpate::study
