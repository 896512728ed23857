// GLFW's callbacks fill a list of events with the time, place and modifiers of the moment; in pixels, not GLFW's screen
// coordinates. A finished picture is copied by one blit, so the window needs no depth buffer.
// Data flow: GLFW -> events -> input.h; Target -> here -> screen. Main thread.
#include "palpate/window/window.h"

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdlib>

#include "palpate/base/error.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/view/layers/gl_objects.h"

namespace palpate::window {

namespace {

constexpr const char* kWithoutAWindow = "`palpate render` makes pictures and `palpate simulate` palpates without one";

// The table of keys relies on GLFW's numbers.
static_assert(static_cast<int>(Key::escape) == GLFW_KEY_ESCAPE && static_cast<int>(Key::up) == GLFW_KEY_UP);
static_assert(static_cast<int>(Key::page_down) == GLFW_KEY_PAGE_DOWN && static_cast<int>(Key::f1) == GLFW_KEY_F1);
static_assert(static_cast<int>(Key::pause) == GLFW_KEY_PAUSE);
static_assert(static_cast<int>(Key::f12) == GLFW_KEY_F12 && static_cast<int>(Key::pad_1) == GLFW_KEY_KP_1);
static_assert(static_cast<int>(Key::pad_enter) == GLFW_KEY_KP_ENTER && static_cast<int>(Key::end) == GLFW_KEY_END);
static_assert(static_cast<int>(Key::left_bracket) == GLFW_KEY_LEFT_BRACKET && static_cast<int>(key('A')) == GLFW_KEY_A);

Modifiers toModifiers(int mods) { return {(mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0}; }

/// The available OpenGL when the needed one is refused: a second try without a version.
std::string offeredVersion() {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  GLFWwindow* probe = glfwCreateWindow(16, 16, "palpate", nullptr, nullptr);
  if (probe == nullptr) return "no OpenGL at all";
  glfwMakeContextCurrent(probe);
  const auto* words = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  std::string version = words == nullptr ? "an OpenGL that reports no version" : fmt::format("OpenGL {}", words);
  glfwMakeContextCurrent(nullptr);
  glfwDestroyWindow(probe);
  return version;
}

bool onAnyMonitor(int x, int y) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
    glfwGetMonitorWorkarea(monitors[i], &left, &top, &width, &height);
    if (x >= left && x < left + width && y >= top && y < top + height) return true;
  }
  return false;
}

}  // namespace

struct Window::Impl {
  GLFWwindow* window = nullptr;
  std::vector<InputEvent> events;
  Modifiers modifiers;
  /// At the time of the current event; GLFW would report the present place, several events later.
  Vec2 cursor = Vec2::Zero();
  int windowed_x = 0;
  int windowed_y = 0;
  int windowed_width = 1280;
  int windowed_height = 800;

  ~Impl() {
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }

  static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }

  InputEvent& add(InputEvent::Kind kind) {
    InputEvent& event = events.emplace_back();
    event.kind = kind;
    event.time_s = glfwGetTime();
    event.at = toPixels(cursor);
    event.modifiers = modifiers;
    return event;
  }
  /// From GLFW's screen coordinates to pixels of the picture.
  Vec2 toPixels(const Vec2& place) const {
    int width = 0;
    int height = 0;
    int pixels_x = 0;
    int pixels_y = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixels_x, &pixels_y);
    return {place.x() * pixels_x / std::max(1, width), place.y() * pixels_y / std::max(1, height)};
  }

  void create(const WindowSettings& settings);
  void listen();
  void listenToPointer();
  void listenToKeys();
  void listenToDesktop();
};

void Window::Impl::create(const WindowSettings& settings) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the picture is made elsewhere
  const auto open = [&](bool quad_buffer) {
    glfwWindowHint(GLFW_STEREO, quad_buffer ? GLFW_TRUE : GLFW_FALSE);
    window = glfwCreateWindow(settings.width, settings.height, settings.title.c_str(), nullptr, nullptr);
  };
  if (settings.quad_buffer) open(true);
  if (window == nullptr) open(false);
  if (window == nullptr) {
    throw Error(fmt::format("the window needs OpenGL 3.3 and found {}; {}", offeredVersion(), kWithoutAWindow));
  }
  glfwMakeContextCurrent(window);
  if (view::contextVersion() < view::kNeededVersion) {
    throw Error(fmt::format("the window needs OpenGL 3.3 and found {}.{}; {}", view::contextVersion() / 10,
                            view::contextVersion() % 10, kWithoutAWindow));
  }
  if (settings.x >= 0 && settings.y >= 0 && onAnyMonitor(settings.x, settings.y)) {
    glfwSetWindowPos(window, settings.x, settings.y);
  }
  glfwSwapInterval(settings.wait_for_screen ? 1 : 0);
}

void Window::Impl::listen() {
  glfwSetWindowUserPointer(window, this);
  listenToPointer();
  listenToKeys();
  listenToDesktop();
}

void Window::Impl::listenToPointer() {
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    of(w).cursor = Vec2(x, y);
    of(w).add(InputEvent::Kind::move);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    of(w).modifiers = toModifiers(mods);
    InputEvent& event = of(w).add(InputEvent::Kind::button);
    event.button = static_cast<Button>(button);  // left, right, middle in both
    event.down = action == GLFW_PRESS;
  });
  // Touch pads send both axes; only the vertical one is used.
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    // Some systems turn Shift and the wheel into a horizontal scroll.
    const double notches = y == 0.0 && of(w).modifiers.shift ? x : y;
    if (notches != 0.0) of(w).add(InputEvent::Kind::scroll).notches = notches;
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    if (entered == GLFW_FALSE) of(w).add(InputEvent::Kind::leave);
  });
}

void Window::Impl::listenToKeys() {
  glfwSetKeyCallback(window, [](GLFWwindow* w, int k, int, int action, int mods) {
    Impl& handles = of(w);
    handles.modifiers = toModifiers(mods);
    // The event of a modifier key has the state before it.
    const bool down = action != GLFW_RELEASE;
    if (k == GLFW_KEY_LEFT_SHIFT || k == GLFW_KEY_RIGHT_SHIFT) handles.modifiers.shift = down;
    if (k == GLFW_KEY_LEFT_CONTROL || k == GLFW_KEY_RIGHT_CONTROL) handles.modifiers.ctrl = down;
    if (k < 0) return;
    InputEvent& event = handles.add(InputEvent::Kind::key);
    event.key = static_cast<Key>(k);
    event.down = down;
    event.repeat = action == GLFW_REPEAT;
  });
  glfwSetCharCallback(
      window, [](GLFWwindow* w, unsigned int code) { appendLetter(of(w).add(InputEvent::Kind::text).text, code); });
}

void Window::Impl::listenToDesktop() {
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    of(w).modifiers = {};
    of(w).add(InputEvent::Kind::focus).down = focused == GLFW_TRUE;
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) of(w).add(InputEvent::Kind::drop).text = paths[i];
  });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int width, int height) {
    of(w).add(InputEvent::Kind::resize).at = Vec2(width, height);
  });
}

Window::Window(const WindowSettings& settings) : impl_(std::make_unique<Impl>()) {
  glfwSetErrorCallback([](int, const char*) {});  // failures are reported by return values
  if (!displayOffered() || glfwInit() != GLFW_TRUE) {
    throw Error(fmt::format("there is no display to open a window on; {}", kWithoutAWindow));
  }
  impl_->create(settings);
  impl_->listen();
  if (settings.full_screen) setFullScreen(true);
}
Window::~Window() = default;

void Window::handBack(std::span<const InputEvent> events) {
  impl_->events.insert(impl_->events.begin(), events.begin(), events.end());
}

std::vector<InputEvent> Window::events(double wait_s) {
  if (wait_s > 0.0) {
    glfwWaitEventsTimeout(wait_s);
  } else {
    glfwPollEvents();
  }
  return std::exchange(impl_->events, {});
}

void Window::present(const view::Target& target) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, target.width(), target.height(), 0, 0, width(), height(), GL_COLOR_BUFFER_BIT,
                    target.width() == width() && target.height() == height() ? GL_NEAREST : GL_LINEAR);
  swap();
}

bool Window::quadBuffered() const {
  GLboolean offered = GL_FALSE;
  glGetBooleanv(GL_STEREO, &offered);
  return offered == GL_TRUE;
}

void Window::swap() { glfwSwapBuffers(impl_->window); }

void Window::showCursor(bool shown) {
  glfwSetInputMode(impl_->window, GLFW_CURSOR, shown ? GLFW_CURSOR_NORMAL : GLFW_CURSOR_HIDDEN);
}

int Window::width() const {
  int width = 0;
  glfwGetFramebufferSize(impl_->window, &width, nullptr);
  return width;
}
int Window::height() const {
  int height = 0;
  glfwGetFramebufferSize(impl_->window, nullptr, &height);
  return height;
}

double Window::contentScale() const {
  float scale = 1.0f;
  glfwGetWindowContentScale(impl_->window, &scale, nullptr);
  return std::clamp(static_cast<double>(scale), 1.0, 3.0);
}

bool Window::closing() const { return glfwWindowShouldClose(impl_->window) == GLFW_TRUE; }
void Window::stayOpen() { glfwSetWindowShouldClose(impl_->window, GLFW_FALSE); }
void Window::setTitle(const std::string& title) { glfwSetWindowTitle(impl_->window, title.c_str()); }
bool Window::focused() const { return glfwGetWindowAttrib(impl_->window, GLFW_FOCUSED) == GLFW_TRUE; }
bool Window::fullScreen() const { return glfwGetWindowMonitor(impl_->window) != nullptr; }

void Window::setFullScreen(bool on) {
  Impl& h = *impl_;
  if (on == fullScreen()) return;
  if (!on) {
    glfwSetWindowMonitor(h.window, nullptr, h.windowed_x, h.windowed_y, h.windowed_width, h.windowed_height, 0);
    return;
  }
  glfwGetWindowPos(h.window, &h.windowed_x, &h.windowed_y);
  glfwGetWindowSize(h.window, &h.windowed_width, &h.windowed_height);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
  if (mode != nullptr) glfwSetWindowMonitor(h.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::setSize(int width, int height) { glfwSetWindowSize(impl_->window, width, height); }
void Window::setClipboard(const std::string& text) { glfwSetClipboardString(impl_->window, text.c_str()); }

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(impl_->window);
  return text == nullptr ? std::string() : text;
}

WindowSettings Window::placement() const {
  WindowSettings settings;
  settings.full_screen = fullScreen();
  if (settings.full_screen) {
    settings.x = impl_->windowed_x;
    settings.y = impl_->windowed_y;
    settings.width = impl_->windowed_width;
    settings.height = impl_->windowed_height;
  } else {
    glfwGetWindowPos(impl_->window, &settings.x, &settings.y);
    glfwGetWindowSize(impl_->window, &settings.width, &settings.height);
  }
  return settings;
}

int Window::top() const {
  int y = 0;
  glfwGetWindowPos(impl_->window, nullptr, &y);
  return y;
}

bool displayOffered() {
  if (system::kIsWindows || system::kIsApple) return true;
  return !system::variable("DISPLAY").empty() || !system::variable("WAYLAND_DISPLAY").empty();
}

}  // namespace palpate::window
