// An OpenGL context without a window or a display: EGL on no surface at all. For pictures, tests and servers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "palpate/view/image.h"
#include "palpate/view/layers/gl_objects.h"

namespace palpate::view {

// A framebuffer to draw a picture into, and the way back to memory.

/// Colour (8 bits, sRGB values) and depth.
class Target {
 public:
  Target(int width, int height);
  void bind() const;  ///< and sets the viewport
  int width() const { return width_; }
  int height() const { return height_; }
  GLuint texture() const { return colour_.get(); }
  GLuint framebuffer() const { return framebuffer_.get(); }
  Image read() const;

 private:
  int width_;
  int height_;
  GlTexture colour_;
  GlTexture depth_;
  GlFramebuffer framebuffer_;
};

/// Core is what the renderer draws with; compatibility also has the pipeline of OpenGL 2.1 (immediate_drawing.h).
enum class Profile : std::uint8_t { core, compatibility };

class OffscreenContext {
 public:
  /// Makes the context current on the calling thread. Throws Error saying what is missing, or which version of OpenGL
  /// was found and which is needed.
  explicit OffscreenContext(Profile profile = Profile::core);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

/// Who draws in the current context, short enough for a folder's name: "llvmpipe-22" for Mesa 22's renderer of that
/// name. Pictures of different ones differ in single pixels.
std::string rendererName();

}  // namespace palpate::view
