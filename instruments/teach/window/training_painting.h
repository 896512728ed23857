// Puts a TrainingScreen where it belongs: words and buttons in points, marks of sites where the camera sees them.
//
//   TrainingScreen, places of the sites ─ paintTraining ─► ImGui, in a frame that has begun ─► what was clicked
//
// Everything grows with the text size of the window. It decides nothing: all words are the screen's.
#pragma once

#include <imgui.h>

#include <optional>
#include <vector>

#include "palpate/base/vec.h"
#include "teach/window/training_screen.h"

namespace palpate::viewer {

struct TrainingClick {
  TrainingAct act = TrainingAct::none;
  int value = 0;
};

/// Where each site of the body is seen, points, by its number from 1; nothing: it is on the far side.
struct SeenSite {
  std::optional<Vec2> at;
  bool tag_left = false;  ///< its number is on the left of it
};

/// Width of the column next to the body, points; the strip above it is as high as its text needs, at most this.
inline constexpr float kTrainingColumn = 300.0f;
inline constexpr float kTrainingStrip = 96.0f;

TrainingClick paintTraining(const TrainingScreen& screen, const std::vector<SeenSite>& sites);

// The marks of sites over the body, each state with a shape of its own: an open ring (not pressed enough yet), a disc
// (pressed), a second ring (a finger is there; none where the rings of its sink show it), brackets (picked), an arrow
// and words (it was here), words on a line (your answer). Colours only repeat the shapes' meaning.

/// Draws all; the number whose tag was clicked, or 0.
int paintSiteMarks(const TrainingScreen& screen, const std::vector<SeenSite>& sites);

/// Ring or disc of a site in the text's colour: the light ink for skin would vanish on a button of a light theme.
void paintSiteDot(ImDrawList& list, const ImVec2& at, float radius, bool pressed);

/// A ring of which this share is left, from the top clockwise, open where the time has gone.
void paintTimeRing(ImDrawList& list, const ImVec2& middle, float radius, double share);
/// A tick or a cross.
void paintOutcome(ImDrawList& list, const ImVec2& middle, float size, TrainingScreen::Outcome outcome);

}  // namespace palpate::viewer
