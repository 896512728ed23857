// Figures 3.1, 3.10 and 3.16 to 3.18: the rates that the author measured in 2008, as printed.
#include "dissertation/figures/dissertation_figures.h"
#include "dissertation/numbers/number_row.h"
#include "dissertation/numbers/printed_numbers.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

constexpr const char* kOwnRates =
    "Measured in 2008 on the author's computer; `palpate study bench` measures this engine.";

Plot ratePlot(const std::string& title, const std::string& label, const std::string& unit) {
  Plot plot{.title = title};
  plot.x = {.label = "triangles"};
  plot.y = {.label = label, .unit = unit, .from = 0.0};
  plot.x.from = 0.0;
  return plot;
}

Figure figure31() {
  Series haptic{.name = "haptic, touched (printed)", .stroke = figures::Stroke::dashed, .marker = Marker::circle};
  Series graphic{.name = "graphic (printed)", .stroke = figures::Stroke::dashed, .marker = Marker::square};
  for (const PrintedRate& rate : printedNumbers().table_3_1) {
    haptic.x.push_back(rate.triangles);
    haptic.y.push_back(rate.haptic_fps);
    graphic.x.push_back(rate.triangles);
    graphic.y.push_back(rate.graphic_fps);
  }
  Plot rates = ratePlot("Rates on five models", "rate", "FPS");
  rates.series = {haptic, graphic};
  for (Series* series : {&haptic, &graphic}) {
    for (double& y : series->y) y = 1000.0 / y;
  }
  Plot times = ratePlot("Time of a frame", "time", "ms");
  times.series = {haptic, graphic};
  return {.panels = {rates, times}, .columns = 2};
}

Series makeTimingSeries(const std::string& name, const std::vector<PrintedTiming>& timings, Marker marker) {
  Series series{.name = name, .stroke = figures::Stroke::dashed, .marker = marker};
  for (const PrintedTiming& timing : timings) {
    series.x.push_back(timing.triangles);
    series.y.push_back(parsePrinted(timing.ms).value);
  }
  return series;
}

Series rateSeries(const std::string& name, const std::vector<PrintedTiming>& timings, Marker marker) {
  Series series = makeTimingSeries(name, timings, marker);
  for (double& y : series.y) y = 1000.0 / y;
  return series;
}

Figure figure310() {
  const PrintedTimings table = printedNumbers().table_3_2;
  Plot times = ratePlot("Time against triangles rendered", "time", "ms");
  times.series = {makeTimingSeries("drawing", table.drawing, Marker::circle),
                  makeTimingSeries("untouched", table.untouched, Marker::square),
                  makeTimingSeries("touched", table.touched, Marker::triangle)};
  Plot rates = ratePlot("Rate against triangles rendered", "rate", "FPS");
  rates.series = {rateSeries("drawing", table.drawing, Marker::circle),
                  rateSeries("untouched", table.untouched, Marker::square),
                  rateSeries("touched", table.touched, Marker::triangle)};
  return {.panels = {times, rates}, .columns = 2};
}

Figure treesCompared(const std::string& what, std::vector<PrintedTiming> PrintedTimings::*column) {
  const PrintedNumbers printed = printedNumbers();
  Plot plot = ratePlot("Haptic process on 41,582 triangles: " + what, "time", "ms");
  plot.series = {makeTimingSeries("BSP tree (printed)", printed.table_3_2.*column, Marker::circle),
                 makeTimingSeries("octree (printed)", printed.appendix_b.*column, Marker::square)};
  return {.panels = {plot}};
}

Figure figure316() { return treesCompared("drawing alone", &PrintedTimings::drawing); }
Figure figure317() { return treesCompared("untouched", &PrintedTimings::untouched); }
Figure figure318() { return treesCompared("touched", &PrintedTimings::touched); }

}  // namespace

std::vector<DissertationFigure> rateFigures() {
  return {
      {"3.1", "Plots of Table 3.1: rates of whole models without a partition", kOwnRates, figure31,
       FigureBasis::printed},
      {"3.10", "Plots of Table 3.2: the haptic process with a BSP tree", kOwnRates, figure310, FigureBasis::printed},
      {"3.16", "Haptic triangles drawn without the haptic interface", kOwnRates, figure316, FigureBasis::printed},
      {"3.17", "Haptic process, untouched", kOwnRates, figure317, FigureBasis::printed},
      {"3.18", "Haptic process, touched", kOwnRates, figure318, FigureBasis::printed}};
}

}  // namespace palpate::study
