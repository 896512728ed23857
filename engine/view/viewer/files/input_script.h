// Input scripts: a user's input as a file that repeats it. Test, demonstration and bug report in one.
//
//   # time s, event, its values
//   0.5, move, 640, 400            pixels from the upper left
//   0.6, down, left                down | up: left, right, middle; modifiers follow: ctrl, shift
//   0.9, scroll, -3                notches, away from the user is positive; shift may follow
//   1.2, key, F12                  pressed and released; names as on the F1 page, e.g. Ctrl+S, PgDn
//   1.3, text, hello
//   1.5, focus, lost               lost | gained
//   2.0, drop, some/file.obj       relative to the script
//   2.5, size, 800, 600
//   2.8, head, 120, 40, 550        the eyes: mm to the right of the screen's middle, above it, before it
//   3.0, close
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "palpate/window/input.h"

namespace palpate::viewer {

struct ScriptEvent {
  enum class Kind : std::uint8_t { input, size, close, head };
  Kind kind = Kind::input;
  window::InputEvent input;
  int width = 0;  ///< size
  int height = 0;
  double time_s = 0.0;
  Vec3 head_mm = Vec3::Zero();  ///< head: where the eyes are (Viewer::headAt)
};

/// Throws Error naming file and line: an unknown event, key or number, times that go back.
std::vector<ScriptEvent> parseInputScript(std::string_view text, std::string_view file);
std::vector<ScriptEvent> readInputScript(const std::filesystem::path& file);

}  // namespace palpate::viewer
