// A program compiles and links on construction; the compiler's message goes into the Error.
#include "palpate/view/layers/gl_objects.h"

#include <fmt/format.h>

#include "palpate/base/error.h"

namespace palpate::view {

namespace {

GLuint compiled(GLenum stage, std::string_view name, std::string_view shared, std::string_view source) {
  const GLuint shader = glCreateShader(stage);
  const std::string text = fmt::format("#version 330 core\n{}{}", shared, source);
  const char* lines = text.c_str();
  glShaderSource(shader, 1, &lines, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  glDeleteShader(shader);
  throw Error(fmt::format("shader '{}' does not compile: {}", name, log));
}

}  // namespace

void fillTexture(GLuint texture, const Image& image, GLint format, GLint beyond_its_edge) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, format, image.width, image.height, 0, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, beyond_its_edge);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, beyond_its_edge);
}

Program::Program(std::string_view name, std::string_view shared, std::string_view vertex, std::string_view fragment,
                 std::string_view geometry) {
  const auto attach = [&](GLenum stage, std::string_view source) {
    const GLuint shader = compiled(stage, name, shared, source);
    glAttachShader(program_.get(), shader);
    glDeleteShader(shader);  // lives as long as the program
  };
  attach(GL_VERTEX_SHADER, vertex);
  attach(GL_FRAGMENT_SHADER, fragment);
  if (!geometry.empty()) attach(GL_GEOMETRY_SHADER, geometry);
  glLinkProgram(program_.get());
  GLint good = 0;
  glGetProgramiv(program_.get(), GL_LINK_STATUS, &good);
  if (good != GL_TRUE) throw Error(fmt::format("shader '{}' does not link", name));
}

}  // namespace palpate::view
