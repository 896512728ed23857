// The bodies of a session's trials, made quickly: one even body, and copies of it with a hidden place.
//
//   body, protocol ─ TrialWorlds ─► the even world ─ with(hidden) ─► a world each trial
//
// A hidden place changes nothing but the stiffness map, so its world is the even one copied with another map: some
// 10 ms, where scene::rebuilt takes 170 ms for the trunk (search tree, deformable skin). Both give the same forces bit
// by bit, and a session that names the scene is replayed by the long way.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/training/session/session.h"

namespace palpate::training {

class TrialWorlds {
 public:
  /// `body` is any world of that body. Throws Error as scene::rebuilt does.
  TrialWorlds(const scene::World& body, const Protocol& protocol, SessionKind kind, const SiteSet& sites);

  const std::shared_ptr<const scene::World>& even() const { return even_; }
  /// Throws Error for a site that there is not.
  std::shared_ptr<const scene::World> with(const std::optional<HiddenNow>& hidden) const;

 private:
  scene::Scene base_;
  Protocol protocol_;
  SessionKind kind_;
  SiteSet sites_;
  std::shared_ptr<const scene::World> even_;
  std::vector<Index> reached_;  ///< vertices that a place on the map plane changes: of a closed body its back
};

}  // namespace palpate::training
