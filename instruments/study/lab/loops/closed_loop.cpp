#include "lab/loops/closed_loop.h"

#include <algorithm>
#include <utility>

namespace palpate::lab {

namespace {

constexpr double kHalfPlate = 200.0;  // mm

}  // namespace

/// Two triangles, or a strip of columns across the blend of a map.
contact::Surface plateSurface(const PlateSettings& settings) {
  std::vector<double> columns{-kHalfPlate, kHalfPlate};
  if (settings.other_n_per_mm > 0.0) columns = {-kHalfPlate, 0.0, settings.blend_mm, kHalfPlate};
  mesh::TriangleMesh mesh;
  std::vector<double> stiffness;
  for (const double x : columns) {
    const double share = settings.other_n_per_mm > 0.0 ? std::clamp(x / settings.blend_mm, 0.0, 1.0) : 0.0;
    for (const double y : {-kHalfPlate, kHalfPlate}) {
      mesh.positions.emplace_back(x, y, 0.0);
      stiffness.push_back((1.0 - share) * settings.stiffness_n_per_mm + share * settings.other_n_per_mm);
    }
  }
  for (Index c = 0; c + 1 < static_cast<Index>(columns.size()); ++c) {
    const Index i = 2 * c;
    mesh.triangles.push_back({i, i + 2, i + 3});
    mesh.triangles.push_back({i, i + 3, i + 1});
  }
  contact::SurfaceOptions options{.force_law = settings.law, .self_intersecting = false};
  options.lumps = settings.lumps;
  return contact::buildSurface(mesh, std::move(stiffness), options);
}

servo::LimiterSettings loopLimiterSettings(const device::DeviceProfile& device, double tick_s, double delay_ticks,
                                           Protection protection) {
  scene::SafetySettings safety;
  safety.delay_ticks = delay_ticks;
  safety.passivity = safety.soft_contact = protection != Protection::none;
  safety.unsafe_stiffness = protection == Protection::none;  // on an open device nothing else takes both away
  if (protection == Protection::identified) {
    safety.device_damping_n_s_per_mm = device.damping_n_s_per_mm;
    safety.device_friction_n = device.friction_n;
  }
  return servo::limiterSettings(safety, device, tick_s);
}

ClosedLoop::ClosedLoop(const LoopSettings& settings)
    : surface_(std::make_unique<contact::Surface>(plateSurface(settings.plate))) {
  contact::FingerSettings finger;
  finger.mu_static = finger.mu_dynamic = settings.plate.friction;
  std::vector<Vec3> starts{settings.hand.start};
  starts.insert(starts.end(), settings.more_hands.begin(), settings.more_hands.end());
  servo::RigParts parts;
  parts.tick_s = settings.hand.tick_s;
  parts.limiter = settings.limits;
  parts.solvers = servo::makeSolvers(*surface_, nullptr, starts.size());
  parts.fingers.assign(starts.size(), finger);
  for (const Vec3& start : starts) {
    device::SimulatedHandSettings hand = settings.hand;
    hand.start = start;
    hand.seed += hands_.size();
    hands_.push_back(std::make_unique<device::SimulatedHand>(hand));
    parts.devices.push_back(device::simulatedHandDevice("hand", *hands_.back()));
  }
  rig_ = servo::rigOf(std::move(parts));
  samples_.resize(starts.size());
}

void ClosedLoop::settleContact() {
  servo::FingerChain& finger = rig_.fingers.front();
  const Vec3 there = hand().place();
  for (double z = 1.0; z > there.z(); z -= 0.5) {
    servo::touch(finger.solver, finger.contact_settings, finger.contact, {there.x(), there.y(), z});
  }
  for (int i = 0; i < 100; ++i) servo::touch(finger.solver, finger.contact_settings, finger.contact, there);
  finger.limiter = {};
  finger.limiter.armed = true;
}

const trace::Sample& ClosedLoop::tick() {
  servo::runTick(rig_, next_++, servo::LoopEvent::none, samples_);
  return samples_.front();
}

}  // namespace palpate::lab
