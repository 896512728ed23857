// A window on the desktop: where input events come from and where a finished picture goes. It draws nothing itself:
// everything is drawn into a Target, as without a window, and presented; so both show the same pixels.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "palpate/view/offscreen.h"
#include "palpate/window/input.h"

namespace palpate::window {

struct WindowSettings {
  std::string title = "Palpate";
  int width = 1280;  ///< of the window, screen coordinates
  int height = 800;
  int x = -1;  ///< place on the desktop; negative or off every monitor: the system chooses
  int y = -1;
  bool full_screen = false;
  bool quad_buffer = false;     ///< try for a picture an eye (shutter glasses); see quadBuffered
  bool wait_for_screen = true;  ///< present at most once a refresh
};

/// Belongs to the thread that made it, which must be the main thread; its context is current there.
class Window {
 public:
  /// Throws Error: no display (and what to do instead), or which OpenGL was found and which is needed.
  explicit Window(const WindowSettings& settings);
  ~Window();

  /// What happened since the last call, in order. Waits at most `wait_s` for something to happen.
  std::vector<InputEvent> events(double wait_s = 0.0);
  /// These come first in the next events(): nobody could use them yet.
  void handBack(std::span<const InputEvent> events);

  /// Shows the target, stretched should its size no longer be the window's.
  void present(const view::Target& target);

  int width() const;  ///< pixels
  int height() const;
  double contentScale() const;  ///< pixels of a point; within [1, 3] whatever the system says
  bool closing() const;
  void stayOpen();  ///< in spite of what was asked for: it is not closing any more
  void setTitle(const std::string& title);
  bool focused() const;
  bool fullScreen() const;
  void setFullScreen(bool on);
  /// It has a picture for each eye: draw into its framebuffer 0 (StereoMode::quad_buffer), then `swap`.
  bool quadBuffered() const;
  void swap();
  void showCursor(bool shown);
  void setSize(int width, int height);
  void setClipboard(const std::string& text);
  std::string clipboard() const;
  WindowSettings placement() const;  ///< to be remembered
  int top() const;                   ///< row of the monitor its picture begins at (interlaced stereo)

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether there is a display to open a window on, as far as the environment tells.
bool displayOffered();

}  // namespace palpate::window
