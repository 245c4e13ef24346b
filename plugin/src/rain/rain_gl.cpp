#include "rain/rain_gl.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "gl/objects.h"
#include "gl/program.h"

namespace rg::rain {
namespace {

constexpr uint32_t kBatch = 1u << 15;  // records sent at once: 1 MiB

// As streak.vert's ClassBlock.
struct ClassBlock {
  std::array<shared::RainClass, kClasses> classes;
  shared::RainView view;
};

}  // namespace

struct RainRenderer::Objects {
  Objects(const gl::Context& context, uint32_t capacity_drops);
  void send(std::span<const uint32_t> slots, std::span<const RainDrop> records);

  const GladGLContext& gl;
  uint32_t capacity;
  gl::Program streak, scatter;
  gl::Buffer records, slots, fresh, classes, shelter;
  gl::VertexArray vertices;
  Canvas canvas;
  Picture picture;
  bool drawable = false;
  std::unique_ptr<StreakSetup> setup = std::make_unique<StreakSetup>();
  std::vector<uint32_t> last_write;  // by slot: which of an upload's records is the last for it
};

RainRenderer::Objects::Objects(const gl::Context& context, uint32_t capacity_drops)
    : gl(context.gl),
      capacity(capacity_drops),
      streak(gl, {"rain/streak.vert", "rain/streak.frag"}),
      scatter(gl, {"rain/scatter.comp"}),
      records(gl, size_t{capacity} * sizeof(RainDrop)),
      slots(gl, kBatch * sizeof(uint32_t)),
      fresh(gl, kBatch * sizeof(RainDrop)),
      classes(gl, sizeof(ClassBlock)),
      shelter(gl, sizeof(shared::RainShelter)),
      vertices(gl),
      canvas(gl),
      last_write(capacity) {
  records.zero();
  vertices.bindBuffer(0, records.name(), 0, sizeof(RainDrop), 1);
  vertices.integerAttribute(0, 0, 4, GL_INT, 0);
  vertices.integerAttribute(1, 0, 4, GL_UNSIGNED_INT, offsetof(RainDrop, fraction_z_class));
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
  setUpStreaks(o.picture, *draw.view, draw.time_ns, *o.setup);
  const ClassBlock block{o.setup->classes, o.setup->view};
  o.classes.write(0, &block, sizeof block);
  o.shelter.write(0, &o.setup->shelter, sizeof o.setup->shelter);
  o.canvas.begin(draw);
  o.streak.use();
  o.gl.BindVertexArray(o.vertices.name());
  o.gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, o.classes.name());
  o.gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, o.shelter.name());
  o.gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(o.picture.slot_end));
}

void RainRenderer::forget() {
  Objects& o = *objects_;
  o.streak.forget();
  o.scatter.forget();
  for (gl::Buffer* buffer : {&o.records, &o.slots, &o.fresh, &o.classes, &o.shelter}) buffer->forget();
  o.vertices.forget();
  o.canvas.forget();
}

}  // namespace rg::rain
