#include "surroundings/splashes_gl.h"

#include <array>
#include <cstddef>
#include <string>

#include "gl/objects.h"
#include "gl/program.h"
#include "shared/rain_drawn.glsl"

namespace rg::surroundings {
namespace {

using shared::kSplashGroup, shared::SplashJob, shared::SplashPoint;

constexpr GLint kJobCount = 0, kSplashCount = 1, kMost_px = 2;  // the kernel's uniforms

// To a depth buffer that is read, or tested.
struct Programs {
  Programs(const GladGLContext& gl, bool read_depth)
      : find(gl, {"surroundings/splash.comp"}, defines(read_depth)),
        show(gl, {"surroundings/splash.vert", "surroundings/splash.frag"}, defines(read_depth)) {}
  static std::vector<std::string> defines(bool read_depth) {
    if (!read_depth) return {};
    return {"READ_DEPTH"};
  }
  void forget() {
    find.forget();
    show.forget();
  }
  gl::Program find, show;
};

}  // namespace

struct SplashRenderer::Objects {
  explicit Objects(const gl::Context& context);
  void makeRoom(uint32_t groups);

  const GladGLContext& gl;
  Programs reading, testing;
  gl::Buffer block, shelter, jobs, starts, drawn, commands;
  gl::VertexArray vertices;
  rain::Canvas canvas;
  SplashPicture picture;
  SplashSetup setup;
  uint32_t groups = 0;   // that there is room for
  float most_px = 1.0f;  // a point's side
};

SplashRenderer::Objects::Objects(const gl::Context& context)
    : gl(context.gl),
      reading(gl, true),
      testing(gl, false),
      block(gl, sizeof(shared::SplashRain)),
      shelter(gl, sizeof(shared::RainShelter)),
      vertices(gl),
      canvas(gl) {
  std::array<float, 2> sizes_px{};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, sizes_px.data());
  most_px = sizes_px[1];
  vertices.attribute(0, 0, 4, GL_FLOAT, offsetof(SplashPoint, place));
  vertices.attribute(1, 0, 4, GL_FLOAT, offsetof(SplashPoint, a));
  vertices.attribute(2, 0, 4, GL_FLOAT, offsetof(SplashPoint, b));
  vertices.attribute(3, 0, 4, GL_FLOAT, offsetof(SplashPoint, c));
}

void SplashRenderer::Objects::makeRoom(uint32_t wanted) {
  const auto atLeast = [&](gl::Buffer& buffer, size_t bytes) {
    if (bytes > buffer.bytes()) buffer = gl::Buffer(gl, bytes + bytes / 2);
  };
  atLeast(jobs, setup.jobs.size() * sizeof(SplashJob));
  atLeast(starts, setup.starts.size() * sizeof(uint32_t));
  if (wanted <= groups) return;
  groups = wanted + wanted / 2;
  drawn = gl::Buffer(gl, size_t{kSplashGroup} * groups * sizeof(SplashPoint), 0);
  commands = gl::Buffer(gl, groups * sizeof(shared::RainLineCommand), 0);
  vertices.bindBuffer(0, drawn.name(), 0, sizeof(SplashPoint));
}

SplashRenderer::SplashRenderer(const gl::Context& context) : objects_(std::make_unique<Objects>(context)) {}
SplashRenderer::~SplashRenderer() = default;

void SplashRenderer::take(const SplashPicture& picture) { objects_->picture = picture; }

double SplashRenderer::draw(const rain::RainDraw& draw, const SplashLook& look) {
  Objects& o = *objects_;
  const bool reads = rain::Canvas::readsDepth(draw.target);
  if (!reads && !o.picture.ground_known) return 1.0;
  if (!setUpSplashes(o.picture, *draw.view, draw.time_ns, look, o.setup)) return 1.0;
  const uint32_t groups = (o.setup.count + kSplashGroup - 1) / kSplashGroup;
  o.makeRoom(groups);
  o.block.write(0, &o.setup.rain, sizeof o.setup.rain);
  o.shelter.write(0, &o.setup.shelter, sizeof o.setup.shelter);
  o.jobs.write(0, std::span<const SplashJob>(o.setup.jobs));
  o.starts.write(0, std::span<const uint32_t>(o.setup.starts));

  o.canvas.begin(draw);
  const GladGLContext& gl = o.gl;
  const Programs& programs = reads ? o.reading : o.testing;
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, o.block.name());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, o.shelter.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, o.jobs.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, o.drawn.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, o.commands.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, o.starts.name());
  programs.find.use();
  programs.find.set(kJobCount, static_cast<uint32_t>(o.setup.jobs.size()));
  programs.find.set(kSplashCount, o.setup.count);
  programs.find.set(kMost_px, o.most_px);
  gl.DispatchCompute(groups, 1, 1);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  programs.show.use();
  gl.BindVertexArray(o.vertices.name());
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, o.commands.name());
  // Points are not cut off at the viewport.
  const glm::ivec4& viewport = draw.viewport_px;
  gl.ScissorIndexed(0, viewport.x, viewport.y, viewport.z, viewport.w);
  gl.Enablei(GL_SCISSOR_TEST, 0);
  gl.MultiDrawArraysIndirect(GL_POINTS, nullptr, static_cast<GLsizei>(groups), 0);
  gl.Disablei(GL_SCISSOR_TEST, 0);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // the next draw's splashes do not overtake these
  return o.setup.kept;
}

void SplashRenderer::forget() {
  Objects& o = *objects_;
  o.reading.forget();
  o.testing.forget();
  for (gl::Buffer* buffer : {&o.block, &o.shelter, &o.jobs, &o.starts, &o.drawn, &o.commands})
    buffer->forget();
  o.vertices.forget();
  o.canvas.forget();
}

}  // namespace rg::surroundings
