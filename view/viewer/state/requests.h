// How a panel asks for what it cannot do itself: requests, actions as of a key, words for the user, and notes of what
// it changed in the scene. Plain data; what draws the panels reads it afterwards.
//
//   panel ─► UiOutput ─► drawGui: actions, words ─► RequestHandler, consequences of changes, once a frame
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

/// What a change of the scene has consequences for; bits.
enum Consequence : std::uint32_t {
  kNothing = 0,
  kFingerChange = 1,  ///< the servo's settings
  kMapChange = 2,     ///< what lies on the body: maps, laws, forms of the deformation
  kBodyChange = 4,    ///< the body itself
};
/// Of a key of this table of the scene file.
std::uint32_t consequenceOf(std::string_view table);

// What only the viewer can do. `sure`: whatever may be thrown away or overwritten.

/// A scene, a mesh, a recording or a table of forces.
struct OpenFile {
  std::string file = {};
  bool sure = false;
  std::optional<scene::Unit> unit = {};  ///< of a mesh file that says none; default: asked about where it is doubtful
};
/// A recording, beside the one that is shown.
struct OpenBeside {
  std::string file = {};
};
/// A scene of scene/presets.h.
struct OpenPreset {
  std::string name = {};
  bool sure = false;
};
/// What was opened, once more.
struct Reload {
  bool sure = false;
};
struct CancelBuild {};
/// The scene, to the file or where it came from.
struct SaveScene {
  std::string file = {};
  bool sure = false;
};
/// What is seen and felt now goes to the clipboard, as the text of a scene.
struct CopyScene {};
/// Everything as it was opened or saved.
struct ResetScene {};
struct Undo {};
struct Redo {};
/// The drawn curve is written to a file that the scene names.
struct UseProfile {};
/// To the recording's question.
struct AnswerQuestion {
  std::string answer = {};
};
struct TakeScreenshot {
  bool with_pop_ups = false;  ///< with what lies over the picture for a moment
  std::string file = {};      ///< empty: a fresh name
};
/// The body alone, the rest transparent.
struct TakeClearScreenshot {};
/// A series of PNG files: start or stop.
struct ToggleSequence {};
/// What the window shows, from now on, as a film; its ending says which kind.
struct StartFilm {
  std::string file = {};
};
struct StopFilm {};
/// The scene's own fingers, or an end of them.
struct PlayScript {};
struct SavePlots {};
/// A table of forces: start or stop.
struct ToggleForces {};
struct KeepRecording {};
/// In the recording, with these words.
struct SetMark {
  std::string words = {};
};
struct GoHome {};
/// To a named place, close by; the finger hovers over it.
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
  std::string words = {};  ///< as for --device
};
struct CloseDevice {
  std::size_t finger = 0;
};
/// Which back ends are here, and why not.
struct FindDevices {};
/// The emergency stop.
struct StopDevices {};
struct ReleaseStop {};
struct Quit {
  bool sure = false;
};
/// The window closes, and that of the program which holds the activity opens.
struct GiveWay {
  Activity activity = Activity::training;
  bool sure = false;
};
/// The dialog of a class.
struct ShowClass {};
/// Makes the folder where there is none, runs the class's broker and collector, and opens the teacher's view.
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
/// All of it ends in order.
struct EndClass {};

using Request =
    std::variant<OpenFile, OpenBeside, OpenPreset, Reload, CancelBuild, SaveScene, CopyScene, ResetScene, Undo, Redo,
                 UseProfile, AnswerQuestion, TakeScreenshot, TakeClearScreenshot, ToggleSequence, PlayScript, SavePlots,
                 ToggleForces, KeepRecording, SetMark, GoHome, GoToPlace, SetView, ToggleFullScreen, CopyView,
                 PasteView, OpenDevice, CloseDevice, FindDevices, StopDevices, ReleaseStop, Quit, GiveWay, StartFilm,
                 StopFilm, ShowClass, StartClass, WatchClass, JoinClass, EndClass>;

/// The same once the user has been asked.
inline Request madeSure(Request request) {
  std::visit(
      [](auto& asked) {
        if constexpr (requires { asked.sure; }) asked.sure = true;
      },
      request);
  return request;
}

/// What is asked before something would be lost; what was requested waits in it.
struct Question {
  enum class Kind : std::uint8_t {
    leave,      ///< changes would be thrown away
    overwrite,  ///< a file would be that is not known here
    turn,       ///< of a mesh that shows its back: turned over, or as it is
    unit,       ///< of a mesh file, before it is opened: as guessed, millimetres, not at all
    of_mode,    ///< a mode asks, and gets the answer (mode.h)
    end_class,  ///< the class would end with the window
    devices,    ///< of a scene, before they are opened: the mouse stays, open, not at all
  };
  Kind kind = Kind::leave;
  std::string words = {};
  /// As the buttons say them; the first is what Enter means, the last what Esc means.
  std::vector<std::string> answers = {toTranslate("Save"), toTranslate("Discard"), toTranslate("Stay")};
  std::string file = {};             ///< overwrite: which
  std::optional<Request> then = {};  ///< what is done after the answer
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
  std::string step;  ///< what the change of this frame is called when it is taken back; empty: by what it changed

  void request(Request request) { requests.push_back(std::move(request)); }
  void act(window::Action action) { actions.push_back(action); }
  void tell(Severity severity, std::string text) { words.push_back({severity, std::move(text)}); }
};

}  // namespace palpate::viewer
