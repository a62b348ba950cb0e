#include "gl/program.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace manzana::gl {
namespace {

const char* extension(GLenum stage) {
  return stage == GL_VERTEX_SHADER ? ".vert: " : stage == GL_FRAGMENT_SHADER ? ".frag: " : ".comp: ";
}

Shader compile(std::string_view name, GLenum stage, const Pieces& pieces) {
  Shader shader(glCreateShader(stage));
  std::vector<const GLchar*> texts;
  std::vector<GLint> lengths;
  for (const std::string_view piece : pieces) {
    texts.push_back(piece.data());
    lengths.push_back(static_cast<GLint>(piece.size()));
  }
  glShaderSource(shader.name(), static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
  glCompileShader(shader.name());
  GLint ok = 0, length = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
  if (ok != 0) return shader;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length) + 1, '\0');
  glGetShaderInfoLog(shader.name(), length + 1, nullptr, log.data());
  throw std::runtime_error("shader " + std::string(name) + extension(stage) + log);
}

Program link(std::string_view name, std::initializer_list<const Shader*> shaders) {
  Program program(glCreateProgram());
  for (const Shader* shader : shaders) glAttachShader(program.name(), shader->name());
  glLinkProgram(program.name());
  for (const Shader* shader : shaders) glDetachShader(program.name(), shader->name());
  GLint ok = 0, length = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  if (ok != 0) return program;
  glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length) + 1, '\0');
  glGetProgramInfoLog(program.name(), length + 1, nullptr, log.data());
  throw std::runtime_error("program " + std::string(name) + ": " + log);
}

}  // namespace

Program make_program(std::string_view name, const Pieces& vertex, const Pieces& fragment) {
  const Shader vertex_shader = compile(name, GL_VERTEX_SHADER, vertex);
  const Shader fragment_shader = compile(name, GL_FRAGMENT_SHADER, fragment);
  return link(name, {&vertex_shader, &fragment_shader});
}

Program make_compute_program(std::string_view name, const Pieces& pieces) {
  const Shader shader = compile(name, GL_COMPUTE_SHADER, pieces);
  return link(name, {&shader});
}

}  // namespace manzana::gl
