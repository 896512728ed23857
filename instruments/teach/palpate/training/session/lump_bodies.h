// Bodies with lumps in them: where there is room for one, the world of a trial, and how plainly a lump is felt there.
//
//   body, protocol, sites ─ LumpBodies ─► places() ─ drawn by lumps::LumpBlock ─► with(hidden) ─► a world each trial
//
// The tissue is the body's own: lumps need its layers. Its dysfunctions are taken out.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "palpate/contact/pressure_field.h"
#include "palpate/lumps/lump_block.h"
#include "palpate/scene/world.h"
#include "palpate/training/protocol.h"
#include "palpate/training/site.h"

namespace palpate::training {

/// The scene with these lumps and no others; `base` keeps its body, fingers, device limits and look.
scene::Scene lumpScene(const scene::Scene& base, const lumps::LumpTask& task,
                       std::span<const lumps::HiddenLump> hidden);

class LumpBodies {
 public:
  /// Places lumps among the sites and a little around them. Throws Error for a protocol without lumps, for a body
  /// without layers that were solved with a field, and where the largest lump does not fit at its greatest depth.
  LumpBodies(const std::shared_ptr<const scene::World>& body, const Protocol& protocol, const SiteSet& sites);

  const std::vector<Vec2>& places() const { return places_; }
  /// Any lump's world, and that without: felt with the same law and the same skin. Throws Error.
  std::shared_ptr<const scene::World> with(std::span<const lumps::HiddenLump> hidden) const;
  /// C of a press of 3 N right over it, as the observer of lumps/lump_observer.h has it.
  double computeClarity(const lumps::HiddenLump& lump) const;

  const lumps::LumpTask& task() const { return task_; }
  /// Patterns of pressure on this body; the same for all its worlds.
  const contact::PressureGround& ground() const { return *ground_; }

 private:
  std::shared_ptr<const scene::World> plain_;
  std::shared_ptr<const contact::PressureGround> ground_;
  lumps::LumpTask task_;
  std::vector<Vec2> places_;
};

}  // namespace palpate::training
