// The panels over time are stacked and share their time axis, so their frames begin at the same place.
#include "report/recording/report_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cli/kit/readable_text.h"
#include "palpate/base/language.h"

namespace palpate::app {

namespace {

using figures::Plot;
using figures::Shape;
using trace::Measured;
using trace::Phase;

constexpr figures::Colour kAwayColour{0.86, 0.87, 0.89};
/// Dotted lines of more marks than this hide what they mark.
constexpr std::size_t kMaxMarkLines = 40;

struct MeasuredPanel {
  Measured measured;
  const char* label;
  std::string_view unit;
};
constexpr std::array kPanels = {MeasuredPanel{Measured::force, toTranslate("force"), "N"},
                                MeasuredPanel{Measured::depth, toTranslate("depth"), "mm"},
                                MeasuredPanel{Measured::proxy_speed, toTranslate("speed"), "mm/s"}};

struct ShownTime {
  double from_s = 0.0;
  double to_s = 1.0;
};

ShownTime shownTime(const RecordingReport& report) {
  const trace::RecordedTicks& ticks = report.statistics.ticks;
  return {report.secondsAt(ticks.first), report.secondsAt(ticks.last + 1)};
}

// ---- over time

/// Runs of buckets that know the value: what was not recorded parts them.
template <class Visit>
void forEachRun(const trace::TickSeries& series, Measured measured, const Visit& visit) {
  const auto i = static_cast<std::size_t>(measured);
  const std::vector<trace::SeriesBucket>& buckets = series.buckets();
  for (std::size_t begin = 0; begin < buckets.size(); ++begin) {
    if (buckets[begin].values[i].count == 0) continue;
    std::size_t end = begin;
    while (end < buckets.size() && buckets[end].values[i].count > 0) ++end;
    visit(begin, end);
    begin = end;
  }
}

double bucketMidTime(const RecordingReport& report, const trace::TickSeries& series, std::size_t bucket) {
  const double ticks = (static_cast<double>(bucket) + 0.5) * static_cast<double>(series.ticksPerBucket());
  return report.secondsAt(series.firstTick()) + ticks / report.statistics.ticks_per_s;
}

/// Means as a line, least to greatest as a band behind it.
void addCourse(const RecordingReport& report, const trace::TickSeries& series, const MeasuredPanel& panel,
               const figures::Colour& colour, const std::string& name, Plot& plot) {
  const auto i = static_cast<std::size_t>(panel.measured);
  Shape band{.stroke = figures::Stroke::none, .colour = colour, .fill = figures::withAlpha(colour, 0.25)};
  figures::Series line{.name = name, .colour = colour, .width_px = 1.1};
  forEachRun(series, panel.measured, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec2> outline;
    for (std::size_t b = begin; b < end; ++b) {
      const double time = bucketMidTime(report, series, b);
      const trace::Extremes& value = series.buckets()[b].values[i];
      outline.emplace_back(time, value.greatest);
      line.x.push_back(time);
      line.y.push_back(value.mean());
    }
    for (std::size_t b = end; b-- > begin;) {
      outline.emplace_back(bucketMidTime(report, series, b), series.buckets()[b].values[i].least);
    }
    if (series.ticksPerBucket() > 1) band.paths.push_back(std::move(outline));
    line.x.push_back(bucketMidTime(report, series, end));
    line.y.push_back(std::numeric_limits<double>::quiet_NaN());
  });
  if (!band.paths.empty()) plot.shapes.push_back(std::move(band));
  plot.series.push_back(std::move(line));
}

Plot coursePlot(const RecordingReport& report, const MeasuredPanel& panel, bool named) {
  Plot plot;
  plot.y = {.label = tr(panel.label), .unit = std::string(panel.unit), .from = 0.0};
  for (std::size_t f = 0; f < report.statistics.fingers.size(); ++f) {
    addCourse(report, report.statistics.fingers[f].series, panel, figures::seriesColour(f),
              named ? readableText(report.facts.fingers[f].name) : std::string(), plot);
  }
  return plot;
}

figures::Colour colourOf(Phase phase) {
  if (phase == Phase::away) return kAwayColour;
  return phase == Phase::search ? figures::kSky : figures::kVermilion;
}

/// A row of bars a finger, from the top down.
Plot phasePlot(const RecordingReport& report) {
  Plot plot;
  const std::size_t fingers = report.statistics.fingers.size();
  plot.y.from = -0.6;
  plot.y.to = static_cast<double>(fingers) - 0.4;
  for (std::size_t f = 0; f < fingers; ++f) {
    plot.y.ticks.push_back({static_cast<double>(fingers - 1 - f), readableText(report.facts.fingers[f].name)});
  }
  for (const Phase phase : {Phase::away, Phase::search, Phase::palpation}) {
    Shape bars{.name = std::string(phaseWord(phase)),
               .stroke = figures::Stroke::none,
               .colour = colourOf(phase),
               .fill = colourOf(phase)};
    for (const trace::PhaseSpan& span : report.statistics.phases) {
      if (span.phase != phase) continue;
      const double y = static_cast<double>(fingers - 1 - span.finger);
      bars.paths.push_back(figures::rectangleOutline({report.secondsAt(span.first_tick), y - 0.34},
                                                     {report.secondsAt(span.last_tick + 1), y + 0.34}));
    }
    if (!bars.paths.empty()) plot.shapes.push_back(std::move(bars));
  }
  return plot;
}

void addMarks(const RecordingReport& report, std::vector<Plot>& panels) {
  std::vector<double> times;
  for (const trace::RecordingEvent& event : report.events) {
    if (event.kind == "mark") times.push_back(report.secondsAt(event.tick));
  }
  if (times.empty() || times.size() > kMaxMarkLines) return;
  for (Plot& panel : panels) {
    const bool phases = &panel == &panels.back();
    double top = phases ? *panel.y.to : 0.0;
    for (const figures::Series& series : panel.series) {
      for (const double y : series.y) top = std::max(top, std::isfinite(y) ? y : 0.0);
    }
    for (const Shape& shape : panel.shapes) {
      for (const auto& path : shape.paths) {
        for (const Vec2& point : path) top = std::max(top, point.y());
      }
    }
    Shape lines{.name = phases ? tr("mark") : "", .closed = false, .stroke = figures::Stroke::dashed};
    lines.colour = figures::kPurple;
    for (const double time : times) lines.paths.push_back({{time, phases ? *panel.y.from : 0.0}, {time, top}});
    panel.shapes.push_back(std::move(lines));
  }
}

/// Width of the names left of the frames, about: letters differ in width.
double roomForNames(const RecordingReport& report) {
  constexpr double kPixelsALetter = 7.8;
  constexpr double kLabelAndTicks = 30.0;
  constexpr std::size_t kMaxLetters = 24;
  std::size_t letters = 6;
  for (const trace::RecordingFinger& finger : report.facts.fingers) letters = std::max(letters, finger.name.size());
  return kLabelAndTicks + kPixelsALetter * static_cast<double>(std::min(letters, kMaxLetters));
}

ReportPicture coursePicture(const RecordingReport& report) {
  std::vector<Plot> panels;
  for (const MeasuredPanel& panel : kPanels) panels.push_back(coursePlot(report, panel, panels.empty()));
  panels.push_back(phasePlot(report));
  addMarks(report, panels);
  const ShownTime time = shownTime(report);
  figures::Figure figure;
  figure.panel_width_px = 900.0;
  figure.panel_height_px = std::max(170.0, 80.0 + 24.0 * static_cast<double>(report.statistics.fingers.size()));
  for (Plot& panel : panels) {
    panel.x.from = time.from_s;
    panel.x.to = time.to_s;
    panel.least_left_px = roomForNames(report);
  }
  panels.back().x.label = tr("time");
  panels.back().x.unit = "s";
  figure.panels.assign(panels.begin(), panels.end());
  std::uint64_t ticks = 1;
  for (const trace::FingerStatistics& finger : report.statistics.fingers) {
    ticks = std::max(ticks, finger.series.ticksPerBucket());
  }
  std::string caption =
      tr("Force of the contact, depth of the tip under the skin and speed of the finger over time; below, what each "
         "finger did.");
  if (ticks > 1) {
    caption += " " + trf("Lines are means over {:.3g} s; the pale bands span the smallest to the largest tick in them.",
                         report.statistics.seconds(ticks));
  }
  return {"course", tr("Over time"), caption, std::move(figure)};
}

// ---- distributions

constexpr std::size_t kBars = 48;

/// The greatest value that is shown: nearly all of every finger's ticks.
double shownMost(const RecordingReport& report, Measured measured) {
  double most = 0.0;
  for (const trace::FingerStatistics& finger : report.statistics.fingers) {
    most = std::max(most, 1.1 * finger.of(measured).quantile(0.995));
  }
  return most;
}

/// The outline of the bars of one finger: each its share of contact.
figures::Series histogramOutline(const trace::FixedHistogram& histogram, std::size_t bins_a_bar) {
  figures::Series outline{.width_px = 1.6};
  const auto all = static_cast<double>(histogram.count());
  const double width = static_cast<double>(bins_a_bar) * histogram.binWidth();
  outline.x.push_back(0.0);
  outline.y.push_back(0.0);
  for (std::size_t bar = 0; bar < kBars; ++bar) {
    std::uint64_t count = 0;
    for (std::size_t bin = bar * bins_a_bar; bin < std::min((bar + 1) * bins_a_bar, histogram.bins().size()); ++bin) {
      count += histogram.bins()[bin];
    }
    for (const std::size_t side : {bar, bar + 1}) {
      outline.x.push_back(static_cast<double>(side) * width);
      outline.y.push_back(100.0 * static_cast<double>(count) / all);
    }
  }
  outline.x.push_back(static_cast<double>(kBars) * width);
  outline.y.push_back(0.0);
  return outline;
}

Plot distributionPlot(const RecordingReport& report, const MeasuredPanel& panel) {
  Plot plot;
  plot.x = {.label = tr(panel.label), .unit = std::string(panel.unit), .from = 0.0};
  plot.y = {.label = tr("share of the time in contact"), .unit = "%", .from = 0.0};
  const double bin_width = report.statistics.fingers.front().of(panel.measured).binWidth();
  const double bar_width = shownMost(report, panel.measured) / static_cast<double>(kBars);
  const auto bins_a_bar = static_cast<std::size_t>(std::max(1.0, std::ceil(bar_width / bin_width)));
  plot.x.to = static_cast<double>(kBars * bins_a_bar) * bin_width;
  for (std::size_t f = 0; f < report.statistics.fingers.size(); ++f) {
    const trace::FixedHistogram& histogram = report.statistics.fingers[f].of(panel.measured);
    if (histogram.count() == 0) continue;
    figures::Series outline = histogramOutline(histogram, bins_a_bar);
    outline.name = readableText(report.facts.fingers[f].name);
    outline.colour = figures::seriesColour(f);
    plot.series.push_back(std::move(outline));
  }
  return plot;
}

ReportPicture distributionPicture(const RecordingReport& report) {
  figures::Figure figure;
  figure.columns = 3;
  figure.panel_width_px = 320.0;
  figure.panel_height_px = 260.0;
  for (const MeasuredPanel& panel : kPanels) figure.panels.emplace_back(distributionPlot(report, panel));
  return {"distributions", tr("How often"),
          trf("Distribution of force, depth and speed while a finger was in contact, in {} steps each. The largest "
              "values, up to one in 200, are beyond the right edge of the pictures.",
              kBars),
          std::move(figure)};
}

}  // namespace

std::vector<ReportPicture> coursePictures(const RecordingReport& report) {
  std::vector<ReportPicture> pictures;
  if (report.statistics.ticks.recorded == 0) return pictures;
  pictures.push_back(coursePicture(report));
  if (report.statistics.contact_count > 0) pictures.push_back(distributionPicture(report));
  return pictures;
}

}  // namespace palpate::app
