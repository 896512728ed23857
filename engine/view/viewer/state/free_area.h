// The part of the window that menu, panel and plots leave free.
#pragma once

#include "view/viewer/state/view_state.h"

namespace palpate::viewer {

/// The picture's own part of the screen, points.
struct FreeArea {
  float left = 0.0f;
  float top = 0.0f;
  float right = 0.0f;
  float below = 0.0f;
};

inline constexpr float kMenuBarHeight = 24.0f;
inline constexpr float kSidePanelWidth = 300.0f;
inline constexpr float kPlotsHeight = 150.0f;  ///< height of the strips below the picture

/// Known before anything has been drawn.
inline FreeArea freeArea(const Shown& shown, float width, float height) {
  FreeArea free{0.0f, kMenuBarHeight, width, height};
  if (shown.panel)
    (shown.panel_right ? free.right : free.left) += shown.panel_right ? -kSidePanelWidth : kSidePanelWidth;
  if (shown.plots) free.below -= kPlotsHeight;
  return free;
}

}  // namespace palpate::viewer
