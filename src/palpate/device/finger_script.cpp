#include "palpate/device/finger_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "palpate/base/error.h"

namespace palpate::device {

namespace {

/// Where a script stands: over which place, and how far above the skin (below it when negative).
struct Stand {
  Vec2 place = Vec2::Zero();
  double height = 0.0;
};

/// Minimum jerk: from 0 to 1 with velocity and acceleration 0 at both ends.
double eased(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

/// Spirals out from the centre, goes round, and spirals back in.
Vec2 circleOffset(const scene::Step& step, double t) {
  constexpr double kLongestSpiral = 0.25;  // of the step, so that at least half of it is round
  const double half_turn = std::abs(step.turns) > 0.0 ? 0.5 / std::abs(step.turns) : 1.0;
  const double spiral = std::min(half_turn, kLongestSpiral);
  const double radius = step.radius_mm * eased(t / spiral) * eased((1.0 - t) / spiral);
  const double angle = 2.0 * std::numbers::pi * step.turns * t;
  return radius * Vec2(std::cos(angle), std::sin(angle));
}

/// The stand at share t of a step that began at `from`.
Stand during(const scene::Step& step, const Stand& from, double t) {
  Stand now = from;
  switch (step.move) {
    case scene::Move::press:
      now.height += (-step.depth_mm - from.height) * eased(t);
      break;
    case scene::Move::lift:
      now.height += (step.height_mm - from.height) * eased(t);
      break;
    case scene::Move::drag:
      now.place += step.by_mm * eased(t);
      break;
    case scene::Move::circle:
      now.place += circleOffset(step, t);
      break;
    case scene::Move::hold:
      break;
  }
  return now;
}

void requireReasonableLength(const scene::Finger& finger) {
  double seconds = 0.0;
  for (const scene::Step& step : finger.steps) seconds += step.seconds;
  if (seconds > kMaxScriptS) {
    throw Error(fmt::format("finger '{}': the script lasts {} s, more than {} s", finger.name, seconds, kMaxScriptS));
  }
}

std::vector<Stand> standsOf(const scene::Finger& finger, double tick_s) {
  requireReasonableLength(finger);
  std::vector<Stand> stands = {{finger.at_mm, finger.start_height_mm}};
  for (const scene::Step& step : finger.steps) {
    const Stand from = stands.back();
    const auto ticks = static_cast<std::size_t>(std::max(1.0, std::round(step.seconds / tick_s)));
    for (std::size_t k = 1; k <= ticks; ++k) {
      stands.push_back(during(step, from, static_cast<double>(k) / static_cast<double>(ticks)));
    }
  }
  return stands;
}

std::vector<double> skinHeights(const scene::Finger& finger, const std::vector<Stand>& stands,
                                const SkinHeight& height) {
  const Vec2 start = stands.front().place;
  const auto first = height(start.x(), start.y());
  if (!first) {
    throw Error(fmt::format("finger '{}': there is no skin at at_mm = [{}, {}]", finger.name, start.x(), start.y()));
  }
  std::vector<double> heights;
  heights.reserve(stands.size());
  for (const Stand& stand : stands) {
    const double last = heights.empty() ? *first : heights.back();
    heights.push_back(height(stand.place.x(), stand.place.y()).value_or(last));
  }
  return heights;
}

/// Mean over `reach` values to both sides; the ends are continued.
std::vector<double> movingMean(const std::vector<double>& values, std::ptrdiff_t reach) {
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  const auto at = [&](std::ptrdiff_t i) {
    return values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, size - 1))];
  };
  std::vector<double> prefix(values.size() + 1 + 2 * static_cast<std::size_t>(reach), 0.0);
  for (std::ptrdiff_t i = 0; i + 1 < static_cast<std::ptrdiff_t>(prefix.size()); ++i) {
    prefix[static_cast<std::size_t>(i) + 1] = prefix[static_cast<std::size_t>(i)] + at(i - reach);
  }
  std::vector<double> means(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto width = static_cast<std::size_t>(2 * reach + 1);
    means[i] = (prefix[i + width] - prefix[i]) / static_cast<double>(width);
  }
  return means;
}

}  // namespace

std::vector<Vec3> walkScript(const scene::Finger& finger, const ScriptFrame& frame, const SkinHeight& height,
                             double tick_s) {
  const std::vector<Stand> stands = standsOf(finger, tick_s);
  const auto reach = static_cast<std::ptrdiff_t>(std::llround(0.5 * kReliefSmoothingS / tick_s));
  // Twice a moving mean: a kink in the relief becomes a smooth curve, not a polygon.
  const std::vector<double> skin = movingMean(movingMean(skinHeights(finger, stands, height), reach), reach);
  std::vector<Vec3> tips(stands.size());
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const Stand& stand = stands[i];
    tips[i] = frame.origin + stand.place.x() * frame.u + stand.place.y() * frame.v +
              (skin[i] + stand.height + finger.radius_mm) * frame.w;
  }
  return tips;
}

}  // namespace palpate::device
