#include "gl/host_state.h"

#include "gl/asked.h"

namespace rg::gl {
namespace {

constexpr std::array<GLenum, TextureState::kKinds> kTextureKinds{GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY,
                                                                 GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP};
constexpr std::array<GLenum, TextureState::kKinds> kTextureBindings{
    GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_CUBE_MAP};

struct BufferTarget {
  GLenum target, binding;
};
constexpr std::array<BufferTarget, 8> kGenericBuffers{
    {{GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
     {GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING},
     {GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER_BINDING},
     {GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING},
     {GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING},
     {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING},
     {GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING},
     {GL_QUERY_BUFFER, GL_QUERY_BUFFER_BINDING}}};

template <size_t N>
void saveRanges(const GladGLContext& gl, std::array<BufferState::Range, N>& ranges, GLenum binding,
                GLenum start, GLenum size) {
  for (GLuint i = 0; i < N; ++i) {
    ranges[i].buffer = integer(gl, binding, i);
    gl.GetInteger64i_v(start, i, &ranges[i].offset);
    gl.GetInteger64i_v(size, i, &ranges[i].bytes);
  }
}

template <size_t N>
void restoreRanges(const GladGLContext& gl, const std::array<BufferState::Range, N>& ranges, GLenum target) {
  for (GLuint i = 0; i < N; ++i) {
    const BufferState::Range& range = ranges[i];
    if (range.buffer == 0 || range.bytes == 0) {  // size 0 means the whole buffer, whatever its size
      gl.BindBufferBase(target, i, asName(range.buffer));
    } else {
      gl.BindBufferRange(target, i, asName(range.buffer), static_cast<GLintptr>(range.offset),
                         static_cast<GLsizeiptr>(range.bytes));
    }
  }
}

}  // namespace

void ProgramState::save(const Context& context) { program = integer(context.gl, GL_CURRENT_PROGRAM); }

void ProgramState::restore(const Context& context) const { context.gl.UseProgram(asName(program)); }

void VertexState::save(const Context& context) {
  vertex_array = integer(context.gl, GL_VERTEX_ARRAY_BINDING);
  switches.save(context.gl, kVertexSwitches);
}

void VertexState::restore(const Context& context) const {
  context.gl.BindVertexArray(asName(vertex_array));
  switches.restore(context.gl, kVertexSwitches);
}

void BufferState::save(const Context& context) {
  const GladGLContext& gl = context.gl;
  for (size_t i = 0; i < generic.size(); ++i) generic[i] = integer(gl, kGenericBuffers[i].binding);
  saveRanges(gl, uniform, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE);
  saveRanges(gl, storage, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
             GL_SHADER_STORAGE_BUFFER_SIZE);
}

void BufferState::restore(const Context& context) const {
  const GladGLContext& gl = context.gl;
  restoreRanges(gl, uniform, GL_UNIFORM_BUFFER);
  restoreRanges(gl, storage, GL_SHADER_STORAGE_BUFFER);
  // After the indexed ones, which bind the generic ones too.
  for (size_t i = 0; i < generic.size(); ++i) gl.BindBuffer(kGenericBuffers[i].target, asName(generic[i]));
}

void TextureState::save(const Context& context) {
  const GladGLContext& gl = context.gl;
  active = integer(gl, GL_ACTIVE_TEXTURE);
  for (GLuint i = 0; i < units.size(); ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + i);
    for (size_t kind = 0; kind < kKinds; ++kind)
      units[i].textures[kind] = integer(gl, kTextureBindings[kind]);
    units[i].sampler = integer(gl, GL_SAMPLER_BINDING);
  }
  gl.ActiveTexture(asEnum(active));
  switches.save(gl, kTextureSwitches);
}

void TextureState::restore(const Context& context) const {
  const GladGLContext& gl = context.gl;
  for (GLuint i = 0; i < units.size(); ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + i);
    for (size_t kind = 0; kind < kKinds; ++kind)
      gl.BindTexture(kTextureKinds[kind], asName(units[i].textures[kind]));
    gl.BindSampler(i, asName(units[i].sampler));
  }
  gl.ActiveTexture(asEnum(active));
  switches.restore(gl, kTextureSwitches);
}

void ImageState::save(const Context& context) {
  const GladGLContext& gl = context.gl;
  for (GLuint i = 0; i < units.size(); ++i) {
    units[i] = {integer(gl, GL_IMAGE_BINDING_NAME, i),    integer(gl, GL_IMAGE_BINDING_LEVEL, i),
                integer(gl, GL_IMAGE_BINDING_LAYERED, i), integer(gl, GL_IMAGE_BINDING_LAYER, i),
                integer(gl, GL_IMAGE_BINDING_ACCESS, i),  integer(gl, GL_IMAGE_BINDING_FORMAT, i)};
  }
}

void ImageState::restore(const Context& context) const {
  for (GLuint i = 0; i < units.size(); ++i) {
    const Unit& unit = units[i];
    context.gl.BindImageTexture(i, asName(unit.texture), unit.level, unit.layered ? GL_TRUE : GL_FALSE,
                                unit.layer, asEnum(unit.access), asEnum(unit.format));
  }
}

void FramebufferState::save(const Context& context) {
  draw = integer(context.gl, GL_DRAW_FRAMEBUFFER_BINDING);
  read = integer(context.gl, GL_READ_FRAMEBUFFER_BINDING);
}

void FramebufferState::drawInto(const Context& context, GLuint framebuffer) {
  const GladGLContext& gl = context.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  if (framebuffer == 0 || drawn_into != kUnchanged) return;
  drawn_into = static_cast<GLint>(framebuffer);
  draw_buffer_count = std::min(integer(gl, GL_MAX_DRAW_BUFFERS), static_cast<GLint>(draw_buffers.size()));
  for (GLuint i = 0; i < static_cast<GLuint>(draw_buffer_count); ++i)
    draw_buffers[i] = asEnum(integer(gl, GL_DRAW_BUFFER0 + i));
  gl.NamedFramebufferDrawBuffer(framebuffer, GL_COLOR_ATTACHMENT0);
}

void FramebufferState::readFrom(const Context& context, GLuint framebuffer) {
  const GladGLContext& gl = context.gl;
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  if (framebuffer == 0 || read_from != kUnchanged) return;
  read_from = static_cast<GLint>(framebuffer);
  read_buffer = integer(gl, GL_READ_BUFFER);
  gl.NamedFramebufferReadBuffer(framebuffer, GL_COLOR_ATTACHMENT0);
}

void FramebufferState::restore(const Context& context) const {
  const GladGLContext& gl = context.gl;
  if (drawn_into != kUnchanged)
    gl.NamedFramebufferDrawBuffers(asName(drawn_into), draw_buffer_count, draw_buffers.data());
  if (read_from != kUnchanged) gl.NamedFramebufferReadBuffer(asName(read_from), asEnum(read_buffer));
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, asName(draw));
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, asName(read));
}

void ViewportState::save(const Context& context) {
  const GladGLContext& gl = context.gl;
  gl.GetFloati_v(GL_VIEWPORT, 0, viewport.data());
  gl.GetDoublei_v(GL_DEPTH_RANGE, 0, depth_range.data());
  scissor = gl.IsEnabledi(GL_SCISSOR_TEST, 0);
  gl.GetIntegeri_v(GL_SCISSOR_BOX, 0, scissor_box.data());
  clip_origin = integer(gl, GL_CLIP_ORIGIN);
  clip_depth = integer(gl, GL_CLIP_DEPTH_MODE);
  clip_distances.save(gl, kClipSwitches);
}

void ViewportState::restore(const Context& context) const {
  const GladGLContext& gl = context.gl;
  gl.ViewportIndexedfv(0, viewport.data());
  gl.DepthRangeIndexed(0, depth_range[0], depth_range[1]);
  (scissor ? gl.Enablei : gl.Disablei)(GL_SCISSOR_TEST, 0);
  gl.ScissorIndexedv(0, scissor_box.data());
  gl.ClipControl(asEnum(clip_origin), asEnum(clip_depth));
  clip_distances.restore(gl, kClipSwitches);
}

void DepthState::save(const Context& context) {
  function = integer(context.gl, GL_DEPTH_FUNC);
  context.gl.GetBooleanv(GL_DEPTH_WRITEMASK, &write);
  switches.save(context.gl, kDepthSwitches);
}

void DepthState::restore(const Context& context) const {
  context.gl.DepthFunc(asEnum(function));
  context.gl.DepthMask(write);
  switches.restore(context.gl, kDepthSwitches);
}

}  // namespace rg::gl
