// Plays a script's events at their times, as if a hand made them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "palpate/window/window.h"
#include "view/viewer/files/input_script.h"
#include "view/viewer/viewer.h"

namespace palpate::app {

class Playback {
 public:
  /// An empty name plays nothing. Throws Error.
  explicit Playback(const std::string& file);

  bool finished() const { return next_ == script_.size(); }

  /// True when the script ends the window. A `close` with events after it is the window's own button, which may ask.
  bool play(double now_s, window::Window& window, viewer::Viewer& viewer, std::vector<window::InputEvent>& events);

 private:
  std::vector<viewer::ScriptEvent> script_;
  std::size_t next_ = 0;
};

/// Turns events into pictures until the script, the viewer, a signal or this many frames (0: no end) stop it. `shown`
/// gets each picture's number, from 1, and its time.
void showFrames(window::Window& window, viewer::Viewer& viewer, Playback& playback, std::uint64_t frames,
                const std::function<void(std::uint64_t frame, double now_s)>& shown);

/// Services of this window for a viewer; the window must outlive it.
viewer::ViewerHost makeViewerHost(window::Window& window);

/// Opens the named devices for the first fingers, with their spaces placed by the scene or by default. Throws Error.
std::vector<viewer::OpenedDevice> openedFor(const scene::World& world, const std::vector<std::string>& names);

}  // namespace palpate::app
