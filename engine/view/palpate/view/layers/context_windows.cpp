// A context of OpenGL needs a window there: a hidden one, of a class of our own.
#include <windows.h>
// After windows.h.
#include <epoxy/wgl.h>
#include <fmt/format.h>

#include <array>

#include "palpate/base/error.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/offscreen.h"

namespace palpate::view {

struct OffscreenContext::Handles {
  HWND window = nullptr;
  HDC device = nullptr;
  HGLRC context = nullptr;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    wglMakeCurrent(nullptr, nullptr);
    if (context != nullptr) wglDeleteContext(context);
    if (device != nullptr) ReleaseDC(window, device);
    if (window != nullptr) DestroyWindow(window);
  }
};

namespace {

constexpr const wchar_t* kClass = L"palpate-offscreen";

HWND hiddenWindow() {
  WNDCLASSW made{};
  made.style = CS_OWNDC;
  made.lpfnWndProc = DefWindowProcW;
  made.hInstance = GetModuleHandleW(nullptr);
  made.lpszClassName = kClass;
  RegisterClassW(&made);  // a second time it is there already
  return CreateWindowExW(0, kClass, L"", WS_OVERLAPPEDWINDOW, 0, 0, 16, 16, nullptr, nullptr, made.hInstance, nullptr);
}

bool choosePixels(HDC device) {
  PIXELFORMATDESCRIPTOR wanted{};
  wanted.nSize = sizeof(wanted);
  wanted.nVersion = 1;
  wanted.dwFlags = PFD_SUPPORT_OPENGL | PFD_DRAW_TO_WINDOW;
  wanted.iPixelType = PFD_TYPE_RGBA;
  wanted.cColorBits = 24;
  const int format = ChoosePixelFormat(device, &wanted);
  return format != 0 && SetPixelFormat(device, format, &wanted) != FALSE;
}

/// A context of the needed version; requested through an old one, which has to be current for that.
HGLRC createContext(HDC device, Profile profile) {
  const std::array<int, 7> wanted = {
      WGL_CONTEXT_MAJOR_VERSION_ARB,
      kNeededVersion / 10,
      WGL_CONTEXT_MINOR_VERSION_ARB,
      kNeededVersion % 10,
      WGL_CONTEXT_PROFILE_MASK_ARB,
      profile == Profile::core ? WGL_CONTEXT_CORE_PROFILE_BIT_ARB : WGL_CONTEXT_COMPATIBILITY_PROFILE_BIT_ARB,
      0};
  HGLRC old = wglCreateContext(device);
  if (old == nullptr || wglMakeCurrent(device, old) == FALSE) return nullptr;
  HGLRC context = epoxy_has_wgl_extension(device, "WGL_ARB_create_context_profile")
                      ? wglCreateContextAttribsARB(device, nullptr, wanted.data())
                      : nullptr;
  if (context == nullptr) {
    const std::string offered = glString(GL_VERSION);
    wglMakeCurrent(nullptr, nullptr);
    wglDeleteContext(old);
    throw Error(fmt::format("cannot draw: needs OpenGL 3.3, found {}", offered.empty() ? "none" : offered));
  }
  wglMakeCurrent(nullptr, nullptr);
  wglDeleteContext(old);
  return context;
}

}  // namespace

OffscreenContext::OffscreenContext(Profile profile) : handles_(std::make_unique<Handles>()) {
  handles_->window = hiddenWindow();
  if (handles_->window != nullptr) handles_->device = GetDC(handles_->window);
  if (handles_->device != nullptr && choosePixels(handles_->device)) {
    handles_->context = createContext(handles_->device, profile);
  }
  if (handles_->context == nullptr || wglMakeCurrent(handles_->device, handles_->context) == FALSE) {
    throw Error("cannot draw: Windows offers no OpenGL here; install the graphics card's driver");
  }
}

OffscreenContext::~OffscreenContext() = default;

}  // namespace palpate::view
