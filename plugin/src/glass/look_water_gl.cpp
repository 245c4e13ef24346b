#include "glass/look_water_gl.h"

#include <glad/gl.h>

#include <array>

#include "shared/glass_tile.glsl"

namespace rg::glass {
namespace {

constexpr size_t kCellGroup = 64;  // of look_cells.comp and look_list.comp
constexpr size_t kTileGroup = 32;  // of look_kinds.comp
constexpr size_t kCellBytes = 8;
constexpr size_t kCommandBytes = 20;

enum MapUnit : GLuint { kFilmUnit = 2, kFrameUnit, kMetricUnit, kBeadUnit, kPositionUnit };
enum Binding : GLuint { kCells = 1, kTiles = 2, kPieces = 5, kLists = 6, kIndices = 7 };

glm::ivec2 tilesOf(const LookPane& pane) {
  return (pane.film_size + shared::kTileSize - 1) / shared::kTileSize;
}

// Contents are made anew each time.
void reserve(const GladGLContext& gl, gl::Buffer& buffer, size_t bytes) {
  if (buffer.bytes() < bytes) buffer = gl::Buffer(gl, bytes, 0);
}

}  // namespace

LookWater::LookWater(const GladGLContext& gl, LookPrograms& programs)
    : gl_(&gl),
      programs_(&programs),
      no_layout_(gl),
      exact_(gl, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE),
      smooth_(gl, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE),
      no_film_(gl, GL_R32I, 1, 1),
      no_beads_(gl, GL_R32UI, 1, 1),
      films_(gl, false),
      bead_maps_(gl, false),
      both_(gl) {
  no_film_.zero();
  no_beads_.zero();
  both_.drawColors(2);
}

void LookWater::prepare(const LookPane& pane, int film_reach) {
  bindMaps(pane);
  if (pane.piece_buffer != 0) sort(pane, film_reach);
  compose(pane);
  if (pane.film != 0 && pane.crater_count > 0) addCraters(pane);
}

void LookWater::bindMaps(const LookPane& pane) {
  const std::array<uint32_t, 5> maps{pane.film != 0 ? pane.film : no_film_.name(), pane.frame, pane.metric,
                                     pane.beads != 0 ? pane.beads : no_beads_.name(), pane.position};
  for (GLuint k = 0; k < maps.size(); ++k) {
    gl_->BindTextureUnit(kFilmUnit + k, maps[k]);
    gl_->BindSampler(kFilmUnit + k, exact_.name());
  }
  for (const GLuint unit : {kFrameUnit, kPositionUnit}) gl_->BindSampler(unit, smooth_.name());
}

void LookWater::sort(const LookPane& pane, int film_reach) {
  const glm::ivec2 tiles = tilesOf(pane);
  const auto tile_count = static_cast<size_t>(tiles.x) * static_cast<size_t>(tiles.y);
  const size_t cell_count = tile_count * shared::kCellsOfTile;
  reserve(*gl_, cells_, cell_count * kCellBytes);
  reserve(*gl_, tiles_, tile_count * sizeof(shared::SeenTile));
  reserve(*gl_, drawn_, static_cast<size_t>(pane.piece_index_count) * sizeof(uint32_t));
  reserve(*gl_, commands_, shared::kPieceLists * kCommandBytes);
  const auto run = [&](LookStage stage, size_t invocations, size_t group, uint32_t variant = kPlain) {
    programs_->use(stage, variant).set(0, tiles);
    gl_->DispatchCompute(static_cast<GLuint>((invocations + group - 1) / group), 1, 1);
    gl_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  const auto bind = [&](Binding binding, uint32_t buffer) {
    gl_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
  };
  bind(kCells, cells_.name());
  bind(kTiles, tiles_.name());
  bind(kPieces, pane.piece_buffer);
  bind(kLists, commands_.name());
  run(LookStage::cells, cell_count, kCellGroup, pane.blades.empty() ? kPlain : kRidges);
  programs_->use(LookStage::kinds).set(1, film_reach);
  run(LookStage::kinds, tile_count, kTileGroup);
  programs_->use(LookStage::sort).set(1, film_reach - 1);  // its surface is made of a texel's neighbours too
  run(LookStage::sort, 1, 1);
  bind(kIndices, pane.index_buffer);
  bind(kLists, drawn_.name());
  run(LookStage::list, cell_count, kCellGroup);
  gl_->MemoryBarrier(GL_ELEMENT_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

// Where nobody looks it stays dry.
void LookWater::compose(const LookPane& pane) {
  const glm::ivec2 tiles = tilesOf(pane), texels = pane.film_size;
  film_ = films_.ofSize(texels.x, texels.y).texture.name();
  beads_ = bead_maps_.ofSize(texels.x, texels.y).texture.name();
  both_.attachColor(0, film_);
  both_.attachColor(1, beads_);
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, both_.name());
  gl_->ViewportIndexedf(0, 0.0f, 0.0f, static_cast<float>(texels.x), static_cast<float>(texels.y));
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  gl_->Disablei(GL_SCISSOR_TEST, 0);
  for (GLuint k = 0; k < 2; ++k) gl_->Disablei(GL_BLEND, k);
  const std::array<float, 4> dry{};
  for (GLint k = 0; k < 2; ++k) gl_->ClearNamedFramebufferfv(both_.name(), GL_COLOR, k, dry.data());
  gl_->BindVertexArray(no_layout_.name());
  const gl::Program& program =
      programs_->use(LookStage::water, pane.piece_buffer != 0 ? kPlain : kEverywhere);
  program.set(0, tiles);
  program.set(2, texels);
  gl_->DrawArrays(GL_TRIANGLES, 0, 6 * tiles.x * tiles.y);
}

void LookWater::addCraters(const LookPane& pane) {
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER,
                       films_.ofSize(pane.film_size.x, pane.film_size.y).framebuffer.name());
  gl_->Enablei(GL_BLEND, 0);
  gl_->BlendEquationi(0, GL_FUNC_ADD);
  gl_->BlendFunci(0, GL_ONE, GL_ONE);
  gl_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, pane.crater_buffer);
  programs_->use(LookStage::craters);
  gl_->DrawArrays(GL_TRIANGLES, 0, 6 * pane.crater_count);
}

void LookWater::forget() {
  no_layout_.forget();
  exact_.forget();
  smooth_.forget();
  no_film_.forget();
  no_beads_.forget();
  films_.forget();
  bead_maps_.forget();
  both_.forget();
  for (gl::Buffer* buffer : {&cells_, &tiles_, &drawn_, &commands_}) buffer->forget();
}

}  // namespace rg::glass
