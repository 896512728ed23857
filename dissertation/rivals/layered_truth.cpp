// Reads the file that CMake compiles in (layered_truth.json); linear between the radii.
#include "dissertation/rivals/tissue_block.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "palpate/base/error.h"

namespace palpate::study {

namespace {

LayeredPress pressOf(const nlohmann::json& entry, double step_mm) {
  LayeredPress press{.tissue = entry.at("tissue"),
                     .layers = {},
                     .depth_mm = entry.at("depth_mm"),
                     .central_mm = entry.at("u0_mm"),
                     .force_n = entry.at("force_n"),
                     .step_mm = step_mm,
                     .inward = entry.at("uz"),
                     .outward = entry.at("ur")};
  for (const auto& layer : entry.at("layers")) press.layers.push_back({layer.at(0), layer.at(1)});
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
    const nlohmann::json file = nlohmann::json::parse(layeredTruthFile());
    std::vector<LayeredPress> presses;
    for (const auto& entry : file.at("presses")) presses.push_back(pressOf(entry, file.at("radius_step_mm")));
    return presses;
  }();
  return all;
}

const LayeredPress& layeredPress(std::string_view tissue, double depth_mm) {
  for (const LayeredPress& press : layeredPresses()) {
    if (press.tissue == tissue && press.depth_mm == depth_mm) return press;
  }
  throw Error(fmt::format("study rivals: no truth for {} pressed {:g} mm", tissue, depth_mm));
}

Vec3 trueDisplacement(const LayeredPress& press, const Vec2& place) {
  const double radius = place.norm();
  const double at = radius / press.step_mm;
  const Vec2 outward = radius > 0.0 ? Vec2(place / radius) : Vec2::Zero();
  const Vec2 along = press.central_mm * between(press.outward, at) * outward;
  return {along.x(), along.y(), -press.central_mm * between(press.inward, at)};
}

}  // namespace palpate::study
