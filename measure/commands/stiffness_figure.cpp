#include "measure/commands/stiffness_figure.h"

#include <fmt/format.h>

#include <algorithm>

namespace palpate::app {

namespace {

using measure::PlaceStiffness;

constexpr std::size_t kMostPlacePanels = 24;

figures::Series formSeries(const PlaceStiffness& place, std::size_t which) {
  constexpr int kPoints = 120;
  const measure::FormOfPlace& form = place.forms[which];
  const bool chosen = which == place.chosen;
  figures::Series line{.name = fmt::format("{}, {:.2g} N", nameOf(form.fit.form), form.rms_n),
                       .stroke = chosen ? figures::Stroke::solid : figures::Stroke::dashed,
                       .colour = figures::seriesColour(which),
                       .width_px = chosen ? 2.6 : 1.4};
  for (int i = 0; i <= kPoints; ++i) {
    line.x.push_back(form.fit.deepest_mm * i / kPoints);
    line.y.push_back(forceOf(form.fit, line.x.back()));
  }
  return line;
}

figures::Plot placePanel(const PlaceStiffness& place) {
  figures::Plot plot{.title = place.refused() ? place.place + ": refused"
                                              : fmt::format("{}: {:.3g} \u00b1 {:.1g} N/mm at 8 mm", place.place,
                                                            place.secant_n_per_mm.value, place.secant_n_per_mm.sd),
                     .x = {.label = "depth", .unit = "mm"},
                     .y = {.label = "force", .unit = "N"}};
  plot.series.push_back({.name = "measured",
                         .x = place.rows.depth_mm,
                         .y = place.rows.force_n,
                         .stroke = figures::Stroke::none,
                         .marker = figures::Marker::circle,
                         .colour = figures::Colour{0.55, 0.55, 0.55}});
  for (std::size_t i = 0; i < place.forms.size(); ++i) plot.series.push_back(formSeries(place, i));
  return plot;
}

}  // namespace

figures::Figure placeStiffnessFigure(const measure::PlaceFits& fits) {
  figures::Figure figure{.title = "stiffness of places", .columns = fits.places.size() > 1 ? 2 : 1};
  for (const PlaceStiffness& place : fits.places) {
    if (figure.panels.size() < kMostPlacePanels) figure.panels.emplace_back(placePanel(place));
  }
  figure.note = "Beside each form what it misses (root mean square). Solid: the form that was chosen.";
  return figure;
}

}  // namespace palpate::app
