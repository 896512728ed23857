// Reads the file that CMake compiles in (layered_truth.json); linear between the radii.
#include "dissertation/rivals/layered_truth.h"

#include <fmt/format.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/base/json.h"

namespace palpate::study {

namespace {

LayeredPress pressOf(const Json& entry, double step_mm) {
  LayeredPress press{.tissue = entry.at("tissue").text(),
                     .layers = {},
                     .depth_mm = entry.at("depth_mm").get<double>(),
                     .central_mm = entry.at("u0_mm").get<double>(),
                     .force_n = entry.at("force_n").get<double>(),
                     .step_mm = step_mm,
                     .inward = entry.at("uz").get<std::vector<double>>(),
                     .outward = entry.at("ur").get<std::vector<double>>()};
  for (const auto& layer : entry.at("layers"))
    press.layers.push_back({layer.at(0).get<double>(), layer.at(1).get<double>()});
  return press;
}

double between(const std::vector<double>& values, double at) {
  const double last = static_cast<double>(values.size() - 1);
  if (at >= last) return values.back();
  const auto below = static_cast<std::size_t>(at);
  const double share = at - static_cast<double>(below);
  return (1.0 - share) * values[below] + share * values[below + 1];
}

}  // namespace

const std::vector<LayeredPress>& layeredPresses() {
  static const std::vector<LayeredPress> all = [] {
    const Json file = Json::parse(layeredTruthFile());
    std::vector<LayeredPress> presses;
    for (const auto& entry : file.at("presses"))
      presses.push_back(pressOf(entry, file.at("radius_step_mm").get<double>()));
    return presses;
  }();
  return all;
}

const LayeredPress& layeredPress(std::string_view tissue, double depth_mm) {
  for (const LayeredPress& press : layeredPresses()) {
    if (press.tissue == tissue && press.depth_mm == depth_mm) return press;
  }
  throw Error(fmt::format("study rivals: no reference for {} pressed {:g} mm", tissue, depth_mm));
}

Vec3 trueDisplacement(const LayeredPress& press, const Vec2& place) {
  const double radius = place.norm();
  const double at = radius / press.step_mm;
  const Vec2 outward = radius > 0.0 ? Vec2(place / radius) : Vec2::Zero();
  const Vec2 along = press.central_mm * between(press.outward, at) * outward;
  return {along.x(), along.y(), -press.central_mm * between(press.inward, at)};
}

}  // namespace palpate::study
