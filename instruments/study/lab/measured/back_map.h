// A value over the back, seen along z: the plot of a map inside the outline of the built-in back.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "palpate/maps/key_points.h"
#include "report/charts/plot.h"

namespace palpate::study {

/// Value at a place in the map plane, mm.
using MapValue = std::function<double(const Vec2& place)>;

/// Look of a map: the colour bar and its range.
struct MapLook {
  std::string label;
  std::string unit;
  double from = 0.0;
  double to = 1.0;
  ColourMap colours = ColourMap::viridis;
  std::vector<double> contour_levels{};
};

/// Colours inside the outline with the key points marked. `step_mm` is the distance of two values.
figures::Plot backMap(const std::string& title, const MapValue& value, const MapLook& look,
                      std::span<const maps::KeyPoint> keys, double step_mm = 4.0);

/// The places of a square grid inside the outline; symmetric about x = 0.
std::vector<Vec2> placesOnBack(double step_mm);

}  // namespace palpate::study
