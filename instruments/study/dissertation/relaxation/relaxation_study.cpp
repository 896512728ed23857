// The study of relaxation: force over time, force over depth, and the dent's return, as a finger of the product has
// them.
#include "dissertation/studies.h"

#include <fmt/format.h>

#include <algorithm>

#include "dissertation/relaxation/relaxation_measurement.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

// Looks of the skins, in every panel.
constexpr std::array kStrokes = {Stroke::dashed, Stroke::solid, Stroke::dotted};
constexpr std::array kColours = {figures::kInk, figures::kBlue, figures::kVermilion};

Plot heldPlot(const RelaxationMeasurement& found) {
  Plot plot{.title = fmt::format("Held at {} mm", found.depth_mm)};
  plot.x = {.label = "since the finger arrived", .unit = "s", .from = 0.0, .to = heldTimes().back()};
  plot.y = {.label = "force", .unit = "N", .from = 0.0};
  for (std::size_t i = 0; i < found.skins.size(); ++i) {
    plot.series.push_back({.name = found.skins[i].name,
                           .x = heldTimes(),
                           .y = found.skins[i].held_n,
                           .stroke = kStrokes[i],
                           .colour = kColours[i]});
  }
  return plot;
}

Plot cyclePlot(const RelaxationMeasurement& found) {
  Plot plot{.title = "Pressed and let go, as offered"};
  plot.x = {.label = "depth", .unit = "mm", .from = 0.0, .to = found.depth_mm};
  plot.y = {.label = "force", .unit = "N", .from = 0.0};
  const std::size_t middle = found.cycles.size() / 2;
  for (const std::size_t i : {std::size_t{0}, middle, found.cycles.size() - 1}) {
    const PressCycle& cycle = found.cycles[i];
    plot.series.push_back(
        {.name = fmt::format("{} s down", rounded(cycle.stroke_s)), .x = cycle.depth_mm, .y = cycle.force_n});
  }
  return plot;
}

Plot returnPlot(const RelaxationMeasurement& found) {
  Plot plot{.title = "The dent after ten seconds of it"};
  plot.x = {.label = "since the finger left", .unit = "s", .from = 0.0, .to = returnTimes().back()};
  plot.y = {.label = "depth of the skin", .unit = "mm", .from = 0.0};
  for (std::size_t i = 1; i < found.skins.size(); ++i) {
    plot.series.push_back({.name = found.skins[i].name,
                           .x = returnTimes(),
                           .y = found.skins[i].dent_mm,
                           .stroke = kStrokes[i],
                           .colour = kColours[i]});
  }
  return plot;
}

TextTable heldTable(const RelaxationMeasurement& found) {
  TextTable table{{"held (s)"}, {}};
  for (const RelaxingSkin& skin : found.skins) table.headings.push_back(skin.name + " (N)");
  const std::vector<double> times = heldTimes();
  for (const double shown : {0.0, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) {
    std::vector<std::string> row = {fmt::format("{}", shown)};
    for (const RelaxingSkin& skin : found.skins) {
      row.push_back(fmt::format("{:.3f}", skin.held_n.front() * (1.0 - lostForceShare(skin, shown))));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

TextTable cycleTable(const RelaxationMeasurement& found) {
  TextTable table{{"down (s)", "greatest force (N)", "work lost (%)"}, {}};
  for (const PressCycle& cycle : found.cycles) {
    table.rows.push_back({fmt::format("{}", cycle.stroke_s),
                          fmt::format("{:.3f}", *std::max_element(cycle.force_n.begin(), cycle.force_n.end())),
                          fmt::format("{:.2f}", 100.0 * cycle.lost_share)});
  }
  return table;
}

double leastLost(const RelaxationMeasurement& found) {
  double least = found.cycles.front().lost_share;
  for (const PressCycle& cycle : found.cycles) least = std::min(least, cycle.lost_share);
  return least;
}

}  // namespace

StudyPage studyRelaxation(const StudySettings& settings) {
  const RelaxationMeasurement found = measureRelaxation(settings.quick, settings.progress);
  const RelaxingSkin& offered = found.skins.at(1);
  return {.title = "Skin that gives way in time",
          .question =
              "Tissue that is held pushes less and less, and comes back late. The dissertation's skin knows no time. "
              "What does the option `relaxation` change for a hand: how much force is lost, what does a press cost, "
              "what of the skin stays behind, and does friction remain what it was?",
          .findings = relaxationFindings(found),
          .method = {"A flat sheet of layered tissue, 40 mm over the bone with 8 mm of fat, felt by the product's own "
                     "finger, a point, at 1 kHz (`contact::step`). The force of a press of 200 mm/s is the first. "
                     "Nothing is drawn and no device limits the force.",
                     "As offered is a share of 0.15 in 1 s; dead beef is 0.26 in 0.40 s and 0.31 in 4.4 s, fitted to "
                     "recordings of beef on a board. Neither is a living back, of which no open recording was found "
                     "(docs/explanation/force-laws.md).",
                     "Work is the sum over ticks of mean force times motion. A cycle goes down and up as a cosine."},
          .tables = {{"relaxation_held", "Force of a press that is held.", heldTable(found)},
                     {"relaxation_cycles", "What a press and its release lose, as offered.", cycleTable(found)}},
          .figures = {{"relaxation",
                       "Force over time of a press that is held; force over depth at three paces; the dent after the "
                       "finger has left.",
                       Figure{.panels = {heldPlot(found), cyclePlot(found), returnPlot(found)}, .columns = 3}}},
          .numbers = {{"force_at_once_n", offered.held_n.front()},
                      {"lost_after_0_5_s", lostForceShare(offered, 0.5)},
                      {"lost_after_10_s", lostForceShare(offered, 10.0)},
                      {"dent_mm", offered.dent_mm.front()},
                      {"work_lost_share_least", leastLost(found)},
                      {"friction_ratio_low", offered.friction_low},
                      {"friction_ratio_high", offered.friction_high}}};
}

}  // namespace palpate::study
