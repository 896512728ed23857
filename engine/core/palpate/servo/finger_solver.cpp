// A surface that breathes stays where it is, and the tip moves against it: the field is so smooth that forces keep
// their direction to 0.02.
#include "palpate/servo/finger_solver.h"

#include <utility>

namespace palpate::servo {

FingerSolvers makeSolvers(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                          std::size_t fingers, const std::optional<body::BreathField>& breath) {
  FingerSolvers solvers(fingers);
  const bool lumps_move = surface.lumps && surface.lumps->anyMoves();
  const auto lumps = lumps_move ? std::make_shared<LumpLoop>(fingers) : nullptr;
  for (std::size_t i = 0; i < fingers; ++i) {
    solvers[i].breath = breath;
    solvers[i].lumps = lumps;
    solvers[i].finger = i;
    ContactSource& source = solvers[i].source;
    source.surface = &surface;
    if (box) {
      source.step = ContactSource::inBox;
      source.box.emplace(box);
    } else if (surface.planes) {
      // Filled with zeros, so that no tick is the first to touch its pages.
      source.skin = std::make_unique<contact::FingerSkin>();
    }
  }
  return solvers;
}

contact::FingerOutput ContactSource::onSkin(ContactSource& source, const contact::FingerSettings& settings,
                                            contact::FingerState& state, const Vec3& tip,
                                            const contact::LumpPlaces* lumps) noexcept {
  return contact::step(*source.surface, settings, state, tip, lumps, source.skin.get());
}

contact::FingerOutput ContactSource::inBox(ContactSource& source, const contact::FingerSettings& settings,
                                           contact::FingerState& state, const Vec3& tip,
                                           const contact::LumpPlaces* lumps) noexcept {
  return hdb::stepHdb(*source.surface, settings, *source.box, state, tip, lumps);
}

namespace {

/// Moves what was felt at rest with the skin, which has risen by this lift under the tip.
void moveWithSkin(const body::BreathField& breath, double lift_mm, const Vec3& tip,
                  contact::FingerOutput& felt) noexcept {
  const bool lost = (felt.status & contact::kTipLost) != 0;
  felt.tip = lost ? breath.moved(felt.tip, lift_mm) : tip;  // the requested tip, to the bit
  const bool free = felt.touch == contact::Touch::free;
  for (Vec3* place : {&felt.proxy, &felt.anchor, &felt.hold}) *place = free ? felt.tip : breath.moved(*place, lift_mm);
  if (felt.dent.rest_mm > 0.0) felt.dent.place = breath.moved(felt.dent.place, lift_mm);
}

/// Fades the force of an exchanged surface to that surface's own, from where the last tick was.
void fadeForceChange(const contact::FingerSettings& settings, const Vec3& tip, Handover& handover,
                     contact::FingerOutput& felt) noexcept {
  const Vec3 change = felt.force - handover.force;
  const double most_mm = 3.0 * (tip - handover.tip).norm() + settings.catch_up_mm_per_s * settings.tick_s;
  const double most_n = handover.secant_n_per_mm * most_mm;
  const double size = change.norm();
  handover.on = size > most_n && most_n > 0.0;
  if (!handover.on) return;
  felt.force = handover.force + (most_n / size) * change;
  felt.status |= contact::kCatchingUp;
  if (felt.touch != contact::Touch::free) return;
  felt.touch = contact::Touch::stick;  // the old force fades
  felt.normal = felt.force.normalized();
  felt.status |= contact::kLettingGo;
}

}  // namespace

contact::FingerOutput touch(FingerSolver& solver, const contact::FingerSettings& settings, contact::FingerState& state,
                            const Vec3& tip, std::uint64_t tick) noexcept {
  ContactSource& source = solver.source;
  const double lift_mm = solver.breath ? solver.breath->lift(static_cast<double>(tick) * settings.tick_s) : 0.0;
  const Vec3 at_rest = solver.breath ? solver.breath->rest(tip, lift_mm) : tip;
  const contact::LumpPlaces* lumps = nullptr;
  if (solver.lumps) lumps = &solver.lumps->begin(*source.surface->lumps, solver.finger, state.lumps, settings.tick_s);
  contact::FingerOutput felt = source.step(source, settings, state, at_rest, lumps);
  if (solver.lumps) solver.lumps->end(solver.finger, state.lumps);
  if (solver.breath) moveWithSkin(*solver.breath, lift_mm, tip, felt);
  Handover& handover = solver.handover;
  if ((felt.status & contact::kTipLost) != 0 || !handover.follows) return felt;
  if (felt.depth_mm > 0.0) handover.secant_n_per_mm = felt.force.norm() / felt.depth_mm;
  if (handover.on) fadeForceChange(settings, tip, handover, felt);
  handover.force = felt.force;
  handover.tip = tip;
  return felt;
}

void lift(FingerSolver& solver, contact::FingerState& state) noexcept {
  state = {};
  solver.handover.on = false;
  if (solver.lumps) solver.lumps->lift(solver.finger);
}

contact::FingerOutput atRest(const body::BreathField& breath, contact::FingerOutput felt, double lift_mm) noexcept {
  for (Vec3* place : {&felt.tip, &felt.proxy, &felt.anchor, &felt.hold}) *place = breath.rest(*place, lift_mm);
  if (felt.dent.rest_mm > 0.0) felt.dent.place = breath.rest(felt.dent.place, lift_mm);
  return felt;
}

void exchange(FingerSolver& at_work, FingerSolver& next, contact::FingerState& state) noexcept {
  // The centre of one is not the centre of the other: a sphere's, or the god object's.
  if (at_work.source.step != next.source.step) state = {};
  if (at_work.lumps && next.lumps) {
    next.lumps->carryOver(*next.source.surface->lumps, *at_work.lumps, *at_work.source.surface->lumps);
  }
  std::swap(at_work.source, next.source);
  std::swap(at_work.lumps, next.lumps);
  std::swap(at_work.breath, next.breath);
  at_work.handover.on = true;
}

}  // namespace palpate::servo
