// The body of a trial: a scene with its tissue made even (for tests) and a hidden place in it.
//
//   scene at hand, protocol, HiddenNow ─ trialScene ─► Scene ─ scene::rebuilt ─► World
#pragma once

#include <optional>

#include "palpate/scene/scene.h"
#include "palpate/training/sitting.h"

namespace palpate::training {

/// `base` keeps its body, fingers and look; own dysfunctions, texture of names and what else would tell are taken out.
/// `touch_mm`: the size of the change felt at the site is exactly stiffnessRatio at its centre.
scene::Scene trialScene(const scene::Scene& base, const Protocol& protocol, SittingKind kind, const SiteSet& sites,
                        const std::optional<HiddenNow>& hidden);

}  // namespace palpate::training
