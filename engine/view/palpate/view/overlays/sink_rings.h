// Depth of a finger as rings on the skin round it, for users without force feedback. One thin ring for each whole
// millimetre, and a bold one outside that opens as the finger goes down.
//
// They depend on the depth only, wherever the finger presses: they reveal no more than the picture of a dent would.
#pragma once

#include <vector>

#include "palpate/contact/finger_state.h"
#include "palpate/scene/world.h"
#include "palpate/view/lines.h"

namespace palpate::view {

/// The first ring opens at the rim of a fingertip, mm.
inline constexpr double kSinkRimMm = 10.0;
/// Each millimetre of sink opens the ring by this much: wide enough apart to be counted where a pixel is half a
/// millimetre.
inline constexpr double kSinkOpensMm = 4.0;
/// Deeper than a press of training goes; more rings would cover the back.
inline constexpr int kMaxSinkRings = 14;

/// Radius of the bold ring at this depth, mm.
double sinkRadius(double depth_mm);

/// On the skin at rest; empty for a finger without contact.
std::vector<Lines> sinkRings(const scene::World& world, const contact::FingerOutput& finger);

}  // namespace palpate::view
