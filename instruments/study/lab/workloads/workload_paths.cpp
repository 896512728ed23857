// Each path is a formula of the tick or a walk with a seed; those round a body ask every triangle, for they are made
// once. As with the meshes, the order of operations decides the last digits.
//
// Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection" (1997), for the rays of `orbit`.
#include "lab/workloads/workload_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "lab/workloads/workload_meshes.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/base/text.h"

namespace palpate::lab {
namespace {

using std::numbers::pi;
using Points = std::vector<Vec3>;

constexpr std::size_t kTwentySeconds = 20000;  // ticks of 1 ms

double roundedToNanometre(double mm) { return std::nearbyint(mm * 1e6) / 1e6; }

device::Trajectory atOneKilohertz(const Points& points) {
  device::Trajectory path;
  for (std::size_t k = 0; k < points.size(); ++k) {
    path.time_s.push_back(static_cast<double>(k) / 1000.0);
    path.tip_mm.push_back(points[k].unaryExpr(&roundedToNanometre));
  }
  return path;
}

/// `place(tick)` for 20 s.
template <class Place>
device::Trajectory makeTwentySecondPath(Place place) {
  Points points;
  for (std::size_t k = 0; k < kTwentySeconds; ++k) points.emplace_back(place(k));
  return atOneKilohertz(points);
}

double tickSeconds(std::size_t tick) { return static_cast<double>(tick) * 1e-3; }

/// 0 to 1 with flat ends.
double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Entry k of n even steps from `first` to `last`, both included.
double ramp(double first, double last, std::size_t k, std::size_t n) {
  if (k + 1 == n) return last;
  return static_cast<double>(k) * ((last - first) / static_cast<double>(n - 1)) + first;
}

/// `a` folded into [low, high] as between two mirrors.
double reflected(double a, double low, double high) {
  const double period = 2 * (high - low);
  double p = std::fmod(a - low, period);
  if (p < 0.0) p += period;
  return low + (p > high - low ? period - p : p);
}

Vec3 randomDirection(Random& random) {
  Vec3 d;
  do {
    d = random.normal3();
  } while (d.norm() < 1e-6);
  return d.normalized();
}

// ---- back_slide ---------------------------------------------------------------------------------------------------

constexpr double kPressFrom = 2.0, kLiftUntil = 18.2;  // s
constexpr double kHalfWidth = 115.0, kHalfLength = 135.0, kPhase = 0.1;

/// The parameter of the Lissajous figure at each tick, so that the horizontal speed is 300 + 200 sin(pi tau / 2) mm/s;
/// explicit Euler with 20 steps a millisecond.
std::vector<double> lissajousParameters() {
  std::vector<double> parameter(kTwentySeconds, 0.0);
  double q = 0.0;
  for (std::size_t k = 1; k < kTwentySeconds; ++k) {
    for (int m = 0; m < 20 && kSlideFromSeconds < tickSeconds(k) && tickSeconds(k) <= kSlideUntilSeconds; ++m) {
      const double tau = tickSeconds(k - 1) - kSlideFromSeconds + m * 5e-5;
      const double speed = 300 + 200 * std::sin(2 * pi * 0.25 * tau);
      q += speed * 5e-5 / std::hypot(2 * kHalfWidth * std::cos(2 * q), 3 * kHalfLength * std::cos(3 * q + kPhase));
    }
    parameter[k] = q;
  }
  return parameter;
}

Vec3 approachPoint(double t) {
  const double x0 = 175.0, y0 = 200 + kHalfLength * std::sin(kPhase), s = t / kPressFrom;
  return {x0 + 20 * std::sin(2 * pi * 2 * s) * (1 - s), y0 + 20 * std::sin(2 * pi * 3 * s) * (1 - s),
          backHeight(x0, y0) + 2 + 70 * (1 - smooth(s))};
}

Vec3 pressPoint(double t) {
  const double x0 = 175.0, y0 = 200 + kHalfLength * std::sin(kPhase);
  return {x0, y0, backHeight(x0, y0) + 2 - 7 * smooth((t - kPressFrom) / (kSlideFromSeconds - kPressFrom))};
}

double slideDepth(double t) {
  const double tau = std::clamp(t - kSlideFromSeconds, 0.0, kSlideUntilSeconds - kSlideFromSeconds);
  return 7.5 - 2.5 * std::cos(2 * pi * 0.7 * tau);
}

Vec3 slidePoint(double parameter, double t) {
  const double x = 175 + kHalfWidth * std::sin(2 * parameter);
  const double y = 200 + kHalfLength * std::sin(3 * parameter + kPhase);
  return {x, y, backHeight(x, y) - slideDepth(t)};
}

Vec3 liftPoint(const Vec3& end, double t) {
  const double depth = slideDepth(kSlideUntilSeconds);
  const double share = smooth((t - kSlideUntilSeconds) / (kLiftUntil - kSlideUntilSeconds));
  return {end.x(), end.y(), backHeight(end.x(), end.y()) - depth + (depth + 2) * share};
}

Vec3 departPoint(const Vec3& end, double t) {
  const double s = t - kLiftUntil, rise = std::sin(pi * s / 1.8 * 0.5);
  return {end.x() + 10 * std::sin(2 * pi * s) * 0.5, end.y(), backHeight(end.x(), end.y()) + 2 + 30 * (rise * rise)};
}

// ---- flat plate ---------------------------------------------------------------------------------------------------

/// Appends straight pieces at an even step.
void moveTo(const Vec3& goal, double step_mm, Points& points) {
  const Vec3 start = points.back();
  const auto n = static_cast<std::size_t>(std::ceil((goal - start).norm() / step_mm));
  for (std::size_t k = 1; k <= n; ++k) {
    points.emplace_back(start + (goal - start) * (static_cast<double>(k) / static_cast<double>(n)));
  }
}

/// A random walk over lattice points, `height` (lattice units over the lattice) followed within +-5 units.
template <class Height>
device::Trajectory latticeWalk(std::uint64_t seed, double unit_mm, std::array<int, 4> xy_range, Height height) {
  Random random(seed);
  const auto step = [&] { return static_cast<int>(random.below(3)) - 1; };
  const auto [x_min, x_max, y_min, y_max] = xy_range;
  int x = (x_min + x_max) / 2, y = (y_min + y_max) / 2, above = 5;
  Points points;
  for (std::size_t k = 0; k < 5 * kTwentySeconds; ++k) {
    points.emplace_back(unit_mm * x, unit_mm * y, unit_mm * (height(x, y) + above));
    x = std::clamp(x + step(), x_min, x_max);
    y = std::clamp(y + step(), y_min, y_max);
    above = std::clamp(above + step(), -5, 5);
  }
  return atOneKilohertz(points);
}

// ---- around a body ------------------------------------------------------------------------------------------------

/// Distance at which the ray from `origin` hits the triangle (Moeller and Trumbore, 1997), if it does.
std::optional<double> rayHit(const Vec3& origin, const Vec3& direction, const std::array<Vec3, 3>& corners) {
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], p = direction.cross(e2),
             t = origin - corners[0];
  const double det = e1.dot(p);
  if (std::abs(det) <= 1e-12) return std::nullopt;
  const Vec3 q = t.cross(e1);
  const double u = t.dot(p) / det, v = direction.dot(q) / det, distance = e2.dot(q) / det;
  if (u < 0 || v < 0 || u + v > 1 || distance <= 0) return std::nullopt;
  return distance;
}

double outermostHit(const mesh::TriangleMesh& body, const Vec3& centre, const Vec3& direction) {
  double farthest = 0.0;
  for (const Triangle& t : body.triangles) {
    const auto hit = rayHit(centre, direction, {body.positions[t[0]], body.positions[t[1]], body.positions[t[2]]});
    if (hit) farthest = std::max(farthest, *hit);
  }
  return farthest;
}

// ---- names --------------------------------------------------------------------------------------------------------

/// The number between `prefix` and `suffix`, if `name` is made like that.
std::optional<double> numberIn(std::string_view name, std::string_view prefix, std::string_view suffix) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() <= prefix.size() + suffix.size()) return {};
  name.remove_prefix(prefix.size());
  name.remove_suffix(suffix.size());
  const std::optional<double> number = parseNumber(name);
  if (!number || !(*number > 0.0 && *number < 1e4)) return {};
  return number;
}

std::optional<device::Trajectory> pathWithNumber(std::string_view name) {
  if (const auto step = numberIn(name, "back_jump", "mm")) return backJumps(*step, 100 + std::lround(*step));
  if (const auto speed = numberIn(name, "back_stab", "mps")) return backStabs(*speed, 200 + std::lround(*speed));
  if (const auto speed = numberIn(name, "eggcrate_", "mps")) return eggcrateSlide(*speed);
  if (const auto speed = numberIn(name, "flat_fric_", "")) return flatFriction(*speed);
  if (const auto angle = numberIn(name, "groove", "")) return grooveShake(300 + std::lround(*angle));
  return {};
}

}  // namespace

device::Trajectory backSlide() {
  const std::vector<double> parameter = lissajousParameters();
  const Vec3 end = slidePoint(parameter[18000], kSlideUntilSeconds);
  return makeTwentySecondPath([&](std::size_t k) {
    const double t = tickSeconds(k);
    if (t < kPressFrom) return approachPoint(t);
    if (t < kSlideFromSeconds) return pressPoint(t);
    if (t < kSlideUntilSeconds) return slidePoint(parameter[k], t);
    return t < kLiftUntil ? liftPoint(end, t) : departPoint(end, t);
  });
}

device::Trajectory backJumps(double step_mm, std::uint64_t seed) {
  Random random(seed);
  Points points{{175, 200, backHeight(175., 200.) + 5}};
  for (std::size_t k = 1; k < kTwentySeconds; ++k) {
    Vec3 q = points.back() + step_mm * randomDirection(random);
    q.x() = reflected(q.x(), 30, 320);
    q.y() = reflected(q.y(), 30, 370);
    const double skin = backHeight(q.x(), q.y());
    q.z() = k > 10 ? std::clamp(q.z(), skin - 25.0, skin - 2.0) : skin + 5 - 0.8 * static_cast<double>(k);
    points.push_back(q);
  }
  return atOneKilohertz(points);
}

device::Trajectory backStabs(double metres_per_second, std::uint64_t seed) {
  Random random(seed);
  const double step = metres_per_second;  // mm in a tick of 1 ms
  const int steps = static_cast<int>(40 / step);
  Points points;
  for (int stab = 0; stab < 300; ++stab) {
    const double x = random.uniform(30, 320), y = random.uniform(30, 370), skin = backHeight(x, y);
    if (stab > 0) {
      points.emplace_back(points.back().x(), points.back().y(), 250.0);
      points.emplace_back(x, y, 250.0);
    }
    for (int k = 0; k <= steps; ++k) points.emplace_back(x, y, skin + 20 - step * k);
    for (int k = 0; k <= steps; ++k) points.emplace_back(x, y, skin - 20 + step * k);
  }
  return atOneKilohertz(points);
}

device::Trajectory grooveShake(std::uint64_t seed) {
  Random random(seed);
  return makeTwentySecondPath([&](std::size_t k) {
    const double t = tickSeconds(k);
    const Vec2 noise = random.normal2();
    Vec3 tip(100 + 15 * std::sin(2 * pi * 5 * t) + 0.3 * noise.x(), 10 + 80 * (0.5 - 0.5 * std::cos(2 * pi * 0.2 * t)),
             -10 + 0.3 * noise.y());
    if (k < 200) tip = Vec3(100, tip.y(), ramp(60, -10, k, 200));
    return tip;
  });
}

device::Trajectory pitShake(std::uint64_t seed) {
  Random random(seed);
  return makeTwentySecondPath([&](std::size_t k) {
    const double t = tickSeconds(k);
    const Vec3 noise = random.normal3();
    Vec3 tip(100 + 8 * std::sin(2 * pi * 3.1 * t) + 0.3 * noise.x(),
             100 + 8 * std::sin(2 * pi * 4.3 * t) + 0.3 * noise.y(), -10 + 0.3 * noise.z());
    if (k < 200) tip = Vec3(100, 100, ramp(60, -10, k, 200));
    return tip;
  });
}

device::Trajectory eggcrateSlide(double metres_per_second) {
  return makeTwentySecondPath([&](std::size_t k) {
    const double s = metres_per_second * static_cast<double>(k);  // mm
    Vec3 tip(reflected(10 + s * 0.8, 10, 110), reflected(10 + s * 0.6, 10, 110), -3.0);
    if (k < 100) tip = Vec3(10, 10, ramp(10, -3, k, 100));
    return tip;
  });
}

device::Trajectory flatEdge() {
  return makeTwentySecondPath([&](std::size_t k) {
    const double phase = std::fmod(tickSeconds(k) * 200 / 70, 2.0);
    Vec3 tip(50 + 70 * (1 - std::abs(phase - 1)), 50.3, -5.0);
    if (k < 100) tip = Vec3(50, 50.3, ramp(10, -5, k, 100));
    return tip;
  });
}

device::Trajectory flatPress() {
  constexpr int kDirections = 16;
  const Vec3 above(50.0, 50.3, 10.0);
  Points points{above};
  for (int pass = 0; pass < kDirections; ++pass) {
    const double angle = 2 * pi * pass / kDirections;
    const Vec3 way(80 * std::cos(angle), 80 * std::sin(angle), 0.0);
    moveTo(above - Vec3(0, 0, 15), 0.15, points);
    moveTo(points.back() + way, 0.2, points);
    moveTo(above + way, 0.15, points);
    moveTo(above, 0.5, points);
  }
  return atOneKilohertz(points);
}

device::Trajectory flatFriction(double mm_per_second) {
  Points points;
  for (std::size_t k = 0; k < 500; ++k) points.emplace_back(30.0, 50.3, k < 200 ? ramp(5, -5, k, 200) : -5.0);
  const int ticks = static_cast<int>(40 / mm_per_second * 1000);
  for (int k = 1; k <= ticks; ++k) points.emplace_back(30 + mm_per_second * 1e-3 * k, 50.3, -5.0);
  return atOneKilohertz(points);
}

device::Trajectory latticeFlat(std::uint64_t seed) {
  return latticeWalk(seed, 1.0, {10, 90, 10, 90}, [](int, int) { return 0; });
}

device::Trajectory latticeGroove(std::uint64_t seed) {
  return latticeWalk(seed, 1.25, {64, 96, 12, 68}, [](int x, int) { return std::abs(x - 80); });
}

device::Trajectory orbit(const mesh::TriangleMesh& body, const Vec3& centre) {
  constexpr double kRadialStep = 0.2;  // mm in a tick: 0.2 m/s
  double radius = 0.0;
  return makeTwentySecondPath([&](std::size_t k) {
    const double t = tickSeconds(k), azimuth = 2 * pi * 0.5 * t, elevation = 0.1 + 0.55 * std::sin(2 * pi * 0.17 * t);
    const Vec3 direction(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                         std::sin(elevation));
    const double goal = outermostHit(body, centre, direction) - (7.5 - 2.5 * std::cos(2 * pi * 0.7 * t));
    radius = k == 0 ? goal : std::clamp(goal, radius - kRadialStep, radius + kRadialStep);
    return Vec3(centre + direction * (radius + (k < 400 ? ramp(40, 0, k, 400) : 0.0)));
  });
}

device::Trajectory workloadPath(std::string_view name) {
  if (name == "back_slide") return backSlide();
  if (name == "pit") return pitShake(400);
  if (name == "flat_edge") return flatEdge();
  if (name == "flat_press") return flatPress();
  if (name == "lattice_flat") return latticeFlat(500);
  if (name == "lattice_groove") return latticeGroove(501);
  if (auto path = pathWithNumber(name)) return *std::move(path);
  throw Error(fmt::format("unknown benchmark trajectory '{}'", name));
}

std::vector<PathName> workloadPathNames() {
  std::vector<PathName> names{{"back_slide", "back"}};
  for (const char* n : {"1", "2", "5", "10", "20"}) names.push_back({fmt::format("back_jump{}mm", n), "back"});
  for (const char* n : {"1", "2", "5"}) names.push_back({fmt::format("back_stab{}mps", n), "back"});
  for (const char* n : {"60", "90", "120"}) names.push_back({fmt::format("groove{}", n), fmt::format("groove{}", n)});
  names.push_back({"pit", "pit"});
  for (const char* n : {"0.1", "0.5", "1.0", "2.0"}) names.push_back({fmt::format("eggcrate_{}mps", n), "eggcrate"});
  for (const char* n : {"20", "50", "100", "200", "500"}) names.push_back({fmt::format("flat_fric_{}", n), "flat100"});
  for (const char* n : {"flat_edge", "flat_press"}) names.push_back({n, "flat100"});
  names.push_back({"lattice_flat", "lattice100"});
  names.push_back({"lattice_groove", "groove90"});
  return names;
}

}  // namespace palpate::lab
