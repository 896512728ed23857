// EGL on Mesa's platform without surfaces, else on the default display; no surface is ever made, so drawing goes to
// framebuffers only. OpenGL counts rows from below: reading turns them over.
#include "palpate/view/offscreen.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/view/layers/gl_objects.h"

namespace palpate::view {

struct OffscreenContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
  }
};

namespace {

/// Empty where the driver says nothing.
std::string glWords(GLenum name) {
  const auto* words = reinterpret_cast<const char*>(glGetString(name));
  return words == nullptr ? "" : words;
}

EGLDisplay surfacelessDisplay() {
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  return display != EGL_NO_DISPLAY ? display : eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

EGLContext madeContext(EGLDisplay display, const EGLint* attributes) {
  const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, config_attributes, &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

/// What an old driver offers, for the message: a context of any version.
std::string versionOffered(EGLDisplay display) {
  const EGLint any[] = {EGL_NONE};
  const EGLContext context = madeContext(display, any);
  if (context == EGL_NO_CONTEXT) return "none";
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  std::string version = glWords(GL_VERSION);
  if (version.empty()) version = "unknown";
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, context);
  return version;
}

}  // namespace

OffscreenContext::OffscreenContext(Profile profile) : handles_(std::make_unique<Handles>()) {
  handles_->display = surfacelessDisplay();
  if (handles_->display == EGL_NO_DISPLAY || !eglInitialize(handles_->display, nullptr, nullptr)) {
    handles_->display = EGL_NO_DISPLAY;
    throw Error("cannot draw: EGL finds no device (on Debian: apt install libegl1 libgl1-mesa-dri)");
  }
  eglBindAPI(EGL_OPENGL_API);
  const EGLint wanted[] = {
      EGL_CONTEXT_MAJOR_VERSION,
      kNeededVersion / 10,
      EGL_CONTEXT_MINOR_VERSION,
      kNeededVersion % 10,
      EGL_CONTEXT_OPENGL_PROFILE_MASK,
      profile == Profile::core ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
      EGL_NONE};
  handles_->context = madeContext(handles_->display, wanted);
  if (handles_->context == EGL_NO_CONTEXT) {
    throw Error(fmt::format("cannot draw: needs OpenGL 3.3, found {}", versionOffered(handles_->display)));
  }
  eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context);
}

OffscreenContext::~OffscreenContext() = default;

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

std::string rendererWords() { return glWords(GL_RENDERER); }

std::string rendererName() {
  const std::string renderer = rendererWords();
  const std::string version = glWords(GL_VERSION);
  constexpr std::string_view kMesa = "Mesa ";
  const std::size_t mesa = version.find(kMesa);
  const std::string number = mesa == std::string::npos ? version : version.substr(mesa + kMesa.size());
  return renderer.substr(0, renderer.find(' ')) + "-" + number.substr(0, number.find('.'));
}

}  // namespace palpate::view
