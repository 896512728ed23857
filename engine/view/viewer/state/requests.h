// Outputs of a panel: requests, actions as of a key, messages to the user, and notes of its changes to the scene. Plain
// data; the caller of the panels reads it afterwards.
//
//   panel ─► UiOutput ─► drawGui: actions, messages ─► RequestHandler, consequences of changes, once a frame
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/scene/scene.h"
#include "palpate/view/camera.h"
#include "palpate/window/keys.h"
#include "view/viewer/state/activities.h"
#include "view/viewer/state/messages.h"

namespace palpate::viewer {

/// Consequences of a change of the scene; bits.
enum Consequence : std::uint32_t {
  kNothing = 0,
  kFingerChange = 1,  ///< the servo's settings
  kMapChange = 2,     ///< things on the body: maps, laws, forms of the deformation
  kBodyChange = 4,    ///< the body itself
};
/// The consequences of a key of this table of the scene file.
std::uint32_t tableConsequences(std::string_view table);

// Actions that only the viewer can do. `sure`: losses and overwriting are accepted.

/// A scene, a mesh, a recording or a table of forces.
struct OpenFile {
  std::string file = {};
  bool sure = false;
  std::optional<scene::Unit> unit = {};  ///< for a mesh file without one; default: asked where it is doubtful
};
/// A recording, next to the one that is shown.
struct OpenBeside {
  std::string file = {};
};
/// A scene of scene/presets.h.
struct OpenPreset {
  std::string name = {};
  bool sure = false;
};
/// Opens the same again.
struct Reload {
  bool sure = false;
};
struct CancelBuild {};
/// Saves the scene to the file or its own.
struct SaveScene {
  std::string file = {};
  bool sure = false;
};
/// Copies the present state to the clipboard, as the text of a scene.
struct CopyScene {};
/// Restores the opened or saved state.
struct ResetScene {};
struct Undo {};
struct Redo {};
/// Writes the drawn curve to a file that the scene names.
struct UseProfile {};
/// The answer to the current question.
struct AnswerQuestion {
  std::string answer = {};
};
struct TakeScreenshot {
  bool with_pop_ups = false;  ///< with pop-ups over the picture
  std::string file = {};      ///< empty: a fresh name
};
/// The body alone, the rest transparent.
struct TakeClearScreenshot {};
/// A series of PNG files: start or stop.
struct ToggleSequence {};
/// Films the window from now on; the ending of the name chooses the format.
struct StartFilm {
  std::string file = {};
};
struct StopFilm {};
/// Starts or ends the scene's own fingers.
struct PlayScript {};
struct SavePlots {};
/// A table of forces: start or stop.
struct ToggleForces {};
struct KeepRecording {};
/// Sets a mark with this text in the recording.
struct SetMark {
  std::string words = {};
};
struct GoHome {};
/// Flies close to a named place; the finger hovers over it.
struct GoToPlace {
  std::string words = {};
};
struct SetView {
  view::StandardView side = view::StandardView::back;
};
struct ToggleFullScreen {};
struct CopyView {};
struct PasteView {};
struct OpenDevice {
  std::size_t finger = 0;
  std::string words = {};  ///< value of --device
};
struct CloseDevice {
  std::size_t finger = 0;
};
/// Searches for back ends.
struct FindDevices {};
/// The emergency stop.
struct StopDevices {};
struct ReleaseStop {};
struct Quit {
  bool sure = false;
};
/// Closes the window and opens that of the program for the activity.
struct GiveWay {
  Activity activity = Activity::training;
  bool sure = false;
};
/// The dialog of a class.
struct ShowClass {};
/// Makes the folder if missing, runs the class's broker and collector, and opens the teacher's view.
struct StartClass {
  std::string folder = {};
  std::string name = {};
  int stations = 1;
  std::string computer = {};  ///< name or address of this computer, as stations reach it
};
/// The teacher's view of a class, as a window of its own.
struct WatchClass {
  std::string folder = {};
};
/// The training of a station of a class, as a window of its own.
struct JoinClass {
  std::string folder = {};
};
/// Ends all of it properly.
struct EndClass {};

using Request =
    std::variant<OpenFile, OpenBeside, OpenPreset, Reload, CancelBuild, SaveScene, CopyScene, ResetScene, Undo, Redo,
                 UseProfile, AnswerQuestion, TakeScreenshot, TakeClearScreenshot, ToggleSequence, PlayScript, SavePlots,
                 ToggleForces, KeepRecording, SetMark, GoHome, GoToPlace, SetView, ToggleFullScreen, CopyView,
                 PasteView, OpenDevice, CloseDevice, FindDevices, StopDevices, ReleaseStop, Quit, GiveWay, StartFilm,
                 StopFilm, ShowClass, StartClass, WatchClass, JoinClass, EndClass>;

/// The same after the user's consent.
inline Request asConfirmed(Request request) {
  std::visit(
      [](auto& asked) {
        if constexpr (requires { asked.sure; }) asked.sure = true;
      },
      request);
  return request;
}

/// A question before a loss; the request waits in it.
struct Question {
  enum class Kind : std::uint8_t {
    leave,      ///< changes would be lost
    overwrite,  ///< an unknown file would be overwritten
    turn,       ///< for a mesh that shows its back: turned over, or unchanged
    unit,       ///< for a mesh file, before it is opened: as guessed, millimetres, not at all
    of_mode,    ///< a mode's own, which gets the answer (mode.h)
    end_class,  ///< the class would end with the window
    devices,    ///< for a scene, before they are opened: the mouse stays, open, not at all
  };
  Kind kind = Kind::leave;
  std::string words = {};
  /// Labels of the buttons; the first is Enter's, the last Esc's.
  std::vector<std::string> answers = {toTranslate("Save"), toTranslate("Discard"), toTranslate("Stay")};
  std::string file = {};             ///< for overwrite
  std::optional<Request> then = {};  ///< done after the answer
};

struct UiOutput {
  std::uint32_t changed = kNothing;  ///< Consequence bits of this frame
  std::vector<Request> requests;
  std::vector<window::Action> actions;  ///< done as if their keys had been pressed
  struct Words {
    Severity severity;
    std::string text;
  };
  std::vector<Words> words;
  std::string step;  ///< name of this frame's change for undo; empty: from its contents

  void request(Request request) { requests.push_back(std::move(request)); }
  void act(window::Action action) { actions.push_back(action); }
  void report(Severity severity, std::string text) { words.push_back({severity, std::move(text)}); }
};

}  // namespace palpate::viewer
