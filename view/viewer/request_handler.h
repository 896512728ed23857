// Handles requests of panels, keys and menus that only the viewer can do: each goes to the modes, then waits for an
// answer if something would be lost, then to its part of the viewer.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "view/viewer/camera_control.h"
#include "view/viewer/class_run.h"
#include "view/viewer/devices/device_control.h"
#include "view/viewer/files/file_preview.h"
#include "view/viewer/files/outputs.h"
#include "view/viewer/files/recording_keeper.h"
#include "view/viewer/files/turned_mesh.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/replay_player.h"
#include "view/viewer/state/async_task.h"
#include "view/viewer/state/viewer_state.h"
#include "view/viewer/world/world_swap.h"

namespace palpate::viewer {

// Services of a window for the viewer; members may be empty.

struct ViewerHost {
  std::function<void()> toggle_full_screen;
  std::function<void(const std::string&)> set_clipboard;
  std::function<std::string()> clipboard;
  std::function<void(bool)> show_cursor;
  std::function<void(const std::string&)> set_title;
  /// Whether framebuffer 0 has a picture for each eye; the viewer then draws quad-buffer stereo into it (drawsItself).
  bool quad_buffer = false;
  /// Palpate's activities besides this window, called while the start page is shown; empty: none.
  std::function<Activities()> activities = {};
  /// Makes the program for the activity open once this window is closed.
  std::function<void(Activity)> give_way = {};
  /// program for classes; empty: not installed
  std::filesystem::path teach_program = {};
};

/// Parts of the viewer for requests; all must outlive the handler.
struct RequestParts {
  ViewerState& viewer;
  WorldSwap& world_swap;
  DeviceControl& devices;
  RecordingKeeper& keeper;
  Outputs& outputs;
  ReplayPlayer& replay;
  CameraControl& camera;
  ClassRun& class_run;
  const Modes& modes;
  const ViewerHost& host;
  const scene::Scene& default_scene;  ///< for Reload without a file
  const std::shared_ptr<const scene::World>& world;
};

class RequestHandler {
 public:
  explicit RequestHandler(const RequestParts& parts) : parts_(parts) {}
  void handle(const Request& request);
  /// Once a frame: handles the findings about a file to open.
  void advance();
  /// Whether the window was asked to close, and nothing is in the way.
  bool quits() const { return quits_; }

 private:
  // Without further questions.
  void fulfil(const OpenFile& request);
  void fulfil(const OpenBeside& request);
  void fulfil(const OpenPreset& request);
  void fulfil(const Reload& request);
  void fulfil(const CancelBuild& request);
  void fulfil(const SaveScene& request);
  void fulfil(const CopyScene& request);
  void fulfil(const ResetScene& request);
  void fulfil(const Undo& request);
  void fulfil(const Redo& request);
  void fulfil(const UseProfile& request);
  void fulfil(const AnswerQuestion& request);
  void fulfil(const TakeScreenshot& request);
  void fulfil(const TakeClearScreenshot& request);
  void fulfil(const ToggleSequence& request);
  void fulfil(const PlayScript& request);
  void fulfil(const SavePlots& request);
  void fulfil(const ToggleForces& request);
  void fulfil(const KeepRecording& request);
  void fulfil(const SetMark& request);
  void fulfil(const GoHome& request);
  void fulfil(const GoToPlace& request);
  void fulfil(const SetView& request);
  void fulfil(const ToggleFullScreen& request);
  void fulfil(const CopyView& request);
  void fulfil(const PasteView& request);
  void fulfil(const OpenDevice& request);
  void fulfil(const CloseDevice& request);
  void fulfil(const FindDevices& request);
  void fulfil(const StopDevices& request);
  void fulfil(const ReleaseStop& request);
  void fulfil(const Quit& request);
  void fulfil(const GiveWay& request);
  void fulfil(const StartFilm& request);
  void fulfil(const StopFilm& request);
  void fulfil(const ShowClass& request);
  void fulfil(const StartClass& request);
  void fulfil(const WatchClass& request);
  void fulfil(const JoinClass& request);
  void fulfil(const EndClass& request);
  void saveThen(const SaveScene& request, const std::optional<Request>& then);

  void lookAtSides();
  void askForUnit(OpenFile request, const std::optional<double>& longest_units);

  RequestParts parts_;
  bool quits_ = false;
  std::optional<OpenFile> to_look_at_;  ///< a mesh of unknown unit
  OpenFile looked_at_;
  AsyncTask<FilePreview> look_;
  const scene::Body* looked_at_body_ = nullptr;  ///< the question about its side was asked; only compared
  AsyncTask<mesh::TurnOver> sides_;
  mesh::TurnOver turn_over_ = mesh::TurnOver::none;  ///< if the answer is yes
  AsyncTask<std::filesystem::path> turning_;
};

// Questions before an action that would lose something.

/// Whether the request loses changes and the user was not asked; then the viewer's state has the question, with the
/// waiting request.
bool needsConfirmation(const Request& request, ViewerState& viewer);

/// The key's answer to the viewer's question, or empty.
std::string_view answerOf(window::Key key, const ViewerState& viewer);

/// The window's title: the open file, and a star for unsaved changes.
std::string titleOf(const ViewerState& viewer);

}  // namespace palpate::viewer
