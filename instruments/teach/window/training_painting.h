// Puts a TrainingScreen where it belongs: words and buttons in points, marks of sites where the camera sees them.
//
//   TrainingScreen, places of the sites ─ paintTraining ─► ImGui, in a frame that has begun ─► what was clicked
//
// Everything grows with the text size of the window. It decides nothing: all words are the screen's.
#pragma once

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

}  // namespace palpate::viewer
