// A finger moved by hand in a test: tips in, outputs out, and what must hold in every tick.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/contact/surface_walk.h"
#include "palpate/mesh/repair.h"

namespace palpate::contact {

inline constexpr double kTestStiffness = 0.5;  // N/mm

/// The surface of a mesh of any kind, repaired as every mesh is at load.
inline Surface surfaceOf(const mesh::TriangleMesh& mesh, double stiffness = kTestStiffness) {
  const mesh::RepairResult fit = mesh::repair(mesh);
  SurfaceOptions options;
  options.self_intersecting = fit.self_intersecting;
  return buildSurface(fit.mesh, std::vector<double>(fit.mesh.positions.size(), stiffness), options);
}

/// A finger of any source straight from `start` to `end` in steps of at most `step_mm`; the last output. `start` by
/// value: the finger moves what it may refer to.
template <class Track>
FingerOutput slideFrom(Vec3 start, const Vec3& end, double step_mm, Track& finger) {
  const int ticks = std::max(1, static_cast<int>(std::ceil((end - start).norm() / step_mm)));
  FingerOutput output;
  for (int i = 1; i <= ticks; ++i) output = finger.to(start + (end - start) * (static_cast<double>(i) / ticks));
  return output;
}

/// One finger and its memory. Every tick is asked whether the force changed by more than tip and proxy can move apart.
class FingerTrack {
 public:
  explicit FingerTrack(const Surface& surface, FingerSettings settings = {})
      : surface_(surface),
        settings_(settings),
        stiffness_(*std::max_element(surface.stiffness_n_per_mm->begin(), surface.stiffness_n_per_mm->end())) {}

  FingerOutput to(const Vec3& tip) {
    const Vec3 force_before = state_.force;
    const double moved_mm = state_.knows_tip ? (tip - state_.tip).norm() : 0.0;
    const FingerOutput output = step(surface_, settings_, state_, tip);
    const double most_mm = 3.0 * moved_mm + settings_.catch_up_mm_per_s * settings_.tick_s;
    const bool hooke = surface_.force_law.kind == tissue::ForceLaw::Kind::linear;
    if (hooke && tip.allFinite()) {
      EXPECT_LE((state_.force - force_before).norm(), 1.1 * stiffness_ * most_mm) << tip.transpose();
    }
    return output;
  }

  /// Straight from the last tip to `end` in steps of at most `step_mm`; the last output.
  FingerOutput slide(const Vec3& end, double step_mm) { return slideFrom(state_.tip, end, step_mm, *this); }

  const FingerState& state() const { return state_; }

 private:
  const Surface& surface_;
  FingerSettings settings_;
  double stiffness_;
  FingerState state_;
};

inline bool touches(const FingerOutput& output) { return output.touch != Touch::free; }

/// Two boxes of 50 mm that share the edge at x = y = 50. The finger presses the first from y = 50 and is drawn out of
/// its side at x = 50, into the air under the other box: it is let go there, `clear_mm` off the skin.
template <class Track>
void expectLetGoInTheOtherSector(Track& finger, double clear_mm) {
  finger.to({30, 70, 25});
  finger.slide({30, 45, 25}, 0.25);
  finger.slide({50 + clear_mm, 40, 25}, 0.25);
  FingerOutput output;
  for (int i = 0; i < 300; ++i) output = finger.to({50.001 + clear_mm, 40, 25});
  EXPECT_FALSE(touches(output)) << output.force.norm() << " N";
  EXPECT_GT(finger.slide({49, 40, 25}, 0.25).force.x(), 0.0) << "and felt again from that side";
}

/// Tangential over normal force.
inline double frictionRatio(const FingerOutput& output) {
  const double normal = output.force.dot(output.normal);
  return (output.force - normal * output.normal).norm() / normal;
}

/// Presses a flat plate 5 mm deep and drags 30 mm in steps: each tick that slips has the dynamic coefficient. The
/// highest ratio of all ticks.
template <class Track>
double highestRatioOfADrag(Track& finger, double radius_mm, double step_mm) {
  finger.to({30, 50.3, radius_mm + 2});
  finger.slide({30, 50.3, -5}, 0.05);
  double highest = 0.0;
  for (double x = 30 + step_mm; x <= 60; x += step_mm) {
    const FingerOutput output = finger.to({x, 50.3, -5});
    highest = std::max(highest, frictionRatio(output));
    if (output.touch == Touch::slip) {
      EXPECT_NEAR(frictionRatio(output), 0.44, 1e-9) << step_mm;
    }
  }
  return highest;
}

/// A plate of 8 x 8 cells over 100 x 100 mm is entered wherever the tip comes down, also by way of a stop on it.
template <class Track, class Plate>
void expectEntranceEverywhere(const Plate& plate) {
  for (const Vec3& aim : {Vec3(50, 50, 0), Vec3(37.5, 62.5, 0), Vec3(43.75, 50, 0), Vec3(40, 40, 0)}) {
    Track straight(plate);
    straight.to(aim + Vec3(0, 0, 1));
    EXPECT_TRUE(touches(straight.to(aim - Vec3(0, 0, 1)))) << aim.transpose();
    Track in_two_moves(plate);
    in_two_moves.to(aim + Vec3(0, 0, 1));
    in_two_moves.to(aim);
    EXPECT_TRUE(touches(in_two_moves.to(aim - Vec3(0, 0, 1)))) << aim.transpose();
  }
}

inline FingerSettings sphereSettings(double radius_mm) {
  FingerSettings settings;
  settings.radius_mm = radius_mm;
  return settings;
}

}  // namespace palpate::contact
