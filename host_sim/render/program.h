// Shader programs from the texts in host_sim/shaders.
#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <string>
#include <unordered_map>
#include <vector>

#include "window/context.h"

namespace host {

/// A linked program with its uniforms by name. Setting one that the driver removed does nothing.
class Program {
 public:
  /// `vertex` and `fragment` are files' names, each a list that is joined; `defines` are names. Throws
  /// std::runtime_error with the driver's words.
  Program(const GladGLContext& gl, std::initializer_list<const char*> vertex,
          std::initializer_list<const char*> fragment, const std::vector<std::string>& defines = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { gl_.UseProgram(program_); }
  void set(const char* name, float value) const;
  void set(const char* name, int value) const;
  void set(const char* name, glm::vec2 value) const;
  void set(const char* name, glm::vec3 value) const;
  void set(const char* name, glm::vec4 value) const;
  void set(const char* name, const glm::mat4& value) const;
  GLint location(const char* name) const;
  GLuint name() const { return program_; }

 private:
  const GladGLContext& gl_;
  GLuint program_ = 0;
  std::unordered_map<std::string, GLint> locations_;
};

}  // namespace host
