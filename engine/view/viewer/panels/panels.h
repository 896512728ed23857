// The panels, each in a file of its own (panel_<name>.cpp), and the windows that hold them.
//
//   drawGui (gui_layout.h) ─► a panel: the parts it shows and may change, by reference ─► UiOutput, for everything else
//
// A panel is a function that draws the controls of one section; the frame around it is drawn by sidePanel. It does not
// know ViewerState: it can only see and change the members of its struct. All need a Gui frame that has begun.
#pragma once

#include <array>
#include <bitset>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/engine/world_builder.h"
#include "palpate/scene/scene.h"
#include "palpate/view/camera.h"
#include "view/viewer/manual/markdown.h"
#include "view/viewer/state/devices_shown.h"
#include "view/viewer/state/editor.h"
#include "view/viewer/state/free_area.h"
#include "view/viewer/state/messages.h"
#include "view/viewer/state/replay.h"
#include "view/viewer/state/requests.h"
#include "view/viewer/state/ruler.h"
#include "view/viewer/state/sample_history.h"
#include "view/viewer/state/vertex_values.h"
#include "view/viewer/state/view_state.h"
#include "view/viewer/state/viewer_parts.h"

namespace palpate::viewer {

class PreviewPane;

// ---- sections of the side panel

struct TouchPanel {
  TouchSettings& touch;
  std::size_t& active_finger;
  scene::Scene& scene;
};
void touchPanel(const TouchPanel& panel, UiOutput& output);

struct DevicePanel {
  DevicesShown& devices;
  scene::Scene& scene;
  const std::optional<VertexReading>& reading;  ///< at the place clicked last
  bool& reach;
  double ticks_per_s;
};
void devicePanel(const DevicePanel& panel, UiOutput& output);

struct TissuePanel {
  scene::Scene& scene;
  ProfileEdit& profile;
  bool has_bones;
};
void tissuePanel(const TissuePanel& panel, UiOutput& output);

struct DysfunctionPanel {
  DysfunctionEdit edit;
  std::string undo_words = {};  ///< the next step to undo; empty: none
  std::string redo_words = {};
};
void dysfunctionPanel(const DysfunctionPanel& panel);

struct LumpPanel {
  LumpEdit edit;
  std::string undo_words = {};  ///< the next step to undo; empty: none
  std::string redo_words = {};
};
void lumpPanel(const LumpPanel& panel);

struct ModelPanel {
  scene::Scene& scene;
  const WorldFacts& world;
  bool& open_dialog;
};
void modelPanel(const ModelPanel& panel, UiOutput& output);

struct ShowPanel {
  view::Look& look;
  bool& adapts_resolution;
  bool& simpler_when_slow;
  bool simple_now;  ///< drawn smooth because it was slow
  const WorldFacts& world;
};
void showPanel(const ShowPanel& panel);
/// Above all sections: the direction of view, and the most common switches.
void viewRow(view::Look& look, const WorldFacts& world, UiOutput& output);

/// The number of the body's file that colours the skin, its colour map, and its distribution.
void scalarWidgets(view::Look& look, const WorldFacts& world);

struct VertexPanel {
  const std::optional<VertexReading>& reading;
  bool& marked;  ///< marks it with a cross, while the panel is open
  bool& open;    ///< set while the panel is drawn
};
void vertexPanel(const VertexPanel& panel);

struct StereoPanel {
  view::StereoSettings& stereo;
  HeadSettings& head;
  const SeenHead& seen;
  const view::Camera& camera;
  const WorldFacts& world;
};
void stereoPanel(const StereoPanel& panel);

/// The running recordings and their lengths: "recording 0:12, 37 pictures"; empty without any.
std::string recordingStatus(const Recording& recording, double now_s);
/// `keeps_last_hour` is switched by it.
void recordPanel(const Recording& recording, bool& keeps_last_hour, double now_s, UiOutput& output);
void performancePanel(const Performance& performance);

/// A curve of the scene's displacement profile, with handles when it is the user's own.
void profileCurve(const tissue::ProfileSettings& of_scene, ProfileEdit& profile, UiOutput& output);

// ---- around the picture

struct MenuBar {
  ViewState& state;
  int& hint;
  std::bitset<window::kActions> on;  ///< switches with a check mark
  std::size_t unread_messages;
  std::vector<std::string> status;  ///< at the right end; where room is short, without the first ones
  std::string recording;            ///< behind a red dot, while something is recorded
  bool filming = false;
  bool offers_stop = false;  ///< a device holds a finger
  bool stopped = false;
  std::vector<window::Action> modes = {};  ///< other uses of this window (mode.h)
  float room_for_place = 0.0f;             ///< left free behind the menus (placeField), points
};
void menuBar(const MenuBar& menu, UiOutput& output);

/// A few names of places with all typed words, those that begin with them first.
std::vector<std::string> placesLike(std::span<const body::SkinLandmark> landmarks, std::string_view typed);
/// Two places of this body, for a hint: "T6, left PSIS" where it has these. Empty without named places.
std::string examplePlaces(std::span<const body::SkinLandmark> landmarks);
/// The first of them.
std::string firstExample(std::span<const body::SkinLandmark> landmarks);
/// Behind the menus: the name of a place to go to, and `here`, the place of the active finger. Hidden where the body
/// has no names.
struct PlaceField {
  PlaceSearch& search;
  std::span<const body::SkinLandmark> landmarks;
  const std::string& here;
};
inline constexpr float kPlaceFieldWidth = 360.0f;
void placeField(const PlaceField& field, UiOutput& output);

struct PlotStrips {
  Plots& plots;
  const std::array<bool, 2>& present;
  double device_limit_n;
  double now_s;
  std::optional<double> frozen_at_s;  ///< the moment of a frozen picture

  /// The time of the numbers above the strips.
  double timeShown() const { return frozen_at_s ? *frozen_at_s : plots.shownEnd(); }
};
void plotStrips(const PlotStrips& panel, const FreeArea& free, UiOutput& output);

void replayBar(Replay& replay, const FreeArea& free, UiOutput& output);
void helpPage(bool& open);
/// Files opened before, a folder to walk through, a line to type into, a preview of the chosen file.
void openDialog(std::span<const std::string> recent, bool& open, PreviewPane& preview, UiOutput& output);
/// The same for a photograph: the chosen file, or empty so far.
std::string photographDialog(const char* title, bool& open);
/// UiOutput where to save the scene; begins next to `now`, or in `folder` when it has no file yet.
void saveDialog(const std::filesystem::path& now, const std::filesystem::path& folder, bool& open, UiOutput& output);
/// UiOutput where to save the picture of the window, or a film of it from now on.
void pictureDialog(const std::filesystem::path& folder, bool& open, UiOutput& output);
void filmDialog(const std::filesystem::path& folder, bool& open, UiOutput& output);
/// Runs a class here, watches one, or takes part in one.
void classDialog(const ClassShown& shown, const std::filesystem::path& folder, bool& open, UiOutput& output);
/// The documents, with search.
void manualDialog(ManualShown& manual, bool& open);
/// A page of it in the current window. Returns the target of the clicked link, or empty. Scrolls to the heading of this
/// anchor, if there is one.
std::string drawBlocks(const std::vector<Block>& blocks, const std::string& to_anchor);
/// Sets the dialogs' folder; by default the last one, in the beginning the working folder.
void showFolder(const std::filesystem::path& folder);
/// A few bodies and recordings in that folder, the newest first; reads the folder again. Scenes and tables are left
/// out: every second .toml and .csv of a computer is something else.
std::vector<std::filesystem::path> newestFilesInFolder();
/// All photographs in that folder, the newest first.
std::vector<std::filesystem::path> photographsInFolder();
/// Whether a dialog is open in the current gui: it owns mouse and keyboard.
bool dialogShown();
/// Closes the menus and lists that are open over the body or over a dialog. False without any.
bool closeMenus();
/// UiOutput before a loss; the answer is a request.
void questionDialog(const std::optional<Question>& question, UiOutput& output);
/// Text in the colour of its severity.
void drawSeverityText(Severity severity, const std::string& words);
void messageList(Messages& messages, bool& open);
void toast(Messages& messages, double now_s, const FreeArea& free);
void buildProgress(const std::optional<engine::BuildProgress>& building, const FreeArea& free, UiOutput& output);
void hint(std::string_view words, const FreeArea& free);
void editingFrame(const FreeArea& free);
/// Round the whole picture while the emergency stop is latched, with the button that releases it.
void stopBanner(const FreeArea& free, UiOutput& output);
/// Along the upper edge as long as --unsafe-stiffness holds; `notes` of servo::safetyNotes.
void unsafeBanner(std::span<const std::string> notes, const FreeArea& free);
/// One line per finger: the limiter's present effect on the force of a held one.
void interventionNotice(std::span<const std::string> lines, const FreeArea& free);
/// A ruler's result, next to its second end; before that, an instruction.
void rulerNotice(const Ruler& ruler, const FreeArea& free);

}  // namespace palpate::viewer
