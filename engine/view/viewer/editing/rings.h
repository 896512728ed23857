// Rings on the skin that belong to the window, not to the picture: where each finger would press, and in the editor the
// dysfunctions. Made as lines in space (Frame::marks), so that both eyes of a stereo picture see them in place. No GL.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "palpate/view/lines.h"
#include "view/viewer/editing/pointer.h"

namespace palpate::viewer {

/// Colours of a finger's lines.
inline constexpr std::array<view::Paint, kFingers> kFingerPaint = {{{110, 165, 255, 230}, {255, 120, 105, 230}}};

/// A ring under each finger that has been over the skin, as large as the finger, tilted with the skin; thicker the
/// deeper it presses. A wider one round a named place, which the finger would hide.
std::vector<view::Lines> fingerRings(const BodyView& seen, const scene::Scene& scene, const Pointer& pointer);

/// The rims of the dysfunctions on the skin; the selected one bold. With the pointer on free skin, dashed: the one that
/// a click would place.
std::vector<view::Lines> dysfunctionRings(const DysfunctionEdit& edit, const std::optional<SkinPlace>& under,
                                          const scene::World& world);

/// The same for lumps, as wide as they are.
std::vector<view::Lines> lumpRings(const LumpEdit& edit, const std::optional<SkinPlace>& under,
                                   const scene::World& world);

}  // namespace palpate::viewer
