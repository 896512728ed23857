// Rings on the skin that belong to the window, not to the picture: where each finger would press, and in the editor
// where the dysfunctions are. Made as lines in space (Frame::marks), so that both eyes of a stereo picture see them
// where they are. No GL.
#pragma once

#include <vector>

#include "palpate/view/lines.h"
#include "view/viewer/editing/pointer.h"
#include "view/viewer/state/session.h"

namespace palpate::viewer {

/// Of lines that belong to a finger.
inline constexpr std::array<view::Paint, kFingers> kFingerPaint = {{{110, 165, 255, 230}, {255, 120, 105, 230}}};

/// A ring under each finger that has been over the skin, as large as the finger, tilted with the skin; thicker the
/// deeper it presses.
std::vector<view::Lines> fingerRings(const Session& session, const Pointer& pointer);

/// The rims of the dysfunctions, laid on the skin; the selected one bold. Where the pointer is on free skin, dashed:
/// the one that a click would place.
std::vector<view::Lines> dysfunctionRings(const Session& session, const Pointer& pointer, const scene::World& world);

}  // namespace palpate::viewer
