// The frame around the panels: what stands where on the screen, and which parts of the viewer's state each panel gets.
//
//   ViewerState ─ drawGui ─► each panel (panels.h): the parts it shows and may change ─► UiOutput, for everything else
//
// All need a Gui frame that has begun.
#pragma once

#include <span>
#include <string_view>

#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/start_page.h"
#include "view/viewer/state/viewer_state.h"

namespace palpate::viewer {

class Modes;

/// What the gui shows that is made beside it.
struct GuiPictures {
  ExamplePictures& examples;
  PreviewPane& preview;
};

/// Draws everything over the picture: menu, side panel, plots, hint, message, dialogs; or what a mode has in place of
/// them. Does the actions that were asked for and passes the words on; requests and notes of changes stay in
/// viewer.output.
void drawGui(ViewerState& viewer, const Modes& modes, const GuiPictures& pictures);

/// Whether a window of this name belongs to a saved picture: menu bar, side panel, plots and what a mode draws in place
/// of the body ("mode...") do, all else lies over it for a moment.
bool staysInPictures(std::string_view window);

using PanelFunction = void (*)(ViewerState&);
struct PanelEntry {
  const char* name;
  PanelFunction draw;
  bool open_at_first = false;
};
/// From top to bottom.
std::span<const PanelEntry> panelList();
/// All sections in one narrow window at an edge of the screen.
void sidePanel(ViewerState& viewer, float width, const FreeArea& free);

}  // namespace palpate::viewer
