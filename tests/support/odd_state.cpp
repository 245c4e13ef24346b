#include "odd_state.h"

namespace rg::test {
namespace {

constexpr std::array<GLenum, 11> kKindsOfTexture{GL_TEXTURE_2D,
                                                 GL_TEXTURE_2D_ARRAY,
                                                 GL_TEXTURE_3D,
                                                 GL_TEXTURE_CUBE_MAP,
                                                 GL_TEXTURE_1D,
                                                 GL_TEXTURE_1D_ARRAY,
                                                 GL_TEXTURE_RECTANGLE,
                                                 GL_TEXTURE_CUBE_MAP_ARRAY,
                                                 GL_TEXTURE_BUFFER,
                                                 GL_TEXTURE_2D_MULTISAMPLE,
                                                 GL_TEXTURE_2D_MULTISAMPLE_ARRAY};
constexpr size_t kPluginKinds = 4;  // the first four

// The first ten are those the plugin may bind.
constexpr std::array<GLenum, 13> kBufferTargets{GL_ARRAY_BUFFER,
                                                GL_COPY_READ_BUFFER,
                                                GL_COPY_WRITE_BUFFER,
                                                GL_DRAW_INDIRECT_BUFFER,
                                                GL_DISPATCH_INDIRECT_BUFFER,
                                                GL_UNIFORM_BUFFER,
                                                GL_SHADER_STORAGE_BUFFER,
                                                GL_QUERY_BUFFER,
                                                GL_PIXEL_UNPACK_BUFFER,
                                                GL_PIXEL_PACK_BUFFER,
                                                GL_ATOMIC_COUNTER_BUFFER,
                                                GL_TEXTURE_BUFFER,
                                                GL_TRANSFORM_FEEDBACK_BUFFER};
constexpr size_t kPluginBufferTargets = 10;

constexpr std::array<GLenum, 31> kSwitchNames{GL_COLOR_LOGIC_OP,
                                              GL_CULL_FACE,
                                              GL_DEPTH_CLAMP,
                                              GL_DEPTH_TEST,
                                              GL_DITHER,
                                              GL_FRAMEBUFFER_SRGB,
                                              GL_LINE_SMOOTH,
                                              GL_MULTISAMPLE,
                                              GL_POLYGON_OFFSET_FILL,
                                              GL_POLYGON_OFFSET_LINE,
                                              GL_POLYGON_OFFSET_POINT,
                                              GL_POLYGON_SMOOTH,
                                              GL_PRIMITIVE_RESTART,
                                              GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                              GL_RASTERIZER_DISCARD,
                                              GL_SAMPLE_ALPHA_TO_COVERAGE,
                                              GL_SAMPLE_ALPHA_TO_ONE,
                                              GL_SAMPLE_COVERAGE,
                                              GL_SAMPLE_SHADING,
                                              GL_SAMPLE_MASK,
                                              GL_STENCIL_TEST,
                                              GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                              GL_PROGRAM_POINT_SIZE,
                                              GL_CLIP_DISTANCE0,
                                              GL_CLIP_DISTANCE1,
                                              GL_CLIP_DISTANCE2,
                                              GL_CLIP_DISTANCE3,
                                              GL_CLIP_DISTANCE4,
                                              GL_CLIP_DISTANCE5,
                                              GL_CLIP_DISTANCE6,
                                              GL_CLIP_DISTANCE7};

GLuint makeProgram(const GladGLContext& gl) {
  const GLuint program = gl.CreateProgram();
  for (const auto& [kind, text] :
       {std::pair{
            GL_VERTEX_SHADER,
            "#version 450\nout gl_PerVertex { vec4 gl_Position; };\nvoid main() { gl_Position = vec4(0); }"},
        std::pair{GL_FRAGMENT_SHADER, "#version 450\nout vec4 c;\nvoid main() { c = vec4(1); }"}}) {
    const GLuint shader = gl.CreateShader(static_cast<GLenum>(kind));
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
  }
  gl.ProgramParameteri(program, GL_PROGRAM_SEPARABLE, GL_TRUE);
  gl.LinkProgram(program);
  return program;
}

void allocate(const GladGLContext& gl, GLuint texture, GLenum kind, GLuint buffer) {
  constexpr int n = OddState::kSize;
  switch (kind) {
    case GL_TEXTURE_1D:
      return gl.TextureStorage1D(texture, 3, GL_RGBA8, n);
    case GL_TEXTURE_1D_ARRAY:
    case GL_TEXTURE_2D:
    case GL_TEXTURE_CUBE_MAP:
      return gl.TextureStorage2D(texture, 3, GL_RGBA8, n, n);
    case GL_TEXTURE_RECTANGLE:
      return gl.TextureStorage2D(texture, 1, GL_RGBA8, n, n);
    case GL_TEXTURE_BUFFER:
      return gl.TextureBuffer(texture, GL_RGBA8, buffer);
    case GL_TEXTURE_2D_MULTISAMPLE:
      return gl.TextureStorage2DMultisample(texture, 1, GL_RGBA8, n, n, GL_TRUE);
    case GL_TEXTURE_2D_MULTISAMPLE_ARRAY:
      return gl.TextureStorage3DMultisample(texture, 1, GL_RGBA8, n, n, 2, GL_TRUE);
    default:
      return gl.TextureStorage3D(texture, 3, GL_RGBA8, n, n, 6);
  }
}

}  // namespace

OddState::OddState(const GladGLContext& context, Profile profile) : gl(context), profile_(profile) {
  gl.CreateVertexArrays(2, vertex_arrays_.data());
  gl.CreateSamplers(2, samplers_.data());
  gl.CreateFramebuffers(2, framebuffers_.data());
  gl.CreateRenderbuffers(2, renderbuffers_.data());
  gl.CreateTransformFeedbacks(2, feedbacks_.data());
  gl.CreateProgramPipelines(2, pipelines_.data());
  for (size_t v = 0; v < 2; ++v) {
    gl.CreateBuffers(static_cast<GLsizei>(kBuffers), buffers_[v].data());
    for (const GLuint buffer : buffers_[v])
      gl.NamedBufferStorage(buffer, 1 << 16, nullptr, GL_DYNAMIC_STORAGE_BIT);
    gl.VertexArrayElementBuffer(vertex_arrays_[v], buffers_[v][14]);
    gl.VertexArrayVertexBuffer(vertex_arrays_[v], 3, buffers_[v][15], 16, 32);
    gl.EnableVertexArrayAttrib(vertex_arrays_[v], 3);
    programs_[v] = makeProgram(gl);
    gl.UseProgramStages(pipelines_[v], GL_FRAGMENT_SHADER_BIT, programs_[v]);
    makeTextures(v);
    makeFramebuffer(v);
  }
  resetDrawBuffers();
}

OddState::~OddState() {
  for (size_t v = 0; v < 2; ++v) {
    gl.DeleteProgram(programs_[v]);
    gl.DeleteTextures(static_cast<GLsizei>(kKinds), textures_[v].data());
    gl.DeleteBuffers(static_cast<GLsizei>(kBuffers), buffers_[v].data());
  }
  gl.DeleteProgramPipelines(2, pipelines_.data());
  gl.DeleteVertexArrays(2, vertex_arrays_.data());
  gl.DeleteSamplers(2, samplers_.data());
  gl.DeleteFramebuffers(2, framebuffers_.data());
  gl.DeleteRenderbuffers(2, renderbuffers_.data());
  gl.DeleteTransformFeedbacks(2, feedbacks_.data());
  gl.DeleteTextures(static_cast<GLsizei>(attachments_.size()), attachments_.data());
}

void OddState::makeTextures(size_t v) {
  for (size_t kind = 0; kind < kKinds; ++kind) {
    gl.CreateTextures(kKindsOfTexture[kind], 1, &textures_[v][kind]);
    allocate(gl, textures_[v][kind], kKindsOfTexture[kind], buffers_[v][0]);
  }
}

void OddState::makeFramebuffer(size_t v) {
  for (const int attachment :
       {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2, GL_DEPTH_ATTACHMENT}) {
    GLuint texture = 0;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &texture);
    gl.TextureStorage2D(texture, 1, attachment == GL_DEPTH_ATTACHMENT ? GL_DEPTH_COMPONENT32F : GL_RGBA16F,
                        kSize, kSize);
    gl.NamedFramebufferTexture(framebuffers_[v], static_cast<GLenum>(attachment), texture, 0);
    attachments_.push_back(texture);
  }
}

void OddState::resetDrawBuffers() const {
  constexpr std::array<GLenum, 3> kOdd{GL_NONE, GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT1};
  for (const GLuint framebuffer : framebuffers_) {
    gl.NamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(kOdd.size()), kOdd.data());
    gl.NamedFramebufferReadBuffer(framebuffer, GL_COLOR_ATTACHMENT2);
  }
}

void OddState::apply(size_t v, const OddScope& scope) const {
  bindings(v, scope);
  textures(v, scope);
  buffers(v, scope);
  switches(v, scope);
  viewports(v, scope);
  blending(v, scope);
  raster(v);
  pixels(v);
  if (scope.host) hostOnly(v);
  if (profile_ == Profile::kCompatibility) compatibility(v, scope);
}

void OddState::flip(GLenum name, bool on) const { (on ? gl.Enable : gl.Disable)(name); }

void OddState::bindings(size_t v, const OddScope& scope) const {
  gl.UseProgram(0);  // Mesa does not change the pipeline's binding while a program is in use
  if (scope.host) gl.BindProgramPipeline(pipelines_[v]);
  gl.UseProgram(programs_[v]);
  gl.BindVertexArray(vertex_arrays_[v]);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[v]);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1 - v]);
}

void OddState::textures(size_t v, const OddScope& scope) const {
  const size_t kinds = scope.host ? kKinds : kPluginKinds;
  for (GLuint unit = 0; unit < scope.texture_units; ++unit) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    for (size_t kind = 0; kind < kinds; ++kind) gl.BindTexture(kKindsOfTexture[kind], textures_[v][kind]);
    gl.BindSampler(unit, samplers_[v]);
  }
  gl.ActiveTexture(GL_TEXTURE0 + (v == 0 ? 5 : 3));
  for (GLuint unit = 0; unit < scope.image_units; ++unit) {
    if (v == 0) {
      gl.BindImageTexture(unit, textures_[v][1], 1, GL_FALSE, 2, GL_READ_ONLY, GL_R32UI);
    } else {
      gl.BindImageTexture(unit, textures_[v][1], 2, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA8);
    }
  }
}

void OddState::buffers(size_t v, const OddScope& scope) const {
  const auto bindIndexed = [&](GLenum target, GLuint count) {
    for (GLuint i = 0; i < count; ++i) {
      if ((i + v) % 2 == 0) {
        gl.BindBufferBase(target, i, buffers_[v][i % kBuffers]);
      } else {
        gl.BindBufferRange(target, i, buffers_[v][i % kBuffers], static_cast<GLintptr>(256 * (i + 1)), 512);
      }
    }
  };
  bindIndexed(GL_UNIFORM_BUFFER, scope.uniform_bindings);
  bindIndexed(GL_SHADER_STORAGE_BUFFER, scope.storage_bindings);
  if (scope.host) {
    gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedbacks_[v]);
    bindIndexed(GL_TRANSFORM_FEEDBACK_BUFFER, 4);
    bindIndexed(GL_ATOMIC_COUNTER_BUFFER, 1);
  }
  const size_t targets = scope.host ? kBufferTargets.size() : kPluginBufferTargets;
  for (size_t i = 0; i < targets; ++i) gl.BindBuffer(kBufferTargets[i], buffers_[v][(i + 3) % kBuffers]);
}

void OddState::switches(size_t v, const OddScope&) const {
  for (const GLenum name : kSwitchNames) flip(name, v == 0);
}

void OddState::viewports(size_t v, const OddScope& scope) const {
  const float odd = v == 0 ? 3.25f : 7.5f;
  for (GLuint i = 0; i < scope.viewports; ++i) {
    const auto n = static_cast<float>(i);
    gl.ViewportIndexedf(i, odd + n, odd, 17.5f + odd, 11.0f + odd);
    gl.DepthRangeIndexed(i, 0.125 * (1.0 + static_cast<double>(v)), 0.75 + 0.125 * static_cast<double>(v));
    (v == 0 ? gl.Enablei : gl.Disablei)(GL_SCISSOR_TEST, i);
    gl.ScissorIndexed(i, static_cast<GLint>(3 + i + v), 5, 7 + static_cast<GLint>(v), 9);
  }
  gl.ClipControl(v == 0 ? GL_UPPER_LEFT : GL_LOWER_LEFT, v == 0 ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
}

void OddState::blending(size_t v, const OddScope& scope) const {
  for (GLuint i = 0; i < scope.draw_buffers; ++i) {
    (v == 0 ? gl.Enablei : gl.Disablei)(GL_BLEND, i);
    if (v == 0) {
      gl.BlendFuncSeparatei(i, GL_SRC_ALPHA, GL_DST_COLOR, GL_CONSTANT_ALPHA, GL_ONE_MINUS_DST_ALPHA);
      gl.BlendEquationSeparatei(i, GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
      gl.ColorMaski(i, GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    } else {
      gl.BlendFuncSeparatei(i, GL_ZERO, GL_SRC_ALPHA, GL_DST_ALPHA, GL_ONE);
      gl.BlendEquationSeparatei(i, GL_MIN, GL_FUNC_SUBTRACT);
      gl.ColorMaski(i, GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    }
  }
  gl.BlendColor(0.125f, 0.25f, v == 0 ? 0.5f : 0.75f, 0.875f);
  gl.DepthFunc(v == 0 ? GL_NOTEQUAL : GL_GEQUAL);
  gl.DepthMask(v == 0 ? GL_TRUE : GL_FALSE);
}

void OddState::raster(size_t v) const {
  gl.CullFace(v == 0 ? GL_FRONT_AND_BACK : GL_FRONT);
  gl.FrontFace(v == 0 ? GL_CW : GL_CCW);
  gl.PolygonMode(GL_FRONT_AND_BACK, v == 0 ? GL_LINE : GL_POINT);
  gl.ProvokingVertex(v == 0 ? GL_FIRST_VERTEX_CONVENTION : GL_LAST_VERTEX_CONVENTION);
  gl.LineWidth(v == 0 ? 0.5f : 0.75f);
  gl.PointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, v == 0 ? GL_LOWER_LEFT : GL_UPPER_LEFT);
}

void OddState::pixels(size_t v) const {
  const auto odd = static_cast<GLint>(v);
  for (const int name : {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST})
    gl.PixelStorei(static_cast<GLenum>(name), 1 - odd);
  for (const int name : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT})
    gl.PixelStorei(static_cast<GLenum>(name), v == 0 ? 8 : 2);
  GLint value = 3 + odd;
  for (const int name :
       {GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_IMAGES,
        GL_PACK_COMPRESSED_BLOCK_WIDTH, GL_PACK_COMPRESSED_BLOCK_HEIGHT, GL_PACK_COMPRESSED_BLOCK_DEPTH,
        GL_PACK_COMPRESSED_BLOCK_SIZE, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
        GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_COMPRESSED_BLOCK_WIDTH,
        GL_UNPACK_COMPRESSED_BLOCK_HEIGHT, GL_UNPACK_COMPRESSED_BLOCK_DEPTH,
        GL_UNPACK_COMPRESSED_BLOCK_SIZE}) {
    gl.PixelStorei(static_cast<GLenum>(name), value);
    value += 2;
  }
}

void OddState::hostOnly(size_t v) const {
  const auto odd = static_cast<GLint>(v);
  gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffers_[v]);
  for (GLuint i = 1; i < 16; ++i)
    gl.VertexAttrib4f(i, 0.5f, 0.25f, static_cast<float>(i), static_cast<float>(v));
  gl.StencilFuncSeparate(GL_FRONT, GL_LESS, 3 + odd, 0x55);
  gl.StencilFuncSeparate(GL_BACK, GL_GREATER, 5 + odd, 0x33);
  gl.StencilOpSeparate(GL_FRONT, GL_INCR, GL_DECR, GL_INVERT);
  gl.StencilOpSeparate(GL_BACK, GL_ZERO, GL_REPLACE, GL_DECR_WRAP);
  gl.StencilMaskSeparate(GL_FRONT, 0x0F);
  gl.StencilMaskSeparate(GL_BACK, 0xF0);
  gl.LogicOp(GL_XOR);
  gl.PolygonOffset(2.5f, -3.0f);
  gl.SampleCoverage(0.25f, GL_TRUE);
  gl.SampleMaski(0, 0x5);
  gl.MinSampleShading(0.5f);
  gl.PrimitiveRestartIndex(7);
  gl.PointSize(3.5f);
  gl.PointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 2.5f);
  gl.PatchParameteri(GL_PATCH_VERTICES, 5);
  gl.ClearColor(0.25f, 0.5f, 0.75f, 0.125f);
  gl.ClearDepth(0.25);
  gl.ClearStencil(7);
  gl.ClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
  gl.Hint(GL_LINE_SMOOTH_HINT, GL_NICEST);
  gl.Hint(GL_FRAGMENT_SHADER_DERIVATIVE_HINT, GL_FASTEST);
}

void OddState::compatibility(size_t v, const OddScope& scope) const {
  const auto odd = static_cast<float>(v);
  for (const int name : {GL_ALPHA_TEST, GL_POINT_SPRITE, GL_POINT_SMOOTH, GL_LINE_STIPPLE, GL_POLYGON_STIPPLE,
                         GL_VERTEX_PROGRAM_TWO_SIDE})
    flip(static_cast<GLenum>(name), v == 0);
  gl.ClampColor(GL_CLAMP_FRAGMENT_COLOR, v == 0 ? GL_TRUE : GL_FIXED_ONLY);
  gl.PolygonMode(GL_BACK, v == 0 ? GL_POINT : GL_LINE);
  for (const int name : {GL_RED_SCALE, GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE, GL_DEPTH_SCALE})
    gl.PixelTransferf(static_cast<GLenum>(name), 0.5f + 0.25f * odd);
  for (const int name : {GL_RED_BIAS, GL_GREEN_BIAS, GL_BLUE_BIAS, GL_ALPHA_BIAS, GL_DEPTH_BIAS})
    gl.PixelTransferf(static_cast<GLenum>(name), 0.25f + 0.25f * odd);
  gl.PixelTransferi(GL_MAP_COLOR, v == 0 ? 1 : 0);
  if (!scope.host) return;
  gl.AlphaFunc(GL_GREATER, 0.75f);
  for (const int name : {GL_FOG, GL_LIGHTING, GL_LIGHT0, GL_NORMALIZE, GL_COLOR_MATERIAL, GL_COLOR_SUM})
    gl.Enable(static_cast<GLenum>(name));
  gl.ShadeModel(GL_FLAT);
  gl.MatrixMode(GL_TEXTURE);
  gl.Color4f(0.5f, 0.25f, 0.125f, 0.5f);
  gl.Normal3f(0.0f, 1.0f, 0.0f);
  gl.LineStipple(3, 0x5A5A);
  gl.PixelZoom(-2.0f, 3.0f);
  gl.Fogf(GL_FOG_DENSITY, 0.5f);
  gl.ClientActiveTexture(GL_TEXTURE2);
  gl.ClampColor(GL_CLAMP_VERTEX_COLOR, GL_FALSE);
}

}  // namespace rg::test
