// The host's GL state, one struct for each RG_TOUCHED_* group, each with save() and restore().
#pragma once

#include <algorithm>
#include <array>

#include "gl/pending_error.h"
#include "gl/state_guard.h"

namespace rg::gl {

// Switches of glEnable, saved as one list.
template <size_t N>
struct Switches {
  std::array<GLboolean, N> on{};
  void save(const GladGLContext& gl, const std::array<GLenum, N>& names) {
    for (size_t i = 0; i < N; ++i) on[i] = gl.IsEnabled(names[i]);
  }
  void restore(const GladGLContext& gl, const std::array<GLenum, N>& names) const {
    for (size_t i = 0; i < N; ++i) (on[i] ? gl.Enable : gl.Disable)(names[i]);
  }
};

// The switches of each group; those of the second list exist in the compatibility profile only.
inline constexpr std::array<GLenum, 2> kVertexSwitches{GL_PRIMITIVE_RESTART,
                                                       GL_PRIMITIVE_RESTART_FIXED_INDEX};
inline constexpr std::array<GLenum, 1> kTextureSwitches{GL_TEXTURE_CUBE_MAP_SEAMLESS};
inline constexpr std::array<GLenum, 9> kBlendSwitches{GL_COLOR_LOGIC_OP,
                                                      GL_FRAMEBUFFER_SRGB,
                                                      GL_DITHER,
                                                      GL_MULTISAMPLE,
                                                      GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                      GL_SAMPLE_ALPHA_TO_ONE,
                                                      GL_SAMPLE_COVERAGE,
                                                      GL_SAMPLE_MASK,
                                                      GL_SAMPLE_SHADING};
inline constexpr std::array<GLenum, 1> kBlendCompatibilitySwitches{GL_ALPHA_TEST};
inline constexpr std::array<GLenum, 3> kDepthSwitches{GL_DEPTH_TEST, GL_STENCIL_TEST, GL_DEPTH_CLAMP};
inline constexpr std::array<GLenum, 8> kRasterSwitches{
    GL_CULL_FACE,      GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT,
    GL_POLYGON_SMOOTH, GL_LINE_SMOOTH,         GL_RASTERIZER_DISCARD,  GL_PROGRAM_POINT_SIZE};
inline constexpr std::array<GLenum, 5> kRasterCompatibilitySwitches{
    GL_POINT_SPRITE, GL_POINT_SMOOTH, GL_LINE_STIPPLE, GL_POLYGON_STIPPLE, GL_VERTEX_PROGRAM_TWO_SIDE};
inline constexpr std::array<GLenum, 8> kClipSwitches{GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1, GL_CLIP_DISTANCE2,
                                                     GL_CLIP_DISTANCE3, GL_CLIP_DISTANCE4, GL_CLIP_DISTANCE5,
                                                     GL_CLIP_DISTANCE6, GL_CLIP_DISTANCE7};

// A pipeline object shows only while no program is in use, so it can stay bound.
struct ProgramState {
  GLint program = 0;
  void save(const Context& context);
  void restore(const Context& context) const;
};

struct VertexState {
  GLint vertex_array = 0;
  Switches<kVertexSwitches.size()> switches;
  void save(const Context& context);
  void restore(const Context& context) const;
};

// Indexed bindings with their ranges, and the generic ones that binding them (or drawing) goes through.
struct BufferState {
  struct Range {
    GLint buffer = 0;
    GLint64 offset = 0, bytes = 0;
  };
  std::array<Range, kUniformBindings> uniform;
  std::array<Range, kStorageBindings> storage;
  std::array<GLint, 8> generic{};
  void save(const Context& context);
  void restore(const Context& context) const;
};

struct TextureState {
  static constexpr size_t kKinds = 4;
  struct Unit {
    std::array<GLint, kKinds> textures{};
    GLint sampler = 0;
  };
  GLint active = GL_TEXTURE0;
  std::array<Unit, kTextureUnits> units;
  Switches<kTextureSwitches.size()> switches;
  void save(const Context& context);
  void restore(const Context& context) const;
};

struct ImageState {
  struct Unit {
    GLint texture = 0, level = 0, layered = 0, layer = 0, access = 0, format = 0;
  };
  std::array<Unit, kImageUnits> units;
  void save(const Context& context);
  void restore(const Context& context) const;
};

// The bindings, and the draw and read buffers of the one framebuffer of the host's that was drawn into or
// read from.
struct FramebufferState {
  static constexpr GLint kUnchanged = -1;
  GLint draw = 0, read = 0;
  GLint drawn_into = kUnchanged, read_from = kUnchanged;
  GLint draw_buffer_count = 0, read_buffer = 0;
  std::array<GLenum, 8> draw_buffers{};
  void save(const Context& context);
  void restore(const Context& context) const;
  void drawInto(const Context& context, GLuint framebuffer);
  void readFrom(const Context& context, GLuint framebuffer);
};

struct ViewportState {
  std::array<GLfloat, 4> viewport{};
  std::array<GLdouble, 2> depth_range{};
  GLboolean scissor = GL_FALSE;
  std::array<GLint, 4> scissor_box{};
  GLint clip_origin = 0, clip_depth = 0;
  Switches<kClipSwitches.size()> clip_distances;
  void save(const Context& context);
  void restore(const Context& context) const;
};

struct BlendState {
  struct DrawBuffer {
    GLboolean enabled = GL_FALSE;
    std::array<GLint, 4> factors{};    // source and destination colour, source and destination alpha
    std::array<GLint, 2> equations{};  // colour, alpha
    std::array<GLboolean, 4> mask{};
  };
  std::array<DrawBuffer, kDrawBuffers> buffers;
  std::array<GLfloat, 4> color{};
  GLint clamp_fragment_color = 0;  // compatibility only
  Switches<kBlendSwitches.size()> switches;
  Switches<kBlendCompatibilitySwitches.size()> compatibility_switches;
  void save(const Context& context);
  void restore(const Context& context) const;
};

struct DepthState {
  GLint function = 0;
  GLboolean write = GL_FALSE;
  Switches<kDepthSwitches.size()> switches;
  void save(const Context& context);
  void restore(const Context& context) const;
};

struct RasterState {
  GLint cull_face = 0, front_face = 0, provoking_vertex = 0, point_origin = 0;
  GLfloat line_width = 1.0f;
  std::array<GLint, 2> polygon_mode{};
  Switches<kRasterSwitches.size()> switches;
  Switches<kRasterCompatibilitySwitches.size()> compatibility_switches;
  void save(const Context& context);
  void restore(const Context& context) const;
};

inline constexpr std::array<GLenum, 24> kPixelStores{GL_PACK_SWAP_BYTES,
                                                     GL_PACK_LSB_FIRST,
                                                     GL_PACK_ROW_LENGTH,
                                                     GL_PACK_IMAGE_HEIGHT,
                                                     GL_PACK_SKIP_PIXELS,
                                                     GL_PACK_SKIP_ROWS,
                                                     GL_PACK_SKIP_IMAGES,
                                                     GL_PACK_ALIGNMENT,
                                                     GL_PACK_COMPRESSED_BLOCK_WIDTH,
                                                     GL_PACK_COMPRESSED_BLOCK_HEIGHT,
                                                     GL_PACK_COMPRESSED_BLOCK_DEPTH,
                                                     GL_PACK_COMPRESSED_BLOCK_SIZE,
                                                     GL_UNPACK_SWAP_BYTES,
                                                     GL_UNPACK_LSB_FIRST,
                                                     GL_UNPACK_ROW_LENGTH,
                                                     GL_UNPACK_IMAGE_HEIGHT,
                                                     GL_UNPACK_SKIP_PIXELS,
                                                     GL_UNPACK_SKIP_ROWS,
                                                     GL_UNPACK_SKIP_IMAGES,
                                                     GL_UNPACK_ALIGNMENT,
                                                     GL_UNPACK_COMPRESSED_BLOCK_WIDTH,
                                                     GL_UNPACK_COMPRESSED_BLOCK_HEIGHT,
                                                     GL_UNPACK_COMPRESSED_BLOCK_DEPTH,
                                                     GL_UNPACK_COMPRESSED_BLOCK_SIZE};
// The compatibility profile's arithmetic on pixels that pass between client and texture.
inline constexpr std::array<GLenum, 11> kPixelTransfers{
    GL_MAP_COLOR, GL_RED_SCALE,  GL_GREEN_SCALE, GL_BLUE_SCALE, GL_ALPHA_SCALE, GL_DEPTH_SCALE,
    GL_RED_BIAS,  GL_GREEN_BIAS, GL_BLUE_BIAS,   GL_ALPHA_BIAS, GL_DEPTH_BIAS};
constexpr bool isAlignment(GLenum store) {
  return store == GL_PACK_ALIGNMENT || store == GL_UNPACK_ALIGNMENT;
}
constexpr bool isScale(GLenum transfer) {
  return transfer == GL_RED_SCALE || transfer == GL_GREEN_SCALE || transfer == GL_BLUE_SCALE ||
         transfer == GL_ALPHA_SCALE || transfer == GL_DEPTH_SCALE;
}

// How client memory is read and written.
struct PixelState {
  GLint pack_buffer = 0, unpack_buffer = 0;
  std::array<GLint, kPixelStores.size()> stores{};
  std::array<GLfloat, kPixelTransfers.size()> transfers{};
  void save(const Context& context);
  void restore(const Context& context) const;
};

struct HostState {
  PendingErrors errors;
  ProgramState program;
  VertexState vertex;
  BufferState buffers;
  TextureState textures;
  ImageState images;
  FramebufferState framebuffer;
  ViewportState viewport;
  BlendState blend;
  DepthState depth;
  RasterState raster;
  PixelState pixels;
  void save(const Context& context, uint32_t touches);
  void restore(const Context& context, uint32_t touches) const;
};

}  // namespace rg::gl
