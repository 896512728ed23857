// Panels over the picture: a Dear ImGui context that gets InputEvents and is drawn into any framebuffer.
//
// It does not depend on the window, so panels can be used and pictured without one. Everything is measured in points; a
// point has as many pixels as the screen's content scale times the user's factor.
//
//   begin (events, size) ─► the caller's ImGui calls ─► end ─► present (once for each eye)
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "palpate/window/input.h"

struct ImFont;

namespace palpate::window {

enum class Theme : std::uint8_t { dark, light, contrast };
inline constexpr std::array<std::string_view, 3> kThemeNames = {"dark", "light", "high contrast"};

/// Letters of equal width, for code; in the current context of ImGui.
ImFont* evenFont();

/// Belongs to the thread of the GL context that is current when it is made.
class Gui {
 public:
  /// Throws Error when OpenGL's functions cannot be loaded.
  Gui();
  ~Gui();

  /// Begins a pass with the events of one of guiPasses. A new scale (pixels per point) makes the letters again.
  void begin(const Vec2& size_points, double scale, double elapsed_s, std::span<const InputEvent> events);
  void end();
  /// Whether a window of the frame is drawn, by its name.
  using Choice = bool (*)(std::string_view window);
  /// Draws the panels into the bound framebuffer, stretched to its pixels: all, or those chosen.
  void present(int width, int height, Choice choice = nullptr) const;
  /// Whether that choice leaves out anything of the last frame.
  bool leavesOut(Choice choice) const;

  void setTheme(Theme theme);
  /// From the next frame on there is a second size of letters, for titles: the last font of ImGui's atlas.
  void useLargeLetters();
  /// Whether, in the last frame, a panel, menu or popup was under the cursor or held the mouse.
  bool wantsMouse() const;
  /// Whether a text field has the keys.
  bool wantsText() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace palpate::window
