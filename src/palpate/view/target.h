// A framebuffer to draw a picture into, and the way back to memory.
#pragma once

#include "palpate/view/gl_objects.h"
#include "palpate/view/image.h"

namespace palpate::view {

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

}  // namespace palpate::view
