// Parts that plots of several studies share.
#pragma once

#include <string>
#include <vector>

#include "figures/plot.h"

namespace palpate::study {

/// A dotted line from the bottom to the top of a plot whose y axis has this range.
figures::Shape verticalLine(const std::string& name, double x, double from, double to);

/// A curve with markers; dashed stands for what the dissertation printed.
figures::Series measuredSeries(const std::string& name, std::vector<double> x, std::vector<double> y,
                               figures::Marker marker = figures::Marker::circle);
figures::Series printedSeries(const std::string& name, std::vector<double> x, std::vector<double> y,
                              figures::Marker marker = figures::Marker::square);

/// Ticks at these values, in plain digits however long.
std::vector<figures::Tick> ticksAt(const std::vector<double>& values);
/// Ticks at these shares, written as 1/4 where they are such.
std::vector<figures::Tick> fractionTicksAt(const std::vector<double>& shares);

/// One value of every row.
template <class Row, class Value>
std::vector<double> column(const std::vector<Row>& rows, Value Row::*value) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back(static_cast<double>(row.*value));
  return values;
}

}  // namespace palpate::study
