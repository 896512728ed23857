// EGL on Mesa's platform without surfaces, else on the default display; no surface is ever made.
#include <epoxy/egl.h>
#include <fmt/format.h>

#include "palpate/base/error.h"
#include "palpate/base/system/library.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/offscreen.h"

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

/// epoxy ends the program where it cannot load this library: it is missing, or memory has run out. Never closed, since
/// epoxy keeps it open too.
void requireEgl() {
  const system::OpenedLibrary egl = system::openLibrary("libEGL.so.1");
  if (egl.handle != nullptr) return;
  throw Error(fmt::format("cannot draw: {} (on Debian: apt install libegl1 libgl1-mesa-dri)", egl.words));
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

/// The version of an old driver, for the message: a context of any version.
std::string offeredGlVersion(EGLDisplay display) {
  const EGLint any[] = {EGL_NONE};
  const EGLContext context = madeContext(display, any);
  if (context == EGL_NO_CONTEXT) return "none";
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  std::string version = glString(GL_VERSION);
  if (version.empty()) version = "unknown";
  eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display, context);
  return version;
}

}  // namespace

OffscreenContext::OffscreenContext(Profile profile) : handles_(std::make_unique<Handles>()) {
  requireEgl();
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
    throw Error(fmt::format("cannot draw: needs OpenGL 3.3, found {}", offeredGlVersion(handles_->display)));
  }
  eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context);
}

OffscreenContext::~OffscreenContext() = default;

}  // namespace palpate::view
