// Everything that is shown and changed while the window is open, as five documents of plain data.
//
// Keys, menus and panels edit it and note their changes (state/requests.h); the viewer (viewer.h) handles the notes
// once a frame. A panel gets only the parts that it shows (panels/panels.h).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpate/device/device.h"
#include "palpate/engine/world_builder.h"
#include "palpate/scene/scene.h"
#include "palpate/view/camera.h"
#include "view/viewer/state/devices_shown.h"
#include "view/viewer/state/edit_history.h"
#include "view/viewer/state/editor.h"
#include "view/viewer/state/replay.h"
#include "view/viewer/state/requests.h"
#include "view/viewer/state/ruler.h"
#include "view/viewer/state/sample_history.h"
#include "view/viewer/state/scene_document.h"
#include "view/viewer/state/vertex_values.h"
#include "view/viewer/state/view_state.h"
#include "view/viewer/state/viewer_parts.h"

namespace palpate::viewer {

/// The scene that is edited, its file, and the world that is built from it.
struct EditedScene {
  scene::Scene scene;  ///< the present world may lag behind
  Editor editor;       ///< dysfunctions
  LumpEditor lump_editor;
  ChangeHistory history;
  ProfileEdit profile;
  SceneDocument document;  ///< target of saving; without a file: a fresh name (files/outputs.h)
  WorldFacts world;
  std::optional<engine::BuildProgress> building;
  bool opening = false;  ///< another scene is being opened: changes meanwhile are not steps

  /// Whether something is edited on the body: the left button places and moves.
  bool editing() const { return editor.active || lump_editor.active; }
  /// Whether an editing gesture is in progress.
  bool editingNow() const { return editor.before.has_value() || lump_editor.before.has_value(); }
  LumpEdit lumps(UiOutput& output) { return {scene.lumps, lump_editor, output, world.landmarks}; }
  DysfunctionEdit dysfunctions(UiOutput& output) { return {scene.dysfunctions, editor, output, world.landmarks}; }
};

/// The user's choices, the camera, and what the picture shows: the fingers, the ruler, a vertex.
struct BodyView {
  ViewState state;
  view::Camera camera;
  OpenedLook opened;                   ///< base for changes of the look
  Vec2 size_points = Vec2(1280, 800);  ///< size of the window
  std::size_t active_finger = 0;
  std::array<contact::FingerOutput, 2> fingers;
  std::array<bool, 2> finger_present{};
  Ruler ruler;
  std::optional<VertexReading> reading;  ///< the vertex clicked last
  bool vertex_panel_open = false;
  bool mark_vertex = true;  ///< marks it with a cross, while the vertex's panel is open
  SeenHead head;
  bool quad_buffer_offered = false;  ///< the window has a picture for each eye
  bool simple_shading = false;       ///< drawn smooth for now, overriding state.look
  Performance performance;
};

/// Who holds the fingers, and the limits of their forces.
struct FingerHolders {
  std::string held_by = "mouse";           ///< as text
  std::vector<device::Capabilities> held;  ///< devices that hold fingers; empty: all are the mouse's
  DevicesShown devices;
  double ticks_per_s = 1000.0;  ///< the servo's: those of the scene that the window began with
  double device_limit_n = 3.3;
};

/// Past touches, shown in place of the present or as plots.
struct PastTouches {
  Replay replay;
  Plots plots;
  double time_speed = 1.0;           ///< for automatic playback
  std::string beside_at_first = {};  ///< a recording to show next to the first one that is replayed

  void plot(const trace::Sample& sample, double device_limit_n) {
    plots.fingers[sample.finger].add(sample, device_limit_n);
  }
};

/// Exchange between window and user: requests, messages, dialogs, files that are being written.
struct Conversation {
  double now_s = 0.0;
  UiOutput output;
  Messages messages;
  std::optional<Question> question;  ///< blocks everything else until it has an answer
  int hint = 0;                      ///< number of hints followed
  PlaceSearch place_search;
  std::string place_words = {};  ///< place of the active finger: "T6, 12 mm right"
  ManualShown manual;
  Recording recording;
  std::filesystem::path output_folder;  ///< absolute: for files without a place of their own
  ClassShown class_shown;
  Activities activities = {};            ///< Palpate's, for the start page
  std::optional<Activity> awaited = {};  ///< opens when it is built

  void request(Request request) { output.request(std::move(request)); }
  void ask(Question asked) { question = std::move(asked); }
  void report(Severity severity, const std::string& text) { messages.add(severity, text, now_s); }
};

/// All of it: for those who distribute the five documents. Everything else gets the documents that it needs.
struct ViewerState : EditedScene, BodyView, FingerHolders, PastTouches, Conversation {};

}  // namespace palpate::viewer
