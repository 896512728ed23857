// Where pictures are drawn without a window or a display: an OpenGL context (EGL on no surface at all), a framebuffer
// to draw into, and the way back to memory. For pictures, tests and servers; the window draws into the same targets.
//
//   OffscreenContext (once a thread) ─► Target::bind ─► Renderer or Painter ─► Target::read ─► Image
//
// No OpenGL header is needed to include this one: an embedding program draws with it and picture.h alone.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "palpate/view/image.h"

namespace palpate::view {

/// Core is what the renderer draws with; compatibility also has the pipeline of OpenGL 2.1 (immediate_drawing.h).
enum class Profile : std::uint8_t { core, compatibility };

class OffscreenContext {
 public:
  /// Makes the context current on the calling thread. Throws Error saying what is missing, or which version of OpenGL
  /// was found and which is needed.
  explicit OffscreenContext(Profile profile = Profile::core);
  ~OffscreenContext();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

/// The number by which OpenGL knows a framebuffer or a texture (its GLuint).
using GlId = std::uint32_t;

/// A framebuffer: colour (8 bits, sRGB values) and depth. Belongs to the thread of the context that is current when it
/// is made.
class Target {
 public:
  /// Throws Error for less than one pixel, and for more than this machine's OpenGL takes.
  Target(int width, int height);
  ~Target();

  void bind() const;  ///< and sets the viewport
  int width() const { return width_; }
  int height() const { return height_; }
  GlId texture() const;
  GlId framebuffer() const;
  Image read() const;
  void clear() const;  ///< black, and bound
  /// Copies a smaller one into this one, its lower left corner at these pixels from the left and from below.
  void put(const Target& part, int left, int below);

 private:
  struct Objects;
  int width_;
  int height_;
  std::unique_ptr<Objects> objects_;
};

/// Returns when all that was asked of the current context has been drawn: for measuring, never needed for a picture.
void waitUntilDrawn();

/// Who draws in the current context, short enough for a folder's name: "llvmpipe-22" for Mesa 22's renderer of that
/// name. Pictures of different ones differ in single pixels.
std::string rendererName();
/// The same in the driver's own words, for reports.
std::string rendererWords();

// A picture on the graphics card as it is, for panels to show: no light falls on it.

/// Needs a current context, of whose thread it is.
class FlatPicture {
 public:
  explicit FlatPicture(const Image& image);
  ~FlatPicture();
  FlatPicture(FlatPicture&&) noexcept;
  FlatPicture& operator=(FlatPicture&&) noexcept;

  GlId texture() const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace palpate::view
