// Writes the ticks of one hunted path: knows where the tip is, goes on from there, and finds places on the skin by the
// judge's own geometry.
//
// Places are found on random triangles, not on random area: small triangles are where trouble is.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lab/judges/hunt_judge.h"
#include "lab/workloads/hunted_paths.h"
#include "palpate/base/random.h"

namespace palpate::lab {

/// In one tick.
inline constexpr double kLongestJumpMm = 30.0;

/// Evenly over orders of magnitude.
inline double anySize(Random& random, double low, double high) { return low * std::pow(high / low, random.uniform()); }

struct SkinSpot {
  Vec3 point, normal;
  Index triangle;
};

/// Writes ticks of one path.
class PathWriter {
 public:
  PathWriter(JudgedBody& on, const HuntedPathSettings& settings)
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
    const Vec3 v(random.normal(), random.normal(), random.normal());
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
    return {(1.0 - u - v) * m.positions[t[0]] + u * m.positions[t[1]] + v * m.positions[t[2]], body.normalOf(triangle),
            triangle};
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
  std::vector<Vec3> take() { return std::move(tips_); }

  JudgedBody& body;
  Random random;
  const double mm, radius;

 private:
  static constexpr int kTriesForAPlace = 20;

  std::size_t ticks_, until_;
  Vec3 tip_ = Vec3::Zero();
  std::vector<Vec3> tips_;
};

}  // namespace palpate::lab
