// The truth is solved now, each sphere on its own mesh; the product blends the shipped stacks as it does on a body.
#include "solve/commands/realism_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "palpate/base/json.h"
#include "palpate/elements/finger_solver.h"
#include "solve/realism/realism.h"
#include "solve/realism/realism_stacks.h"

namespace palpate::app {

namespace {

/// One press of a sphere.
struct RadiusPress {
  std::string name;
  double radius_mm = 0.0;
  double depth_mm = 0.0;
  double true_force_n = 0.0;  ///< by finite elements
  double force_n = 0.0;       ///< felt by the finger
  double fingertip_n = 0.0;   ///< would be felt by a fingertip of 8 mm: the force before the radius counted
  double error() const { return force_n / true_force_n - 1.0; }
};

struct RadiusReport {
  std::vector<RadiusPress> presses;
  std::vector<std::string> left_out;  ///< where the solver finds no equilibrium
  /// Fraction; of this radius, or of all (0).
  double worst(double radius_mm = 0.0) const;
};

struct JudgedRadius {
  double radius_mm;
  std::vector<double> depths_mm;
};
/// Small spheres puncture the model's skin before 10 mm.
const std::vector<JudgedRadius> kJudged = {
    {2, {1, 2, 5}}, {4, {2, 5, 8}}, {8, {2, 5, 10}}, {12, {2, 5, 10}}, {16, {2, 5, 10}}};

std::optional<double> solvedForce(const tissue::LayeredTable& table, double depth_mm) {
  const auto found = std::ranges::find(table.shapes, depth_mm, &tissue::PressedShape::depth_mm);
  return found == table.shapes.end() ? std::nullopt : std::optional(found->force_n);
}

double RadiusReport::worst(double radius_mm) const {
  double worst = 0.0;
  for (const RadiusPress& press : presses) {
    if (radius_mm == 0.0 || press.radius_mm == radius_mm) worst = std::max(worst, std::abs(press.error()));
  }
  return worst;
}

void judge(const lab::JudgedPlace& place, const scene::World& world, const JudgedRadius& judged, RadiusReport& report) {
  const double radius = judged.radius_mm;
  const elements::PressSolution truth =
      elements::solvePress(place.stack, elements::settingsOf(radius, judged.depths_mm));
  for (const double depth : judged.depths_mm) {
    const std::optional<double> force = solvedForce(truth.table, depth);
    if (!force) {
      report.left_out.push_back(fmt::format("{}, {:g} mm at {:g} mm: {}", place.name, radius, depth, truth.stopped_by));
      continue;
    }
    report.presses.push_back({place.name, radius, depth, *force, lab::pressedForce(world, radius, depth),
                              lab::pressedForce(world, 0.0, depth)});
  }
}

Json toJson(const RadiusReport& report) {
  Json json;
  json["force_error_percent_worst"] = 100.0 * report.worst();
  for (const JudgedRadius& judged : kJudged) {
    json["force_error_percent_worst_by_radius"][fmt::format("{:g}", judged.radius_mm)] =
        100.0 * report.worst(judged.radius_mm);
  }
  double fingertip = 0.0;
  json["cases"] = Json::array();
  for (const RadiusPress& press : report.presses) {
    fingertip = std::max(fingertip, std::abs(press.fingertip_n / press.true_force_n - 1.0));
    json["cases"].push_back({{"name", press.name},
                             {"radius_mm", press.radius_mm},
                             {"depth_mm", press.depth_mm},
                             {"true_force_n", press.true_force_n},
                             {"force_n", press.force_n},
                             {"force_error_percent", 100.0 * press.error()},
                             {"fingertip_n", press.fingertip_n}});
  }
  json["fingertip_error_percent_worst"] = 100.0 * fingertip;
  json["left_out"] = report.left_out;
  return json;
}

}  // namespace

Json judgeRadius(const Progress& progress) {
  RadiusReport result;
  const std::vector<lab::JudgedPlace> places = lab::placesOfBody();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const lab::JudgedPlace& place = places[i];
    const double secant = place.tissue->secantAt(place.thickness_mm, tissue::kReferenceDepthMm);
    const auto world = lab::flatWorld(scene::TissueModel::layered, place.tissue, place.thickness_mm, secant);
    for (std::size_t j = 0; j < kJudged.size(); ++j) {
      report(progress, "pressing " + place.name,
             (static_cast<double>(i) + static_cast<double>(j) / static_cast<double>(kJudged.size())) /
                 static_cast<double>(places.size()));
      judge(place, *world, kJudged[j], result);
    }
  }
  return toJson(result);
}

}  // namespace palpate::app
