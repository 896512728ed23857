// Draws pictures without a window or a display: an OpenGL context (EGL on no surface at all), a framebuffer to draw
// into, and the way back to memory. For pictures, tests and servers; the window draws into the same targets.
//
//   OffscreenContext (once per thread) ─► Target::bind ─► Renderer or Painter ─► Target::read ─► Image
//
// No OpenGL header is needed to include this one: an embedding program draws with it and picture.h alone.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "palpate/view/image.h"

namespace palpate::view {

/// Core is for the renderer; compatibility also has the pipeline of OpenGL 2.1 (immediate_drawing.h).
enum class Profile : std::uint8_t { core, compatibility };

class OffscreenContext {
 public:
  /// Makes the context current on the calling thread. Throws Error with the missing part, or the found and the needed
  /// version of OpenGL.
  explicit OffscreenContext(Profile profile = Profile::core);
  ~OffscreenContext();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

/// OpenGL's name of a framebuffer or a texture (its GLuint).
using GlId = std::uint32_t;

/// A framebuffer: colour (8 bits, sRGB values) and depth. Belongs to the thread of the context that is current when it
/// is made.
class Target {
 public:
  /// Throws Error for less than one pixel, and for more than this machine's OpenGL allows.
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

/// Returns when the current context has drawn everything: for measuring, never needed for a picture.
void waitUntilDrawn();

/// The renderer of the current context, short enough for a folder's name: "llvmpipe-22" for Mesa 22's renderer of that
/// name. Pictures of different ones differ in single pixels.
std::string rendererName();
/// The same as the driver spells it, for reports.
std::string rendererString();

// An unlit picture on the graphics card, for panels to show.

/// Needs a current context, to whose thread it belongs.
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
