#include "state_snapshot.h"

#include <array>
#include <sstream>

namespace rg::test {
namespace {

struct Item {
  GLenum name;
  const char* text;
  size_t count = 1;
};

#define RG_ITEM(name) \
  Item { name, #name, 1 }
#define RG_ITEMS(name, count) \
  Item { name, #name, count }

constexpr std::array kSwitches{RG_ITEM(GL_BLEND),
                               RG_ITEM(GL_COLOR_LOGIC_OP),
                               RG_ITEM(GL_CULL_FACE),
                               RG_ITEM(GL_DEBUG_OUTPUT),
                               RG_ITEM(GL_DEBUG_OUTPUT_SYNCHRONOUS),
                               RG_ITEM(GL_DEPTH_CLAMP),
                               RG_ITEM(GL_DEPTH_TEST),
                               RG_ITEM(GL_DITHER),
                               RG_ITEM(GL_FRAMEBUFFER_SRGB),
                               RG_ITEM(GL_LINE_SMOOTH),
                               RG_ITEM(GL_MULTISAMPLE),
                               RG_ITEM(GL_POLYGON_OFFSET_FILL),
                               RG_ITEM(GL_POLYGON_OFFSET_LINE),
                               RG_ITEM(GL_POLYGON_OFFSET_POINT),
                               RG_ITEM(GL_POLYGON_SMOOTH),
                               RG_ITEM(GL_PRIMITIVE_RESTART),
                               RG_ITEM(GL_PRIMITIVE_RESTART_FIXED_INDEX),
                               RG_ITEM(GL_RASTERIZER_DISCARD),
                               RG_ITEM(GL_SAMPLE_ALPHA_TO_COVERAGE),
                               RG_ITEM(GL_SAMPLE_ALPHA_TO_ONE),
                               RG_ITEM(GL_SAMPLE_COVERAGE),
                               RG_ITEM(GL_SAMPLE_SHADING),
                               RG_ITEM(GL_SAMPLE_MASK),
                               RG_ITEM(GL_SCISSOR_TEST),
                               RG_ITEM(GL_STENCIL_TEST),
                               RG_ITEM(GL_TEXTURE_CUBE_MAP_SEAMLESS),
                               RG_ITEM(GL_PROGRAM_POINT_SIZE),
                               RG_ITEM(GL_CLIP_DISTANCE0),
                               RG_ITEM(GL_CLIP_DISTANCE1),
                               RG_ITEM(GL_CLIP_DISTANCE2),
                               RG_ITEM(GL_CLIP_DISTANCE3),
                               RG_ITEM(GL_CLIP_DISTANCE4),
                               RG_ITEM(GL_CLIP_DISTANCE5),
                               RG_ITEM(GL_CLIP_DISTANCE6),
                               RG_ITEM(GL_CLIP_DISTANCE7)};
constexpr std::array kCompatibilitySwitches{RG_ITEM(GL_ALPHA_TEST),      RG_ITEM(GL_FOG),
                                            RG_ITEM(GL_LIGHTING),        RG_ITEM(GL_LIGHT0),
                                            RG_ITEM(GL_LINE_STIPPLE),    RG_ITEM(GL_NORMALIZE),
                                            RG_ITEM(GL_POINT_SMOOTH),    RG_ITEM(GL_POINT_SPRITE),
                                            RG_ITEM(GL_POLYGON_STIPPLE), RG_ITEM(GL_VERTEX_PROGRAM_TWO_SIDE),
                                            RG_ITEM(GL_COLOR_MATERIAL),  RG_ITEM(GL_COLOR_SUM),
                                            RG_ITEM(GL_VERTEX_ARRAY)};

constexpr std::array kNumbers{RG_ITEM(GL_CURRENT_PROGRAM),
                              RG_ITEM(GL_PROGRAM_PIPELINE_BINDING),
                              RG_ITEM(GL_VERTEX_ARRAY_BINDING),
                              RG_ITEM(GL_ACTIVE_TEXTURE),
                              RG_ITEM(GL_ARRAY_BUFFER_BINDING),
                              RG_ITEM(GL_ELEMENT_ARRAY_BUFFER_BINDING),
                              RG_ITEM(GL_COPY_READ_BUFFER_BINDING),
                              RG_ITEM(GL_COPY_WRITE_BUFFER_BINDING),
                              RG_ITEM(GL_DRAW_INDIRECT_BUFFER_BINDING),
                              RG_ITEM(GL_DISPATCH_INDIRECT_BUFFER_BINDING),
                              RG_ITEM(GL_PIXEL_PACK_BUFFER_BINDING),
                              RG_ITEM(GL_PIXEL_UNPACK_BUFFER_BINDING),
                              RG_ITEM(GL_UNIFORM_BUFFER_BINDING),
                              RG_ITEM(GL_SHADER_STORAGE_BUFFER_BINDING),
                              RG_ITEM(GL_ATOMIC_COUNTER_BUFFER_BINDING),
                              RG_ITEM(GL_TEXTURE_BUFFER_BINDING),
                              RG_ITEM(GL_QUERY_BUFFER_BINDING),
                              RG_ITEM(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING),
                              RG_ITEM(GL_TRANSFORM_FEEDBACK_BINDING),
                              RG_ITEM(GL_TRANSFORM_FEEDBACK_BUFFER_ACTIVE),
                              RG_ITEM(GL_TRANSFORM_FEEDBACK_BUFFER_PAUSED),
                              RG_ITEM(GL_DRAW_FRAMEBUFFER_BINDING),
                              RG_ITEM(GL_READ_FRAMEBUFFER_BINDING),
                              RG_ITEM(GL_RENDERBUFFER_BINDING),
                              RG_ITEM(GL_READ_BUFFER),
                              RG_ITEM(GL_DRAW_BUFFER0),
                              RG_ITEM(GL_DRAW_BUFFER1),
                              RG_ITEM(GL_DRAW_BUFFER2),
                              RG_ITEM(GL_DRAW_BUFFER3),
                              RG_ITEM(GL_DRAW_BUFFER4),
                              RG_ITEM(GL_DRAW_BUFFER5),
                              RG_ITEM(GL_DRAW_BUFFER6),
                              RG_ITEM(GL_DRAW_BUFFER7),
                              RG_ITEMS(GL_BLEND_COLOR, 4),
                              RG_ITEM(GL_LOGIC_OP_MODE),
                              RG_ITEM(GL_DEPTH_FUNC),
                              RG_ITEM(GL_DEPTH_WRITEMASK),
                              RG_ITEM(GL_DEPTH_CLEAR_VALUE),
                              RG_ITEMS(GL_COLOR_CLEAR_VALUE, 4),
                              RG_ITEM(GL_STENCIL_CLEAR_VALUE),
                              RG_ITEM(GL_STENCIL_FUNC),
                              RG_ITEM(GL_STENCIL_REF),
                              RG_ITEM(GL_STENCIL_VALUE_MASK),
                              RG_ITEM(GL_STENCIL_WRITEMASK),
                              RG_ITEM(GL_STENCIL_FAIL),
                              RG_ITEM(GL_STENCIL_PASS_DEPTH_FAIL),
                              RG_ITEM(GL_STENCIL_PASS_DEPTH_PASS),
                              RG_ITEM(GL_STENCIL_BACK_FUNC),
                              RG_ITEM(GL_STENCIL_BACK_REF),
                              RG_ITEM(GL_STENCIL_BACK_VALUE_MASK),
                              RG_ITEM(GL_STENCIL_BACK_WRITEMASK),
                              RG_ITEM(GL_STENCIL_BACK_FAIL),
                              RG_ITEM(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
                              RG_ITEM(GL_STENCIL_BACK_PASS_DEPTH_PASS),
                              RG_ITEM(GL_CULL_FACE_MODE),
                              RG_ITEM(GL_FRONT_FACE),
                              RG_ITEM(GL_POLYGON_MODE),
                              RG_ITEM(GL_POLYGON_OFFSET_FACTOR),
                              RG_ITEM(GL_POLYGON_OFFSET_UNITS),
                              RG_ITEM(GL_CLIP_ORIGIN),
                              RG_ITEM(GL_CLIP_DEPTH_MODE),
                              RG_ITEM(GL_SAMPLE_COVERAGE_VALUE),
                              RG_ITEM(GL_SAMPLE_COVERAGE_INVERT),
                              RG_ITEM(GL_MIN_SAMPLE_SHADING_VALUE),
                              RG_ITEM(GL_PRIMITIVE_RESTART_INDEX),
                              RG_ITEM(GL_LINE_WIDTH),
                              RG_ITEM(GL_POINT_SIZE),
                              RG_ITEM(GL_POINT_FADE_THRESHOLD_SIZE),
                              RG_ITEM(GL_POINT_SPRITE_COORD_ORIGIN),
                              RG_ITEM(GL_PROVOKING_VERTEX),
                              RG_ITEM(GL_PATCH_VERTICES),
                              RG_ITEMS(GL_PATCH_DEFAULT_OUTER_LEVEL, 4),
                              RG_ITEMS(GL_PATCH_DEFAULT_INNER_LEVEL, 2),
                              RG_ITEM(GL_CLAMP_READ_COLOR),
                              RG_ITEM(GL_LINE_SMOOTH_HINT),
                              RG_ITEM(GL_POLYGON_SMOOTH_HINT),
                              RG_ITEM(GL_TEXTURE_COMPRESSION_HINT),
                              RG_ITEM(GL_FRAGMENT_SHADER_DERIVATIVE_HINT),
                              RG_ITEM(GL_DEBUG_GROUP_STACK_DEPTH),
                              RG_ITEM(GL_DEBUG_LOGGED_MESSAGES),
                              RG_ITEM(GL_PACK_SWAP_BYTES),
                              RG_ITEM(GL_PACK_LSB_FIRST),
                              RG_ITEM(GL_PACK_ROW_LENGTH),
                              RG_ITEM(GL_PACK_IMAGE_HEIGHT),
                              RG_ITEM(GL_PACK_SKIP_PIXELS),
                              RG_ITEM(GL_PACK_SKIP_ROWS),
                              RG_ITEM(GL_PACK_SKIP_IMAGES),
                              RG_ITEM(GL_PACK_ALIGNMENT),
                              RG_ITEM(GL_PACK_COMPRESSED_BLOCK_WIDTH),
                              RG_ITEM(GL_PACK_COMPRESSED_BLOCK_HEIGHT),
                              RG_ITEM(GL_PACK_COMPRESSED_BLOCK_DEPTH),
                              RG_ITEM(GL_PACK_COMPRESSED_BLOCK_SIZE),
                              RG_ITEM(GL_UNPACK_SWAP_BYTES),
                              RG_ITEM(GL_UNPACK_LSB_FIRST),
                              RG_ITEM(GL_UNPACK_ROW_LENGTH),
                              RG_ITEM(GL_UNPACK_IMAGE_HEIGHT),
                              RG_ITEM(GL_UNPACK_SKIP_PIXELS),
                              RG_ITEM(GL_UNPACK_SKIP_ROWS),
                              RG_ITEM(GL_UNPACK_SKIP_IMAGES),
                              RG_ITEM(GL_UNPACK_ALIGNMENT),
                              RG_ITEM(GL_UNPACK_COMPRESSED_BLOCK_WIDTH),
                              RG_ITEM(GL_UNPACK_COMPRESSED_BLOCK_HEIGHT),
                              RG_ITEM(GL_UNPACK_COMPRESSED_BLOCK_DEPTH),
                              RG_ITEM(GL_UNPACK_COMPRESSED_BLOCK_SIZE)};
constexpr std::array kCompatibilityNumbers{RG_ITEM(GL_ALPHA_TEST_FUNC),
                                           RG_ITEM(GL_ALPHA_TEST_REF),
                                           RG_ITEM(GL_CLAMP_FRAGMENT_COLOR),
                                           RG_ITEM(GL_CLAMP_VERTEX_COLOR),
                                           RG_ITEM(GL_SHADE_MODEL),
                                           RG_ITEM(GL_MATRIX_MODE),
                                           RG_ITEMS(GL_MODELVIEW_MATRIX, 16),
                                           RG_ITEMS(GL_PROJECTION_MATRIX, 16),
                                           RG_ITEM(GL_MODELVIEW_STACK_DEPTH),
                                           RG_ITEM(GL_ATTRIB_STACK_DEPTH),
                                           RG_ITEM(GL_CLIENT_ATTRIB_STACK_DEPTH),
                                           RG_ITEMS(GL_CURRENT_COLOR, 4),
                                           RG_ITEMS(GL_CURRENT_NORMAL, 3),
                                           RG_ITEMS(GL_CURRENT_TEXTURE_COORDS, 4),
                                           RG_ITEMS(GL_FOG_COLOR, 4),
                                           RG_ITEM(GL_FOG_DENSITY),
                                           RG_ITEM(GL_LINE_STIPPLE_PATTERN),
                                           RG_ITEM(GL_LINE_STIPPLE_REPEAT),
                                           RG_ITEM(GL_ZOOM_X),
                                           RG_ITEM(GL_ZOOM_Y),
                                           RG_ITEM(GL_MAP_COLOR),
                                           RG_ITEM(GL_RED_SCALE),
                                           RG_ITEM(GL_GREEN_SCALE),
                                           RG_ITEM(GL_BLUE_SCALE),
                                           RG_ITEM(GL_ALPHA_SCALE),
                                           RG_ITEM(GL_DEPTH_SCALE),
                                           RG_ITEM(GL_RED_BIAS),
                                           RG_ITEM(GL_GREEN_BIAS),
                                           RG_ITEM(GL_BLUE_BIAS),
                                           RG_ITEM(GL_ALPHA_BIAS),
                                           RG_ITEM(GL_DEPTH_BIAS),
                                           RG_ITEM(GL_CLIENT_ACTIVE_TEXTURE)};

constexpr std::array kTextureBindings{RG_ITEM(GL_TEXTURE_BINDING_1D),
                                      RG_ITEM(GL_TEXTURE_BINDING_2D),
                                      RG_ITEM(GL_TEXTURE_BINDING_3D),
                                      RG_ITEM(GL_TEXTURE_BINDING_1D_ARRAY),
                                      RG_ITEM(GL_TEXTURE_BINDING_2D_ARRAY),
                                      RG_ITEM(GL_TEXTURE_BINDING_RECTANGLE),
                                      RG_ITEM(GL_TEXTURE_BINDING_CUBE_MAP),
                                      RG_ITEM(GL_TEXTURE_BINDING_CUBE_MAP_ARRAY),
                                      RG_ITEM(GL_TEXTURE_BINDING_BUFFER),
                                      RG_ITEM(GL_TEXTURE_BINDING_2D_MULTISAMPLE),
                                      RG_ITEM(GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY),
                                      RG_ITEM(GL_SAMPLER_BINDING)};

// Indexed state and how many indices are looked at: all that GL 4.5 promises, or well above what the plugin
// uses.
struct Indexed {
  Item item;
  GLuint indices;
};
constexpr std::array kIndexedIntegers{Indexed{RG_ITEM(GL_UNIFORM_BUFFER_BINDING), 24},
                                      Indexed{RG_ITEM(GL_UNIFORM_BUFFER_START), 24},
                                      Indexed{RG_ITEM(GL_UNIFORM_BUFFER_SIZE), 24},
                                      Indexed{RG_ITEM(GL_SHADER_STORAGE_BUFFER_BINDING), 8},
                                      Indexed{RG_ITEM(GL_SHADER_STORAGE_BUFFER_START), 8},
                                      Indexed{RG_ITEM(GL_SHADER_STORAGE_BUFFER_SIZE), 8},
                                      Indexed{RG_ITEM(GL_ATOMIC_COUNTER_BUFFER_BINDING), 1},
                                      Indexed{RG_ITEM(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING), 4},
                                      Indexed{RG_ITEM(GL_IMAGE_BINDING_NAME), 8},
                                      Indexed{RG_ITEM(GL_IMAGE_BINDING_LEVEL), 8},
                                      Indexed{RG_ITEM(GL_IMAGE_BINDING_LAYERED), 8},
                                      Indexed{RG_ITEM(GL_IMAGE_BINDING_LAYER), 8},
                                      Indexed{RG_ITEM(GL_IMAGE_BINDING_ACCESS), 8},
                                      Indexed{RG_ITEM(GL_IMAGE_BINDING_FORMAT), 8},
                                      Indexed{RG_ITEM(GL_BLEND_SRC_RGB), 8},
                                      Indexed{RG_ITEM(GL_BLEND_DST_RGB), 8},
                                      Indexed{RG_ITEM(GL_BLEND_SRC_ALPHA), 8},
                                      Indexed{RG_ITEM(GL_BLEND_DST_ALPHA), 8},
                                      Indexed{RG_ITEM(GL_BLEND_EQUATION_RGB), 8},
                                      Indexed{RG_ITEM(GL_BLEND_EQUATION_ALPHA), 8},
                                      Indexed{RG_ITEMS(GL_COLOR_WRITEMASK, 4), 8},
                                      Indexed{RG_ITEM(GL_SAMPLE_MASK_VALUE), 1},
                                      Indexed{RG_ITEMS(GL_SCISSOR_BOX, 4), 16}};
constexpr std::array kIndexedDoubles{Indexed{RG_ITEMS(GL_VIEWPORT, 4), 16},
                                     Indexed{RG_ITEMS(GL_DEPTH_RANGE, 2), 16}};

std::string indexed(const char* name, GLuint index) {
  return std::string(name) + "[" + std::to_string(index) + "]";
}

class Taker {
 public:
  Taker(const GladGLContext& context, Profile profile) : gl(context), profile_(profile) {}

  Snapshot take() {
    switches(kSwitches);
    numbers(kNumbers);
    indexedState();
    vertexAttributes();
    textures();
    if (profile_ == Profile::kCompatibility) compatibility();
    return std::move(snapshot);
  }

 private:
  template <size_t N>
  void switches(const std::array<Item, N>& items) {
    for (const Item& item : items) snapshot[item.text] = {static_cast<double>(gl.IsEnabled(item.name))};
  }

  template <size_t N>
  void numbers(const std::array<Item, N>& items) {
    for (const Item& item : items) {
      std::array<double, 16> values{};
      gl.GetDoublev(item.name, values.data());
      const size_t count =
          item.name == GL_POLYGON_MODE ? 2 : item.count;  // front and back, where the profile has both
      snapshot[item.text].assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
    }
  }

  void indexedState() {
    for (const Indexed& entry : kIndexedIntegers) {
      for (GLuint i = 0; i < entry.indices; ++i) {
        std::array<GLint64, 4> values{};
        gl.GetInteger64i_v(entry.item.name, i, values.data());
        auto& kept = snapshot[indexed(entry.item.text, i)];
        for (size_t k = 0; k < entry.item.count; ++k) kept.push_back(static_cast<double>(values[k]));
      }
    }
    for (const Indexed& entry : kIndexedDoubles) {
      for (GLuint i = 0; i < entry.indices; ++i) {
        std::array<double, 4> values{};
        gl.GetDoublei_v(entry.item.name, i, values.data());
        snapshot[indexed(entry.item.text, i)].assign(
            values.begin(), values.begin() + static_cast<std::ptrdiff_t>(entry.item.count));
      }
    }
    for (GLuint i = 0; i < 8; ++i)
      snapshot[indexed("BLEND", i)] = {static_cast<double>(gl.IsEnabledi(GL_BLEND, i))};
    for (GLuint i = 0; i < 16; ++i)
      snapshot[indexed("SCISSOR_TEST", i)] = {static_cast<double>(gl.IsEnabledi(GL_SCISSOR_TEST, i))};
  }

  // Of the vertex array that is bound, and the current values. Attribute 0 has no current value in the
  // compatibility profile.
  void vertexAttributes() {
    for (GLuint i = 1; i < 16; ++i) {
      std::array<double, 4> current{};
      gl.GetVertexAttribdv(i, GL_CURRENT_VERTEX_ATTRIB, current.data());
      snapshot[indexed("CURRENT_VERTEX_ATTRIB", i)].assign(current.begin(), current.end());
    }
    for (GLuint i = 0; i < 16; ++i) {
      GLint enabled = 0, buffer = 0, divisor = 0;
      gl.GetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled);
      gl.GetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &buffer);
      gl.GetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_DIVISOR, &divisor);
      snapshot[indexed("VERTEX_ATTRIB", i)] = {static_cast<double>(enabled), static_cast<double>(buffer),
                                               static_cast<double>(divisor)};
    }
  }

  void textures() {
    GLint active = 0;
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint unit = 0; unit < 32; ++unit) {
      gl.ActiveTexture(GL_TEXTURE0 + unit);
      for (const Item& item : kTextureBindings) {
        GLint name = 0;
        gl.GetIntegerv(item.name, &name);
        snapshot[indexed(item.text, unit)] = {static_cast<double>(name)};
      }
    }
    gl.ActiveTexture(static_cast<GLenum>(active));
  }

  void compatibility() {
    switches(kCompatibilitySwitches);
    numbers(kCompatibilityNumbers);
  }

  const GladGLContext& gl;
  Profile profile_;
  Snapshot snapshot;
};

void print(std::ostream& out, const std::vector<double>& values) {
  for (const double value : values) out << ' ' << value;
}

}  // namespace

Snapshot takeSnapshot(const GladGLContext& gl, Profile profile) { return Taker(gl, profile).take(); }

std::string difference(const Snapshot& before, const Snapshot& after) {
  std::ostringstream out;
  for (const auto& [name, values] : before) {
    const auto found = after.find(name);
    if (found != after.end() && found->second == values) continue;
    out << name << ':';
    print(out, values);
    out << " ->";
    if (found != after.end()) print(out, found->second);
    out << '\n';
  }
  return out.str();
}

}  // namespace rg::test
