// The haptic finger: one call a tick turns the place of the device's tip into the force on the hand.
//
// Words, the same everywhere (docs/explanation/contact.md): the *tip* D is where the device is; the *proxy* P is the
// point of the skin that it presses, at a *depth* p along the normal n; the *friction anchor* A is the point of the
// skin that friction holds. Force F = k_n p n + k_t u, u being the tangential pull from P to A.
//
// `step` is noexcept, takes no lock, allocates nothing and does no I/O. Fingers share a Surface and nothing else.
#pragma once

#include <span>

#include "palpate/contact/finger_state.h"
#include "palpate/contact/surface.h"

namespace palpate::contact {

struct FingerSkin;
struct LumpPlaces;

/// The same finger in a world `factor` times as large: every length, nothing else.
FingerSettings scaled(FingerSettings settings, double factor);

/// Throws Error naming the first setting that makes no sense (negative, not finite, mu_dynamic > mu_static).
void check(const FingerSettings& settings);

/// One tick of one finger. Any thread, but one thread at a time per state. It does not look at its settings again:
/// those that check() refuses may give any force, and so may lengths beyond those of the surface by many powers of ten,
/// of which few digits are left. The facade (engine/simulator.h) refuses both. `lumps`: where the surface's lumps lie
/// now, which a loop knows (lump_force.h); null: where the world has them. `skin`: what the finger keeps of the skin
/// near it (nearby_skin.h), value-initialised for its first tick; null: nothing. A sphere is then felt two to three
/// times as fast on a surface that has planes, and the same to the last bit.
FingerOutput step(const Surface& surface, const FingerSettings& settings, FingerState& state, const Vec3& tip,
                  const LumpPlaces* lumps = nullptr, FingerSkin* skin = nullptr) noexcept;

/// One tick of many fingers on one surface, each as `step` does it; all spans have one length. For a hand of many
/// points or many simulated hands: fingers are independent, so a caller with several threads may give each a part.
void stepAll(const Surface& surface, std::span<const FingerSettings> settings, std::span<FingerState> states,
             std::span<const Vec3> tips, std::span<FingerOutput> outputs) noexcept;

}  // namespace palpate::contact
