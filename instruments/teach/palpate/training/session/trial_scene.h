// The body of a trial: a scene with its tissue made even (for tests) and a hidden place in it.
//
//   present scene, protocol, HiddenNow ─ trialScene ─► Scene ─ scene::rebuilt ─► World
//
// At the centre of the hidden place, and over its inner part, the stiffness is exactly `feltRatio` times the base under
// every force law, because laws are proportional to the map.
#pragma once

#include <optional>

#include "palpate/device/device_profile.h"
#include "palpate/scene/scene.h"
#include "palpate/training/session/session.h"

namespace palpate::training {

/// The factor that a finger on the skin feels over the place: the change, weakened by its depth, and the raised bone.
double feltRatio(const HiddenPlace& place, double change, ChangeMeaning meaning);

/// The base that a device can render together with the largest change of any session, at most the protocol's. A device
/// that cannot is given the whole body softer (servo/device_limits.h), more for a larger change: that would reveal the
/// answer's size, so the base is lowered once instead, for all sessions alike. `stiffest`: the most that the hand may
/// feel, N/mm.
double renderableBase(const Protocol& protocol, double stiffest_n_per_mm);

/// The same for a scene's fingers on a device.
double renderableBase(const Protocol& protocol, const scene::Scene& scene, const device::DeviceProfile& profile);

/// A site's hidden place as the scene's own dysfunction.
maps::Dysfunction dysfunctionAt(const Site& site, const HiddenPlace& place, double change, ChangeMeaning meaning);

/// `base` keeps its body, fingers, device limits and look; its own dysfunctions are taken out. Without
/// natural_stiffness the tissue is the same everywhere and answers by Hooke's law at once.
scene::Scene trialScene(const scene::Scene& base, const Protocol& protocol, SessionKind kind, const SiteSet& sites,
                        const std::optional<HiddenNow>& hidden);

}  // namespace palpate::training
