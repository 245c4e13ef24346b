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

constexpr uint32_t partsOf(uint32_t slots) { return (slots + shared::kRainPart - 1) / shared::kRainPart; }

// Into how many draw commands of each sort streaks go on software GL, at most: enough for its threads to have
// alike to do.
constexpr uint32_t kSoftwareGroups = 8;

// The two triangles of each of a group's rectangles. Both begin with the first corner, whose flat values
// count.
std::vector<uint32_t> rectangles(uint32_t count) {
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < count; ++i) {
    for (const uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) indices.push_back(4 * i + corner);
  }
  return indices;
}

// How streaks are worked out and drawn, with flakes and stones among them or without.
struct Programs {
  Programs(const gl::Context& context, bool solids)
      : prepare(context.gl, {"rain/streak.comp"}, defines(solids, false, context.software)),
        tested(context.gl, {"rain/streak.vert", "rain/streak.frag"}, defines(solids, false, false)),
        soft(context.gl, {"rain/streak.vert", "rain/streak.frag"}, defines(solids, true, false)) {}
  static std::vector<std::string> defines(bool solids, bool soft_depth, bool software) {
    std::vector<std::string> result;
    if (solids) result.emplace_back("SOLIDS");
    if (soft_depth) result.emplace_back("SOFT_DEPTH");
    if (software) result.emplace_back("RG_SOFTWARE_GL");
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

}  // namespace

struct RainRenderer::Objects {
  Objects(const gl::Context& context, uint32_t capacity_drops);
  void scatterNow(std::span<const uint32_t> slots, std::span<const RainDrop> records);
  void scatterStaged();
  void stage(std::span<const uint32_t> slots, std::span<const RainDrop> records);
  void countSolids(std::span<const uint32_t> slots, std::span<const RainDrop> records);
  void drawStreaks(uint32_t slot_end, bool soft_depth);
  // Parts that a workgroup takes, of so many slots.
  uint32_t groupParts(uint32_t count) const {
    return software ? std::max(1u, (partsOf(count) + kSoftwareGroups - 1) / kSoftwareGroups) : 1;
  }
  uint32_t groupsOf(uint32_t count) const {
    const uint32_t parts = groupParts(count);
    return (partsOf(count) + parts - 1) / parts;
  }
  // Corners of the streaks of so many slots, and one that the very last reads in vain.
  size_t cornersOf(uint32_t count) const {
    const size_t rounded = size_t{partsOf(count) + kSoftwareGroups} * shared::kRainPart;
    return shared::kRainSlotCorners * rounded + 1;
  }

  const GladGLContext& gl;
  uint32_t capacity;
  bool software;
  Programs rain, all;
  gl::Program scatter;
  gl::Buffer records, slots, fresh, starts_of, classes, shelter, drawn, told, commands, line_commands,
      corners;
  gl::VertexArray vertices;
  bool lines;  // thin streaks are drawn as such
  Canvas canvas;
  Picture picture;
  bool drawable = false;
  uint32_t staged = 0;  // records in `fresh` that are not in their slots yet
  std::vector<uint32_t> starts, staged_slots;
  std::vector<RainDrop> staged_records;
  std::unique_ptr<StreakSetup> setup = std::make_unique<StreakSetup>();
  std::vector<uint32_t> last_write;  // by slot: which of an upload's records is the last for it
  std::vector<bool> solid;           // by slot: whether its record is a flake's or a stone's
  size_t solids = 0;
};

RainRenderer::Objects::Objects(const gl::Context& context, uint32_t capacity_drops)
    : gl(context.gl),
      capacity(capacity_drops),
      software(context.software),
      rain(context, false),
      all(context, true),
      scatter(gl, {"rain/scatter.comp"}),
      records(gl, size_t{capacity} * sizeof(RainDrop)),
      slots(gl, kBatch * sizeof(uint32_t)),
      fresh(gl, kBatch * sizeof(RainDrop)),
      starts_of(gl, (size_t{partsOf(capacity)} + 1) * sizeof(uint32_t)),
      classes(gl, sizeof(ClassBlock)),
      shelter(gl, sizeof(shared::RainShelter)),
      drawn(gl, cornersOf(capacity) * sizeof(shared::RainCorner), 0),
      told(gl, cornersOf(capacity) * sizeof(glm::vec4), 0),
      commands(gl, size_t{partsOf(capacity)} * sizeof(shared::RainCommand), 0),
      line_commands(gl, 2 * size_t{partsOf(capacity)} * sizeof(shared::RainLineCommand), 0),
      corners(gl, std::span<const uint32_t>(rectangles(groupParts(capacity) * shared::kRainPart))),
      vertices(gl),
      lines(drawsLines(context)),
      canvas(gl),
      last_write(capacity),
      solid(capacity) {
  records.zero();
  vertices.bindIndices(corners.name());
  using shared::RainCorner;
  vertices.bindBuffer(0, drawn.name(), 0, sizeof(RainCorner));
  vertices.bindBuffer(1, told.name(), 0, sizeof(glm::vec4));
  vertices.attribute(0, 0, 4, GL_FLOAT, offsetof(RainCorner, place));
  vertices.attribute(1, 0, 4, GL_FLOAT, offsetof(RainCorner, a));
  vertices.attribute(2, 0, 4, GL_FLOAT, sizeof(RainCorner) + offsetof(RainCorner, a));
  vertices.attribute(3, 1, 4, GL_FLOAT, sizeof(glm::vec4));
  vertices.attribute(4, 1, 4, GL_FLOAT, 0);
}

void RainRenderer::Objects::scatterNow(std::span<const uint32_t> to, std::span<const RainDrop> drops) {
  for (size_t first = 0; first < to.size(); first += kBatch) {
    const size_t count = std::min<size_t>(kBatch, to.size() - first);
    slots.write(0, to.subspan(first, count));
    fresh.write(0, drops.subspan(first, count));
    staged = static_cast<uint32_t>(count);
    scatterStaged();
  }
}

void RainRenderer::Objects::scatterStaged() {
  if (staged == 0) return;
  scatter.use();
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, records.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, slots.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, fresh.name());
  scatter.set(0, staged);
  gl.DispatchCompute((staged + 63) / 64, 1, 1);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                   GL_SHADER_STORAGE_BARRIER_BIT);
  staged = 0;
}

// For the next draw, whose workgroups put each what is theirs in its slots: a dispatch less, which on
// software GL costs the calling thread as much as a few hundred streaks.
void RainRenderer::Objects::stage(std::span<const uint32_t> to, std::span<const RainDrop> drops) {
  const uint32_t groups = groupsOf(picture.slot_end),
                 group_slots = groupParts(picture.slot_end) * shared::kRainPart;
  const auto groupOf = [&](uint32_t slot) { return std::min(slot / group_slots, groups - 1); };
  starts.assign(groups + 1, 0);
  for (const uint32_t slot : to) ++starts[groupOf(slot)];
  uint32_t end = 0;
  for (uint32_t& start : starts) start = end += start;
  staged_slots.resize(to.size());
  staged_records.resize(to.size());
  for (size_t i = to.size(); i-- > 0;) {
    const uint32_t place = --starts[groupOf(to[i])];
    staged_slots[place] = to[i];
    staged_records[place] = drops[i];
  }
  slots.write(0, std::span<const uint32_t>(staged_slots));
  fresh.write(0, std::span<const RainDrop>(staged_records));
  starts_of.write(0, std::span<const uint32_t>(starts));
  staged = end;
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
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, told.name());
  programs.prepare.use();
  programs.prepare.set(0, slot_end);
  programs.prepare.set(1, groupParts(slot_end));
  programs.prepare.set(2, lines ? 1 : 0);
  programs.prepare.set(3, staged > 0 ? 1 : 0);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, slots.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, fresh.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, starts_of.name());
  gl.DispatchCompute(groupsOf(slot_end), 1, 1);
  staged = 0;
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  (soft_depth ? programs.soft : programs.tested).use();
  gl.BindVertexArray(vertices.name());
  gl.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  const auto draws = static_cast<GLsizei>(groupsOf(slot_end));
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.name());
  gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, draws, 0);
  if (lines) {
    constexpr GLsizei kStride = 2 * sizeof(shared::RainLineCommand);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, line_commands.name());
    gl.LineWidth(shared::kRainThinLine_px);
    gl.MultiDrawArraysIndirect(GL_LINES, nullptr, draws, kStride);
    gl.LineWidth(shared::kRainLine_px);
    gl.MultiDrawArraysIndirect(GL_LINES, reinterpret_cast<const void*>(sizeof(shared::RainLineCommand)),
                               draws, kStride);
  }
  // The next draw's streaks do not overtake these, nor a new beginning the records that this one put in.
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

RainRenderer::RainRenderer(const gl::Context& context, uint32_t capacity)
    : objects_(std::make_unique<Objects>(context, capacity)) {}
RainRenderer::~RainRenderer() = default;

bool RainRenderer::uploadBinds(const Upload& upload) const {
  return (objects_->staged > 0 && !upload.whole) || upload.slots.size() > kBatch ||
         upload.picture.slot_end == 0;
}

void RainRenderer::upload(Upload& upload) {
  Objects& o = *objects_;
  if (upload.whole) {
    o.staged = 0;
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
  const auto slots = std::span<const uint32_t>(upload.slots).first(kept);
  const auto records = std::span<const RainDrop>(upload.records).first(kept);
  o.picture = upload.picture;
  o.scatterStaged();  // of an upload that was never drawn
  if (kept <= kBatch && o.picture.slot_end > 0)
    o.stage(slots, records);
  else
    o.scatterNow(slots, records);
  upload.slots.clear();
  upload.records.clear();
  upload.whole = false;
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
  for (gl::Buffer* buffer : {&o.records, &o.slots, &o.fresh, &o.starts_of, &o.classes, &o.shelter, &o.drawn,
                             &o.told, &o.commands, &o.line_commands, &o.corners})
    buffer->forget();
  o.vertices.forget();
  o.canvas.forget();
}

}  // namespace rg::rain
