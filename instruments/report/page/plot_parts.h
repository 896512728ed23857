// Parts that plots of several studies share.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "palpate/hdb/partition.h"
#include "report/charts/figure.h"
#include "report/charts/plot.h"

namespace palpate::study {

// Every study draws with these.
using figures::Figure;
using figures::Marker;
using figures::Plot;
using figures::Scale;
using figures::Series;
using figures::Stroke;

/// The dissertation's two trees, in the order of every comparison.
inline constexpr std::array kTrees{hdb::TreeKind::Bsp, hdb::TreeKind::Octree};

/// Empty, in mm, one as long on both axes.
Plot mapPlane(const std::string& title);

/// From the least to the greatest of these thresholds, ascending, logarithmic.
figures::Axis thresholdAxis(const std::vector<Index>& thresholds, const std::vector<double>& ticks);

/// A dotted line from the bottom to the top of a plot whose y axis has this range.
figures::Shape verticalLine(const std::string& name, double x, double from, double to);

/// A curve with markers; dashed ones are the dissertation's printed values.
figures::Series measuredSeries(const std::string& name, std::vector<double> x, std::vector<double> y,
                               figures::Marker marker = figures::Marker::circle);
figures::Series dissertationSeries(const std::string& name, std::vector<double> x, std::vector<double> y,
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

/// The data of every curve and field: columns panel,series,x,y,value.
std::string toCsv(const figures::Figure& figure);

}  // namespace palpate::study
