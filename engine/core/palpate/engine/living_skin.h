// The skin of a world under its fingers: the one place where what fingers feel becomes a deformed surface.
//
//   FingerOutput or Sample of each finger ─ scene::contactOf ─► contacts ─ deformer ─► DeformedSurface ─► picture, file
//
// Knows no window and no clock: a display calls it sixty times a second with the newest samples of the servo, a file
// writer once with those of a moment.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/deform/deformer.h"
#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/trace/sample.h"

namespace palpate::engine {

struct LivingSkinSettings {
  bool strain = true;       ///< also write the strain of the skin
  std::size_t fingers = 0;  ///< room for this many, where the scene has fewer
};

/// One thread at a time. The world must outlive it.
class LivingSkin {
 public:
  /// At rest. Allocates everything that `follow` needs. Throws Error for an invalid profile.
  explicit LivingSkin(const scene::World& world, const LivingSkinSettings& settings = {});
  LivingSkin(const scene::World&& world, const LivingSkinSettings& settings = {}) = delete;

  /// Deforms the surface by these fingers, whatever it was before; none: to rest. Fingers in free space do not count.
  /// The report lists contacts that could not be followed. No allocation.
  /// `tick` is when they felt it, which counts on a body that breathes.
  deform::Report follow(std::span<const contact::FingerOutput> fingers, std::uint64_t tick = 0) noexcept;
  deform::Report follow(std::span<const trace::Sample> samples) noexcept;

  /// The skin as if the body held its breath: World.breath moves it by `lift`.
  const deform::DeformedSurface& surface() const noexcept { return surface_; }
  /// Motion of the body by breath (BreathField::lift), mm; 0 for one that does not breathe.
  double lift() const noexcept { return lift_mm_; }

 private:
  LivingSkin(const scene::World& world, const deform::FormSettings& forms);
  template <class Finger>
  deform::Report followAny(std::span<const Finger> fingers, std::uint64_t tick) noexcept;

  const scene::World& world_;
  deform::Deformer deformer_;
  deform::DeformedSurface surface_;
  std::vector<deform::Contact> touching_;
  double lift_mm_ = 0.0;
};

}  // namespace palpate::engine
