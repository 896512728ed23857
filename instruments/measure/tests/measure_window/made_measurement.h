// A pair of photographs and its measurement that are made up, so that no measuring has a say in what a test sees.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "measure/window/measuring_view.h"
#include "palpate/view/offscreen.h"

namespace palpate::viewer {

inline constexpr int kPhotoWidth = 300;
inline constexpr int kPhotoHeight = 360;
inline constexpr int kColumns = 8;
inline constexpr int kRows = 10;
inline constexpr double kSpacingPx = 33.0;

inline Vec2 dotPlace(int column, int row) { return {34.0 + kSpacingPx * column, 32.0 + kSpacingPx * row}; }

/// Towards the upper right, less far away from the middle.
inline Vec2 dragged(const Vec2& place) {
  const double q = (place - Vec2(150.0, 180.0)).norm() / 70.0;
  return place + 14.0 * std::exp(-q * q) * Vec2(0.6, -0.8);
}

/// Red discs on skin.
inline view::Image dottedSkin(bool after) {
  view::Image image(kPhotoWidth, kPhotoHeight, {214, 170, 140});
  for (int i = 0; i < kColumns * kRows; ++i) {
    const Vec2 dot = dotPlace(i % kColumns, i / kColumns);
    const Vec2 at = after ? dragged(dot) : dot;
    for (int y = static_cast<int>(at.y()) - 5; y <= at.y() + 6; ++y) {
      for (int x = static_cast<int>(at.x()) - 5; x <= at.x() + 6; ++x) {
        if ((Vec2(x, y) - at).norm() < 4.5) image.at(x, y) = {176, 42, 44};
      }
    }
  }
  return image;
}

inline std::vector<Vec2> ellipseAbout(const Vec2& centre, double major, double minor, double turn) {
  std::vector<Vec2> places;
  for (int i = 0; i <= 72; ++i) {
    const double angle = std::numbers::pi * i / 36.0;
    const Vec2 along = major * std::cos(angle) * Vec2(std::cos(turn), -std::sin(turn));
    places.emplace_back(centre + along + minor * std::sin(angle) * Vec2(std::sin(turn), std::cos(turn)));
  }
  return places;
}

inline measure::OverlayPanel titledPanel(const char* title, measure::PanelPicture picture) {
  measure::OverlayPanel panel;
  panel.title = title;
  panel.picture = picture;
  return panel;
}

inline measure::OverlayPanel beforePanel() {
  measure::OverlayPanel panel = titledPanel("before: the grid", measure::PanelPicture::before);
  constexpr measure::OverlayColour kSky{0.3f, 0.8f, 0.95f, 1.0f};
  for (int row = 0; row < kRows; ++row) {
    panel.lines.push_back({.places_px = {dotPlace(0, row), dotPlace(kColumns - 1, row)}, .colour = kSky});
  }
  panel.legend.push_back({.words = "grid of 80 dots", .colour = kSky, .is_line = true});
  return panel;
}

inline measure::OverlayPanel afterPanel() {
  measure::OverlayPanel panel = titledPanel("after: matched dots", measure::PanelPicture::after);
  constexpr measure::OverlayColour kGreen{0.1f, 0.75f, 0.2f, 1.0f};
  for (int i = 0; i < kColumns * kRows; ++i) {
    panel.marks.push_back({.place_px = dragged(dotPlace(i % kColumns, i / kColumns)), .colour = kGreen});
  }
  panel.legend.push_back({.words = "matched", .colour = kGreen});
  return panel;
}

inline measure::OverlayPanel resultPanel() {
  measure::OverlayPanel panel = titledPanel("displacement and ellipse", measure::PanelPicture::before_faded);
  constexpr measure::OverlayColour kInk{0.1f, 0.1f, 0.35f, 1.0f};
  constexpr measure::OverlayColour kBlue{0.1f, 0.25f, 0.85f, 0.9f};
  const Vec2 middle(150.0, 180.0);
  std::vector<Vec2> band = ellipseAbout(middle, 104.0, 78.0, 0.9);
  const std::vector<Vec2> inner = ellipseAbout(middle, 92.0, 70.0, 0.9);
  band.insert(band.end(), inner.rbegin(), inner.rend());
  panel.lines.push_back({.places_px = std::move(band), .colour = kBlue, .closed = true, .filled = true});
  panel.lines.push_back({.places_px = ellipseAbout(middle, 98.0, 74.0, 0.9), .colour = kBlue, .width = 2.0f});
  panel.lines.push_back({.places_px = ellipseAbout(middle, 70.0, 52.0, 0.9), .colour = kBlue, .dashed = true});
  for (int i = 0; i < kColumns * kRows; ++i) {
    const Vec2 from = dotPlace(i % kColumns, i / kColumns);
    panel.arrows.push_back({from, from + 3.0 * (dragged(from) - from), kInk});
  }
  panel.marks.push_back({.place_px = middle, .form = measure::MarkForm::star, .colour = kInk, .radius = 6.0f});
  panel.legend = {{.words = "2 mm ellipse", .colour = kBlue, .is_line = true},
                  {.words = "4 mm ellipse", .colour = kBlue, .is_line = true, .dashed = true},
                  {.words = "contact, fitted", .colour = kInk, .form = measure::MarkForm::star}};
  panel.scale_bar_px = 55.0;
  return panel;
}

inline std::shared_ptr<const measure::Measurement> somethingMeasured() {
  auto measured = std::make_shared<measure::Measurement>();
  measure::FieldFit& fit = measured->fit.emplace();
  fit.at_2_mm = {2.0, {89.1, 1.2}, {67.3, 0.9}, {1.32, 0.03}, {51.6, 2.0}};
  fit.at_4_mm = {4.0, {63.6, 0.9}, {47.3, 0.7}, {1.34, 0.03}, {51.6, 2.0}};
  fit.peak_mm = {12.7, 0.8};
  fit.drag_deg = {53.1, 0.7};
  fit.inverse_tail = {0.12, 0.05};
  fit.drift.length_mm = 0.31;
  fit.residual_rms_mm = 0.14;
  fit.gaussian_rim_mm = 151.0;
  fit.inside_share = 1.0;
  measured->dots.resize(80);
  measured->matched = 76;
  measured->findings = {{measure::Severity::warning, "form", "The field is not quite of the fitted form."}};
  return measured;
}

/// What `fillView` shows; it needs a context of OpenGL.
using MadePhotographs = std::array<view::FlatPicture, 2>;
inline MadePhotographs madePhotographs() {
  return {view::FlatPicture(dottedSkin(false)), view::FlatPicture(dottedSkin(true))};
}

/// As it is after an accepted measurement.
inline void fillView(MeasuringView& view, const MadePhotographs& photographs) {
  view.open = true;
  for (std::size_t i = 0; i < 2; ++i) {
    view.photos[i] = {i == 0 ? "person/T6_before.jpg" : "person/T6_after.jpg",
                      kPhotoWidth,
                      kPhotoHeight,
                      {},
                      photographs[i].texture()};
  }
  view.stale = Stale::nothing;
  for (int i = 0; i < kColumns * kRows; ++i) {
    view.marks.before.push_back({dotPlace(i % kColumns, i / kColumns), 60.0});
    view.marks.after.push_back({dragged(dotPlace(i % kColumns, i / kColumns)), 60.0});
  }
  view.measured = somethingMeasured();
  view.overlay = {.panels = {beforePanel(), afterPanel(), resultPanel()},
                  .verdict = "accepted: half axes at 2 mm 89.1 ± 1.2 and 67.3 ± 0.9 mm",
                  .accepted = true,
                  .findings = {}};
  view.tab = MeasuringTab::result;
  view.form = {.place = "T6 left 40", .table = "key_points.csv", .at_mm = Vec2(-40.0, 60.0)};
  view.form.place_name = "T6 left 40 mm";
  view.form.place_words = "T6 left 40 mm: x -40, y 60 mm";
}

}  // namespace palpate::viewer
