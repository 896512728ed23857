// Every bound is relative, to the mesh's diagonal or to the largest force there can be, and allows a billionth for the
// rounding of finger and check together.
// Data flow: outputs of a run -> here, afterwards -> which invariant broke, how often, since when.
#include "lab/judges/invariant_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace palpate::lab {
namespace {

/// Rounding of the finger and of this check together, relative to the size of
/// the mesh or of the force.
constexpr double kRounding = 1e-9;

/// Distance from a point to a triangle of the mesh.
double distanceToTriangle(const mesh::TriangleMesh& mesh, Index triangle, const Vec3& point) {
  const Triangle& t = mesh.triangles[triangle];
  const std::array<Vec3, 3> corners{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
  return (nearestOnTriangle(corners, point) - point).norm();
}

class Checker {
 public:
  Checker(const mesh::TriangleMesh& mesh, const contact::FingerSettings& settings, double stiffness)
      : mesh_(mesh),
        settings_(settings),
        length_(kRounding * mesh::boundingBox(mesh).diagonal().norm()),
        force_limit_(stiffness * (settings.max_depth_mm + settings.radius_mm) * std::hypot(1.0, settings.mu_static) *
                     (1.0 + kRounding)),
        force_(kRounding * stiffness * (settings.max_depth_mm + settings.radius_mm)) {}

  void add(const contact::FingerOutput& o, std::size_t tick) {
    tick_ = tick;
    const double sum = o.tip.sum() + o.proxy.sum() + o.anchor.sum() + o.normal.sum() + o.force.sum() + o.depth_mm;
    require(Invariant::finite, std::isfinite(sum));
    if (o.touch == contact::Touch::free) {
      require(Invariant::free_without_force, o.force.isZero(0.0) && o.triangle == kNoIndex);
    } else {
      addGeometry(o);
      addForce(o);
    }
  }
  const InvariantReport& report() const { return report_; }

 private:
  void addGeometry(const contact::FingerOutput& o) {
    require(Invariant::unit_normal, std::abs(o.normal.norm() - 1.0) <= kRounding);
    require(Invariant::anchor_on_triangle, isOn(o.anchor_triangle, o.anchor));
    if (settings_.radius_mm > 0.0) return;
    require(Invariant::proxy_on_triangle, isOn(o.triangle, o.proxy));
    const bool fades = (o.status & contact::kLettingGo) != 0;  // the tip is out; its force still has a direction
    require(Invariant::tip_not_in_front, fades || (o.tip - o.proxy).dot(o.normal) <= length_);
  }
  void addForce(const contact::FingerOutput& o) {
    const double normal = o.force.dot(o.normal);
    const double tangential = (o.force - normal * o.normal).norm();
    require(Invariant::force_not_pulling, normal >= -force_);
    require(Invariant::friction_in_cone, tangential <= settings_.mu_static * normal + force_);
    require(Invariant::force_bounded, o.force.norm() <= force_limit_);
  }
  bool isOn(Index triangle, const Vec3& point) const {
    return triangle < mesh_.triangles.size() && distanceToTriangle(mesh_, triangle, point) <= length_;
  }
  void require(Invariant invariant, bool holds) {
    if (holds) return;
    InvariantReport::Breach& breach = report_.breaches[static_cast<std::size_t>(invariant)];
    if (breach.ticks++ == 0) breach.first_tick = tick_;
  }

  const mesh::TriangleMesh& mesh_;
  const contact::FingerSettings& settings_;
  double length_, force_limit_, force_;
  std::size_t tick_ = 0;
  InvariantReport report_;
};

}  // namespace

const char* nameOf(Invariant invariant) {
  constexpr std::array<const char*, kInvariants> kNames{
      "finite",           "free_without_force", "proxy_on_triangle", "anchor_on_triangle", "unit_normal",
      "tip_not_in_front", "force_not_pulling",  "friction_in_cone",  "force_bounded"};
  return kNames[static_cast<std::size_t>(invariant)];
}

bool InvariantReport::clean() const {
  return std::all_of(breaches.begin(), breaches.end(), [](const Breach& b) { return b.ticks == 0; });
}

std::string InvariantReport::text() const {
  std::string text;
  for (std::size_t i = 0; i < kInvariants; ++i) {
    if (breaches[i].ticks == 0) continue;
    text += fmt::format("{}{} in {} ticks from tick {}", text.empty() ? "" : "; ", nameOf(static_cast<Invariant>(i)),
                        breaches[i].ticks, breaches[i].first_tick);
  }
  return text.empty() ? "none" : text;
}

InvariantReport checkInvariants(const mesh::TriangleMesh& mesh, const contact::FingerSettings& settings,
                                double stiffness, std::span<const contact::FingerOutput> outputs) {
  Checker checker(mesh, settings, stiffness);
  for (std::size_t k = 0; k < outputs.size(); ++k) checker.add(outputs[k], k);
  return checker.report();
}

}  // namespace palpate::lab
