// What the haptic finger knows, drawn: friction anchor, proxy, tip and force.
#pragma once

#include "palpate/contact/finger_state.h"
#include "palpate/view/overlays/lines.h"

namespace palpate::view {

/// Length of the force arrow, and where it ends whatever the force; a longer one has a break before its head.
inline constexpr double kForceMmPerN = 10.0;
inline constexpr double kLongestForceMm = 60.0;

/// Anchor (yellow) and proxy (white) on the skin at rest, tip, and what ties them; the force from the proxy.
void addContactMarks(const contact::FingerOutput& contact, Lines& lines);

}  // namespace palpate::view
