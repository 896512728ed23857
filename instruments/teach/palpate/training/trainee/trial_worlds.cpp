#include "palpate/training/trainee/trial_worlds.h"

#include <utility>

#include "palpate/maps/stiffness_map.h"
#include "palpate/training/session/trial_scene.h"

namespace palpate::training {

namespace {

/// As in scene::build: the map plane is seen from behind, and a place on it leaves the front of a body as it is.
std::vector<Index> verticesReached(const scene::World& world) {
  const bool known_front = world.body->closed && !world.body->anatomy.landmarks.empty();
  const std::vector<Vec3> normals = mesh::vertexNormals(world.body->skin);
  std::vector<Index> reached;
  for (Index v = 0; v < normals.size(); ++v) {
    if (!known_front || !(normals[v].z() < 0)) reached.push_back(v);
  }
  return reached;
}

}  // namespace

TrialWorlds::TrialWorlds(const scene::World& body, const Protocol& protocol, SessionKind kind, const SiteSet& sites)
    : base_(body.scene), protocol_(protocol), kind_(kind), sites_(sites) {
  even_ = scene::rebuilt(body, trialScene(base_, protocol_, kind_, sites_, {}));
  reached_ = verticesReached(*even_);
}

std::shared_ptr<const scene::World> TrialWorlds::with(const std::optional<HiddenNow>& hidden) const {
  if (!hidden) return even_;
  const scene::Scene scene = trialScene(base_, protocol_, kind_, sites_, hidden);
  // The detecting box holds stiffness of its own.
  if (even_->hdb) return scene::rebuilt(*even_, scene);
  auto world = std::make_shared<scene::World>(*even_);
  auto stiffness_n_per_mm = std::make_shared<std::vector<double>>(*even_->surface.stiffness_n_per_mm);
  for (const maps::Dysfunction& place : scene.dysfunctions) {
    for (const Index v : reached_) {
      (*stiffness_n_per_mm)[v] *= maps::stiffnessFactor(place, world->body->skin.positions[v].head<2>());
    }
  }
  world->surface.stiffness_n_per_mm = std::move(stiffness_n_per_mm);
  world->scene = scene;
  return world;
}

}  // namespace palpate::training
