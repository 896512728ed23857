// Changes are in per cent on logarithmic axes: as much better is as far down everywhere.
#include "teach/report/training_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "palpate/base/language.h"
#include "palpate/training/psychometric.h"

namespace palpate::app {

namespace {

using figures::Marker;
using figures::Plot;
using figures::Series;
using figures::Shape;
using figures::Stroke;
using training::AnswerBox;
using training::Occasion;
using training::ThresholdPoint;
using training::TraineeStatistics;
using training::TrialStatistics;

/// Labels of changes on an axis, per cent: the levels of the Virtual Haptic Back and their neighbours.
constexpr std::array kSaidChanges = {2.0, 3.0, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0, 60.0, 80.0, 100.0};
/// More words than this below an axis cover each other.
constexpr std::size_t kMaxOccasionWords = 9;
constexpr figures::Colour kQuartileColour{0.72, 0.75, 0.80};

std::vector<figures::Tick> changeTicks(double least, double most) {
  std::vector<figures::Tick> ticks;
  for (const double change : kSaidChanges) {
    if (change >= least && change <= most) ticks.push_back({change, fmt::format("{:g}", WrittenNumber{change})});
  }
  return ticks;
}

figures::Axis changeAxis(std::string label, double least, double most) {
  return {.label = std::move(label),
          .unit = "%",
          .scale = figures::Scale::logarithmic,
          .from = least,
          .to = most,
          .ticks = changeTicks(least, most)};
}

/// Estimates with their intervals, in per cent: a line with a band, or markers with bars.
struct Estimates {
  std::vector<double> x, middle, low, high;

  /// All but the place are shares.
  void add(double place, double share, double from, double to) {
    x.push_back(place);
    middle.push_back(100.0 * share);
    low.push_back(100.0 * from);
    high.push_back(100.0 * to);
  }
  Shape band(const std::string& name, const figures::Colour& colour) const {
    Shape shape{.name = name, .stroke = Stroke::none, .colour = colour, .fill = colour};
    std::vector<Vec2> outline;
    for (std::size_t i = 0; i < x.size(); ++i) outline.emplace_back(x[i], low[i]);
    for (std::size_t i = x.size(); i-- > 0;) outline.emplace_back(x[i], high[i]);
    shape.paths.push_back(std::move(outline));
    return shape;
  }
  Shape blueBand() const { return band(tr("95 % band"), figures::withAlpha(figures::kBlue, 0.18)); }
  Series line(const std::string& name, double width_px) const {
    return {.name = name, .x = x, .y = middle, .colour = figures::kBlue, .width_px = width_px};
  }
  /// With bars, whose short ends have this half width.
  void addMarkers(const std::string& name, Marker marker, const figures::Colour& colour, double half_width,
                  Plot& plot) const {
    Shape bars{.closed = false, .stroke = Stroke::solid, .colour = colour, .width_px = 1.3};
    for (std::size_t i = 0; i < x.size(); ++i) {
      bars.paths.push_back({{x[i], low[i]}, {x[i], high[i]}});
      if (half_width == 0.0) continue;
      for (const double end : {low[i], high[i]})
        bars.paths.push_back({{x[i] - half_width, end}, {x[i] + half_width, end}});
    }
    plot.shapes.push_back(std::move(bars));
    plot.series.push_back(
        {.name = name, .x = x, .y = middle, .stroke = Stroke::none, .marker = marker, .colour = colour});
  }
};

/// A range of changes in per cent that shows all of these.
struct ShownChanges {
  double least = 100.0, most = 5.0;
  void add(const Estimates& shown) {
    for (const double low : shown.low) least = std::min(least, low);
    for (const double high : shown.high) most = std::max(most, high);
  }
  figures::Axis axis(std::string label) const {
    return changeAxis(std::move(label), std::max(1.5, least / 1.15), std::min(200.0, most * 1.15));
  }
};

figures::Axis occasionAxis(const std::vector<std::string>& words) {
  figures::Axis axis{.from = 0.5, .to = static_cast<double>(words.size()) + 0.5};
  const std::size_t every = (words.size() + kMaxOccasionWords - 1) / kMaxOccasionWords;
  for (std::size_t i = 0; i < words.size(); ++i) {
    axis.ticks.push_back({static_cast<double>(i + 1), i % every == 0 ? words[i] : ""});
  }
  return axis;
}

void addSentence(std::string& text, const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence; }

/// Side by side.
figures::Figure panelFigure(double height_px, std::vector<Plot> plots) {
  figures::Figure figure;
  figure.columns = static_cast<int>(plots.size());
  figure.panel_width_px = (860.0 - 18.0 * static_cast<double>(plots.size() - 1)) / static_cast<double>(plots.size());
  figure.panel_height_px = height_px;
  for (Plot& plot : plots) figure.panels.emplace_back(std::move(plot));
  return figure;
}

// ---- learning curves

/// Quartiles of the class where the trainee's occasions have them.
void addOthers(const TraineeStatistics& trainee, const std::vector<Occasion>& others, ShownChanges& shown, Plot& plot) {
  Estimates quartiles;
  for (std::size_t i = 0; i < trainee.curve.size(); ++i) {
    const ThresholdPoint& point = trainee.points[trainee.curve[i].point];
    const auto at = std::ranges::find_if(
        others, [&](const Occasion& each) { return each.kind == point.kind && each.nth == point.nth; });
    if (at == others.end()) continue;
    const training::Spread& medians = at->medians;
    quartiles.add(static_cast<double>(i + 1), medians.median, medians.lower_quartile, medians.upper_quartile);
  }
  shown.add(quartiles);
  if (quartiles.x.size() < 2) return;
  plot.shapes.push_back(quartiles.band(tr("middle half of the class"), figures::withAlpha(kQuartileColour, 0.45)));
  plot.series.push_back({.name = tr("class median"),
                         .x = quartiles.x,
                         .y = quartiles.middle,
                         .stroke = Stroke::dashed,
                         .colour = figures::mixed(kQuartileColour, figures::kInk, 0.4),
                         .width_px = 1.2});
}

void addFiltered(const TraineeStatistics& trainee, ShownChanges& shown, Plot& plot) {
  Estimates so_far;
  for (std::size_t i = 0; i < trainee.curve.size(); ++i) {
    const auto& filtered = trainee.curve[i].filtered;
    so_far.add(static_cast<double>(i + 1), filtered.median, filtered.low, filtered.high);
  }
  shown.add(so_far);
  if (so_far.x.size() > 1) plot.shapes.push_back(so_far.blueBand());
  plot.series.push_back(so_far.line(tr("so far"), 2.2));
}

/// The exponential, between the blocks too.
void addLearning(const TraineeStatistics& trainee, Plot& plot) {
  if (!trainee.learning) return;
  Series line{.name = tr("fitted exponential"), .x = {}, .y = {}, .stroke = Stroke::dashed, .colour = figures::kGreen};
  for (const training::CurvePoint& point : trainee.learning->fit.curve) {
    line.x.push_back(static_cast<double>(trainee.learning->first + 1) + point.session);
    line.y.push_back(100.0 * point.median);
  }
  plot.series.push_back(std::move(line));
}

/// Each block alone, with its 95 % interval.
void addBlocks(const TraineeStatistics& trainee, bool tests, ShownChanges& shown, Plot& plot) {
  Estimates blocks;
  for (std::size_t i = 0; i < trainee.curve.size(); ++i) {
    const ThresholdPoint& point = trainee.points[trainee.curve[i].point];
    if (training::isTest(point.kind) != tests) continue;
    blocks.add(static_cast<double>(i + 1), point.threshold->median, point.threshold->low, point.threshold->high);
  }
  shown.add(blocks);
  if (blocks.x.empty()) return;
  blocks.addMarkers(tests ? tr("a test by itself, 95 % interval") : tr("practice by itself, 95 % interval"),
                    tests ? Marker::square : Marker::circle, tests ? figures::kVermilion : figures::kInk, 0.06, plot);
}

/// Describes many occasions by the first, the last and the direction; the table has all.
std::string firstAndLast(const std::string& what, const std::string& first, const std::string& last,
                         std::size_t count) {
  if (count == 1) return fmt::format("{}: {}.", what, first);
  return trf("{} over {} occasions: first {}, last {}.", what, count, first, last);
}

// ---- psychometric functions

std::string formatAnswerBoxes(const std::vector<AnswerBox>& boxes, double scale, std::string_view unit) {
  std::string words;
  for (const AnswerBox& box : boxes) {
    const int decimals = scale * box.middle < 10.0 ? 1 : 0;
    words += (words.empty() ? "" : ", ") +
             trf("at {:.{}f}{} {} of {}", scale * box.middle, decimals, unit, box.right.part, box.right.whole);
  }
  return words;
}

/// Shares in per cent with Wilson's intervals.
void addBoxes(const std::vector<AnswerBox>& boxes, double scale, const std::string& name, const figures::Colour& colour,
              Marker marker, Plot& plot) {
  Estimates shares;
  for (const AnswerBox& box : boxes) {
    const training::ShareInterval interval = box.right.interval();
    shares.add(scale * box.middle, box.right.share(), interval.low, interval.high);
  }
  shares.addMarkers(name, marker, colour, 0.0, plot);
}

figures::Axis rightAxis(const std::string& label) { return {.label = label, .unit = "%", .from = 0.0, .to = 100.0}; }

Series levelLine(const std::string& name, double from, double to, double y) {
  return {
      .name = name, .x = {from, to}, .y = {y, y}, .stroke = Stroke::dotted, .colour = figures::kInk, .width_px = 1.2};
}

Plot fitPlot(const ThresholdPoint& point) {
  const training::FittedCurve curve =
      training::fittedCurve(training::computePosterior(point), training::curveChanges());
  Plot plot{.title = fmt::format("{}, {}", occasionName(point.kind, point.nth), formatDay(point.start_ms))};
  plot.x = changeAxis(tr("change"), 3.0, 100.0);
  plot.y = rightAxis(tr("right answers"));
  Estimates fitted;
  for (std::size_t i = 0; i < curve.changes.size(); ++i) {
    fitted.add(100.0 * curve.changes[i], curve.mean[i], curve.low[i], curve.high[i]);
  }
  plot.shapes.push_back(fitted.blueBand());
  const double t = 100.0 * point.threshold->median;
  plot.shapes.push_back({.name = tr("smallest reliable change"),
                         .paths = {{{t, 0.0}, {t, 100.0}}},
                         .closed = false,
                         .stroke = Stroke::dashed,
                         .colour = figures::kVermilion,
                         .width_px = 1.6});
  plot.series.push_back(levelLine(tr("chance"), 3.0, 100.0, 100.0 / point.choices));
  plot.series.push_back(fitted.line(tr("fitted"), 2.2));
  addBoxes(point.trials.boxes, 100.0, tr("answers, neighbouring changes together"), figures::kInk, Marker::circle,
           plot);
  return plot;
}

}  // namespace

TrainingPicture curvePicture(const TraineeStatistics& trainee, const std::vector<Occasion>& others) {
  Plot plot;
  ShownChanges shown;
  addOthers(trainee, others, shown, plot);
  const bool has_others = !plot.shapes.empty();
  addFiltered(trainee, shown, plot);
  addLearning(trainee, plot);
  addBlocks(trainee, false, shown, plot);
  addBlocks(trainee, true, shown, plot);
  std::vector<std::string> words;
  for (const training::FilteredPoint& point : trainee.curve) {
    words.push_back(occasionName(trainee.points[point.point].kind, trainee.points[point.point].nth));
  }
  plot.x = occasionAxis(words);
  plot.y = shown.axis(tr("smallest reliable change"));
  const auto said = [&](const training::FilteredPoint& point) {
    const ThresholdPoint& block = trainee.points[point.point];
    return fmt::format("{} {}", occasionName(block.kind, block.nth), formatThreshold(*block.threshold));
  };
  return {"curve",
          tr("Lower is better. Markers: each block by itself. Line and blue band: the estimate from all blocks up to "
             "it, with its 95 % band; a threshold may drift by a fifth between blocks.") +
              (has_others ? std::string(" ") + tr("Grey: the middle half of the class.") : std::string()),
          firstAndLast(tr("Learning curve, smallest reliable change"), said(trainee.curve.front()),
                       said(trainee.curve.back()), trainee.curve.size()),
          panelFigure(400.0, {std::move(plot)})};
}

TrainingPicture classCurvePicture(const training::TrainingStatistics& statistics) {
  const std::vector<Occasion>& occasions = statistics.all.occasions;
  Plot plot;
  ShownChanges shown;
  Estimates quartiles, reach, group;
  std::vector<std::string> words;
  Series everybody{.name = tr("a trainee"), .x = {}, .y = {}, .stroke = Stroke::none, .marker = Marker::circle};
  everybody.colour = figures::withAlpha(figures::kSky, 0.45);
  for (std::size_t i = 0; i < occasions.size(); ++i) {
    const Occasion& occasion = occasions[i];
    const double at = static_cast<double>(i + 1);
    words.push_back(occasionName(occasion.kind, occasion.nth));
    const training::Spread& medians = occasion.medians;
    quartiles.add(at, medians.median, medians.lower_quartile, medians.upper_quartile);
    reach.add(at, medians.median, medians.least, medians.greatest);
    std::size_t of_occasion = 0;
    for (const TraineeStatistics& trainee : statistics.trainees) {
      for (const ThresholdPoint& point : trainee.points) {
        if (!point.threshold || point.kind != occasion.kind || point.nth != occasion.nth) continue;
        // Spread sideways in a fixed pattern, so that equal results do not cover each other.
        constexpr std::size_t kPlaces = 13;
        const double aside = static_cast<double>(of_occasion++ * 5 % kPlaces) / (kPlaces - 1) - 0.5;
        everybody.x.push_back(at - 0.12 + 0.2 * aside);
        everybody.y.push_back(100.0 * point.threshold->median);
      }
    }
    if (occasion.group.people < 2) continue;
    group.add(at + 0.18, occasion.group.mean, occasion.group.low, occasion.group.high);
  }
  if (quartiles.x.size() > 1) {
    plot.shapes.push_back(quartiles.band(tr("middle half of the class"), figures::withAlpha(kQuartileColour, 0.5)));
  }
  plot.series.push_back(std::move(everybody));
  plot.series.push_back(quartiles.line(tr("median"), 2.0));
  if (!group.x.empty()) {
    group.addMarkers(tr("mean of the group, 95 % interval"), Marker::diamond, figures::kVermilion, 0.05, plot);
    plot.shapes.back().width_px = 1.8;
  }
  for (const Estimates* each : {&reach, &group}) shown.add(*each);
  plot.x = occasionAxis(words);
  plot.y = shown.axis(tr("smallest reliable change"));
  const auto said = [&](std::size_t i) {
    return trf("{} median {}, middle half {} to {}", words[i], formatChange(occasions[i].medians.median),
               formatChange(occasions[i].medians.lower_quartile), formatChange(occasions[i].medians.upper_quartile));
  };
  return {
      "curve",
      tr("Lower is better. Dots: each trainee's own threshold; grey: the middle half of them. Diamonds: the mean of "
         "the group behind them, which allows for how well each trainee is known."),
      firstAndLast(tr("Learning curve of the class"), said(0), said(occasions.size() - 1), occasions.size()),
      panelFigure(420.0, {std::move(plot)})};
}

TrainingPicture fitPicture(const std::vector<const ThresholdPoint*>& blocks) {
  figures::Figure figure;
  figure.columns = 2;
  figure.panel_width_px = 430.0;
  figure.panel_height_px = 360.0;
  std::string alternative;
  for (const ThresholdPoint* point : blocks) {
    figure.panels.emplace_back(fitPlot(*point));
    addSentence(alternative,
                trf("{}: T {}. Right answers {}.", occasionName(point->kind, point->nth),
                    formatThreshold(*point->threshold), formatAnswerBoxes(point->trials.boxes, 100.0, " %")));
  }
  return {"fit",
          tr("How often answers are right at which change: the fitted function with its 95 % band, and the answers "
             "with neighbouring changes together (bars: 95 %). Dashed: T. Answers given after fewer places were felt "
             "follow a separate function; the fit allows for it, the dots do not."),
          alternative, std::move(figure)};
}

TrainingPicture collapsedPicture(const std::vector<AnswerBox>& boxes) {
  Plot plot;
  plot.x = {.label = tr("change / own threshold"), .scale = figures::Scale::logarithmic, .from = 0.25, .to = 8.0};
  for (const double at : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0})
    plot.x.ticks.push_back({at, fmt::format("{:g}", WrittenNumber{at})});
  plot.y = rightAxis(tr("right answers"));
  Series expected{.name = tr("fitted"), .x = {}, .y = {}, .colour = figures::kBlue, .width_px = 2.2};
  for (const AnswerBox& box : boxes) {
    expected.x.push_back(box.middle);
    expected.y.push_back(100.0 * box.expected);
  }
  plot.series.push_back(std::move(expected));
  addBoxes(boxes, 1.0, tr("answers of tests, 95 % intervals"), figures::kInk, Marker::circle, plot);
  return {
      "fit",
      tr("All answers of tests, with the change in units of each block's own threshold, and what the fitted functions "
         "expect. Below the threshold, dots are somewhat under the line even if the model holds exactly: answers chose "
         "both the changes and the threshold. The picture shows the answers; it does not test the model."),
      trf("Right answers of tests by change over own threshold: {}.", formatAnswerBoxes(boxes, 1.0, "")),
      panelFigure(360.0, {std::move(plot)})};
}

// ---- accuracy, force, time

namespace {

struct ShownTrials {
  const TrialStatistics* trials = nullptr;
  std::string name;
  figures::Colour colour;
  Marker marker = Marker::circle;
  Stroke stroke = Stroke::solid;
};

std::vector<ShownTrials> shownTrials(const TrialStatistics& tests, const TrialStatistics& practice) {
  std::vector<ShownTrials> all = {{&tests, tr("tests"), figures::kVermilion, Marker::square, Stroke::solid},
                                  {&practice, tr("practice"), figures::kBlue, Marker::circle, Stroke::dashed}};
  std::erase_if(all, [](const ShownTrials& each) { return each.trials->counted == 0; });
  return all;
}

/// Shares of all counts, as the outline of bars.
Series outlineSeries(const training::Histogram& histogram, const std::string& name, const figures::Colour& colour,
                     Stroke stroke) {
  Series outline{.name = name, .x = {0.0}, .y = {0.0}, .stroke = stroke, .colour = colour, .width_px = 1.8};
  double all = 0.0;
  for (const int count : histogram.counts) all += count;
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    for (const std::size_t side : {i, i + 1}) {
      outline.x.push_back(histogram.width * static_cast<double>(side));
      outline.y.push_back(all > 0.0 ? 100.0 * histogram.counts[i] / all : 0.0);
    }
  }
  outline.x.push_back(histogram.width * static_cast<double>(histogram.counts.size()));
  outline.y.push_back(0.0);
  return outline;
}

/// So that an axis ends with the last box that has anything.
double lastBox(const std::vector<ShownTrials>& shown,
               std::initializer_list<training::Histogram TrialStatistics::*> of) {
  double end = 1.0;
  for (const ShownTrials& each : shown) {
    for (const auto member : of) {
      const training::Histogram& histogram = each.trials->*member;
      for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        if (histogram.counts[i] > 0) end = std::max(end, histogram.width * static_cast<double>(i + 2));
      }
    }
  }
  return end;
}

Plot sharePlot(std::string title, std::string label, std::string unit, double to) {
  Plot plot{.title = std::move(title)};
  plot.x = {.label = std::move(label), .unit = std::move(unit), .from = 0.0, .to = to};
  plot.y = {.label = tr("share of trials"), .unit = "%", .from = 0.0};
  return plot;
}

}  // namespace

TrainingPicture accuracyPicture(const TrialStatistics& tests, const TrialStatistics& practice) {
  Plot raw{.title = tr("as answered")};
  Plot corrected{.title = tr("corrected for chance")};
  raw.y = rightAxis(tr("right answers"));
  corrected.y = {.label = tr("found"), .unit = "%", .from = -20.0, .to = 100.0};
  std::string alternative;
  for (const ShownTrials& each : shownTrials(tests, practice)) {
    addBoxes(each.trials->boxes, 100.0, each.name, each.colour, each.marker, raw);
    Series points{
        .name = each.name, .x = {}, .y = {}, .stroke = each.stroke, .marker = each.marker, .colour = each.colour};
    for (const AnswerBox& box : each.trials->boxes) {
      points.x.push_back(100.0 * box.middle);
      points.y.push_back(100.0 * box.corrected());
    }
    corrected.series.push_back(std::move(points));
    addSentence(alternative,
                trf("Right answers in {}: {}.", each.name, formatAnswerBoxes(each.trials->boxes, 100.0, " %")));
  }
  corrected.series.push_back(levelLine(tr("guessing"), 3.0, 100.0, 0.0));
  for (Plot* plot : {&raw, &corrected}) plot->x = changeAxis(tr("change"), 3.0, 100.0);
  return {
      "accuracy",
      tr("Neighbouring changes together; the table below has each. Corrected for chance, 0 % is a guesser and 100 % "
         "finds every place. Bars: 95 %."),
      alternative, panelFigure(320.0, {std::move(raw), std::move(corrected)})};
}

namespace {

/// A trainee who only lifts and presses never searches.
std::string medianForce(const training::Spread& force) {
  return force.count == 0 ? tr("not measured") : fmt::format("{:.2f} N", WrittenNumber{force.median});
}

}  // namespace

TrainingPicture handlingPicture(const TrialStatistics& tests, const TrialStatistics& practice) {
  const std::vector<ShownTrials> all = shownTrials(tests, practice);
  const double most_force = lastBox(all, {&TrialStatistics::search_force_bins, &TrialStatistics::palpate_force_bins});
  std::vector<Plot> plots;
  std::string alternative;
  for (const ShownTrials& each : all) {
    Plot plot = sharePlot(trf("force, {}", each.name), tr("mean force of a trial"), "N", most_force);
    plot.series.push_back(outlineSeries(each.trials->search_force_bins, tr("search"), figures::kSky, Stroke::dashed));
    plot.series.push_back(
        outlineSeries(each.trials->palpate_force_bins, tr("palpation"), figures::kVermilion, Stroke::solid));
    plots.push_back(std::move(plot));
    addSentence(
        alternative,
        trf("In {} the median force was {} while searching and {} while palpating, the median speed {:.0f} mm/s.",
            each.name, medianForce(each.trials->search_force_n), medianForce(each.trials->palpate_force_n),
            each.trials->speed_mm_per_s.median));
  }
  Plot speed =
      sharePlot(tr("speed"), tr("mean speed of a trial"), "mm/s", lastBox(all, {&TrialStatistics::speed_bins}));
  for (const ShownTrials& each : all) {
    speed.series.push_back(outlineSeries(each.trials->speed_bins, each.name, each.colour, each.stroke));
  }
  plots.push_back(std::move(speed));
  return {"handling",
          tr("How hard and how fast: means of each trial while the finger moves over the skin (search) and while it "
             "stays (palpation)."),
          alternative, panelFigure(320.0, std::move(plots))};
}

TrainingPicture secondsPicture(const TrialStatistics& tests, const TrialStatistics& practice) {
  const std::vector<ShownTrials> all = shownTrials(tests, practice);
  Plot plot = sharePlot("", tr("time for a trial"), "s", lastBox(all, {&TrialStatistics::seconds_bins}));
  std::string alternative;
  for (const ShownTrials& each : all) {
    plot.series.push_back(outlineSeries(each.trials->seconds_bins, each.name, each.colour, each.stroke));
    addSentence(alternative, trf("In {} a trial took {:.0f} s (median; middle half {:.0f} to {:.0f} s).", each.name,
                                 each.trials->seconds.median, each.trials->seconds.lower_quartile,
                                 each.trials->seconds.upper_quartile));
  }
  return {"seconds", tr("How long a trial took, pauses left out."), alternative, panelFigure(280.0, {std::move(plot)})};
}

}  // namespace palpate::app
