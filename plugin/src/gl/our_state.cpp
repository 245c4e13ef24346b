#include "gl/host_state.h"

namespace rg::gl {
namespace {

template <size_t N>
void disable(const GladGLContext& gl, const std::array<GLenum, N>& switches) {
  for (const GLenum name : switches) gl.Disable(name);
}

void setVertex(const Context& context) { disable(context.gl, kVertexSwitches); }

// A bound QUERY_BUFFER would swallow the results of our timestamps.
void setBuffers(const Context& context) { context.gl.BindBuffer(GL_QUERY_BUFFER, 0); }

void setTextures(const Context& context) {
  context.gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  for (GLuint unit = 0; unit < kTextureUnits; ++unit) context.gl.BindSampler(unit, 0);
}

void setViewport(const Context& context) {
  const GladGLContext& gl = context.gl;
  gl.DepthRangeIndexed(0, 0.0, 1.0);
  gl.Disablei(GL_SCISSOR_TEST, 0);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  disable(gl, kClipSwitches);
}

void setBlend(const Context& context) {
  const GladGLContext& gl = context.gl;
  for (GLuint i = 0; i < kDrawBuffers; ++i) {
    gl.Disablei(GL_BLEND, i);
    gl.BlendFuncSeparatei(i, GL_ONE, GL_ZERO, GL_ONE, GL_ZERO);
    gl.BlendEquationSeparatei(i, GL_FUNC_ADD, GL_FUNC_ADD);
    gl.ColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  disable(gl, kBlendSwitches);
  if (!context.compatibility) return;
  disable(gl, kBlendCompatibilitySwitches);
  gl.ClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FALSE);
}

void setDepth(const Context& context) {
  disable(context.gl, kDepthSwitches);
  context.gl.DepthFunc(GL_LESS);
  context.gl.DepthMask(GL_FALSE);
}

void setRaster(const Context& context) {
  const GladGLContext& gl = context.gl;
  disable(gl, kRasterSwitches);
  gl.Enable(GL_PROGRAM_POINT_SIZE);
  gl.CullFace(GL_BACK);
  gl.FrontFace(GL_CCW);
  gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  gl.ProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  gl.PointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_UPPER_LEFT);
  if (!context.compatibility) return;
  disable(gl, kRasterCompatibilitySwitches);
  gl.Enable(GL_POINT_SPRITE);  // as in the core profile: points have a gl_PointCoord
}

void setPixels(const Context& context) {
  const GladGLContext& gl = context.gl;
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (size_t i = 0; i < kPixelStores.size(); ++i)
    gl.PixelStorei(kPixelStores[i], isAlignment(kPixelStores[i]) ? 1 : 0);
  if (!context.compatibility) return;
  for (const GLenum name : kPixelTransfers) gl.PixelTransferf(name, isScale(name) ? 1.0f : 0.0f);
}

}  // namespace

void setOurState(const Context& context, uint32_t touches) {
  const auto set = [&](uint32_t group, void (*function)(const Context&)) {
    if (touches & group) function(context);
  };
  set(RG_TOUCHED_VERTEX_ARRAY, setVertex);
  set(RG_TOUCHED_BUFFERS, setBuffers);
  set(RG_TOUCHED_TEXTURES, setTextures);
  set(RG_TOUCHED_VIEWPORT, setViewport);
  set(RG_TOUCHED_BLEND, setBlend);
  set(RG_TOUCHED_DEPTH, setDepth);
  set(RG_TOUCHED_RASTER, setRaster);
  set(RG_TOUCHED_PIXEL_STORE, setPixels);
}

}  // namespace rg::gl
