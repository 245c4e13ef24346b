// Draws Dear ImGui's lists with OpenGL 4.5.
#pragma once

#include <glm/vec2.hpp>

#include "render/program.h"
#include "window/context.h"

struct ImDrawData;
struct ImDrawList;

namespace host {

class ImguiGl {
 public:
  // Makes the letters' texture: an ImGui context must be current, its fonts added.
  explicit ImguiGl(const Context& context);
  ~ImguiGl();
  ImguiGl(const ImguiGl&) = delete;
  ImguiGl& operator=(const ImguiGl&) = delete;

  // Over what `framebuffer` holds. Leaves blending and scissor off.
  void draw(const ImDrawData& data, GLuint framebuffer);

 private:
  void makeLetters();
  void makeVertexArray();
  void drawList(const ImDrawList& list, glm::vec2 size_px);

  const GladGLContext& gl_;
  Program program_;
  GLuint letters_ = 0, vertex_array_ = 0, vertices_ = 0, indices_ = 0;
};

}  // namespace host
