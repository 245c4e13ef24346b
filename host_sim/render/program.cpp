#include "render/program.h"

#include <array>
#include <stdexcept>
#include <string_view>

namespace host {

std::string_view shaderSource(std::string_view path);  // made by cmake/embed.cmake

namespace {

std::string joined(std::initializer_list<const char*> files, const std::vector<std::string>& defines) {
  std::string text = "#version 450 core\n";
  for (const std::string& name : defines) text += "#define " + name + "\n";
  for (const char* file : files) {
    const std::string_view source = shaderSource(file);
    if (source.empty()) throw std::runtime_error(std::string("no shader ") + file);
    text += "#line 1\n" + std::string(source);
  }
  return text;
}

GLuint compile(const GladGLContext& gl, GLenum stage, const std::string& text, const char* file) {
  const GLuint shader = gl.CreateShader(stage);
  const char* source = text.c_str();
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::array<char, 4000> log{};
  gl.GetShaderInfoLog(shader, log.size(), nullptr, log.data());
  gl.DeleteShader(shader);
  throw std::runtime_error(std::string("shader ") + file + ": " + log.data());
}

}  // namespace

Program::Program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
                 std::initializer_list<const char*> fragment, const std::vector<std::string>& defines)
    : gl_(gl) {
  const char* name = *(fragment.end() - 1);
  const GLuint first = compile(gl, GL_VERTEX_SHADER, joined(vertex, defines), name);
  const GLuint second = compile(gl, GL_FRAGMENT_SHADER, joined(fragment, defines), name);
  program_ = gl.CreateProgram();
  for (GLuint shader : {first, second}) {
    gl.AttachShader(program_, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program_);
  GLint linked = 0;
  gl.GetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (!linked) {
    std::array<char, 4000> log{};
    gl.GetProgramInfoLog(program_, log.size(), nullptr, log.data());
    gl.DeleteProgram(program_);
    throw std::runtime_error(std::string("shader ") + name + ": " + log.data());
  }
  GLint count = 0;
  gl.GetProgramiv(program_, GL_ACTIVE_UNIFORMS, &count);
  for (GLint i = 0; i < count; ++i) {
    std::array<char, 128> text{};
    GLint size = 0;
    GLenum type = 0;
    gl.GetActiveUniform(program_, static_cast<GLuint>(i), text.size(), nullptr, &size, &type, text.data());
    std::string found = text.data();
    if (const auto bracket = found.find('['); bracket != std::string::npos) found.resize(bracket);
    locations_[found] = gl.GetUniformLocation(program_, text.data());
  }
}

Program::~Program() { gl_.DeleteProgram(program_); }

GLint Program::location(const char* name) const {
  const auto found = locations_.find(name);
  return found == locations_.end() ? -1 : found->second;
}

void Program::set(const char* name, float value) const {
  gl_.ProgramUniform1f(program_, location(name), value);
}
void Program::set(const char* name, int value) const {
  gl_.ProgramUniform1i(program_, location(name), value);
}
void Program::set(const char* name, glm::vec2 value) const {
  gl_.ProgramUniform2fv(program_, location(name), 1, &value[0]);
}
void Program::set(const char* name, glm::vec3 value) const {
  gl_.ProgramUniform3fv(program_, location(name), 1, &value[0]);
}
void Program::set(const char* name, glm::vec4 value) const {
  gl_.ProgramUniform4fv(program_, location(name), 1, &value[0]);
}
void Program::set(const char* name, const glm::mat4& value) const {
  gl_.ProgramUniformMatrix4fv(program_, location(name), 1, GL_FALSE, &value[0][0]);
}

}  // namespace host
