// Figures 4.1, 4.2, 4.5, 4.6, 4.10 and 4.11: sketches of the deformation, drawn with the engine's own curves.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dissertation/figures/dissertation_figures.h"
#include "palpate/base/gaussian.h"
#include "palpate/deform/contact.h"
#include "palpate/tissue/profile_forms.h"
#include "report/page/plot_parts.h"

namespace palpate::study {

namespace {

constexpr double kSketchDepth = 10.0;  // mm, (4.15)
constexpr double kSketchDrag = 20.0;   // mm, (4.17)

// The circle of a press of that depth, with the default tissue.
double sketchRadius() {
  const deform::TissueSettings tissue;
  return tissue.normal_radius_mm + tissue.normal_radius_per_depth * kSketchDepth;
}

Plot skinSketch(const std::string& title, double half_width) {
  Plot plot{.title = title};
  plot.equal_aspect = true;
  plot.x = {.label = "along the skin", .unit = "mm", .from = -half_width, .to = half_width};
  plot.y = {.label = "height", .unit = "mm", .from = -0.5 * half_width, .to = 0.5 * half_width};
  return plot;
}

// The skin along a line through the contact, pressed by `depth` and dragged by `drag` along that line.
template <class Form>
Series sketchedSkin(const std::string& name, double half_width, double depth, double drag, const Form& form) {
  constexpr int kPoints = 300;
  // The drag's own region, so wide that no part of the line overtakes another.
  constexpr double kDragRadius = 70.0;  // mm
  Series series{.name = name};
  for (int i = 0; i <= kPoints; ++i) {
    const double at = half_width * (2.0 * i / kPoints - 1.0);
    series.x.push_back(at + drag * halfGaussian(std::abs(at) / kDragRadius));
    series.y.push_back(-depth * form(std::abs(at) / sketchRadius()));
  }
  return series;
}

double roundForm(double q) { return q < 1.0 ? tissue::halfGaussianForm(q).value : 0.0; }
double sharpSketchForm(double q) { return q < 1.0 ? tissue::sharpForm(q).value : 0.0; }

Series skinAtRest(double half_width) {
  return {.name = "at rest", .x = {-half_width, half_width}, .y = {0.0, 0.0}, .stroke = Stroke::dashed};
}

Figure figure41() {
  constexpr double kHalf = 45.0;
  Plot plot = skinSketch("A sharp rigid object", kHalf);
  plot.shapes = {{.name = "rigid object",
                  .paths = {{Vec2(0.0, -kSketchDepth), Vec2(9.0, 20.0), Vec2(-9.0, 20.0)}},
                  .fill = figures::withAlpha(figures::kSky, 0.4)}};
  plot.series = {skinAtRest(kHalf), sketchedSkin("pressed", kHalf, kSketchDepth, 0.0, sharpSketchForm)};
  return {.panels = {plot}, .panel_height_px = 330.0};
}

Figure figure42() {
  constexpr double kHalf = 45.0;
  constexpr double kBall = 8.0;  // mm
  Plot plot = skinSketch("A round rigid object", kHalf);
  plot.shapes = {{.name = "ball of 8 mm",
                  .paths = {figures::ellipseOutline(Vec2(0.0, kBall - kSketchDepth), kBall, kBall, 0.0)},
                  .fill = figures::withAlpha(figures::kSky, 0.4)}};
  plot.series = {skinAtRest(kHalf), sketchedSkin("half Gaussian", kHalf, kSketchDepth, 0.0, roundForm)};
  return {.panels = {plot}, .panel_height_px = 330.0};
}

Figure figure45() {
  constexpr double kHalf = 90.0;
  Figure figure{.columns = 2, .panel_height_px = 300.0};
  for (const double drag : {0.0, kSketchDrag}) {
    Plot plot = skinSketch(drag > 0.0 ? "Pressed and dragged" : "Pressed", kHalf);
    plot.series = {skinAtRest(kHalf), sketchedSkin("deformed", kHalf, kSketchDepth, drag, roundForm)};
    const Vec2 anchor(0.0, 0.0);
    plot.arrows = {{anchor, Vec2(drag, -kSketchDepth), figures::kVermilion, 1.8}};
    figure.panels.emplace_back(plot);
  }
  return figure;
}

Figure figure46() {
  const double radius = sketchRadius();
  const Vec2 d(0.45 * radius, 0.3 * radius);
  const Vec2 c = d.normalized() * radius;
  Plot above{.title = "Seen along the normal"};
  above.equal_aspect = true;
  above.x = {.label = "x", .unit = "mm"};
  above.y = {.label = "y", .unit = "mm"};
  above.shapes = {
      {.name = "boundary of the deformation",
       .paths = {figures::ellipseOutline(Vec2::Zero(), radius, radius, 0.0)},
       .stroke = Stroke::dashed,
       .colour = figures::kVermilion},
      {.name = "r = OD", .paths = {{Vec2::Zero(), d}}, .closed = false, .colour = figures::kBlue, .width_px = 2.2},
      {.paths = {{d, c}}, .closed = false, .stroke = Stroke::dotted}};
  above.places = {{Vec2::Zero(), "O"}, {d, "D"}, {c, "C"}};
  Plot section = skinSketch("Section through O and C", 1.4 * radius);
  section.series = {skinAtRest(1.4 * radius), sketchedSkin("pressed", 1.4 * radius, kSketchDepth, 0.0, roundForm)};
  section.arrows = {
      {Vec2::Zero(), Vec2(0.0, -kSketchDepth), figures::kVermilion, 1.8},
      {Vec2(d.norm(), 0.0), Vec2(d.norm(), -kSketchDepth * roundForm(d.norm() / radius)), figures::kBlue, 1.8}};
  section.places = {{Vec2(0.0, -kSketchDepth), "d_max"}, {Vec2(d.norm(), 0.0), "D"}, {Vec2(radius, 0.0), "C"}};
  return {.panels = {above, section}, .columns = 2};
}

Figure figure410() {
  constexpr double kMajor = 27.0;
  constexpr double kMinor = 19.0;
  const Vec2 d(13.0, 6.0);
  const double q = std::hypot(d.x() / kMajor, d.y() / kMinor);
  Plot plane{.title = "Deformation plane"};
  plane.equal_aspect = true;
  plane.x = {.label = "along the major axis", .unit = "mm"};
  plane.y = {.label = "across", .unit = "mm"};
  plane.shapes = {{.name = "boundary",
                   .paths = {figures::ellipseOutline(Vec2::Zero(), kMajor, kMinor, 0.0)},
                   .colour = figures::kVermilion},
                  {.paths = {{Vec2::Zero(), d / q}}, .closed = false, .stroke = Stroke::dotted}};
  plane.places = {{Vec2::Zero(), "O"}, {d, "D"}, {d / q, "C"}};
  Plot array{.title = "Array of the Gaussian curve"};
  array.x = {.label = "index i", .from = 0.0, .to = 699.0};
  array.y = {.label = "M[i]", .from = 0.0, .to = 1.0};
  Series curve{.name = "M[i]"};
  for (int i = 0; i < 700; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(halfGaussian(i / 699.0));
  }
  array.series = {curve};
  const double index = std::round(699.0 * q);
  array.shapes = {verticalLine("round(699 OD / OC)", index, 0.0, 1.0)};
  array.places = {{Vec2(index, halfGaussian(index / 699.0)), fmt::format("M[{:.0f}]", index)}};
  return {.panels = {plane, array}, .columns = 2};
}

}  // namespace

std::vector<DissertationFigure> sketchFigures() {
  const std::string photograph = "A computed section instead of a photograph.";
  const std::string sketch = "Sizes are ours: a press of 10 mm in the default circle.";
  return {{"4.1", "Deformation under a sharp object", photograph, figure41, FigureBasis::own_example},
          {"4.2", "Deformation under a round object", photograph + " The finger beside the ball is left out.", figure42,
           FigureBasis::own_example},
          {"4.5", "Normal deformation, and normal and tangential deformation together",
           sketch + " The drag is (4.17)'s 20 mm, set.", figure45, FigureBasis::own_example},
          {"4.6", "Deformation region and contact point", sketch, figure46, FigureBasis::own_example},
          {"4.10", "Mapping from the deformation plane to the array", "The ellipse is ours.", figure410,
           FigureBasis::own_example}};
}

}  // namespace palpate::study
