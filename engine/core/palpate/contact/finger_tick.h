// One tick of any finger, whatever finds how its tip presses: what is the same for a finger alone and for a pad of a
// tool.
#pragma once

#include <utility>

#include "palpate/contact/felt_force.h"
#include "palpate/contact/press.h"
#include "palpate/contact/sides.h"
#include "palpate/contact/surface_walk.h"

namespace palpate::contact {

/// `press_by()` moves the proxy in `state`, whose tip is still the last tick's, and returns the Press.
template <class PressBy>
FingerOutput tickBy(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip,
                    const LumpPlaces* lumps, PressBy&& press_by) noexcept {
  if (!usableTip(surface, tip)) return lostOutput(state);
  if (!state.knows_tip) {
    state.tip = tip;
    state.from_inside = isBuried(surface, tip);
  }
  const Index triangle_before = state.proxy.triangle;
  const Press press = std::forward<PressBy>(press_by)();
  const double tip_moved_mm = (tip - state.tip).norm();
  state.knows_tip = true;
  state.tip = tip;
  if (press.touching) {
    noteThatItCameOut(surface, tip, state);
    prefetchNeighbours(surface, state.proxy.triangle, state.proxy.triangle != triangle_before);
  }
  return feltOutput(surface, settings, press, tip, tip_moved_mm, state, lumps);
}

}  // namespace palpate::contact
