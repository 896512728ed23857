// The rows of the dissertation's Appendix C, and their means: arithmetic as printed, or log-Euclidean, and of
// the axes alone by doubled angles.
//
// Based on: Ji, dissertation 2008, section 5.1 and Appendix C; Mardia, Jupp, "Directional statistics" (2000), axial
// data.
#include "palpate/maps/measured_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "palpate/base/elementary.h"

namespace palpate::maps {

namespace {

constexpr ForceDirection kUp = ForceDirection::up;
constexpr ForceDirection kDown = ForceDirection::down;

/// Force, point, subject, "major" cm, "minor" cm, degree.
constexpr std::array<MeasuredEllipse, 40> kAppendixC{{
    {kUp, 1, 1, 42, 32, 90},    {kUp, 1, 2, 35, 33, 90},    {kUp, 1, 3, 34, 32, 90},
    {kUp, 1, 4, 36, 33, 90},    {kUp, 1, 5, 32, 28, 90},  //
    {kUp, 2, 1, 33, 27, 90},    {kUp, 2, 2, 28, 28, 90},    {kUp, 2, 3, 23, 28, 90},
    {kUp, 2, 4, 35, 31, 90},    {kUp, 2, 5, 30, 28, 90},  //
    {kUp, 3, 1, 26, 18, 180},   {kUp, 3, 2, 28, 28, 180},   {kUp, 3, 3, 29, 21, 180},
    {kUp, 3, 4, 26, 21, 180},   {kUp, 3, 5, 24, 22, 180},  //
    {kUp, 4, 1, 36, 25, 95},    {kUp, 4, 2, 35, 29, 87},    {kUp, 4, 3, 41, 29, 135},
    {kUp, 4, 4, 38, 27, 90},    {kUp, 4, 5, 29, 22, 90},  //
    {kUp, 5, 1, 26, 20, 145},   {kUp, 5, 2, 30, 24, 90},    {kUp, 5, 3, 34, 24, 140},
    {kUp, 5, 4, 27, 20, 155},   {kUp, 5, 5, 25, 20, 75},                                 //
    {kDown, 1, 3, 27, 28, 90},  {kDown, 1, 4, 32, 28, 90},  {kDown, 1, 5, 23, 25, 90},   //
    {kDown, 2, 3, 39, 31, 90},  {kDown, 2, 4, 36, 31, 90},  {kDown, 2, 5, 33, 26, 90},   //
    {kDown, 3, 3, 28, 21, 180}, {kDown, 3, 4, 31, 32, 180}, {kDown, 3, 5, 25, 25, 180},  //
    {kDown, 4, 3, 35, 27, 60},  {kDown, 4, 4, 38, 30, 45},  {kDown, 4, 5, 32, 25, 100},  //
    {kDown, 5, 3, 33, 33, 90},  {kDown, 5, 4, 46, 34, 85},  {kDown, 5, 5, 37, 24, 90},
}};

/// Rounds as a table with that many digits would.
double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

}  // namespace

std::span<const MeasuredEllipse> appendixC() { return kAppendixC; }

std::vector<MeasuredEllipse> measuredAt(ForceDirection force, int point) {
  std::vector<MeasuredEllipse> rows;
  std::copy_if(kAppendixC.begin(), kAppendixC.end(), std::back_inserter(rows),
               [&](const MeasuredEllipse& row) { return row.force == force && row.point == point; });
  return rows;
}

PlainMean plainMean(std::span<const MeasuredEllipse> rows) {
  PlainMean sum{0.0, 0.0, 0.0, 0.0};
  for (const MeasuredEllipse& row : rows) {
    sum.major_cm += row.major_cm;
    sum.minor_cm += row.minor_cm;
    sum.major_over_minor += row.majorOverMinor();
    sum.direction_deg += row.direction_deg;
  }
  const auto n = static_cast<double>(rows.size());
  return {sum.major_cm / n, sum.minor_cm / n, sum.major_over_minor / n, sum.direction_deg / n};
}

Ellipse tensorialMean(std::span<const MeasuredEllipse> rows) {
  LogTensor sum = LogTensor::Zero();
  for (const MeasuredEllipse& row : rows) {
    sum += logTensor(ellipseFromFullAxesCm(row.major_cm, row.minor_cm, row.direction_deg));
  }
  return ellipseOf(sum / static_cast<double>(rows.size()));
}

AxialMean axialMean(std::span<const MeasuredEllipse> rows) {
  Vec2 sum = Vec2::Zero();
  for (const MeasuredEllipse& row : rows) {
    const double twice = 2.0 * row.direction_deg * kRadPerDeg;
    sum += Vec2(elementary::cos(twice), elementary::sin(twice));
  }
  // A circle: canonicalEllipse folds the angle into [0, pi).
  const Ellipse axis = canonicalEllipse(1.0, 1.0, 0.5 * elementary::atan2(sum.y(), sum.x()));
  return {axis.direction_rad / kRadPerDeg, sum.norm() / static_cast<double>(rows.size())};
}

Ellipse asPrinted(const PlainMean& mean) {
  const double major_cm = rounded(mean.major_cm, 10.0);
  const double minor_cm = major_cm / rounded(mean.major_over_minor, 1000.0);
  return ellipseFromFullAxesCm(major_cm, minor_cm, rounded(mean.direction_deg, 10.0));
}

Ellipse meanEllipse(std::span<const MeasuredEllipse> rows, Averaging averaging) {
  return averaging == Averaging::tensorial ? tensorialMean(rows) : asPrinted(plainMean(rows));
}

}  // namespace palpate::maps
