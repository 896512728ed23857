// Two exponentials and a few products a tick, and none without relaxation. Called by felt_force.cpp.
#include "palpate/contact/relaxation.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/elementary.h"

namespace palpate::contact {

namespace {

using Eased = std::array<double, 2>;

/// mm: a shallower dent is gone. Without an end a finger would remember for ever.
constexpr double kShallowest = 1e-6;

double restDepth(const Relaxation& relaxation, const Eased& eased) noexcept {
  return relaxation.share * eased[0] + relaxation.share_2 * eased[1];
}

/// The share of its way to the held depth that each term has left after a tick.
Eased decayFactors(const Relaxation& relaxation, double tick_s) noexcept {
  return {elementary::exp(-tick_s / relaxation.time_s), elementary::exp(-tick_s / relaxation.time_2_s)};
}

void ease(const Eased& kept, double held_mm, Eased& eased) noexcept {
  for (std::size_t i = 0; i < eased.size(); ++i) eased[i] = held_mm + kept[i] * (eased[i] - held_mm);
}

/// The last tick's change, computed from the state after it: exact if the held depth stayed the same.
double relaxationChange(const Relaxation& relaxation, const Eased& kept, double held_mm, const Eased& eased) noexcept {
  const auto moved = [&](std::size_t i) { return (1.0 / kept[i] - 1.0) * std::abs(held_mm - eased[i]); };
  return relaxation.share * moved(0) + relaxation.share_2 * moved(1);
}

/// Lets a dent recover that no finger presses.
void easeDent(const Relaxation& relaxation, const Eased& kept, SkinMemory& memory) noexcept {
  if (!(memory.dent.rest_mm > 0.0)) return;
  ease(kept, memory.dent.rest_mm, memory.left_mm);
  memory.dent.rest_mm = restDepth(relaxation, memory.left_mm);
  if (memory.dent.rest_mm > kShallowest) return;
  memory.left_mm = {};
  memory.dent = {};
}

/// A finger that has just landed takes over what it left here.
void land(const Vec3& place, SkinMemory& memory) noexcept {
  if (!(memory.dent.rest_mm > 0.0)) return;
  const double here = 1.0 - (place - memory.dent.place).norm() / kDentReachMm;
  if (!(here > 0.0)) return;
  for (std::size_t i = 0; i < memory.under_mm.size(); ++i) memory.under_mm[i] = here * memory.left_mm[i];
  memory.left_mm = {};
  memory.dent = {};
}

bool isFresh(const Eased& under) noexcept { return under[0] == 0.0 && under[1] == 0.0; }

}  // namespace

Relaxed relaxed(const FingerSettings& settings, const tissue::Response& instant, double stiffness_n_per_mm,
                const Vec3& place, SkinMemory& memory) noexcept {
  const Relaxation& relaxation = settings.relaxation;
  const Eased kept = decayFactors(relaxation, settings.tick_s);
  if (isFresh(memory.under_mm)) land(place, memory);
  easeDent(relaxation, kept, memory);
  const double pressed_mm = stiffness_n_per_mm > 0.0 ? instant.force_n / stiffness_n_per_mm : 0.0;
  Relaxed result{.rest_mm = restDepth(relaxation, memory.under_mm), .tissue = instant};
  const double held_mm = std::max(pressed_mm, result.rest_mm);
  result.change_mm = relaxationChange(relaxation, kept, held_mm, memory.under_mm);
  // As a share, so that friction's lengths (felt_force.cpp) do not depend on time.
  const double taken = result.rest_mm > 0.0 ? result.rest_mm / pressed_mm : 0.0;
  result.share = std::max(0.0, 1.0 - taken);
  result.tissue.force_n *= result.share;
  result.tissue.secant_n_per_mm *= result.share;
  ease(kept, held_mm, memory.under_mm);
  return result;
}

void recover(const Surface& surface, const FingerSettings& settings, const SurfacePoint& left_at,
             SkinMemory& memory) noexcept {
  const Relaxation& relaxation = settings.relaxation;
  if (!isFresh(memory.under_mm)) {
    memory.left_mm = memory.under_mm;
    memory.under_mm = {};
    memory.dent = {left_at.position, restDepth(relaxation, memory.left_mm),
                   left_at.triangle == kNoIndex ? kNoIndex : surface.geometry->tree.source_triangle[left_at.triangle]};
  }
  easeDent(relaxation, decayFactors(relaxation, settings.tick_s), memory);
}

}  // namespace palpate::contact
