// Drawing goes to framebuffers only. OpenGL counts rows from below: reading turns them over.
#include "palpate/view/offscreen.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/view/layers/gl_objects.h"

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

struct Target::Objects {
  GlTexture colour, depth;
  GlFramebuffer framebuffer;
};

Target::Target(int width, int height) : width_(width), height_(height) {
  if (width < 1 || height < 1) throw Error("a picture needs at least one pixel");
  objects_ = std::make_unique<Objects>();
  makeTexture(texture(), GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  makeTexture(objects_->depth.get(), GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, objects_->depth.get(), 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error("the picture is too large for this machine's OpenGL");
  }
}

Target::~Target() = default;

GlId Target::texture() const { return objects_->colour.get(); }
GlId Target::framebuffer() const { return objects_->framebuffer.get(); }

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glViewport(0, 0, width_, height_);
}

void Target::clear() const {
  bind();
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
}

void Target::put(const Target& part, int left, int below) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, part.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer());
  glBlitFramebuffer(0, 0, part.width(), part.height(), left, below, left + part.width(), below + part.height(),
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image Target::read() const {
  Image image(width_, height_);
  Image upside_down(width_, height_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upside_down.pixels.data());
  for (int y = 0; y < height_; ++y) {
    const auto* row = &upside_down.at(0, height_ - 1 - y);
    std::copy(row, row + width_, &image.at(0, y));
  }
  return image;
}

void waitUntilDrawn() { glFinish(); }

std::string rendererString() { return glString(GL_RENDERER); }

std::string rendererName() {
  const std::string renderer = rendererString();
  const std::string version = glString(GL_VERSION);
  constexpr std::string_view kMesa = "Mesa ";
  const std::size_t mesa = version.find(kMesa);
  const std::string number = mesa == std::string::npos ? version : version.substr(mesa + kMesa.size());
  return renderer.substr(0, renderer.find(' ')) + "-" + number.substr(0, number.find('.'));
}

// Uploaded with the first row on top. At a change of picture.
struct FlatPicture::Objects {
  GlTexture picture;
};

FlatPicture::FlatPicture(const Image& image) : objects_(std::make_unique<Objects>()) {
  fillTexture(objects_->picture.get(), image, GL_RGB8, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
}

FlatPicture::~FlatPicture() = default;
FlatPicture::FlatPicture(FlatPicture&&) noexcept = default;
FlatPicture& FlatPicture::operator=(FlatPicture&&) noexcept = default;

GlId FlatPicture::texture() const { return objects_->picture.get(); }

}  // namespace palpate::view
