#include "gl/asked.h"
#include "gl/host_state.h"

namespace rg::gl {
namespace {

void saveDrawBuffer(const GladGLContext& gl, GLuint index, BlendState::DrawBuffer& buffer) {
  buffer.enabled = gl.IsEnabledi(GL_BLEND, index);
  gl.GetIntegeri_v(GL_BLEND_SRC_RGB, index, &buffer.factors[0]);
  gl.GetIntegeri_v(GL_BLEND_DST_RGB, index, &buffer.factors[1]);
  gl.GetIntegeri_v(GL_BLEND_SRC_ALPHA, index, &buffer.factors[2]);
  gl.GetIntegeri_v(GL_BLEND_DST_ALPHA, index, &buffer.factors[3]);
  gl.GetIntegeri_v(GL_BLEND_EQUATION_RGB, index, &buffer.equations[0]);
  gl.GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, index, &buffer.equations[1]);
  gl.GetBooleani_v(GL_COLOR_WRITEMASK, index, buffer.mask.data());
}

void restoreDrawBuffer(const GladGLContext& gl, GLuint index, const BlendState::DrawBuffer& buffer) {
  const auto& [source, destination, source_alpha, destination_alpha] = buffer.factors;
  (buffer.enabled ? gl.Enablei : gl.Disablei)(GL_BLEND, index);
  gl.BlendFuncSeparatei(index, asEnum(source), asEnum(destination), asEnum(source_alpha),
                        asEnum(destination_alpha));
  gl.BlendEquationSeparatei(index, asEnum(buffer.equations[0]), asEnum(buffer.equations[1]));
  gl.ColorMaski(index, buffer.mask[0], buffer.mask[1], buffer.mask[2], buffer.mask[3]);
}

}  // namespace

void BlendState::save(const Context& context) {
  const GladGLContext& gl = context.gl;
  for (GLuint i = 0; i < buffers.size(); ++i) saveDrawBuffer(gl, i, buffers[i]);
  gl.GetFloatv(GL_BLEND_COLOR, color.data());
  switches.save(gl, kBlendSwitches);
  if (!context.compatibility) return;
  clamp_fragment_color = integer(gl, GL_CLAMP_FRAGMENT_COLOR);
  compatibility_switches.save(gl, kBlendCompatibilitySwitches);
}

void BlendState::restore(const Context& context) const {
  const GladGLContext& gl = context.gl;
  for (GLuint i = 0; i < buffers.size(); ++i) restoreDrawBuffer(gl, i, buffers[i]);
  gl.BlendColor(color[0], color[1], color[2], color[3]);
  switches.restore(gl, kBlendSwitches);
  if (!context.compatibility) return;
  gl.ClampColor(GL_CLAMP_FRAGMENT_COLOR, asEnum(clamp_fragment_color));
  compatibility_switches.restore(gl, kBlendCompatibilitySwitches);
}

void RasterState::save(const Context& context) {
  const GladGLContext& gl = context.gl;
  cull_face = integer(gl, GL_CULL_FACE_MODE);
  front_face = integer(gl, GL_FRONT_FACE);
  provoking_vertex = integer(gl, GL_PROVOKING_VERTEX);
  gl.GetFloatv(GL_LINE_WIDTH, &line_width);
  point_origin = integer(gl, GL_POINT_SPRITE_COORD_ORIGIN);
  polygon_mode.fill(0);
  gl.GetIntegerv(GL_POLYGON_MODE, polygon_mode.data());  // two values in compatibility, one or two in core
  switches.save(gl, kRasterSwitches);
  if (context.compatibility) compatibility_switches.save(gl, kRasterCompatibilitySwitches);
}

void RasterState::restore(const Context& context) const {
  const GladGLContext& gl = context.gl;
  gl.CullFace(asEnum(cull_face));
  gl.FrontFace(asEnum(front_face));
  gl.ProvokingVertex(asEnum(provoking_vertex));
  gl.LineWidth(line_width);
  gl.PointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, point_origin);
  switches.restore(gl, kRasterSwitches);
  if (!context.compatibility) {
    gl.PolygonMode(GL_FRONT_AND_BACK, asEnum(polygon_mode[0]));
    return;
  }
  gl.PolygonMode(GL_FRONT, asEnum(polygon_mode[0]));
  gl.PolygonMode(GL_BACK, asEnum(polygon_mode[1]));
  compatibility_switches.restore(gl, kRasterCompatibilitySwitches);
}

void PixelState::save(const Context& context) {
  const GladGLContext& gl = context.gl;
  pack_buffer = integer(gl, GL_PIXEL_PACK_BUFFER_BINDING);
  unpack_buffer = integer(gl, GL_PIXEL_UNPACK_BUFFER_BINDING);
  for (size_t i = 0; i < stores.size(); ++i) stores[i] = integer(gl, kPixelStores[i]);
  if (!context.compatibility) return;
  for (size_t i = 0; i < transfers.size(); ++i) gl.GetFloatv(kPixelTransfers[i], &transfers[i]);
}

void PixelState::restore(const Context& context) const {
  const GladGLContext& gl = context.gl;
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(pack_buffer));
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpack_buffer));
  for (size_t i = 0; i < stores.size(); ++i) gl.PixelStorei(kPixelStores[i], stores[i]);
  if (!context.compatibility) return;
  for (size_t i = 0; i < transfers.size(); ++i) gl.PixelTransferf(kPixelTransfers[i], transfers[i]);
}

}  // namespace rg::gl
