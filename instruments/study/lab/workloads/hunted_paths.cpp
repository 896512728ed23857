// One function a kind moves a PathWriter's tip until its share of the ticks is used up; then comes another kind.
// Data flow: oracle's body and seed -> here -> hunt/hunt_world.h.
#include "lab/workloads/hunted_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/judges/hunt_judge.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"

namespace palpate::lab {
namespace {

/// In one tick.
constexpr double kLongestJumpMm = 30.0;

/// Evenly over orders of magnitude.
double anySize(Random& random, double low, double high) { return low * std::pow(high / low, random.uniform()); }

struct SkinSpot {
  Vec3 point, normal;
  Index triangle;
};

/// Writes the ticks of one hunted path: knows where the tip is, continues from there, and finds places on the skin by
/// the oracle's own geometry: on random triangles, not on random area, for small triangles are where trouble is.
class PathWriter {
 public:
  PathWriter(OracleBody& on, const HuntedPathSettings& settings)
      : body(on),
        random(settings.seed),
        mm(settings.mm),
        radius(settings.radius_mm * settings.mm),
        ticks_(settings.ticks) {
    until_ = ticks_;
  }

  bool done() const { return tips_.size() >= until_; }
  std::size_t left() const { return until_ > tips_.size() ? until_ - tips_.size() : 0; }
  void endAt(std::size_t tick) { until_ = std::min(tick, ticks_); }
  const Vec3& tip() const { return tip_; }
  void put(const Vec3& tip) {
    if (done()) return;
    tip_ = tip;
    tips_.push_back(tip);
  }
  void hold(std::size_t ticks) {
    for (std::size_t i = 0; i < ticks; ++i) put(tip_);
  }
  /// Straight on in steps of that length; the last step ends at the target exactly.
  void go(const Vec3& target, double step) {
    const Vec3 from = tip_;
    const double length = (target - from).norm();
    const auto steps = static_cast<std::size_t>(std::min(1e6, std::ceil(length / step)));
    for (std::size_t i = 1; i < steps && !done(); ++i)
      put(from + static_cast<double>(i) / static_cast<double>(steps) * (target - from));
    put(target);
  }

  Vec3 direction() {
    const Vec3 v = random.normal3();
    return v.norm() > 1e-9 ? Vec3(v.normalized()) : Vec3(Vec3::UnitZ());
  }
  Vec3 tangent(const Vec3& normal) {
    const Vec3 t = normal.cross(direction());
    return t.norm() > 1e-9 ? Vec3(t.normalized()) : Vec3(normal.unitOrthogonal());
  }
  SkinSpot anyPlace() {
    const auto& m = body.mesh();
    const auto triangle = static_cast<Index>(random.below(m.triangles.size()));
    const Triangle& t = m.triangles[triangle];
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    return {(1.0 - u - v) * m.positions[t[0]] + u * m.positions[t[1]] + v * m.positions[t[2]],
            body.triangleNormal(triangle), triangle};
  }
  /// So high above a place that the finger is free there; not every place has such a height.
  bool isClear(const Vec3& tip) {
    if (body.nearest(tip).distance <= 1.001 * radius + 1e-6 * body.diagonal()) return false;
    return !body.closed() || !body.inside(tip);
  }
  /// A place whose normal leads out of the body.
  SkinSpot openPlace(double height) {
    SkinSpot place = anyPlace();
    for (int i = 0; i < kTriesForAPlace && !isClear(place.point + height * place.normal); ++i) place = anyPlace();
    return place;
  }
  /// The nearest of a few random places.
  SkinSpot placeNear(const Vec3& from, int tries) {
    SkinSpot best = anyPlace();
    for (int i = 0; i < tries; ++i) {
      const SkinSpot other = anyPlace();
      if ((other.point - from).norm() < (best.point - from).norm()) best = other;
    }
    return best;
  }
  /// 0.05 to 5 m/s as a way a tick.
  double anySpeed() { return mm * anySize(random, 0.05, 5.0); }
  /// To a height above another place, straight, through whatever is between, as quick as a jump.
  SkinSpot start(double height) {
    const SkinSpot place = openPlace(height);
    const Vec3 target = place.point + height * place.normal;
    if (tips_.empty()) put(target);
    go(target, kLongestJumpMm * mm);
    return place;
  }
  std::vector<Vec3> releaseTips() { return std::move(tips_); }

  OracleBody& body;
  Random random;
  const double mm, radius;

 private:
  static constexpr int kTriesForAPlace = 20;

  std::size_t ticks_, until_;
  Vec3 tip_ = Vec3::Zero();
  std::vector<Vec3> tips_;
};

using std::numbers::pi;

/// Free of the finger's reach, and some more.
double height(PathWriter& w) { return 1.01 * w.radius + w.mm * anySize(w.random, 0.5, 15); }

/// Into the skin, mostly along the normal, now and then far off it.
Vec3 inwardDirection(PathWriter& w, const SkinSpot& place) {
  const double tilt = w.random.below(2) == 0 ? 0.0 : std::tan(w.random.uniform(0.0, 1.2));
  return (-place.normal + tilt * w.tangent(place.normal)).normalized();
}

void press(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const double step = w.anySpeed();
  const Vec3 out = w.tip();
  w.go(place.point + w.mm * anySize(w.random, 1, 80) * inwardDirection(w, place), step);
  w.hold(w.random.below(30));
  if (w.random.below(2) == 0) w.go(w.tip() + w.mm * w.random.uniform(1, 40) * w.tangent(place.normal), w.anySpeed());
  w.go(out, w.anySpeed());
}

/// Along the skin at a depth that swings.
void rubAt(PathWriter& w, double least, double most, double step) {
  const SkinSpot place = w.start(height(w));
  Vec3 under = place.point, normal = place.normal, heading = w.tangent(normal);
  const double depth = w.mm * anySize(w.random, least, most);
  w.go(under - depth * normal, w.anySpeed());
  for (std::size_t k = 0, n = 50 + w.random.below(300); k < n && !w.done(); ++k) {
    heading = (heading + 0.05 * w.direction()).normalized();
    heading = (heading - heading.dot(normal) * normal).normalized();
    const NearPoint near = w.body.nearest(under + step * heading);
    under = near.point;
    normal = w.body.triangleNormal(near.triangle);
    const Vec3 request = under - depth * (0.67 + 0.33 * std::sin(0.01 * static_cast<double>(k))) * normal;
    const Vec3 move = request - w.tip();
    w.put(w.tip() + move * std::min(1.0, 2.0 * step / std::max(move.norm(), 1e-300)));
  }
}
void drag(PathWriter& w) { rubAt(w, 0.5, 20, w.mm * anySize(w.random, 0.02, 2)); }
void slow(PathWriter& w) { rubAt(w, 2, 15, w.mm * anySize(w.random, 0.001, 0.3)); }
void graze(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const double depth = w.mm * w.random.normal() * anySize(w.random, 1e-6, 0.1) - w.radius;
  const double step = w.mm * anySize(w.random, 0.01, 1);
  Vec3 under = place.point, normal = place.normal, heading = w.tangent(normal);
  for (std::size_t k = 0; k < 200 && !w.done(); ++k) {
    w.put(under - depth * normal);
    const NearPoint near = w.body.nearest(under + step * heading);
    under = near.point;
    normal = w.body.triangleNormal(near.triangle);
    heading = (heading - heading.dot(normal) * normal + 1e-3 * w.direction()).normalized();
  }
}

void stab(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const Vec3 above = w.tip(), below = place.point + w.mm * anySize(w.random, 1, 60) * inwardDirection(w, place);
  const double step = w.anySpeed();
  for (int i = 0; i < 4; ++i) w.go(below, step), w.go(above, step);
}

void jump(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  Vec3 around = place.point;
  for (std::size_t k = 0, n = 30 + w.random.below(200); k < n && !w.done(); ++k) {
    if (w.random.below(20) == 0) around = w.placeNear(around, 10).point;
    const Vec3 aim = around + w.mm * anySize(w.random, 0.5, 20) * w.direction() - w.tip();
    w.put(w.tip() + aim * std::min(1.0, kLongestJumpMm * w.mm / std::max(aim.norm(), 1e-300)));
    if (w.random.below(4) == 0) w.hold(w.random.below(5));
  }
}

/// Right through the body and out on the other side, past limbs and plates.
void cross(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const Vec3 out = w.tip();
  const double way = std::min(0.9 * w.body.diagonal(), w.mm * anySize(w.random, 10, 250));
  w.go(out + way * inwardDirection(w, place), w.anySpeed());
  if (w.random.below(2) == 0) w.go(out, w.anySpeed());
}

void tour(PathWriter& w) {
  w.start(height(w));
  const double step = w.anySpeed(), most = w.mm * anySize(w.random, 0.5, 30);
  for (int i = 0; i < 12 && !w.done(); ++i) {
    const SkinSpot next = w.placeNear(w.tip(), w.random.below(5) == 0 ? 0 : 20);
    w.go(next.point + w.random.uniform(-1, 1) * most * next.normal, step);
  }
}

/// Follows edges of the mesh at a depth, from vertex to vertex, continuing as straight as it can.
void crease(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const double depth = w.mm * anySize(w.random, 1e-4, 10), step = w.mm * anySize(w.random, 0.01, 2);
  const auto& m = w.body.mesh();
  Index triangle = place.triangle;
  for (int i = 0; i < 40 && !w.done(); ++i) {
    const Triangle& t = m.triangles[triangle];
    const auto corner = static_cast<std::size_t>(w.random.below(3));
    const Vec3 normal = w.body.triangleNormal(triangle);
    w.go(m.positions[t[corner]] - depth * normal, step);
    w.go(m.positions[t[(corner + 1) % 3]] - depth * normal, step);
    const Vec3& end = m.positions[t[(corner + 1) % 3]];
    triangle = w.body.nearest(end + 0.3 * (end - m.positions[t[corner]])).triangle;
  }
}

/// A place where an edge pierces a triangle that it shares no vertex with; a random one if none is found.
Vec3 pierced(PathWriter& w) {
  const auto& m = w.body.mesh();
  for (int i = 0; i < (w.body.selfIntersecting() ? 400 : 20); ++i) {
    const Triangle& t = m.triangles[w.random.below(m.triangles.size())];
    const Vec3 a = m.positions[t[0]], b = m.positions[t[1]];
    const Vec3 in = 1e-6 * (b - a);
    const BoxTree::Crossing crossing = w.body.tree().crossing(a + in, b - in);
    if (crossing.entry) return *crossing.entry;
  }
  return w.anyPlace().point;
}
void sheets(PathWriter& w) {
  w.start(height(w));
  const Vec3 middle = pierced(w), axis = w.direction(), u = axis.unitOrthogonal(), v = axis.cross(u);
  const double most = w.mm * anySize(w.random, 0.1, 25), turns = w.random.uniform(0.5, 6);
  const double step = w.anySpeed();
  w.go(middle + most * u, step);
  for (std::size_t k = 0, n = 40 + w.random.below(200); k < n && !w.done(); ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n), a = 2 * pi * turns * share;
    w.put(middle + most * (1.0 - share) * (std::cos(a) * u + std::sin(a) * v));
  }
  w.go(middle + 2 * most * w.direction(), step);
}

void circle(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const Vec3 u = w.tangent(place.normal), v = place.normal.cross(u);
  const Vec3 middle = place.point - w.mm * anySize(w.random, 0.2, 20) * place.normal;
  const double radius = w.mm * anySize(w.random, 0.5, 30), step = w.mm * anySize(w.random, 0.05, 3);
  w.go(middle + radius * u, w.anySpeed());
  const auto ticks = static_cast<std::size_t>(std::min(600.0, 2 * pi * radius / step));
  for (std::size_t k = 0; k < ticks && !w.done(); ++k) {
    const double a = step / radius * static_cast<double>(k);
    w.put(middle + radius * (std::cos(a) * u + std::sin(a) * v));
  }
}

void walk(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  w.go(place.point + w.mm * anySize(w.random, 1, 40) * inwardDirection(w, place), w.anySpeed());
  const double step = w.mm * anySize(w.random, 0.01, 5);
  Vec3 heading = w.direction();
  const double keep = w.random.uniform(0, 0.95);
  for (std::size_t k = 0, n = 100 + w.random.below(400); k < n && !w.done(); ++k) {
    heading = (keep * heading + (1.0 - keep) * w.direction()).normalized();
    w.put(w.tip() + step * heading);
  }
}

void tremble(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const double depth = w.random.below(2) == 0 ? -w.radius : w.mm * anySize(w.random, 0.01, 10);
  w.go(place.point - depth * place.normal, w.anySpeed());
  const Vec3 middle = w.tip();
  const double size = w.mm * anySize(w.random, 1e-5, 0.05);
  for (std::size_t k = 0; k < 150 && !w.done(); ++k) w.put(middle + size * w.random.normal3());
}

/// Ticks that end on a vertex, an edge's middle, a corner's coordinates or a triangle's plane, bit by bit.
void exact(PathWriter& w) {
  SkinSpot place = w.start(height(w));
  const double step = w.anySpeed();
  const auto& m = w.body.mesh();
  for (int i = 0; i < 15 && !w.done(); ++i) {
    const Triangle& t = m.triangles[place.triangle];
    const Vec3 &a = m.positions[t[0]], &b = m.positions[t[1]], &c = m.positions[t[2]];
    const std::array<Vec3, 5> stops{a, 0.5 * (a + b), (a + b + c) / 3.0, {a.x(), b.y(), c.z()}, a + 0.5 * (c - a)};
    w.go(stops[w.random.below(stops.size())], step);
    w.hold(w.random.below(3));
    const Vec3 on = w.tip();
    const double depth = w.mm * anySize(w.random, 1e-3, 10);
    w.go(on - depth * place.normal, step);
    if (w.random.below(2) == 0) w.go(on, step);
    if (w.random.below(3) == 0) w.go(on + depth * place.normal, step);
    place = w.placeNear(w.tip(), 30);
  }
}

/// Deeper and deeper along a wall, pulled back a little now and then, as a finger works its way into a pocket.
void burrow(PathWriter& w) {
  const SkinSpot place = w.start(height(w));
  const Vec3 in = inwardDirection(w, place);
  const double step = w.mm * anySize(w.random, 0.05, 1.5);
  w.go(place.point, step);
  for (int i = 0; i < 60 && !w.done(); ++i) {
    const Vec3 aside = 0.6 * w.tangent(in);
    w.go(w.tip() + w.mm * w.random.uniform(0.2, 6) * (in + aside).normalized(), step);
    if (w.random.below(4) == 0) w.go(w.tip() - w.mm * w.random.uniform(0, 4) * in, step);
  }
}

/// Through a gap that is about as wide as the finger, between fingers or the teeth of a comb, and back or not.
void gap(PathWriter& w) {
  w.start(height(w));
  const double widest = 2.2 * std::max(w.radius, w.mm);
  for (int i = 0; i < 60; ++i) {
    const SkinSpot place = w.anyPlace();
    const BoxTree::Crossing wall =
        w.body.tree().crossing(place.point + 1e-3 * widest * place.normal, place.point + widest * place.normal);
    if (!wall.entry) continue;
    const Vec3 middle = 0.5 * (place.point + *wall.entry);
    const Vec3 way = w.mm * w.random.uniform(5, 50) * w.tangent(place.normal);
    if (!w.isClear(middle - way) || !w.isClear(middle + way) || w.body.inside(middle - way)) continue;
    w.go(middle - way, kLongestJumpMm * w.mm);
    w.go(middle + way, w.anySpeed());
    if (w.random.below(2) == 0) w.go(middle - way, w.anySpeed());
    return;
  }
}

struct PathKind {
  const char* name;
  void (*write)(PathWriter& w);
};

constexpr std::array<PathKind, 16> kPathKinds{{{"press", press},
                                               {"drag", drag},
                                               {"stab", stab},
                                               {"jump", jump},
                                               {"cross", cross},
                                               {"tour", tour},
                                               {"crease", crease},
                                               {"sheets", sheets},
                                               {"circle", circle},
                                               {"walk", walk},
                                               {"tremble", tremble},
                                               {"exact", exact},
                                               {"graze", graze},
                                               {"burrow", burrow},
                                               {"slow", slow},
                                               {"gap", gap}}};

/// Adds a device's noise, microns, to one path in four.
void addNoise(std::vector<Vec3>& tips, double mm, Random& random) {
  if (random.below(4) != 0) return;
  const double size = mm * anySize(random, 1e-4, 0.02);
  for (std::size_t k = 1; k < tips.size(); ++k) tips[k] += size * random.normal3();
}

}  // namespace

std::vector<std::string> huntedPathKinds() {
  std::vector<std::string> kinds;
  for (const PathKind& kind : kPathKinds) kinds.emplace_back(kind.name);
  return kinds;
}

std::vector<Vec3> huntedPath(OracleBody& body, std::string_view kind, const HuntedPathSettings& settings) {
  const auto* now =
      std::find_if(kPathKinds.begin(), kPathKinds.end(), [&](const PathKind& k) { return kind == k.name; });
  if (now == kPathKinds.end()) throw Error(fmt::format("unknown hunted path '{}'", kind));
  PathWriter writer(body, settings);
  const std::size_t share = settings.ticks / (2 + writer.random.below(2)) + 1;
  for (std::size_t end = share; end < settings.ticks + share; end += share) {
    writer.endAt(end);
    while (!writer.done()) now->write(writer);
    now = &kPathKinds[writer.random.below(kPathKinds.size())];
  }
  Random noise(settings.seed ^ 0x9e3779b97f4a7c15ull);
  std::vector<Vec3> tips = writer.releaseTips();
  addNoise(tips, settings.mm, noise);
  return tips;
}

}  // namespace palpate::lab
