#include "overlay/imgui_gl.h"

#include <imgui.h>

#include <cstddef>
#include <cstdint>

namespace host {
namespace {

constexpr GLenum kIndexType = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;

}  // namespace

ImguiGl::ImguiGl(const Context& context)
    : gl_(context.gl()), program_(gl_, {"overlay.vert"}, {"overlay.frag"}) {
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  makeLetters();
  makeVertexArray();
}

ImguiGl::~ImguiGl() {
  gl_.DeleteTextures(1, &letters_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
  gl_.DeleteBuffers(1, &vertices_);
  gl_.DeleteBuffers(1, &indices_);
}

void ImguiGl::makeLetters() {
  unsigned char* alpha = nullptr;
  int width_px = 0, height_px = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&alpha, &width_px, &height_px);
  gl_.CreateTextures(GL_TEXTURE_2D, 1, &letters_);
  gl_.TextureStorage2D(letters_, 1, GL_R8, width_px, height_px);
  gl_.TextureParameteri(letters_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TextureParameteri(letters_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl_.TextureSubImage2D(letters_, 0, 0, 0, width_px, height_px, GL_RED, GL_UNSIGNED_BYTE, alpha);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void ImguiGl::makeVertexArray() {
  gl_.CreateBuffers(1, &vertices_);
  gl_.CreateBuffers(1, &indices_);
  gl_.CreateVertexArrays(1, &vertex_array_);
  gl_.VertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(ImDrawVert));
  gl_.VertexArrayElementBuffer(vertex_array_, indices_);
  gl_.VertexArrayAttribFormat(vertex_array_, 0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
  gl_.VertexArrayAttribFormat(vertex_array_, 1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
  gl_.VertexArrayAttribFormat(vertex_array_, 2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
  for (GLuint i = 0; i < 3; ++i) {
    gl_.EnableVertexArrayAttrib(vertex_array_, i);
    gl_.VertexArrayAttribBinding(vertex_array_, i, 0);
  }
}

void ImguiGl::draw(const ImDrawData& data, GLuint framebuffer) {
  const glm::vec2 size_px(data.DisplaySize.x, data.DisplaySize.y);
  if (size_px.x < 1.0F || size_px.y < 1.0F) return;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.Viewport(0, 0, static_cast<GLsizei>(size_px.x), static_cast<GLsizei>(size_px.y));
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_BLEND);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  program_.use();
  program_.set("u_size_px", size_px);
  gl_.BindTextureUnit(0, letters_);
  gl_.BindVertexArray(vertex_array_);
  for (int i = 0; i < data.CmdListsCount; ++i) drawList(*data.CmdLists[i], size_px);
  gl_.BindVertexArray(0);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
}

void ImguiGl::drawList(const ImDrawList& list, glm::vec2 size_px) {
  gl_.NamedBufferData(vertices_, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
  gl_.NamedBufferData(indices_, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data, GL_STREAM_DRAW);
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const glm::vec2 from = glm::max(glm::vec2(command.ClipRect.x, command.ClipRect.y), glm::vec2(0.0F));
    const glm::vec2 to = glm::min(glm::vec2(command.ClipRect.z, command.ClipRect.w), size_px);
    if (to.x <= from.x || to.y <= from.y || command.ElemCount == 0) continue;
    const glm::ivec2 corner(glm::vec2(from.x, size_px.y - to.y)), extent(to - from);
    gl_.Scissor(corner.x, corner.y, extent.x, extent.y);
    const auto offset = std::uintptr_t{command.IdxOffset} * sizeof(ImDrawIdx);
    gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), kIndexType,
                               reinterpret_cast<const void*>(offset), static_cast<GLint>(command.VtxOffset));
  }
}

}  // namespace host
