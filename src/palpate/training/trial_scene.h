// The body of a trial: a scene with its tissue made even (for tests) and a hidden place in it.
//
//   scene at hand, protocol, HiddenNow ─ trialScene ─► Scene ─ scene::rebuilt ─► World
//
// At the centre of the hidden place, and over its inner part, the stiffness is exactly `feltRatio` times the base under
// every force law, because laws are proportional to the map.
#pragma once

#include <optional>

#include "palpate/scene/scene.h"
#include "palpate/training/sitting.h"

namespace palpate::training {

/// The factor that a finger on the skin feels over the place: the change, weakened by its depth, and the raised bone.
double feltRatio(const HiddenPlace& place, double change, ChangeMeaning meaning);

/// A site's hidden place as the scene's own dysfunction.
maps::Dysfunction dysfunctionAt(const Site& site, const HiddenPlace& place, double change, ChangeMeaning meaning);

/// `base` keeps its body, fingers, device limits and look; its own dysfunctions are taken out. Without
/// natural_stiffness the tissue is the same everywhere and answers by Hooke's law at once.
scene::Scene trialScene(const scene::Scene& base, const Protocol& protocol, SittingKind kind, const SiteSet& sites,
                        const std::optional<HiddenNow>& hidden);

}  // namespace palpate::training
