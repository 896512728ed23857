// The panels, each in a file of its own (panel_<name>.cpp), and what puts them on the screen.
//
// A panel is a function that draws the controls of one section and edits the session; the frame around it is drawn by
// sidePanel. All need a Gui frame that has begun.
#pragma once

#include "apps/viewer/session.h"

namespace palpate::viewer {

/// Points of the screen that the picture has to itself.
struct FreeArea {
  float left = 0.0f;
  float top = 0.0f;
  float right = 0.0f;
  float below = 0.0f;
};

inline constexpr float kPlotsHeight = 150.0f;  ///< of the strips below the picture

/// Draws everything over the picture: menu, side panel, plots, hint, message, dialogs. Returns the area left free.
FreeArea drawGui(Session& session);
/// Where the picture will be free before anything was drawn.
FreeArea freeArea(const Session& session, float width, float height);

void menuBar(Session& session);
void touchPanel(Session& session);
void tissuePanel(Session& session);
void dysfunctionPanel(Session& session);
void modelPanel(Session& session);
void showPanel(Session& session);
void stereoPanel(Session& session);
void recordPanel(Session& session);
void performancePanel(Session& session);

using PanelFunction = void (*)(Session&);
struct PanelEntry {
  const char* name;
  PanelFunction draw;
};
/// From top to bottom.
std::span<const PanelEntry> panelList();
/// All sections in one narrow window at an edge of the screen.
void sidePanel(Session& session, float width, const FreeArea& free);

void plotStrips(Session& session, const FreeArea& free);
void helpPage(Session& session);
void openDialog(Session& session);
void messageList(Session& session);
void toast(Session& session, const FreeArea& free);
void buildProgress(Session& session, const FreeArea& free);
void hint(Session& session, const FreeArea& free);
void editingFrame(Session& session, const FreeArea& free);
void replayBar(Session& session, const FreeArea& free);

/// A curve of the scene's displacement profile, with handles when it is the user's own.
void profileCurve(Session& session);

/// The words of hint number `i`, from 0; empty after the last.
std::string_view hintText(int i);

}  // namespace palpate::viewer
