// A window on the desktop: the source of input events and the screen for finished pictures. It draws nothing itself:
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
  int width = 1280;  ///< size of the window, screen coordinates
  int height = 800;
  int x = -1;  ///< place on the desktop; negative or off every monitor: the system chooses
  int y = -1;
  bool full_screen = false;
  bool quad_buffer = false;     ///< try for a picture per eye (shutter glasses); see quadBuffered
  bool wait_for_screen = true;  ///< present at most once per refresh
};

/// Belongs to the thread that made it, which must be the main thread; its context is current there.
class Window {
 public:
  /// Throws Error: no display (and the remedy), or the found and the needed version of OpenGL.
  explicit Window(const WindowSettings& settings);
  ~Window();

  /// Events since the last call, in order. Waits at most `wait_s` for one.
  std::vector<InputEvent> events(double wait_s = 0.0);
  /// Puts events that were not used back to the front of the next events().
  void handBack(std::span<const InputEvent> events);

  /// Shows the target, stretched if the window has another size now.
  void present(const view::Target& target);

  int width() const;  ///< pixels
  int height() const;
  double contentScale() const;  ///< pixels per point; within [1, 3] whatever the system reports
  bool closing() const;
  void stayOpen();  ///< cancels a request to close
  void setTitle(const std::string& title);
  bool focused() const;
  bool fullScreen() const;
  void setFullScreen(bool on);
  /// Whether it has a picture for each eye: draw into its framebuffer 0 (StereoMode::quad_buffer), then `swap`.
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

/// Whether there is a display to open a window on, judging by the environment.
bool displayOffered();

}  // namespace palpate::window
