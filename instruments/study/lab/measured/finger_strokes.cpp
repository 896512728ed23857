// A stroke is a polyline through air and under the skin, then walked at constant speed from a random phase: speeds
// share their ways, for the seed draws the same numbers.
#include "lab/measured/finger_strokes.h"

#include <cmath>
#include <numbers>

#include "lab/workloads/workload_meshes.h"
#include "palpate/base/random.h"

namespace palpate::study {

namespace {

using lab::kBackLengthMm;
using lab::kBackWidthMm;

// Strokes stay this far from the border of the back.
constexpr double kBorderMm = 40.0;
// Step of the way that is then walked at constant speed.
constexpr double kWayStepMm = 0.5;

bool isInside(const Vec2& place) {
  return place.x() > kBorderMm && place.x() < kBackWidthMm - kBorderMm && place.y() > kBorderMm &&
         place.y() < kBackLengthMm - kBorderMm;
}

Vec3 skinAt(const Vec2& place) { return {place.x(), place.y(), lab::backHeight(place.x(), place.y())}; }

Vec2 unitVector(double angle) { return {std::cos(angle), std::sin(angle)}; }

// Air, contact, slide, as a polyline.
std::vector<Vec3> strokeWay(const StrokeSettings& settings, Random& random) {
  Vec2 from = Vec2::Zero();
  Vec2 direction = Vec2::Zero();
  do {
    from.y() = random.uniform(0.0, kBackLengthMm);
    from.x() = random.uniform(0.0, kBackWidthMm);
    direction = unitVector(random.uniform(0.0, 2.0 * std::numbers::pi));
  } while (!isInside(from) || !isInside(from + settings.slide_mm * direction));
  const double tilt = random.uniform(0.0, std::numbers::pi / 4.0);
  const Vec2 sideways = std::sin(tilt) * unitVector(random.uniform(0.0, 2.0 * std::numbers::pi));
  const Vec3 down = settings.depth_mm * Vec3::UnitZ();
  std::vector<Vec3> way{skinAt(from) + settings.approach_mm * Vec3(sideways.x(), sideways.y(), std::cos(tilt))};
  for (double along = 0.0; along <= settings.slide_mm; along += kWayStepMm) {
    way.push_back(skinAt(from + along * direction) - down);
  }
  return way;
}

// Places every `step` mm along the polyline; the first is `offset` in, so that strokes differ in phase.
std::vector<Vec3> walked(const std::vector<Vec3>& way, double step, double offset) {
  std::vector<Vec3> places;
  double ahead = offset;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 piece = way[i] - way[i - 1];
    const double length = piece.norm();
    for (; ahead < length; ahead += step) places.push_back(way[i - 1] + (ahead / length) * piece);
    ahead -= length;
  }
  return places;
}

}  // namespace

std::vector<std::vector<Vec3>> fingerStrokes(const StrokeSettings& settings) {
  Random random(settings.seed);
  const double step = settings.speed_mm_s * settings.tick_s;
  std::vector<std::vector<Vec3>> strokes;
  for (int i = 0; i < settings.count; ++i) {
    const std::vector<Vec3> way = strokeWay(settings, random);
    strokes.push_back(walked(way, step, step * random.uniform()));
  }
  return strokes;
}

}  // namespace palpate::study
