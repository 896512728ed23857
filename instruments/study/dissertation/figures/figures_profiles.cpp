// Figures 4.3, 4.4, 4.8, 4.9 and the curves of Table 4.2: displacement profiles.
#include <fmt/format.h>

#include <cmath>

#include "dissertation/figures/dissertation_figures.h"
#include "dissertation/profile/array_quality.h"
#include "palpate/base/gaussian.h"
#include "palpate/tissue/profile_forms.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

constexpr int kSamples = 400;

// A curve over q in [from, to].
template <class Curve>
Series sampled(const std::string& name, double from, double to, const Curve& curve) {
  Series series{.name = name};
  for (int i = 0; i <= kSamples; ++i) {
    const double q = from + (to - from) * i / kSamples;
    series.x.push_back(q);
    series.y.push_back(curve(q));
  }
  return series;
}

Plot sectionPlot(const std::string& title) {
  Plot plot{.title = title};
  plot.x = {.label = "distance over the radius, q", .from = -1.0, .to = 1.0};
  plot.y = {.label = "share of the depth", .from = -1.1, .to = 0.2};
  return plot;
}

Figure figure43() {
  Plot plot = sectionPlot("Under a round object");
  plot.series = {sampled("half Gaussian, both sides", -1.0, 1.0, [](double q) { return -halfGaussian(std::abs(q)); })};
  return {.panels = {plot}};
}

// The inflection points of (4.2) lie at x = sigma, that is q = sigma / 1.4.
constexpr double kInflection = 0.28495;

Figure figure44() {
  Plot left = sectionPlot("The Gaussian and its inflection points");
  left.series = {sampled("kept", -1.0, 1.0, [](double q) { return -halfGaussian(std::abs(q)); }),
                 sampled("removed", -kInflection, kInflection, [](double q) { return -halfGaussian(std::abs(q)); })};
  left.series[1].stroke = figures::Stroke::dashed;
  left.series[1].width_px = 3.0;
  Plot right = sectionPlot("Under a sharp object");
  right.series = {
      sampled("the rest, joined", -1.0, 1.0, [](double q) { return -tissue::sharpForm(std::abs(q)).value; })};
  return {.panels = {left, right}, .columns = 2};
}

Figure table42() {
  Plot plot{.title = "Curves of Table 4.2"};
  plot.x = {.label = "location ratio q"};
  plot.y = {.label = "share of the displacement", .from = 0.0, .to = 1.0};
  plot.series = {sampled("half Gaussian", 0.0, 1.0, [](double q) { return tissue::halfGaussianForm(q).value; }),
                 sampled("cosine", 0.0, 1.0, [](double q) { return tissue::cosineForm(q).value; }),
                 sampled("logarithm", 0.0, 1.0, [](double q) { return tissue::logarithmForm(q).value; })};
  return {.panels = {plot}};
}

Figure figure48() {
  Plot curve{.title = "Half Gaussian"};
  curve.x = {.label = "x", .from = 0.0, .to = kGaussianCut};
  curve.y = {.label = "y", .from = 0.0, .to = 1.0};
  curve.series = {
      sampled("y = exp(-\u03c0 x\u00b2)", 0.0, kGaussianCut, [](double x) { return halfGaussian(x / kGaussianCut); })};
  curve.places = {{Vec2(kGaussianCut, halfGaussian(1.0)), "y(1.4) = 0.0021"}};
  Plot array{.title = "Its array M[i] of 700 entries"};
  array.x = {.label = "index i", .from = 0.0, .to = 699.0};
  array.x.ticks = {{0, "0"},     {100, "100"}, {200, "200"}, {300, "300"},
                   {400, "400"}, {500, "500"}, {600, "600"}, {699, "699"}};
  array.y = {.label = "M[i]", .from = 0.0, .to = 1.0};
  const auto table = arrayProfile(700, tissue::TableLookup::nearest);
  array.series = {sampled("M[i]", 0.0, 698.9, [&](double i) { return table.at(i / 699.0).value; })};
  return {.panels = {curve, array}, .columns = 2};
}

Plot arrayPlot(int entries) {
  constexpr double kDepthMm = 10.0;
  constexpr int kFineSteps = 4000;  // steps of 700 entries must be visible
  Plot plot{.title = fmt::format("Array of {}: {:.3f} mm off at most", entries,
                                 worstArrayError(entries, tissue::TableLookup::nearest))};
  plot.x = {.label = "location ratio q", .from = 0.1, .to = 0.5};
  plot.y = {.label = "displacement", .unit = "mm", .from = 2.0, .to = 10.0};
  const auto array = arrayProfile(entries, tissue::TableLookup::nearest);
  Series steps{.name = "nearest entry", .width_px = 1.2};
  for (int i = 0; i <= kFineSteps; ++i) {
    const double q = 0.1 + 0.4 * i / kFineSteps;
    steps.x.push_back(q);
    steps.y.push_back(kDepthMm * array.at(q).value);
  }
  plot.series = {steps};
  return plot;
}

// Errors of nearest and linear lookup in arrays of all sizes.
Plot errorPlot() {
  Plot plot{.title = "Worst error, 10 mm deep"};
  plot.x = {.label = "entries", .scale = figures::Scale::logarithmic};
  plot.y = {.label = "error", .unit = "mm", .scale = figures::Scale::logarithmic};
  Series nearest{.name = "nearest (4.3)", .marker = figures::Marker::circle};
  Series linear{.name = "linear", .marker = figures::Marker::square};
  for (const int entries : {10, 20, 50, 130, 300, 700, 2000}) {
    nearest.x.push_back(entries);
    nearest.y.push_back(worstArrayError(entries, tissue::TableLookup::nearest));
    linear.x.push_back(entries);
    linear.y.push_back(worstArrayError(entries, tissue::TableLookup::linear));
  }
  plot.series = {nearest, linear};
  return plot;
}

Figure figure49() {
  return {.panels = {arrayPlot(20), arrayPlot(130), arrayPlot(700), errorPlot()},
          .columns = 2,
          .panel_width_px = 440.0,
          .panel_height_px = 310.0};
}

}  // namespace

std::vector<DissertationFigure> profileFigures() {
  return {
      {"4.3", "The half Gaussian, turned over: skin under a round object", "", figure43},
      {"4.4", "The Gaussian without the part between its inflection points: skin under a sharp object", "", figure44},
      {"T4.2", "The curves that Table 4.2 compares",
       "The logarithm has a finite slope at q = 0: no curve from 1 has the infinite one of the table.", table42},
      {"4.8", "Half Gaussian and its array", "", figure48},
      {"4.9", "Smoothness of arrays of 20, 130 and 700 entries",
       "Curves instead of renderings; the fourth panel is added.", figure49}};
}

}  // namespace palpate::study
