// A flat sheet of layered tissue as the loin has it, felt by the product's own finger at 1 kHz. Based on: see
// contact/relaxation.h; the two terms of beef are fitted to published curves (docs/explanation/force-laws.md).
#include "dissertation/relaxation/relaxation_measurement.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/finger.h"
#include "palpate/tissue/force_law.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/layered_tissue.h"

namespace palpate::study {

namespace {

constexpr double kTissueMm = 40.0;
constexpr double kFatMm = 8.0;
constexpr double kDepthMm = 8.0;
constexpr double kApproach = 200.0;  // mm/s
constexpr double kTick = 0.001;      // s
constexpr double kHeldS = 10.0;

contact::Surface loin() {
  mesh::TriangleMesh sheet;
  sheet.positions = {{-200, -200, 0}, {200, -200, 0}, {200, 200, 0}, {-200, 200, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const tissue::LayeredTissue layered(tissue::libraryNodes(kFatMm));
  contact::SurfaceOptions options;
  options.force_law.kind = tissue::ForceLaw::Kind::layered;
  options.force_law.layers = layered.forceRows();
  options.self_intersecting = false;
  options.tissue_mm.assign(4, kTissueMm);
  return contact::buildSurface(sheet, std::vector<double>(4, layered.secantAt(kTissueMm, tissue::kReferenceDepthMm)),
                               options);
}

/// A finger over the sheet that follows given tips.
class Finger {
 public:
  Finger(const contact::Surface& surface, const contact::Relaxation& relaxation) : surface_(surface) {
    settings_.tick_s = kTick;
    settings_.relaxation = relaxation;
    to(Vec3(0.2, 0.1, 1.0));
  }
  const contact::FingerOutput& to(const Vec3& tip) {
    felt_ = contact::step(surface_, settings_, state_, tip);
    return felt_;
  }
  const contact::FingerOutput& deep(double depth_mm) { return to(Vec3(0.2, 0.1, -depth_mm)); }
  /// At this pace; ends exactly there.
  void goTo(double depth_mm, double mm_per_s) {
    const double from = -felt_.tip.z();
    const int ticks = std::max(1, static_cast<int>(std::ceil(std::abs(depth_mm - from) / (mm_per_s * kTick))));
    for (int i = 1; i <= ticks; ++i) deep(from + (depth_mm - from) * i / ticks);
  }
  const contact::FingerOutput& felt() const { return felt_; }

 private:
  const contact::Surface& surface_;
  contact::FingerSettings settings_;
  contact::FingerState state_;
  contact::FingerOutput felt_;
};

int toTicks(double seconds) { return static_cast<int>(std::lround(seconds / kTick)); }

/// Held, then left: both of one finger.
void measureHoldAndRelease(const contact::Surface& surface, RelaxingSkin& skin) {
  Finger finger(surface, skin.relaxation);
  finger.goTo(kDepthMm, kApproach);
  int tick = 0;
  for (const double time : heldTimes()) {
    for (; tick < toTicks(time); ++tick) finger.deep(kDepthMm);
    skin.held_n.push_back(finger.felt().force.z());
  }
  finger.goTo(-5.0, kApproach);
  tick = 0;
  for (const double time : returnTimes()) {
    for (; tick < toTicks(time); ++tick) finger.deep(-5.0);
    skin.dent_mm.push_back(tissue::depthOf(surface.force_law, finger.felt().dent.rest_mm, kTissueMm));
  }
}

/// Slides at 20 mm/s for 4 s while the force falls.
void drag(const contact::Surface& surface, RelaxingSkin& skin) {
  Finger finger(surface, skin.relaxation);
  finger.goTo(kDepthMm, kApproach);
  skin.friction_low = 1e9;
  for (int tick = 1; tick <= toTicks(4.0); ++tick) {
    const contact::FingerOutput& felt = finger.to(Vec3(0.2 + 0.02 * tick, 0.1, -kDepthMm));
    if (felt.touch != contact::Touch::slip) continue;
    const double normal = felt.force.dot(felt.normal);
    const double ratio = (felt.force - normal * felt.normal).norm() / normal;
    skin.friction_low = std::min(skin.friction_low, ratio);
    skin.friction_high = std::max(skin.friction_high, ratio);
  }
}

PressCycle runPressCycle(const contact::Surface& surface, const contact::Relaxation& relaxation, double stroke_s) {
  Finger finger(surface, relaxation);
  PressCycle cycle{.stroke_s = stroke_s, .depth_mm = {}, .force_n = {}};
  const int ticks = toTicks(2.0 * stroke_s);
  const int shown_every = std::max(1, ticks / 400);
  double put_in = 0.0;
  double net = 0.0;
  double depth = 0.0;
  double force = finger.deep(0.0).force.z();
  for (int tick = 1; tick <= ticks; ++tick) {
    const double next = 0.5 * kDepthMm * (1.0 - std::cos(2.0 * 3.14159265358979 * tick / ticks));
    const double felt = finger.deep(next).force.z();
    const double work = 0.5 * (force + felt) * (next - depth);
    net += work;
    if (tick <= ticks / 2) put_in += work;
    depth = next;
    force = felt;
    if (tick % shown_every != 0) continue;
    cycle.depth_mm.push_back(depth);
    cycle.force_n.push_back(force);
  }
  cycle.lost_share = net / put_in;
  return cycle;
}

}  // namespace

std::vector<double> heldTimes() {
  std::vector<double> times;
  for (int i = 0; i <= 100; ++i) times.push_back(kHeldS * i / 100);
  return times;
}

std::vector<double> returnTimes() {
  std::vector<double> times;
  for (int i = 1; i <= 60; ++i) times.push_back(0.1 * i);
  return times;
}

RelaxationMeasurement measureRelaxation(bool quick, const Progress& progress) {
  const contact::Surface surface = loin();
  RelaxationMeasurement found{.depth_mm = kDepthMm};
  const contact::Relaxation offered{.share = 0.15, .time_s = 1.0};
  found.skins = {
      {.name = "none", .relaxation = {}},
      {.name = "as offered", .relaxation = offered},
      {.name = "dead beef", .relaxation = {.share = 0.26, .time_s = 0.40, .share_2 = 0.31, .time_2_s = 4.4}}};
  for (RelaxingSkin& skin : found.skins) {
    report(progress, "holding skin that relaxes", 0.0);
    measureHoldAndRelease(surface, skin);
    drag(surface, skin);
  }
  const std::vector<double> strokes = quick ? std::vector{0.1, 1.0, 5.0} : std::vector{0.1, 0.3, 1.0, 3.0, 10.0, 30.0};
  for (const double stroke_s : strokes) {
    report(progress, "pressing at several paces", 0.5);
    found.cycles.push_back(runPressCycle(surface, offered, stroke_s));
  }
  return found;
}

}  // namespace palpate::study
