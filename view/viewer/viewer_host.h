// What only a window can do for the viewer; members may be empty.
#pragma once

#include <functional>
#include <string>

namespace palpate::viewer {

struct ViewerHost {
  std::function<void()> toggle_full_screen;
  std::function<void(const std::string&)> set_clipboard;
  std::function<std::string()> clipboard;
  std::function<void(bool)> show_cursor;
  std::function<void(const std::string&)> set_title;
  /// Framebuffer 0 has a picture for each eye; the viewer then draws quad-buffer stereo into it (drawsItself).
  bool quad_buffer = false;
};

}  // namespace palpate::viewer
