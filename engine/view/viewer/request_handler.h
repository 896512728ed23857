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
#include "view/viewer/files/outputs.h"
#include "view/viewer/files/recording_keeper.h"
#include "view/viewer/modes/mode.h"
#include "view/viewer/replay_player.h"
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
  std::filesystem::path class_program = {};
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
  explicit RequestHandler(const RequestParts& parts);
  ~RequestHandler();
  void handle(const Request& request);
  /// Once a frame: handles the findings about a file to open.
  void advance();
  /// Whether the window was asked to close, and nothing is in the way.
  bool quits() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// Questions before an action that would lose something.

/// Whether the request loses changes and the user was not asked; then the question is put, with the waiting request.
bool needsConfirmation(const Request& request, const EditedScene& edited, Conversation& user);

/// The key's answer to the question, or empty.
std::string_view answerForKey(window::Key key, const std::optional<Question>& question);

/// The window's title: the open file, and a star for unsaved changes.
std::string titleOf(const EditedScene& edited);

}  // namespace palpate::viewer
