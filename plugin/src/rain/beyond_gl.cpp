#include "rain/beyond_gl.h"

#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <string>

#include "gl/objects.h"
#include "gl/program.h"
#include "rain/beyond_tiles.h"

namespace rg::rain {
namespace {

using shared::RainTile;

constexpr int kLayers = 4;                        // with the haze
constexpr GLint kOnlyLayer = 0, kPixelLevel = 1;  // the shaders' uniforms
constexpr GLint kCount = 0;
constexpr GLuint kPatternUnit = 2;
constexpr size_t kFirstTiles = 1024;  // 1280 x 720

gl::Program programFor(const GladGLContext& gl, uint32_t volumes) {
  const std::string define = "VOLUMES " + std::to_string(volumes);
  return gl::Program(gl, {"rain/beyond.vert", "rain/beyond.frag"}, std::span(&define, 1));
}

}  // namespace

struct BeyondRenderer::Objects {
  explicit Objects(const gl::Context& context);
  void sendTiles();
  void cullTiles(float side_px);

  const GladGLContext& gl;
  std::array<gl::Program, kTileKinds.size()> programs;
  gl::Program cull;
  gl::Buffer block, shelter, tiles;
  gl::VertexArray vertices;
  gl::Sampler repeating;
  gl::Texture2D pattern;
  double pattern_mean = 1.0, pattern_greatest = 1.0;
  Canvas canvas;
  BeyondPicture picture;
  Tiler tiler;
  Tiles cut;
  std::unique_ptr<shared::RainShelter> volumes = std::make_unique<shared::RainShelter>();
};

BeyondRenderer::Objects::Objects(const gl::Context& context)
    : gl(context.gl),
      cull(gl, {"rain/beyond_cull.comp"}),
      block(gl, sizeof(shared::RainBeyond)),
      shelter(gl, sizeof(shared::RainShelter)),
      tiles(gl, kFirstTiles * sizeof(RainTile)),
      vertices(gl),
      repeating(gl, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_REPEAT),
      canvas(gl) {
  for (size_t kind = 0; kind < kTileKinds.size(); ++kind) programs[kind] = programFor(gl, kTileKinds[kind]);
  vertices.integerAttribute(0, 0, 4, GL_UNSIGNED_INT, offsetof(RainTile, place));
  for (GLuint i = 0; i < 4; ++i)
    vertices.integerAttribute(1 + i, 0, 4, GL_UNSIGNED_INT,
                              static_cast<GLuint>(offsetof(RainTile, bounds) + i * sizeof(glm::uvec4)));
}

void BeyondRenderer::Objects::sendTiles() {
  const size_t bytes = cut.tiles.size() * sizeof(RainTile);
  if (bytes > tiles.bytes()) tiles = gl::Buffer(gl, bytes);
  tiles.write(0, cut.tiles.data(), bytes);
  vertices.bindBuffer(0, tiles.name(), 0, sizeof(RainTile), 1);
}

void BeyondRenderer::Objects::cullTiles(float side_px) {
  const auto count = static_cast<uint32_t>(cut.tiles.size());
  cull.set(kCount, count);
  cull.use();
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, tiles.name());
  gl.DispatchCompute((count * static_cast<uint32_t>(side_px) + 63) / 64, 1, 1);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

BeyondRenderer::BeyondRenderer(const gl::Context& context) : objects_(std::make_unique<Objects>(context)) {}
BeyondRenderer::~BeyondRenderer() = default;

void BeyondRenderer::setPattern(const RainPattern& pattern) {
  Objects& o = *objects_;
  const auto width = static_cast<int>(pattern.width_px), height = static_cast<int>(pattern.height_px);
  o.pattern = gl::Texture2D(o.gl, GL_RGBA8, width, height, gl::fullMipLevels(width, height));
  o.pattern.write(0, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pattern.rgba.data());
  o.pattern.generateMipmaps();
  o.pattern_mean = pattern.mean;
  o.pattern_greatest = pattern.greatest;
}

void BeyondRenderer::take(const BeyondPicture& picture) { objects_->picture = picture; }

void BeyondRenderer::draw(const RainDraw& draw, const BeyondLook& look) {
  Objects& o = *objects_;
  if (!o.pattern) return;
  shared::RainBeyond block;
  if (!setUpBeyond(o.picture, *draw.view, draw.time_ns, look, static_cast<double>(draw.gain), o.pattern_mean,
                   o.pattern_greatest, block))
    return;
  // A pixel across the fall spans so many texels; along it the pattern is as fine or finer.
  for (glm::length_t layer = 0; layer < 3; ++layer)
    block.level[layer] =
        std::log2(block.repeats[layer] * static_cast<float>(o.pattern.width()) / glm::two_pi<float>());
  block.level.w = 0.0f;
  block.scroll.w = Tiler::tileSide_px(draw.viewport_px);
  const double after_s = static_cast<double>(draw.time_ns - o.picture.time_ns) * 1e-9;
  setUpShelter(o.picture.volumes, coneOf(*draw.view).eye_m, after_s, *o.volumes);
  o.tiler.cut(draw.viewport_px, block, *o.volumes, o.cut);
  o.block.write(0, &block, sizeof block);
  o.shelter.write(0, o.volumes.get(), sizeof *o.volumes);
  o.sendTiles();

  o.canvas.begin(draw);
  o.gl.BindVertexArray(o.vertices.name());
  o.gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, o.block.name());
  o.gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, o.shelter.name());
  o.gl.BindTextureUnit(kPatternUnit, o.pattern.name());
  o.gl.BindSampler(kPatternUnit, o.repeating.name());
  const bool at_once = Canvas::readsDepth(draw.target);
  if (at_once) o.cullTiles(block.scroll.w);
  for (int layer = at_once ? -1 : kLayers - 1; layer >= (at_once ? -1 : 0); --layer) {
    for (const TileRun& run : o.cut.runs) {
      const gl::Program& program = o.programs[run.kind];
      program.set(kOnlyLayer, layer);
      program.set(kPixelLevel, run.pixel_level);
      program.use();
      o.gl.DrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(run.count),
                                           run.first);
    }
  }
}

void BeyondRenderer::forget() {
  Objects& o = *objects_;
  for (gl::Program& program : o.programs) program.forget();
  o.cull.forget();
  for (gl::Buffer* buffer : {&o.block, &o.shelter, &o.tiles}) buffer->forget();
  o.vertices.forget();
  o.repeating.forget();
  o.pattern.forget();
  o.canvas.forget();
}

}  // namespace rg::rain
