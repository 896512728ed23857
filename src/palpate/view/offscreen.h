// An OpenGL context without a window or a display: EGL on no surface at all. For pictures, tests and servers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace palpate::view {

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
