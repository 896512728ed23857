#include "palpate/view/target.h"

#include "palpate/base/error.h"

namespace palpate::view {

namespace {

void makeTexture(GLuint texture, GLint format, GLenum layout, GLenum type, int width, int height) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

Target::Target(int width, int height) : width_(width), height_(height) {
  if (width < 1 || height < 1) throw Error("a picture needs at least one pixel");
  makeTexture(colour_.get(), GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  makeTexture(depth_.get(), GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.get(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.get(), 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error("the picture is too large for this machine's OpenGL");
  }
}

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, width_, height_);
}

Image Target::read() const {
  Image image(width_, height_);
  Image upside_down(width_, height_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upside_down.pixels.data());
  for (int y = 0; y < height_; ++y) {
    const auto* row = &upside_down.at(0, height_ - 1 - y);
    std::copy(row, row + width_, &image.at(0, y));
  }
  return image;
}

}  // namespace palpate::view
