#include "palpate/training/trial_scene.h"

#include <cmath>

#include "palpate/base/error.h"

namespace palpate::training {

namespace {

/// The soft tissue over the transverse processes beside the spine, mm: where a bone that stands nearer is felt.
constexpr double kTissueOverBoneMm = 30.0;

/// Boussinesq's pressure under a small load falls with the depth squared: what lies deep gives that much less.
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

maps::Dysfunction dysfunctionAt(const Site& site, const HiddenPlace& place, double change, ChangeMeaning meaning) {
  return {.x_mm = site.place_mm.x(),
          .y_mm = site.place_mm.y(),
          .radius_mm = std::hypot(place.radius_mm, place.depth_mm),
          .change_percent = 100.0 * (feltRatio(place, change, meaning) - 1.0),
          .edge_softness = place.edge_softness};
}

scene::Scene trialScene(const scene::Scene& base, const Protocol& protocol, SittingKind kind, const SiteSet& sites,
                        const std::optional<HiddenNow>& hidden) {
  const SittingSettings& settings = settingsOf(protocol, kind);
  scene::Scene scene = base;
  scene.dysfunctions.clear();
  if (!settings.natural_stiffness) makeEven(scene, protocol.base_n_per_mm);
  if (!hidden) return scene;
  const Site* site = sites.numbered(hidden->site);
  if (site == nullptr) throw Error("trial: there is no site " + std::to_string(hidden->site));
  scene.dysfunctions.push_back(dysfunctionAt(*site, protocol.hidden, hidden->change, settings.block.meaning));
  return scene;
}

}  // namespace palpate::training
