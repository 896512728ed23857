// A flat sheet of one stack of layers with a lump in it, as silicone models of breasts are: where published
// examinations of lumps are repeated.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "palpate/lumps/lump_observer.h"
#include "palpate/tissue/layered_table.h"

namespace palpate::lumps {

/// The sheet without a lump. Immutable; any number of threads.
class LumpSheet {
 public:
  /// Throws Error for a table without a field.
  explicit LumpSheet(tissue::LayeredTable table);

  /// A fingertip on the sheet with this lump under foot(); without one both presses are the same. Throws Error for a
  /// lump that the layers have no room for.
  ComparedSkin with(const std::optional<tissue::LumpShape>& lump) const;

  /// On the skin over the lump; not on an edge of the sheet's triangles.
  static Vec3 foot() { return {20.0, 10.0, 0.0}; }
  /// Depth of a fingertip that presses with this force away from the lump, mm.
  double depthAt(double force_n) const;

  const tissue::LayerStack& stack() const { return table_.stack; }

 private:
  tissue::LayeredTable table_;
  contact::Surface plain_;
  std::shared_ptr<const contact::PressureGround> ground_;
};

/// Strokes a finger straight past the lump at this depth and lateral distance, tick by tick: returns the cue at each
/// millimetre, from half a stroke's width before to as far behind. An observer goes by the clearest.
std::vector<LumpCue> strokePast(const ComparedSkin& skin, double beside_mm, double depth_mm, std::size_t taxels);
double maxClarity(const std::vector<LumpCue>& cues, const LumpObserver& observer) noexcept;

}  // namespace palpate::lumps
