// Random ellipses about a known axis, of the mean measured size, are averaged in each of the three ways. Seeds are the
// trials' numbers, so all ways see the same people. Based on: see axis_means.h.
#include "dissertation/directions/axis_means.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/random.h"
#include "palpate/maps/ellipse.h"

namespace palpate::study {

namespace {

constexpr double kMmPerHalfCm = 5.0;  // half axis in mm of a full axis in cm (E16)

double foldedDeg(double degree) {
  const double rest = std::fmod(degree, 180.0);
  return rest < 0.0 ? rest + 180.0 : rest;
}

// The mean of Appendix C: 31.6 cm, ratio 1.2; the ratio of real subjects spreads from 1 to 1.54.
maps::Ellipse trueEllipse(double direction_deg) {
  maps::LogTensor sum = maps::LogTensor::Zero();
  double half_difference = 0.0;
  for (const maps::MeasuredEllipse& row : maps::appendixC()) {
    const auto tensor = maps::logTensor(maps::ellipseFromFullAxesCm(row.major_cm, row.minor_cm, row.direction_deg));
    sum += tensor;
    half_difference += tensor.tail<2>().norm();
  }
  const auto n = static_cast<double>(maps::appendixC().size());
  const double twice = 2.0 * direction_deg / kDegPerRad;
  return maps::ellipseOf({sum[0] / n, half_difference / n * std::cos(twice), half_difference / n * std::sin(twice)});
}

maps::MeasuredEllipse toMeasuredEllipse(const maps::Ellipse& ellipse) {
  const double major_cm = ellipse.half_major_mm / kMmPerHalfCm;
  return {
      .major_cm = major_cm, .minor_cm = major_cm * ellipse.aspect, .direction_deg = ellipse.direction_rad * kDegPerRad};
}

}  // namespace

double meanAxisDeg(std::span<const maps::MeasuredEllipse> rows, AxisMean mean) {
  switch (mean) {
    case AxisMean::degrees:
      return foldedDeg(maps::plainMean(rows).direction_deg);
    case AxisMean::double_angle:
      return maps::axialMean(rows).direction_deg;
    case AxisMean::tensor:
      return foldedDeg(maps::tensorialMean(rows).direction_rad * kDegPerRad);
  }
  return 0.0;
}

double axisDifferenceDeg(double a_deg, double b_deg) {
  const double turn = foldedDeg(a_deg - b_deg);
  return std::min(turn, 180.0 - turn);
}

std::vector<maps::MeasuredEllipse> scatteredRows(const AxisScatter& scatter, std::uint64_t seed) {
  Random random(seed);
  std::vector<maps::MeasuredEllipse> rows;
  for (int person = 0; person < scatter.people; ++person) {
    const double turned = scatter.true_deg + scatter.spread_deg * random.normal();
    maps::LogTensor tensor = maps::logTensor(trueEllipse(turned));
    for (double& part : tensor) part += scatter.radius_noise * random.normal();
    rows.push_back(toMeasuredEllipse(maps::ellipseOf(tensor)));
  }
  return rows;
}

std::array<double, 3> meanErrorsDeg(const AxisScatter& scatter) {
  constexpr double kGoldenTurn = 0.6180339887498949;  // fills the half circle evenly
  std::array<double, 3> squares{};
  AxisScatter one = scatter;
  for (int trial = 0; trial < scatter.trials; ++trial) {
    if (scatter.true_deg < 0.0) one.true_deg = foldedDeg(180.0 * kGoldenTurn * trial);
    const auto rows = scatteredRows(one, static_cast<std::uint64_t>(trial));
    for (std::size_t i = 0; i < kAxisMeans.size(); ++i) {
      const double error = axisDifferenceDeg(meanAxisDeg(rows, kAxisMeans[i]), one.true_deg);
      squares[i] += error * error / scatter.trials;
    }
  }
  for (double& square : squares) square = std::sqrt(square);
  return squares;
}

}  // namespace palpate::study
