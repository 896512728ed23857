#include "palpate/view/gl_objects.h"

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

Program::Program(std::string_view name, std::string_view shared, std::string_view vertex, std::string_view fragment) {
  const GLuint vertex_shader = compiled(GL_VERTEX_SHADER, name, shared, vertex);
  const GLuint fragment_shader = compiled(GL_FRAGMENT_SHADER, name, shared, fragment);
  glAttachShader(program_.get(), vertex_shader);
  glAttachShader(program_.get(), fragment_shader);
  glLinkProgram(program_.get());
  glDeleteShader(vertex_shader);
  glDeleteShader(fragment_shader);
  GLint good = 0;
  glGetProgramiv(program_.get(), GL_LINK_STATUS, &good);
  if (good != GL_TRUE) throw Error(fmt::format("shader '{}' does not link", name));
}

}  // namespace palpate::view
