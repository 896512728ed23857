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

#include "palpate/contact/finger.h"
#include "palpate/deform/deformer.h"
#include "palpate/scene/world.h"
#include "palpate/trace/sample.h"

namespace palpate::engine {

struct LivingSkinSettings {
  bool strain = true;       ///< also write the strain of the skin
  std::size_t fingers = 0;  ///< room for so many, where the scene has fewer
};

/// One thread at a time. The world must outlive it.
class LivingSkin {
 public:
  /// At rest. Allocates everything that `follow` needs. Throws Error for a profile that is none.
  explicit LivingSkin(const scene::World& world, const LivingSkinSettings& settings = {});
  LivingSkin(const scene::World&& world, const LivingSkinSettings& settings = {}) = delete;

  /// Brings the surface to what these fingers make of it, whatever it was before; none: to rest. Fingers in free space
  /// count as none. The report says what could not be followed. No allocation.
  deform::Report follow(std::span<const contact::FingerOutput> fingers) noexcept;
  deform::Report follow(std::span<const trace::Sample> samples) noexcept;

  const deform::DeformedSurface& surface() const noexcept { return surface_; }

 private:
  LivingSkin(const scene::World& world, const deform::FormSettings& forms);
  template <class Finger>
  deform::Report followAny(std::span<const Finger> fingers) noexcept;

  const scene::World& world_;
  deform::Deformer deformer_;
  deform::DeformedSurface surface_;
  std::vector<deform::Contact> touching_;
};

}  // namespace palpate::engine
