#include "palpate/training/session/trial_scene.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/servo/device_limits.h"

namespace palpate::training {

namespace {

/// Thickness of the soft tissue over the transverse processes, mm: where a bone nearer to the skin is felt.
constexpr double kTissueOverBoneMm = 30.0;

/// Boussinesq's pressure under a small load falls with the depth squared: deep tissue gives that much less.
double shareAtSkin(const HiddenPlace& place) {
  const double relative = place.depth_mm / place.radius_mm;
  return 1.0 / (1.0 + relative * relative);
}

double boneRatio(double displacement_mm) {
  return maps::stiffnessAtDepth(kTissueOverBoneMm - displacement_mm) / maps::stiffnessAtDepth(kTissueOverBoneMm);
}

void makeEven(scene::Scene& scene, double base_n_per_mm) {
  scene.stiffness = {};
  scene.stiffness.source = scene::StiffnessSource::constant;
  scene.stiffness.constant_n_per_mm = base_n_per_mm;
  scene.tissue = {};
  scene.tissue.force_law = {};  // Hooke's
}

}  // namespace

double feltRatio(const HiddenPlace& place, double change, ChangeMeaning meaning) {
  const double at_skin = 1.0 + shareAtSkin(place) * (stiffnessRatio(change, meaning) - 1.0);
  return at_skin * boneRatio(place.bony_displacement_mm);
}

double renderableBase(const Protocol& protocol, double stiffest_n_per_mm) {
  double largest_ratio = 1.0;
  for (const auto& kind : WordsOf<SessionKind>::kAll) {
    const BlockSettings& block = settingsOf(protocol, kind.value).block;
    largest_ratio = std::max(largest_ratio, feltRatio(protocol.hidden, largestChange(block), block.meaning));
  }
  return std::min(protocol.base_n_per_mm, stiffest_n_per_mm / largest_ratio);
}

double renderableBase(const Protocol& protocol, const scene::Scene& scene, const device::DeviceProfile& profile) {
  const double cap = servo::stiffnessCap(scene.safety, profile, 1.0 / scene.ticks_per_s);
  return renderableBase(protocol, cap / std::max(1.0, scene.contact.finger.stiffness_ratio));
}

maps::Dysfunction dysfunctionAt(const Site& site, const HiddenPlace& place, double change, ChangeMeaning meaning) {
  return {.x_mm = site.place_mm.x(),
          .y_mm = site.place_mm.y(),
          .radius_mm = std::hypot(place.radius_mm, place.depth_mm),
          .change_percent = 100.0 * (feltRatio(place, change, meaning) - 1.0),
          .edge_softness = place.edge_softness};
}

scene::Scene trialScene(const scene::Scene& base, const Protocol& protocol, SessionKind kind, const SiteSet& sites,
                        const std::optional<HiddenNow>& hidden) {
  const SessionSettings& settings = settingsOf(protocol, kind);
  scene::Scene scene = base;
  scene.dysfunctions.clear();
  scene.lumps.clear();  // only the trial may hide lumps
  if (!settings.natural_stiffness && !hidesLumps(kind)) makeEven(scene, protocol.base_n_per_mm);
  if (!hidden) return scene;
  const Site* site = sites.numbered(hidden->site);
  if (site == nullptr) throw Error("trial: unknown site " + std::to_string(hidden->site));
  scene.dysfunctions.push_back(dysfunctionAt(*site, protocol.hidden, hidden->change, settings.block.meaning));
  return scene;
}

}  // namespace palpate::training
