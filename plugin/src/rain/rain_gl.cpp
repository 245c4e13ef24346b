#include "rain/rain_gl.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "gl/objects.h"
#include "gl/program.h"
#include "rain/standing.h"
#include "shared/rain_drawn.glsl"

namespace rg::rain {
namespace {

constexpr uint32_t kBatch = 1u << 15;  // records sent at once: 1 MiB

// As streak.comp's ClassBlock.
struct ClassBlock {
  std::array<shared::RainClass, kClasses> classes;
  shared::RainView view;
};

constexpr uint32_t groupsOf(uint32_t slots) {
  return (slots + shared::kRainDrawnGroup - 1) / shared::kRainDrawnGroup;
}

// The two triangles of each of a group's rectangles. Both begin with the first corner, whose flat values
// count.
std::vector<uint32_t> rectangles() {
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < shared::kRainDrawnGroup; ++i) {
    for (const uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) indices.push_back(4 * i + corner);
  }
  return indices;
}

// How streaks are worked out and drawn, with flakes and stones among them or without.
struct Programs {
  Programs(const GladGLContext& gl, bool solids)
      : prepare(gl, {"rain/streak.comp"}, defines(solids, false)),
        tested(gl, {"rain/streak.vert", "rain/streak.frag"}, defines(solids, false)),
        soft(gl, {"rain/streak.vert", "rain/streak.frag"}, defines(solids, true)) {}
  static std::vector<std::string> defines(bool solids, bool soft_depth) {
    std::vector<std::string> result;
    if (solids) result.emplace_back("SOLIDS");
    if (soft_depth) result.emplace_back("SOFT_DEPTH");
    return result;
  }
  void forget() {
    for (gl::Program* program : {&prepare, &tested, &soft}) program->forget();
  }

  gl::Program prepare, tested, soft;  // to a depth buffer that is tested, or read
};

// Whether thin streaks are lines. On a GPU setup costs nothing, and each draws wide lines in its own way. In
// contexts from which all that is deprecated is gone lines may not be wide.
bool drawsLines(const gl::Context& context) {
  GLint flags = 0;
  std::array<GLfloat, 2> widths{};
  context.gl.GetIntegerv(GL_CONTEXT_FLAGS, &flags);
  context.gl.GetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, widths.data());
  return context.software && (static_cast<GLuint>(flags) & GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT) == 0 &&
         widths[1] >= shared::kRainLine_px;
}

// Corners of the streaks of so many slots, and one that the very last reads in vain.
size_t cornersOf(uint32_t slots) { return size_t{4} * groupsOf(slots) * shared::kRainDrawnGroup + 1; }

}  // namespace

struct RainRenderer::Objects {
  Objects(const gl::Context& context, uint32_t capacity_drops);
  void send(std::span<const uint32_t> slots, std::span<const RainDrop> records);
  void countSolids(std::span<const uint32_t> slots, std::span<const RainDrop> records);
  void drawStreaks(uint32_t slot_end, bool soft_depth);

  const GladGLContext& gl;
  uint32_t capacity;
  Programs rain, all;
  gl::Program scatter;
  gl::Buffer records, slots, fresh, classes, shelter, drawn, commands, line_commands, corners;
  gl::VertexArray vertices;
  bool lines;  // thin streaks are drawn as such
  Canvas canvas;
  Picture picture;
  bool drawable = false;
  std::unique_ptr<StreakSetup> setup = std::make_unique<StreakSetup>();
  std::vector<uint32_t> last_write;  // by slot: which of an upload's records is the last for it
  std::vector<bool> solid;           // by slot: whether its record is a flake's or a stone's
  size_t solids = 0;
};

RainRenderer::Objects::Objects(const gl::Context& context, uint32_t capacity_drops)
    : gl(context.gl),
      capacity(capacity_drops),
      rain(gl, false),
      all(gl, true),
      scatter(gl, {"rain/scatter.comp"}),
      records(gl, size_t{capacity} * sizeof(RainDrop)),
      slots(gl, kBatch * sizeof(uint32_t)),
      fresh(gl, kBatch * sizeof(RainDrop)),
      classes(gl, sizeof(ClassBlock)),
      shelter(gl, sizeof(shared::RainShelter)),
      drawn(gl, cornersOf(capacity) * sizeof(shared::RainCorner), 0),
      commands(gl, size_t{groupsOf(capacity)} * sizeof(shared::RainCommand), 0),
      line_commands(gl, size_t{groupsOf(capacity)} * sizeof(shared::RainLineCommand), 0),
      corners(gl, std::span<const uint32_t>(rectangles())),
      vertices(gl),
      lines(drawsLines(context)),
      canvas(gl),
      last_write(capacity),
      solid(capacity) {
  records.zero();
  vertices.bindIndices(corners.name());
  vertices.bindBuffer(0, drawn.name(), 0, sizeof(shared::RainCorner));
  using shared::RainCorner;
  const size_t next = sizeof(RainCorner);
  vertices.attribute(0, 0, 4, GL_FLOAT, offsetof(RainCorner, place));
  vertices.attribute(1, 0, 4, GL_FLOAT, offsetof(RainCorner, a));
  vertices.attribute(2, 0, 4, GL_FLOAT, next + offsetof(RainCorner, a));
  vertices.attribute(3, 0, 2, GL_FLOAT, next + offsetof(RainCorner, b));
  vertices.attribute(4, 0, 4, GL_FLOAT, offsetof(RainCorner, told));
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

// A particle that is gone counts until its slot is written or emptied.
void RainRenderer::Objects::countSolids(std::span<const uint32_t> to, std::span<const RainDrop> drops) {
  for (size_t i = 0; i < to.size(); ++i) {
    const uint32_t kind = shared::rainClassOf(drops[i]);
    const bool is_solid =
        drops[i].diameter_m > 0.0f && classLattices()[kind].drops.hydrometeor != Hydrometeor::kRain;
    if (is_solid == solid[to[i]]) continue;
    solid[to[i]] = is_solid;
    solids = is_solid ? solids + 1 : solids - 1;
  }
}

void RainRenderer::Objects::drawStreaks(uint32_t slot_end, bool soft_depth) {
  const Programs& programs = solids > 0 ? all : rain;
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, classes.name());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, shelter.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, records.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, drawn.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, commands.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, line_commands.name());
  programs.prepare.use();
  programs.prepare.set(0, slot_end);
  programs.prepare.set(1, lines ? shared::kRainLine_px : 0.0f);
  gl.DispatchCompute(groupsOf(slot_end), 1, 1);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  (soft_depth ? programs.soft : programs.tested).use();
  gl.BindVertexArray(vertices.name());
  gl.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  const auto draws = static_cast<GLsizei>(groupsOf(slot_end));
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.name());
  gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, draws, 0);
  if (lines) {
    gl.LineWidth(shared::kRainLine_px);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, line_commands.name());
    gl.MultiDrawArraysIndirect(GL_LINES, nullptr, draws, 0);
  }
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // the next draw's streaks do not overtake these
}

RainRenderer::RainRenderer(const gl::Context& context, uint32_t capacity)
    : objects_(std::make_unique<Objects>(context, capacity)) {}
RainRenderer::~RainRenderer() = default;

void RainRenderer::upload(Upload& upload) {
  Objects& o = *objects_;
  if (upload.whole) {
    o.records.zero();
    o.solid.assign(o.capacity, false);
    o.solids = 0;
  }
  // Several ticks may have written a slot; shader invocations come in no order, so only the last goes out.
  const auto count = static_cast<uint32_t>(upload.slots.size());
  for (uint32_t i = 0; i < count; ++i) o.last_write[upload.slots[i]] = i;
  uint32_t kept = 0;
  for (uint32_t i = 0; i < count; ++i) {
    if (o.last_write[upload.slots[i]] != i) continue;
    upload.slots[kept] = upload.slots[i];
    upload.records[kept++] = upload.records[i];
  }
  o.countSolids(std::span(upload.slots).first(kept), std::span(upload.records).first(kept));
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
  setUpStreaks(o.picture, *draw.view, draw.time_ns, *o.setup);
  const ClassBlock block{o.setup->classes, o.setup->view};
  o.classes.write(0, &block, sizeof block);
  o.shelter.write(0, &o.setup->shelter, sizeof o.setup->shelter);
  o.canvas.begin(draw);
  o.drawStreaks(o.picture.slot_end, Canvas::readsDepth(draw.target));
}

void RainRenderer::forget() {
  Objects& o = *objects_;
  o.rain.forget();
  o.all.forget();
  o.scatter.forget();
  for (gl::Buffer* buffer : {&o.records, &o.slots, &o.fresh, &o.classes, &o.shelter, &o.drawn, &o.commands,
                             &o.line_commands, &o.corners})
    buffer->forget();
  o.vertices.forget();
  o.canvas.forget();
}

}  // namespace rg::rain
