// A two-dimensional plot as plain data: what is shown, never how it is drawn (draw_plot.cpp does that).
//
// One type serves line charts, maps and sketches: fill in what the picture needs. Layers are painted in this order:
// field, grid, shapes, contour lines, series, arrows, labelled places, labels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "report/charts/colour.h"

namespace palpate::figures {

enum class Scale { linear, logarithmic };

struct Tick {
  double value = 0.0;
  std::string text{};
};

struct Axis {
  std::string label{};  ///< without the unit
  std::string unit{};   ///< shown as "label (unit)"; empty for pure numbers
  Scale scale = Scale::linear;
  /// The shown range; from the data, widened to nice numbers, where empty.
  std::optional<double> from{};
  std::optional<double> to{};
  /// Named places instead of numbers.
  std::vector<Tick> ticks{};
  bool hidden = false;  ///< no ticks, no numbers, no label: for sketches
};

enum class Stroke { none, solid, dashed, dotted };
enum class Marker { none, circle, square, triangle, diamond, cross };

/// A curve, or points with `stroke = none`. Non-finite points (and, on a logarithmic axis, those <= 0) interrupt it.
struct Series {
  std::string name{};  ///< for the legend; an empty name is not listed
  std::vector<double> x{};
  std::vector<double> y{};  ///< same size as x
  Stroke stroke = Stroke::solid;
  Marker marker = Marker::none;
  std::optional<Colour> colour{};  ///< the next of the palette where empty
  double width_px = 1.8;
};

/// Outlines in the plot's coordinates: ellipses, polygons, boxes, wire frames.
struct Shape {
  std::string name{};  ///< for the legend; an empty name is not listed
  std::vector<std::vector<Vec2>> paths{};
  bool closed = true;
  Stroke stroke = Stroke::solid;
  Colour colour = kInk;
  std::optional<Colour> fill{};
  double width_px = 1.2;
};

struct Arrow {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  Colour colour = kBlue;
  double width_px = 1.2;
};

/// A marked place with a text next to it.
template <class Point>
struct PlaceAt {
  Point at = Point::Zero();
  std::string text{};
  Marker marker = Marker::circle;
  Colour colour = kInk;
};
/// The text looks for a free spot around it.
using Place = PlaceAt<Vec2>;

/// Values over a regular grid, shown as colours; NaN is outside and stays empty.
struct Field {
  Vec2 origin = Vec2::Zero();    ///< place of the first value
  Vec2 step = Vec2::Ones();      ///< between neighbours, > 0
  int columns = 0;               ///< along x
  int rows = 0;                  ///< along y
  std::vector<double> values{};  ///< row by row from the origin upwards, columns x rows
  std::string label{};           ///< label of the colour bar
  std::string unit{};
  std::optional<double> from{};  ///< range of the colours; of the finite values where empty
  std::optional<double> to{};
  ColourMap colours = ColourMap::viridis;
  std::vector<double> contour_levels{};  ///< lines of equal value, labelled
  bool cells = false;                    ///< each value fills a box of its own instead of blending into its neighbours
};

/// A text whose middle is at a place: in the cells of a table, next to discs.
struct Label {
  Vec2 at = Vec2::Zero();
  std::string text{};
  Colour colour = kInk;
  double size_px = 11.0;
};

struct Plot {
  std::string title{};
  Axis x{};
  Axis y{};
  bool equal_aspect = false;  ///< one unit is as long on both axes: for maps in mm
  std::optional<Field> field{};
  std::vector<Shape> shapes{};
  std::vector<Series> series{};
  std::vector<Arrow> arrows{};
  std::vector<Place> places{};
  std::vector<Label> labels{};
  bool legend = true;  ///< below the plot, so that it never hides data
  /// The frame begins at least this far from the panel's left edge, so that stacked plots share their x axis.
  double least_left_px = 0.0;
};

/// A closed polygon of an ellipse; the direction of its first half axis against x.
std::vector<Vec2> ellipseOutline(const Vec2& centre, double half_along, double half_across, double direction_rad);
std::vector<Vec2> rectangleOutline(const Vec2& low, const Vec2& high);

/// Bars of equal width from 0 up to each height, centred on the places.
Shape bars(const std::string& name, const std::vector<double>& centres, const std::vector<double>& heights,
           double width, const Colour& colour);

/// Samples a field on the grid of its origin, step, columns and rows.
template <class Function>
void sampleField(Field& field, Function value_at) {
  field.values.clear();
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      field.values.push_back(value_at(field.origin.x() + column * field.step.x(),  //
                                      field.origin.y() + row * field.step.y()));
    }
  }
}

}  // namespace palpate::figures
