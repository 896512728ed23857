// A viewer without a window: events in, frames out, and the numbers a user would see. Waits for the servo thread by
// looking, never by sleeping a fixed time.
#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "palpate/base/stopwatch.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/scene_file.h"
#include "palpate/view/offscreen.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"
#include "view/viewer/panels/widgets.h"
#include "view/viewer/viewer.h"

namespace palpate::viewer {

inline constexpr int kStageWidth = 1280;
inline constexpr int kStageHeight = 800;

/// A gently waved sheet of 200 mm, seen from its front.
inline scene::Scene sheetScene(const support::TemporaryFolder& folder) {
  const auto file = folder / "sheet.ply";
  if (!std::filesystem::exists(file)) mesh::save(file, zoo::wavyGrid(40, 200.0, 3.0));
  scene::Scene scene = scene::parse("[[finger]]\nname = \"a\"\nscript = [{ do = \"lift\" }]\n", "stage.toml");
  scene.file.clear();
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = file;
  return scene;
}

/// The cursor is moved there, and the left button goes down or up.
inline void addButton(std::vector<window::InputEvent>& events, const Vec2& at, bool down) {
  window::InputEvent event;
  event.kind = window::InputEvent::Kind::move;
  event.at = at;
  events.push_back(event);
  event.kind = window::InputEvent::Kind::button;
  event.down = down;
  events.push_back(event);
}

class Stage {
 public:
  explicit Stage(ViewState state = quiet()) : Stage(std::move(state), {}) {}
  /// With a mode of another product.
  explicit Stage(std::unique_ptr<Mode> mode) : Stage(quiet(), {}, false, std::move(mode)) {}
  /// On another body than the sheet.
  explicit Stage(const scene::Scene& scene) : Stage(quiet(), {}, false, nullptr, &scene) {}
  /// `records`: recordings by themselves, into the folder `recordings`.
  Stage(ViewState state, ViewerHost host, bool records = false, std::unique_ptr<Mode> mode = nullptr,
        const scene::Scene* scene = nullptr) {
    ViewerSettings settings;
    settings.intro = false;
    settings.output_folder = folder.path();
    if (records) settings.recording_folder = folder / "sessions";
    settings.default_scene = sheetScene(folder);
    if (mode) settings.modes.push_back(std::move(mode));
    viewer = std::make_unique<Viewer>(scene::build(scene != nullptr ? *scene : sheetScene(folder)), std::move(state),
                                      std::move(settings), std::move(host));
    frame();
  }

  /// Plain and quick to draw.
  static ViewState quiet() {
    ViewState state;
    state.look.shading = view::Shading::gouraud;
    state.look.finger = view::FingerShape::finger;  // not by how fast this machine draws
    state.hints = false;
    state.reduced_motion = true;
    return state;
  }

  void frame(const std::vector<window::InputEvent>& events = {}) { frameOf(kStageWidth, kStageHeight, events); }
  /// In the smallest window that panels are made for.
  void smallFrame() { frameOf(640, 480, {}); }
  /// Draws the next frame and reads it.
  view::Image picture() {
    const bool before = std::exchange(draws, true);
    frame();
    draws = before;
    return viewer->target().read();
  }
  /// Frames until it is so, for at most so many seconds. With pauses: drawn as fast as it goes, they would leave
  /// little of the processor to what is waited for.
  template <class Ready>
  bool until(const Ready& ready, int patience_s = 60) {
    const auto end = Clock::now() + std::chrono::seconds(patience_s);
    while (!ready()) {
      if (Clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      frame();
    }
    return true;
  }

  void move(const Vec2& to) {
    at_ = to;
    frame({event(window::InputEvent::Kind::move)});
  }
  void button(bool down, window::Button which = window::Button::left) {
    window::InputEvent e = event(window::InputEvent::Kind::button);
    e.button = which;
    e.down = down;
    frame({e});
  }
  void scroll(double notches) {
    window::InputEvent e = event(window::InputEvent::Kind::scroll);
    e.notches = notches;
    frame({e});
  }
  void key(window::Key k, window::Modifiers modifiers = {}) {
    window::InputEvent e = event(window::InputEvent::Kind::key);
    e.key = k;
    e.modifiers = modifiers;
    e.down = true;
    frame({e});
    e.down = false;
    frame({e});
  }
  void drop(const std::filesystem::path& file) {
    window::InputEvent e = event(window::InputEvent::Kind::drop);
    e.text = file.string();
    frame({e});
  }
  void loseFocus() { frame({event(window::InputEvent::Kind::focus)}); }

  /// A click on a control by its name, as one would with a mouse: there, down, up.
  void click(const std::string& widget) {
    frame();
    const auto place = widgetPlaces().find(widget);
    ASSERT_NE(place, widgetPlaces().end()) << "no control '" << widget << "' on the screen";
    const auto& [left, top, right, below] = place->second;
    move(Vec2(0.5 * (left + right), 0.5 * (top + below)));
    button(true);
    button(false);
    frame();
  }
  /// The middle of what the panels leave free: over the sheet.
  Vec2 middle() const { return {790.0, 350.0}; }

  ViewerState& state() { return viewer->state(); }
  const contact::FingerOutput& finger(std::size_t i = 0) { return state().fingers[i]; }
  std::string lastMessage() {
    return state().messages.all().empty() ? std::string() : state().messages.all().back().text;
  }

  const support::TemporaryFolder folder;
  const view::OffscreenContext context;
  std::unique_ptr<Viewer> viewer;
  double now_s = 0.0;
  /// Whether frames become pixels. Without a graphics card these cost most of a test, and few tests look at them: those
  /// that save a picture or a film set it, the others call picture().
  bool draws = false;

 private:
  void frameOf(int width, int height, const std::vector<window::InputEvent>& events) {
    if (!draws) glEnable(GL_RASTERIZER_DISCARD);
    viewer->frame(width, height, 1.0, now_s += 1.0 / 60.0, events);
    glDisable(GL_RASTERIZER_DISCARD);
  }
  window::InputEvent event(window::InputEvent::Kind kind) const {
    window::InputEvent e;
    e.kind = kind;
    e.at = at_;
    e.time_s = now_s;
    return e;
  }
  Vec2 at_ = Vec2::Zero();
};

}  // namespace palpate::viewer
