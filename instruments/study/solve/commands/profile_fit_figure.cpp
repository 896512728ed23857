// Depths by the shade of an ordered colour map, measured places as dots, fits as lines.
#include <fmt/format.h>

#include <algorithm>

#include "solve/commands/fit_reports.h"
#include "solve/commands/layered_figure.h"

namespace palpate::app {

namespace {

using figures::Plot;
using figures::Series;
using tissue::ProfileFit;
using tissue::SkinProfile;

constexpr double kShownRadiusMm = 60.0;

Series placesAt(const SkinProfile& profile, const std::vector<double>& values, double sign,
                const figures::Colour& colour) {
  Series places{.stroke = figures::Stroke::none, .marker = figures::Marker::circle, .colour = colour};
  for (std::size_t i = 0; i < values.size() && profile.radius_mm[i] <= kShownRadiusMm; ++i) {
    places.x.push_back(profile.radius_mm[i]);
    places.y.push_back(sign * values[i]);
  }
  return places;
}

template <class Share>
Series fitLine(const ProfileFit& fit, const SkinProfile& profile, double sign, const figures::Colour& colour,
               const Share& share) {
  constexpr int kPoints = 240;
  const double to = std::min(kShownRadiusMm, profile.radius_mm.back());
  Series line{.name = fmt::format("{:.4g} mm", profile.depth_mm), .colour = colour};
  for (int i = 0; i <= kPoints; ++i) {
    const double radius = to * i / kPoints;
    line.x.push_back(radius);
    line.y.push_back(sign * fit.surface_mm * share(fit, radius));
  }
  return line;
}

/// Measured places and fits, depth by depth.
template <class Share>
Plot fittedPlot(Plot plot, const ProfileResult& result, std::vector<double> SkinProfile::*measured, double sign,
                const Share& share) {
  for (std::size_t i = 0; i < result.profiles.size(); ++i) {
    const SkinProfile& profile = result.profiles[i];
    const figures::Colour colour = depthColour(i, result.profiles.size());
    plot.series.push_back(placesAt(profile, profile.*measured, sign, colour));
    plot.series.push_back(fitLine(result.chosenFit(i), profile, sign, colour, share));
  }
  return plot;
}

/// Misses of every form at every depth.
Plot formMisses(const ProfileResult& result) {
  Plot plot{.title = "error of the forms",
            .x = {.label = "depth", .unit = "mm"},
            .y = {.label = "RMS of places left out, of the depth", .unit = "%"}};
  plot.y.from = 0.0;
  for (const tissue::ProfileForm form : tissue::kProfileForms) {
    Series misses{.name = std::string(nameOf(form)),
                  .marker = figures::Marker::circle,
                  .colour = figures::seriesColour(static_cast<std::size_t>(form))};
    for (std::size_t i = 0; i < result.profiles.size(); ++i) {
      misses.x.push_back(result.profiles[i].depth_mm);
      misses.y.push_back(100.0 * result.fits[i][static_cast<std::size_t>(form)].unseen_rms);
    }
    plot.series.push_back(std::move(misses));
  }
  return plot;
}

Plot sharedCurve(const ProfileResult& result) {
  Plot plot{.title = "one curve for all depths",
            .x = {.label = "distance over the region's radius"},
            .y = {.label = "share of the depth"}};
  for (std::size_t i = 0; i < result.profiles.size(); ++i) {
    const double region = result.shared.radius_mm + result.shared.radius_per_depth * result.profiles[i].depth_mm;
    Series line{.name = fmt::format("{:.4g} mm", result.profiles[i].depth_mm),
                .stroke = figures::Stroke::dashed,
                .colour = depthColour(i, result.profiles.size())};
    const auto& radii = result.table.radii_mm;
    for (std::size_t k = 0; k < radii.size() && radii[k] <= region; ++k) {
      line.x.push_back(radii[k] / region);
      line.y.push_back(result.table.shapes[i].down[k]);
    }
    plot.series.push_back(std::move(line));
  }
  Series shared{.name = "for all", .colour = figures::kInk, .width_px = 2.6};
  for (const tissue::ProfileKnot& knot : result.shared.knots) {
    shared.x.push_back(knot.q);
    shared.y.push_back(knot.value);
  }
  plot.series.push_back(std::move(shared));
  return plot;
}

}  // namespace

figures::Figure profileFitFigure(const ProfileResult& result) {
  figures::Figure figure;
  figure.title = fmt::format("{}: {}", result.file, nameOf(result.chosen));
  figure.columns = 2;
  figure.panels.emplace_back(fittedPlot(skinDownPlot(), result, &SkinProfile::down_mm, -1.0, tissue::downShare));
  if (!result.profiles.front().outward_mm.empty()) {
    figure.panels.emplace_back(
        fittedPlot(skinSidewaysPlot(), result, &SkinProfile::outward_mm, 1.0, tissue::outwardShare));
  }
  figure.panels.emplace_back(formMisses(result));
  figure.panels.emplace_back(sharedCurve(result));
  figure.note = "Dots: measured. Misses are RMS over the area within 40 mm of the axis.";
  return figure;
}

}  // namespace palpate::app
