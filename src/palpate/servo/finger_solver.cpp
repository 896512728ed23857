// Chooses per finger between contact::step and hdb::stepHdb: one branch that the processor always guesses right. Own.
#include "palpate/servo/finger_solver.h"

#include <utility>

namespace palpate::servo {

FingerSolvers makeSolvers(const contact::Surface& surface, const std::shared_ptr<const hdb::HdbSurface>& box,
                          std::size_t fingers) {
  FingerSolvers solvers(fingers);
  for (FingerSolver& solver : solvers) {
    solver.surface = &surface;
    if (box) solver.box.emplace(box);
  }
  return solvers;
}

contact::FingerOutput touch(FingerSolver& solver, const contact::FingerSettings& settings, contact::FingerState& state,
                            const Vec3& tip) noexcept {
  if (solver.box) return hdb::stepHdb(*solver.surface, settings, *solver.box, state, tip);
  return contact::step(*solver.surface, settings, state, tip);
}

void exchange(FingerSolver& at_work, FingerSolver& next, contact::FingerState& state) noexcept {
  // The centre of one is not the centre of the other: a sphere's, or the god object's.
  if (at_work.box.has_value() != next.box.has_value()) state = {};
  std::swap(at_work, next);
}

}  // namespace palpate::servo
