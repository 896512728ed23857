// The skin of a world under its fingers: the one place where what fingers feel becomes a deformed surface.
//
//   FingerOutput or Sample of each finger ─ scene::contactOf ─► contacts ─ deformer ─► DeformedSurface ─► picture, file
//
// Knows no window and no clock: a display calls it sixty times a second with the newest samples of the servo, a file
// writer once with those of a moment.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/contact/finger.h"
#include "palpate/deform/deformer.h"
#include "palpate/deform/surface.h"
#include "palpate/scene/world.h"
#include "palpate/trace/sample.h"
#include "palpate/tree/triangle_tree.h"

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

// Tissue left between the pressed skin and the bones: measured on the surface that is drawn and the bones that are
// drawn, after the fact.
//
// Knows nothing of layers or of how deep a press may go; it checks whether they keep their promise
// (docs/explanation/tissue.md).

struct BoneCover {
  double least_mm = 0.0;   ///< from a vertex that moved to the nearest bone; below 0: it has sunk in
  Vec3 at = Vec3::Zero();  ///< the vertex now
  Index bone = kNoIndex;   ///< among the body's bones
};

class BoneCoverMeter {
 public:
  /// The world must outlive it.
  explicit BoneCoverMeter(const scene::World& world);
  BoneCoverMeter(const scene::World&&) = delete;

  /// Cover over all vertices that are not at rest; nothing on a body without bones or where none moved. Milliseconds.
  std::optional<BoneCover> of(const deform::DeformedSurface& surface) const;

 private:
  const scene::World& world_;
  std::optional<tree::TriangleTree> bones_;
  std::vector<Index> bone_of_triangle_;
};

/// "3.2 mm of tissue left over left rib 7"
std::string describe(const BoneCover& cover, const scene::World& world);

}  // namespace palpate::engine
