// The marks of sites over the body, each state with a shape of its own: an open ring (not pressed enough yet), a disc
// (pressed), a second ring (a finger is there; none where the rings of its sink show it), brackets (picked), an arrow
// and words (it was here), words on a line (your answer). Colours only repeat the shapes' meaning.
#pragma once

#include <imgui.h>
#include <vector>

#include "teach/window/training_painting.h"

namespace palpate::viewer {

/// Draws all; the number whose tag was clicked, or 0.
int paintSiteMarks(const TrainingScreen& screen, const std::vector<SeenSite>& sites);

/// Ring or disc of a site in the text's colour: the light ink for skin would vanish on a button of a light theme.
void paintSiteDot(ImDrawList& list, const ImVec2& at, float radius, bool pressed);

/// A ring of which this share is left, from the top clockwise, open where the time has gone.
void paintTimeRing(ImDrawList& list, const ImVec2& middle, float radius, double share);
/// A tick or a cross.
void paintOutcome(ImDrawList& list, const ImVec2& middle, float size, TrainingScreen::Outcome outcome);

}  // namespace palpate::viewer
