// The frame around the panels: the layout of the screen, and the parts of the viewer's state for each panel.
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

/// Pictures for the gui that are made outside it.
struct GuiPictures {
  ExamplePictures& examples;
  PreviewPane& preview;
};

/// Draws everything over the picture: menu, side panel, plots, hint, message, dialogs; or a mode's own in their place.
/// Performs the requested actions and shows the messages; requests and notes of changes stay in viewer.output.
void drawGui(ViewerState& viewer, const Modes& modes, const GuiPictures& pictures);

/// Whether a window of this name belongs to a saved picture: menu bar, side panel, plots and a mode's picture in place
/// of the body ("mode...") do, all others are temporary.
bool staysInPictures(std::string_view window);

enum class Panel { touch, devices, tissue, dysfunctions, lumps, model, show, vertex, stereo, record, performance };
struct PanelEntry {
  const char* name;
  Panel panel;
  bool open_at_first = false;
};
/// From top to bottom.
std::span<const PanelEntry> panelList();
/// All sections in one narrow window at an edge of the screen.
void sidePanel(ViewerState& viewer, float width, const FreeArea& free);

}  // namespace palpate::viewer
