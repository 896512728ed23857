#include "view/viewer/files/scene_snippet.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "palpate/base/text.h"

namespace palpate::viewer {

namespace {

constexpr std::string_view kWord = "palpate-view";

/// Millimetres and degrees: no body is viewed from farther.
constexpr double kFarthest = 1e7;

}  // namespace

std::string viewAsText(const view::Camera& camera) {
  return fmt::format("{} {:.3f} {:.3f} {:.3f} {:.4f} {:.4f} {:.3f} {:.4f}", kWord, camera.centre.x(), camera.centre.y(),
                     camera.centre.z(), camera.yaw_rad / kRadPerDeg, camera.pitch_rad / kRadPerDeg, camera.distance_mm,
                     camera.height_rad / kRadPerDeg);
}

std::optional<view::Camera> viewFromText(std::string_view text) {
  const auto fields = split(trimmed(text), ' ');
  if (fields.size() != 8 || fields[0] != kWord) return std::nullopt;
  std::vector<double> v;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const auto number = parseNumber(fields[i]);
    if (!number || !(std::abs(*number) <= kFarthest)) return std::nullopt;
    v.push_back(*number);
  }
  if (!(v[5] > 0.0) || !(v[6] > 0.0 && v[6] < 170.0) || !(std::abs(v[4]) < 90.0)) return std::nullopt;
  return view::Camera{.centre = Vec3(v[0], v[1], v[2]),
                      .yaw_rad = v[3] * kRadPerDeg,
                      .pitch_rad = v[4] * kRadPerDeg,
                      .distance_mm = v[5],
                      .height_rad = v[6] * kRadPerDeg};
}

}  // namespace palpate::viewer
