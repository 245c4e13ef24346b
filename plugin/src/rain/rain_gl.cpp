#include "rain/rain_gl.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gl/objects.h"
#include "gl/program.h"
#include "rain/region.h"
#include "shared/rain_drawn.glsl"
#include "shared/rain_look.glsl"

namespace rg::rain {
namespace {

using glm::dvec3, glm::vec3, glm::vec4;
using shared::RainLook;

constexpr uint32_t kBatch = 1u << 15;  // records sent at once: 1 MiB

// As streak.comp's ClassBlock.
struct ClassBlock {
  std::array<shared::RainClass, kClasses> classes;
  shared::RainView view;
};

constexpr uint32_t groupsOf(uint32_t slots) {
  return (slots + shared::kRainDrawnGroup - 1) / shared::kRainDrawnGroup;
}

// The two triangles of each of a group's streaks. Both end with the streak's first corner, whose flat values
// count.
std::vector<uint32_t> rectangles() {
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < shared::kRainDrawnGroup; ++i) {
    for (const uint32_t corner : {1u, 3u, 0u, 3u, 2u, 0u}) indices.push_back(4 * i + corner);
  }
  return indices;
}

// Corners of the streaks of so many slots, and one that the very last reads in vain.
size_t cornersOf(uint32_t slots) { return size_t{4} * groupsOf(slots) * shared::kRainDrawnGroup + 1; }

vec4 wide(const vec3& v) { return vec4(v, 0.0f); }

// The lamps nearest to the eye, seen from it.
uint32_t setLamps(std::span<const DropLamp> given, const dvec3& eye, RainLook& look) {
  std::vector<const DropLamp*> lamps;
  for (const DropLamp& lamp : given) lamps.push_back(&lamp);
  const size_t count = std::min<size_t>(lamps.size(), shared::kRainLamps);
  std::partial_sort(lamps.begin(), lamps.begin() + static_cast<std::ptrdiff_t>(count), lamps.end(),
                    [&](const DropLamp* a, const DropLamp* b) {
                      return glm::distance(a->position_m, eye) < glm::distance(b->position_m, eye);
                    });
  for (size_t i = 0; i < count; ++i) {
    look.lamps[i] = {vec4(vec3(lamps[i]->position_m - eye), lamps[i]->cos_inner),
                     vec4(lamps[i]->direction, lamps[i]->cos_outer), wide(lamps[i]->intensity)};
  }
  return static_cast<uint32_t>(count);
}

void setLight(const RainLighting& lighting, RainLook& look) {
  look.sky = wide(lighting.sky_radiance);
  look.ground = wide(lighting.ground_radiance);
  look.sun_direction = wide(lighting.sun_direction);
  look.sun_irradiance =
      wide(glm::length(lighting.sun_direction) > 0.0f ? lighting.sun_irradiance : vec3(0.0f));
}

void setView(const RainDraw& draw, RainLook& look) {
  const glm::dmat4& p = draw.view->clipFromEye;
  const glm::dmat3 eyeFromWorld(draw.view->eyeFromWorld);
  look.clipFromWorldAtEye = glm::mat4(p * glm::dmat4(eyeFromWorld));
  look.forward = wide(vec3(glm::transpose(eyeFromWorld) * dvec3(0, 0, -1)));
  look.viewport = vec4(draw.viewport_px);
  look.focal = vec4(0.5 * p[0][0] * draw.viewport_px.z, 0.5 * p[1][1] * draw.viewport_px.w, draw.gain,
                    draw.target.exposure);
  look.depth_rows = vec4(p[2][2], p[3][2], p[2][3], p[3][3]);
  look.zero_to_one = draw.view->clip_zero_to_one ? 1 : 0;
  look.srgb = draw.target.srgb ? 1 : 0;
}

uint32_t levelsOfCube(const GladGLContext& gl, GLuint cube) {
  if (cube == 0) return 0;
  GLint size = 0;
  gl.GetTextureLevelParameteriv(cube, 0, GL_TEXTURE_WIDTH, &size);
  return static_cast<uint32_t>(std::floor(std::log2(std::max(size, 1)))) + 1;
}

}  // namespace

struct RainRenderer::Objects {
  Objects(const gl::Context& context, uint32_t capacity_drops);
  void send(std::span<const uint32_t> slots, std::span<const RainDrop> records);
  void bindTarget(const RainTarget& target, bool soft_depth);
  void setDrawState(const RainDraw& draw, bool soft_depth);
  void drawStreaks(uint32_t slot_end);

  const GladGLContext& gl;
  uint32_t capacity;
  gl::Program prepare, streak, scatter;
  gl::Buffer records, slots, fresh, classes, shelter, look, drawn, commands, corners;
  gl::VertexArray vertices;
  gl::Sampler nearest, mipmapped;
  gl::Framebuffer colour_only;
  GLuint colour_attached = 0;
  Picture picture;
  bool drawable = false;
  std::unique_ptr<StreakSetup> setup = std::make_unique<StreakSetup>();
  std::unique_ptr<RainLook> look_block = std::make_unique<RainLook>();
  std::vector<uint32_t> last_write;  // by slot: which of an upload's records is the last for it
};

RainRenderer::Objects::Objects(const gl::Context& context, uint32_t capacity_drops)
    : gl(context.gl),
      capacity(capacity_drops),
      prepare(gl, {"rain/streak.comp"}),
      streak(gl, {"rain/streak.vert", "rain/streak.frag"}),
      scatter(gl, {"rain/scatter.comp"}),
      records(gl, size_t{capacity} * sizeof(RainDrop)),
      slots(gl, kBatch * sizeof(uint32_t)),
      fresh(gl, kBatch * sizeof(RainDrop)),
      classes(gl, sizeof(ClassBlock)),
      shelter(gl, sizeof(shared::RainShelter)),
      look(gl, sizeof(RainLook)),
      drawn(gl, cornersOf(capacity) * sizeof(shared::RainCorner), 0),
      commands(gl, size_t{groupsOf(capacity)} * sizeof(shared::RainCommand), 0),
      corners(gl, std::span<const uint32_t>(rectangles())),
      vertices(gl),
      nearest(gl, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE),
      mipmapped(gl, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE),
      colour_only(gl),
      last_write(capacity) {
  records.zero();
  vertices.bindIndices(corners.name());
  vertices.bindBuffer(0, drawn.name(), 0, sizeof(shared::RainCorner));
  vertices.attribute(0, 0, 4, GL_FLOAT, offsetof(shared::RainCorner, place));
  vertices.attribute(1, 0, 4, GL_FLOAT, offsetof(shared::RainCorner, seen));
  vertices.attribute(2, 0, 4, GL_FLOAT, offsetof(shared::RainCorner, told));
  vertices.attribute(3, 0, 4, GL_FLOAT, sizeof(shared::RainCorner) + offsetof(shared::RainCorner, told));
}

void RainRenderer::Objects::send(std::span<const uint32_t> to, std::span<const RainDrop> drops) {
  slots.write(0, to);
  fresh.write(0, drops);
  scatter.use();
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, records.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, slots.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, fresh.name());
  const auto count = static_cast<uint32_t>(to.size());
  scatter.set(0, count);
  gl.DispatchCompute((count + 63) / 64, 1, 1);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                   GL_SHADER_STORAGE_BARRIER_BIT);
}

// With the depth buffer read in the shader it must not be attached: the host's colour goes on a framebuffer
// of ours.
void RainRenderer::Objects::bindTarget(const RainTarget& target, bool soft_depth) {
  if (!soft_depth) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    return;
  }
  colour_only.attachColor(0, target.color_texture);
  colour_only.drawColors(1);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, colour_only.name());
}

void RainRenderer::Objects::setDrawState(const RainDraw& draw, bool soft_depth) {
  const glm::ivec4& v = draw.viewport_px;
  gl.ViewportIndexedf(0, static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
                      static_cast<float>(v.w));
  gl.ClipControl(GL_LOWER_LEFT, draw.view->clip_zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  gl.Enablei(GL_BLEND, 0);
  gl.BlendEquationSeparatei(0, GL_FUNC_ADD, GL_FUNC_ADD);
  gl.BlendFuncSeparatei(0, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO,
                        GL_ONE);  // the target's alpha is the host's
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_DEPTH_CLAMP);  // the host's near plane does not cut drops
  gl.DepthMask(GL_FALSE);
  if (soft_depth) {
    gl.Disable(GL_DEPTH_TEST);
    gl.BindTextureUnit(0, draw.target.depth_texture);
    gl.BindSampler(0, nearest.name());
  } else {
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(draw.view->reversed_depth ? GL_GEQUAL : GL_LEQUAL);
  }
  if (draw.target.color_texture != 0) {
    // Read before the streaks are drawn, not while they are.
    gl.BindTextureUnit(2, draw.target.color_texture);
    gl.BindSampler(2, nearest.name());
  }
  if (draw.lighting.environment_cube != 0) {
    gl.BindTextureUnit(1, draw.lighting.environment_cube);
    gl.BindSampler(1, mipmapped.name());
  }
}

void RainRenderer::Objects::drawStreaks(uint32_t slot_end) {
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, classes.name());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, shelter.name());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 2, look.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, records.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, drawn.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, commands.name());
  prepare.use();
  prepare.set(0, slot_end);
  gl.DispatchCompute(groupsOf(slot_end), 1, 1);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  streak.use();
  gl.BindVertexArray(vertices.name());
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.name());
  gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                               static_cast<GLsizei>(groupsOf(slot_end)), 0);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // the next draw's streaks do not overtake these
}

RainRenderer::RainRenderer(const gl::Context& context, uint32_t capacity)
    : objects_(std::make_unique<Objects>(context, capacity)) {}
RainRenderer::~RainRenderer() = default;

void RainRenderer::upload(Upload& upload) {
  Objects& o = *objects_;
  if (upload.whole) o.records.zero();
  // Several ticks may have written a slot; shader invocations come in no order, so only the last goes out.
  const auto count = static_cast<uint32_t>(upload.slots.size());
  for (uint32_t i = 0; i < count; ++i) o.last_write[upload.slots[i]] = i;
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; ++i) {
    if (o.last_write[upload.slots[i]] != i) continue;
    upload.slots[kept] = upload.slots[i];
    upload.records[kept++] = upload.records[i];
  }
  for (uint32_t first = 0; first < kept; first += kBatch) {
    const uint32_t size = std::min(kBatch, kept - first);
    o.send(std::span(upload.slots).subspan(first, size), std::span(upload.records).subspan(first, size));
  }
  upload.slots.clear();
  upload.records.clear();
  upload.whole = false;
  o.picture = upload.picture;
  o.drawable = true;
}

void RainRenderer::draw(const RainDraw& draw) {
  Objects& o = *objects_;
  if (!o.drawable || o.picture.slot_end == 0) return;
  const bool soft_depth = draw.target.color_texture != 0 && draw.target.depth_texture != 0;
  setUpStreaks(o.picture, *draw.view, draw.time_ns, *o.setup);
  const ClassBlock block{o.setup->classes, o.setup->view};
  o.classes.write(0, &block, sizeof block);
  o.shelter.write(0, &o.setup->shelter, sizeof o.setup->shelter);
  RainLook& look = *o.look_block;
  setView(draw, look);
  setLight(draw.lighting, look);
  look.lamp_count = setLamps(draw.lighting.lamps, coneOf(*draw.view).eye_m, look);
  look.soft_depth = soft_depth ? 1 : 0;
  look.colour_behind = draw.target.color_texture != 0 ? 1 : 0;
  look.environment = levelsOfCube(o.gl, draw.lighting.environment_cube);
  o.look.write(0, &look, sizeof look);

  o.bindTarget(draw.target, soft_depth);
  o.setDrawState(draw, soft_depth);
  o.drawStreaks(o.picture.slot_end);
}

void RainRenderer::forget() {
  Objects& o = *objects_;
  o.prepare.forget();
  o.streak.forget();
  o.scatter.forget();
  for (gl::Buffer* buffer :
       {&o.records, &o.slots, &o.fresh, &o.classes, &o.shelter, &o.look, &o.drawn, &o.commands, &o.corners})
    buffer->forget();
  o.vertices.forget();
  o.nearest.forget();
  o.mipmapped.forget();
  o.colour_only.forget();
}

}  // namespace rg::rain
