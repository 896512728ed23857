// OpenGL objects that delete themselves. Everything here needs a current context of version 3.3 core (offscreen.h,
// window.h) and belongs to the thread that has it.
#pragma once

#include <epoxy/gl.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "palpate/base/vec.h"
#include "palpate/view/image.h"

namespace palpate::view {

/// Owns one name of a kind of GL object.
template <class Kind>
class GlName {
 public:
  GlName() : name_(Kind::make()) {}
  ~GlName() {
    if (name_ != 0) Kind::destroy(name_);
  }
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GLuint get() const { return name_; }

 private:
  GLuint name_;
};

/// Kinds whose names OpenGL makes and deletes many at a time.
template <auto& kGenerate, auto& kDelete>
struct GeneratedKind {
  static GLuint make() {
    GLuint name = 0;
    kGenerate(1, &name);
    return name;
  }
  static void destroy(GLuint name) { kDelete(1, &name); }
};
struct ProgramKind {
  static GLuint make() { return glCreateProgram(); }
  static void destroy(GLuint name) { glDeleteProgram(name); }
};

using GlBuffer = GlName<GeneratedKind<glGenBuffers, glDeleteBuffers>>;
using GlVertexArray = GlName<GeneratedKind<glGenVertexArrays, glDeleteVertexArrays>>;
using GlTexture = GlName<GeneratedKind<glGenTextures, glDeleteTextures>>;
using GlFramebuffer = GlName<GeneratedKind<glGenFramebuffers, glDeleteFramebuffers>>;

/// Binds a buffer and gives it these values for good.
template <class T>
void fillBuffer(GLenum kind, GLuint buffer, std::span<const T> values, GLenum usage = GL_STATIC_DRAW) {
  glBindBuffer(kind, buffer);
  glBufferData(kind, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), usage);
}

/// Binds a texture and uploads this picture, with mipmaps for where it is shown small.
void fillTexture(GLuint texture, const Image& image, GLint format, GLint beyond_its_edge);

/// Offsets into a bound buffer are passed to OpenGL as if they were pointers.
inline const void* bufferOffset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr): that is OpenGL's interface
}

/// From now on the bound vertex array reads a location out of the bound buffer, `size` numbers per vertex; bytes are
/// shares of 255, shorts of 32767. A stride of 0 means numbers without gaps.
inline void attributeAt(GLuint location, GLint size, GLenum type, std::size_t stride = 0, std::size_t offset = 0) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, type, type == GL_UNSIGNED_BYTE || type == GL_SHORT ? GL_TRUE : GL_FALSE,
                        static_cast<GLsizei>(stride), bufferOffset(offset));
}

/// Shaders, compiled and linked: vertex, fragment and, when it is not empty, geometry. Throws Error with the compiler's
/// message.
class Program {
 public:
  /// `name` identifies it in messages; `#version 330 core` and `shared` are put before every source.
  Program(std::string_view name, std::string_view shared, std::string_view vertex, std::string_view fragment,
          std::string_view geometry = {});

  void use() const { glUseProgram(program_.get()); }
  /// Uniforms of the program in use; a name that the compiler optimised away is ignored.
  void set(const char* name, int value) const { glUniform1i(location(name), value); }
  void set(const char* name, float value) const { glUniform1f(location(name), value); }
  void set(const char* name, const Eigen::Vector2f& v) const { glUniform2fv(location(name), 1, v.data()); }
  void set(const char* name, const Vec3f& v) const { glUniform3fv(location(name), 1, v.data()); }
  void set(const char* name, const Eigen::Vector4f& v) const { glUniform4fv(location(name), 1, v.data()); }
  void set(const char* name, std::span<const float> values) const {
    glUniform1fv(location(name), static_cast<GLsizei>(values.size()), values.data());
  }
  void set(const char* name, std::span<const Vec3f> values) const {
    if (!values.empty()) glUniform3fv(location(name), static_cast<GLsizei>(values.size()), values.front().data());
  }
  void set(const char* name, std::span<const Eigen::Vector4f> values) const {
    if (!values.empty()) glUniform4fv(location(name), static_cast<GLsizei>(values.size()), values.front().data());
  }
  void set(const char* name, const Eigen::Matrix3f& m) const {
    glUniformMatrix3fv(location(name), 1, GL_FALSE, m.data());
  }
  void set(const char* name, const Eigen::Matrix4f& m) const {
    glUniformMatrix4fv(location(name), 1, GL_FALSE, m.data());
  }

 private:
  GLint location(const char* name) const { return glGetUniformLocation(program_.get(), name); }
  GlName<ProgramKind> program_;
};

/// Makes transparent things blend over the rest. The picture itself stays opaque: some desktops would show through.
inline void blendOver() { glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA); }

/// The driver's text, GL_VERSION for instance; empty without one.
inline std::string glString(GLenum name) {
  const auto* words = reinterpret_cast<const char*>(glGetString(name));
  return words == nullptr ? "" : words;
}

/// Version the current context offers as major * 10 + minor.
inline int contextVersion() { return epoxy_gl_version(); }
inline constexpr int kNeededVersion = 33;

}  // namespace palpate::view
