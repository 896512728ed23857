// An OpenGL context without a window or a display: EGL on no surface at all. For pictures, tests and servers.
#pragma once

#include <memory>

namespace palpate::view {

class OffscreenContext {
 public:
  /// Makes the context current on the calling thread. Throws Error saying what is missing, or which version of OpenGL
  /// was found and which is needed.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace palpate::view
