// Chooses per finger between contact::step and hdb::stepHdb: one branch that the processor always guesses right. A
// surface that breathes stays where it is, and the tip moves against it: the field is so smooth that forces keep their
// direction to 0.02. Own.
#include "palpate/servo/finger_solver.h"

#include <utility>

namespace palpate::servo {

FingerSolvers makeSolvers(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                          std::size_t fingers, const std::optional<body::BreathField>& breath) {
  FingerSolvers solvers(fingers);
  for (FingerSolver& solver : solvers) {
    solver.surface = &surface;
    solver.breath = breath;
    if (box) solver.box.emplace(box);
  }
  return solvers;
}

namespace {

contact::FingerOutput touchAtRest(FingerSolver& solver, const contact::FingerSettings& settings,
                                  contact::FingerState& state, const Vec3& tip) noexcept {
  if (solver.box) return hdb::stepHdb(*solver.surface, settings, *solver.box, state, tip);
  return contact::step(*solver.surface, settings, state, tip);
}

}  // namespace

contact::FingerOutput touch(FingerSolver& solver, const contact::FingerSettings& settings, contact::FingerState& state,
                            const Vec3& tip, std::uint64_t tick) noexcept {
  if (!solver.breath) return touchAtRest(solver, settings, state, tip);
  const body::BreathField& breath = *solver.breath;
  const double lift_mm = breath.lift(static_cast<double>(tick) * settings.tick_s);
  contact::FingerOutput felt = touchAtRest(solver, settings, state, breath.rest(tip, lift_mm));
  const bool lost = (felt.status & contact::kTipLost) != 0;
  felt.tip = lost ? breath.moved(felt.tip, lift_mm) : tip;  // to the bit what it was asked for
  const bool free = felt.touch == contact::Touch::free;
  for (Vec3* place : {&felt.proxy, &felt.anchor, &felt.hold}) *place = free ? felt.tip : breath.moved(*place, lift_mm);
  if (felt.dent.rest_mm > 0.0) felt.dent.place = breath.moved(felt.dent.place, lift_mm);
  return felt;
}

contact::FingerOutput atRest(const body::BreathField& breath, contact::FingerOutput felt, double lift_mm) noexcept {
  for (Vec3* place : {&felt.tip, &felt.proxy, &felt.anchor, &felt.hold}) *place = breath.rest(*place, lift_mm);
  if (felt.dent.rest_mm > 0.0) felt.dent.place = breath.rest(felt.dent.place, lift_mm);
  return felt;
}

void exchange(FingerSolver& at_work, FingerSolver& next, contact::FingerState& state) noexcept {
  // The centre of one is not the centre of the other: a sphere's, or the god object's.
  if (at_work.box.has_value() != next.box.has_value()) state = {};
  std::swap(at_work, next);
}

}  // namespace palpate::servo
