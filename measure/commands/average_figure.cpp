#include "measure/commands/average_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace palpate::app {

namespace {

using measure::MeanEllipse;
using measure::PointMean;

constexpr double kShare = 0.2;  ///< of the true size, over the back
constexpr std::size_t kMostPanels = 24;

std::vector<Vec2> outlineOf(const maps::Ellipse& ellipse, const Vec2& centre, double share) {
  return figures::ellipseOutline(centre, share * ellipse.half_major_mm, share * ellipse.half_major_mm * ellipse.aspect,
                                 ellipse.direction_rad);
}

/// Between the band's two rims: one outline, there and back again.
figures::Shape bandOf(const MeanEllipse& mean, const Vec2& centre, double share, const std::string& name) {
  const auto rims = confidenceBand(mean);
  figures::Shape band{.name = name,
                      .stroke = figures::Stroke::none,
                      .colour = figures::kBlue,
                      .fill = figures::withAlpha(figures::kBlue, 0.2)};
  if (rims[0].empty()) return band;
  std::vector<Vec2> path;
  const std::size_t rays = rims[0].size();
  for (std::size_t i = 0; i <= rays; ++i) path.emplace_back(centre + share * rims[1][i % rays]);
  for (std::size_t i = 0; i <= rays; ++i) path.emplace_back(centre + share * rims[0][(2 * rays - i) % rays]);
  band.paths.push_back(std::move(path));
  return band;
}

figures::Plot overview(const measure::Averages& averages) {
  figures::Plot plot{.title = "over the back, at a fifth of their size",
                     .x = {.label = "to the right", .unit = "mm"},
                     .y = {.label = "towards the head", .unit = "mm"},
                     .equal_aspect = true};
  figures::Shape means{.name = "mean", .colour = figures::kBlue, .width_px = 1.8};
  for (const PointMean& point : averages.points) {
    plot.shapes.push_back(bandOf(point.mean, point.place_mm, kShare, ""));
    means.paths.push_back(outlineOf(point.mean.ellipse, point.place_mm, kShare));
    plot.places.push_back({point.place_mm, point.name});
  }
  plot.shapes.push_back(std::move(means));
  return plot;
}

std::string errorWords(const measure::Estimate& estimate, int digits) {
  if (!std::isfinite(estimate.sd)) return fmt::format("{:.{}f}", estimate.value, digits);
  return fmt::format("{:.{}f} \u00b1 {:.{}f}", estimate.value, digits, estimate.sd, digits);
}

figures::Plot panelOf(const PointMean& point) {
  figures::Plot plot{
      .title = fmt::format("{}: {} mm, ratio {}, {}\u00b0{}", point.name, errorWords(point.mean.half_major_mm, 1),
                           errorWords(point.mean.major_over_minor, 2), errorWords(point.mean.direction_deg, 0),
                           point.mean.hardly_determined ? " (hardly determined)" : ""),
      .x = {.label = "to the right", .unit = "mm"},
      .y = {.label = "towards the head", .unit = "mm"},
      .equal_aspect = true};
  plot.shapes.push_back(bandOf(point.mean, Vec2::Zero(), 1.0, "95 % band"));
  plot.shapes.push_back({.name = point.knowsTissue() ? "the tissue's" : "mean",
                         .paths = {outlineOf(point.mean.ellipse, Vec2::Zero(), 1.0)},
                         .colour = figures::kBlue,
                         .width_px = 2.0});
  for (std::size_t i = 0; point.drags.size() > 1 && i < point.drags.size(); ++i) {
    const measure::DragMean& drag = point.drags[i];
    plot.shapes.push_back({.name = drag.drag_deg ? "pulled " + measure::dragWords(*drag.drag_deg) : "pulled some way",
                           .paths = {outlineOf(drag.mean.ellipse, Vec2::Zero(), 1.0)},
                           .stroke = figures::Stroke::dashed,
                           .colour = figures::seriesColour(i + 1)});
  }
  return plot;
}

}  // namespace

figures::Figure averageFigure(const measure::Averages& averages) {
  figures::Figure figure{.title = "measured ellipses", .columns = 2};
  figure.panels.emplace_back(overview(averages));
  for (const PointMean& point : averages.points) {
    if (figure.panels.size() > kMostPanels) break;
    if (point.mirrored_from.empty()) figure.panels.emplace_back(panelOf(point));
  }
  figure.note = "Where the skin moves 2 mm. Bands: standard errors of the mean, 95 %.";
  return figure;
}

}  // namespace palpate::app
