#include "render/painter.h"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>

namespace host {
namespace {

constexpr std::size_t kLampsPerDraw = 16;
constexpr float kDepthFirst_m = 40.0F;  // beyond, parts are small and hide little of each other
constexpr std::size_t kGridsPerDraw = 2;
constexpr std::size_t kAirShelters = 6;  // as in air.glsl

constexpr std::array<std::pair<unsigned, const char*>, 11> kNames = {{{kBaseMap, "BASE_MAP"},
                                                                      {kRoughnessMap, "ROUGHNESS_MAP"},
                                                                      {kNormalMap, "NORMAL_MAP"},
                                                                      {kGlowMap, "GLOW_MAP"},
                                                                      {kMask, "MASK"},
                                                                      {kBlend, "BLEND"},
                                                                      {kGlossy, "GLOSSY"},
                                                                      {kShelter, "SHELTER"},
                                                                      {kSun, "SUN"},
                                                                      {kMirror, "MIRROR"},
                                                                      {kCarAbove, "CAR_ABOVE"}}};

/// To 0 .. 1 in its box from what is relative to the eye.
glm::dmat4 boxFromRel(const PlacedGrid& placed, glm::dvec3 eye_m) {
  glm::dmat4 box_from_rel = placed.box_from_world;
  box_from_rel[3] = box_from_rel * glm::dvec4(eye_m, 1.0);
  return box_from_rel;
}

/// An item's bounds in a shelter's box.
struct Bounds {
  glm::vec3 low, high;
};
Bounds boundsIn(const glm::dmat4& box_from_rel, const DrawItem& item) {
  const glm::vec3 middle(box_from_rel * glm::dvec4(item.middle, 1.0));
  const glm::mat3 m{glm::dmat3(box_from_rel)};
  const glm::vec3 half =
      glm::abs(m[0]) * item.half.x + glm::abs(m[1]) * item.half.y + glm::abs(m[2]) * item.half.z;
  return {middle - half, middle + half};
}

bool meetsBox(const Bounds& bounds) {
  return glm::all(glm::lessThan(bounds.low, glm::vec3(1.0F))) &&
         glm::all(glm::greaterThan(bounds.high, glm::vec3(0.0F)));
}

bool overlaps(const PlacedGrid& placed, const DrawItem& item, glm::dvec3 eye_m) {
  return meetsBox(boundsIn(boxFromRel(placed, eye_m), item));
}

/// Whether the way from the eye to some part of it may lead through.
bool liesOnTheWay(const PlacedGrid& placed, const DrawItem& item, glm::dvec3 eye_m) {
  const glm::dmat4 box_from_rel = boxFromRel(placed, eye_m);
  const glm::vec3 eye(box_from_rel[3]);
  const auto [low, high] = boundsIn(box_from_rel, item);
  return meetsBox({glm::min(low, eye), glm::max(high, eye)});
}

}  // namespace

Painter::Painter(const GladGLContext& gl)
    : gl_(gl), depth_(gl, {"frame.glsl", "depth.vert"}, {"depth.frag"}) {
  gl.CreateBuffers(1, &frame_buffer_);
  gl.NamedBufferStorage(frame_buffer_, sizeof(FrameBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

Painter::~Painter() { gl_.DeleteBuffers(1, &frame_buffer_); }

const Program& Painter::program(unsigned features) {
  std::unique_ptr<Program>& found = programs_[features];
  if (!found) {
    std::vector<std::string> defines;
    for (const auto& [feature, name] : kNames) {
      if (features & feature) defines.emplace_back(name);
    }
    found = std::make_unique<Program>(
        gl_, std::initializer_list<const char*>{"frame.glsl", "scene.vert"},
        std::initializer_list<const char*>{"frame.glsl", "air.glsl", "scene.frag"}, defines);
  }
  return *found;
}

void Painter::setFrame(const FrameBlock& frame, glm::dvec3 eye_m, std::span<const LampNow> lamps,
                       std::span<const PlacedGrid> grids, const FrameTextures& textures) {
  frame_ = frame;
  eye_m_ = eye_m;
  grids_ = grids;
  lamps_.clear();
  for (const LampNow& lamp : lamps.first(std::min<std::size_t>(lamps.size(), kMaxLamps))) {
    const std::size_t i = lamps_.size();
    const LampAt at{glm::vec3(lamp.position_m - eye_m), lampReach(lamp)};
    frame_.lamp_place[i] = glm::vec4(at.place, 1.0F / (at.reach_m * at.reach_m));
    frame_.lamp_aim[i] = glm::vec4(lamp.direction, lamp.cos_outer);
    frame_.lamp_intensity[i] = glm::vec4(
        lamp.intensity, lamp.low_beam             ? -1.0F
                        : lamp.cos_outer <= -1.0F ? 1e6F
                                                  : 1.0F / std::max(lamp.cos_inner - lamp.cos_outer, 1e-3F));
    lamps_.push_back(at);
  }
  gl_.NamedBufferSubData(frame_buffer_, 0, sizeof(FrameBlock), &frame_);
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer_);
  gl_.BindTextureUnit(4, textures.mirrored);
  gl_.BindTextureUnit(5, textures.shadow);
  gl_.BindTextureUnit(8, textures.mirror_picture);
}

bool Painter::underCar(const DrawItem& item) const {
  if (frame_.car.w <= 0.0F) return false;
  const glm::vec3 at(frame_.car_from_rel * glm::vec4(item.middle, 1.0F));
  return glm::length(glm::max(
             glm::abs(item.middle - glm::vec3(glm::inverse(frame_.car_from_rel)[3])) - item.half, 0.0F)) <
             6.0F &&
         at.z < 60.0F;
}

unsigned Painter::featuresOf(const DrawItem& item, bool sheltered) const {
  unsigned features = item.material().features;
  const bool road = item.instance->scene->frame == SceneFrame::Road;
  if (frame_.air.x * item.material().film > 0.0F)
    features |= kGlossy | (frame_.screen.z > 0.0F ? kMirror : 0U);
  if (road && underCar(item)) features |= kCarAbove;
  if (sheltered) features |= kShelter;
  if (frame_.to_sun.w > 0.0F) features |= kSun;
  return features;
}

Painter::Grids Painter::gridsOf(const DrawItem& item) const {
  Grids found;
  for (const PlacedGrid& placed : grids_) {
    // A car's cabin is its own; a road's tunnel darkens the car as a whole (Instance::open).
    if (placed.owner == item.instance && found.size() < kGridsPerDraw && overlaps(placed, item, eye_m_))
      found.push_back(&placed);
  }
  return found;
}

/// Shelters that the eye sees an item through. Others' cabins are too small to count.
Painter::Grids Painter::airOf(const DrawItem& item) const {
  Grids found;
  for (const PlacedGrid& placed : grids_) {
    const bool counts = placed.owner == item.instance || placed.owner->scene->frame == SceneFrame::Road;
    if (counts && found.size() < kAirShelters && liesOnTheWay(placed, item, eye_m_)) found.push_back(&placed);
  }
  return found;
}

void Painter::setAir(const Program& program, const Grids& air) const {
  std::array<glm::mat4, kAirShelters> from_rel{};
  std::array<float, kAirShelters> lit{};
  for (std::size_t i = 0; i < air.size(); ++i) {
    const SkyGrid& grid = air[i]->grid->grid;
    // Without the borders, in which the box fades into the open.
    const glm::vec3 within = 1.0F / (1.0F - 2.0F * grid.border);
    from_rel[i] = glm::scale(glm::mat4(1.0F), within) * glm::translate(glm::mat4(1.0F), -grid.border) *
                  glm::mat4(boxFromRel(*air[i], eye_m_));
    lit[i] = grid.lit;
  }
  const auto count = static_cast<GLsizei>(air.size());
  program.set("u_air_count", count);
  if (count == 0) return;
  gl_.ProgramUniformMatrix4fv(program.name(), program.location("u_air_from_rel"), count, GL_FALSE,
                              &from_rel[0][0][0]);
  gl_.ProgramUniform1fv(program.name(), program.location("u_air_lit"), count, lit.data());
}

void Painter::setMaterial(const Program& program, const DrawItem& item, unsigned features) const {
  const GpuMaterial& material = item.material();
  const int role = item.draw->role;
  const bool road = item.instance->scene->frame == SceneFrame::Road;
  const Placement& placement = item.instance->placement;
  const float level = role < 0       ? (material.glow_map != 0 || !road ? placement.display_level : 1.0F)
                      : lamps_shown_ ? placement.lamp_levels[static_cast<std::size_t>(role)]
                                     : 0.0F;
  program.set("u_base", material.base);
  program.set("u_surface", material.surface);
  program.set("u_glow", material.glow * level);
  program.set("u_wet", road ? glm::vec2(1.0F, material.film) : glm::vec2(0.0F));
  program.set("u_open", item.instance->open);
  program.set("u_roofed", road ? 0.0F : 1.0F);
  if (features & kBaseMap) gl_.BindTextureUnit(0, material.base_map);
  if (features & kRoughnessMap) gl_.BindTextureUnit(1, material.roughness_map);
  if (features & kNormalMap) gl_.BindTextureUnit(2, material.normal_map);
  if (features & kGlowMap) gl_.BindTextureUnit(3, material.glow_map);
}

Painter::Lamps Painter::lampsOf(const DrawItem& item) const {
  Lamps found;
  for (std::size_t i = 0; i < lamps_.size() && found.size() < kLampsPerDraw; ++i) {
    const glm::vec3 off = glm::max(glm::abs(lamps_[i].place - item.middle) - item.half, 0.0F);
    if (glm::dot(off, off) < lamps_[i].reach_m * lamps_[i].reach_m) found.push_back(static_cast<GLint>(i));
  }
  return found;
}

void Painter::setLamps(const Program& program, const Lamps& lamps) const {
  std::array<GLint, kLampsPerDraw> chosen{};
  std::copy(lamps.begin(), lamps.end(), chosen.begin());
  program.set("u_lamp_count", static_cast<int>(lamps.size()));
  if (!lamps.empty())
    gl_.ProgramUniform4iv(program.name(), program.location("u_lamps"), kLampsPerDraw / 4, chosen.data());
}

void Painter::setGrids(const Program& program, const Grids& grids) const {
  std::array<glm::mat4, kGridsPerDraw> grid_from_rel{};
  std::array<glm::vec4, kGridsPerDraw> shape{};
  std::array<float, kGridsPerDraw> dry{};
  for (std::size_t i = 0; i < grids.size(); ++i) {
    grid_from_rel[i] = glm::mat4(boxFromRel(*grids[i], eye_m_));
    shape[i] = glm::vec4(grids[i]->grid->grid.border, grids[i]->grid->grid.probe_step_m);
    dry[i] = 1.0F;
    gl_.BindTextureUnit(6 + static_cast<GLuint>(i), grids[i]->grid->texture);
  }
  const auto count = static_cast<GLsizei>(grids.size());
  gl_.ProgramUniformMatrix4fv(program.name(), program.location("u_grid_from_rel"), count, GL_FALSE,
                              &grid_from_rel[0][0][0]);
  gl_.ProgramUniform4fv(program.name(), program.location("u_grid"), count, &shape[0][0]);
  gl_.ProgramUniform1fv(program.name(), program.location("u_dry"), count, dry.data());
  program.set("u_grid_count", count);
}

/// How many of the first items can be drawn by one call: the same body and material, seen through the same
/// `air`, without lamps and shelters of their own.
std::size_t Painter::alike(std::span<const DrawItem> items, const Grids& air) const {
  const DrawItem& first = items.front();
  std::size_t count = 1;
  while (count < items.size()) {
    const DrawItem& next = items[count];
    const bool same = next.instance == first.instance && next.draw->body == first.draw->body &&
                      next.draw->material == first.draw->material && next.draw->role == first.draw->role;
    if (!same || !gridsOf(next).empty() || !lampsOf(next).empty() || airOf(next) != air) break;
    ++count;
  }
  return count;
}

void Painter::setState(const DrawItem& item, const Grids& grids, const Lamps& lamps, const Grids& air) {
  const unsigned features = featuresOf(item, !grids.empty());
  const Program& its = program(features);
  its.use();
  const bool blended = (features & kBlend) != 0;
  (blended ? gl_.Enable : gl_.Disable)(GL_BLEND);
  gl_.DepthFunc(features & (kBlend | kMask) ? GL_GREATER : GL_GEQUAL);
  (item.material().double_sided ? gl_.Disable : gl_.Enable)(GL_CULL_FACE);
  gl_.DepthMask(blended ? GL_FALSE : GL_TRUE);
  its.set("u_rel_from_body", item.rel_from_body);
  setMaterial(its, item, features);
  setLamps(its, lamps);
  setAir(its, air);
  if (!grids.empty()) setGrids(its, grids);
  gl_.BindVertexArray(item.instance->scene->vertex_array);
}

/// Solid parts' depth first: a surface that something hides is then not lit in vain, which on a software
/// renderer is most of the time.
void Painter::paintDepth(const DrawList& list) {
  depth_.use();
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.Enable(GL_CULL_FACE);
  gl_.Disable(GL_BLEND);
  for (const DrawItem& item : list.items()) {
    if (item.material().features & (kBlend | kMask)) break;
    if (item.distance_m > kDepthFirst_m) continue;
    (item.material().double_sided ? gl_.Disable : gl_.Enable)(GL_CULL_FACE);
    depth_.set("u_rel_from_body", item.rel_from_body);
    gl_.BindVertexArray(item.instance->scene->vertex_array);
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(item.draw->count), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(std::uintptr_t{item.draw->first} * sizeof(std::uint32_t)));
  }
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

Painted Painter::paint(const DrawList& list) {
  Painted painted;
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_GREATER);
  gl_.CullFace(GL_BACK);
  gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  paintDepth(list);
  std::span<const DrawItem> items = list.items();
  std::vector<GLsizei> counts;
  std::vector<const void*> firsts;
  while (!items.empty()) {
    const Grids grids = gridsOf(items.front());
    const Lamps lamps = lampsOf(items.front());
    const Grids air = airOf(items.front());
    const std::size_t together = grids.empty() && lamps.empty() ? alike(items, air) : 1;
    setState(items.front(), grids, lamps, air);
    counts.clear();
    firsts.clear();
    for (const DrawItem& item : items.first(together)) {
      counts.push_back(static_cast<GLsizei>(item.draw->count));
      firsts.push_back(
          reinterpret_cast<const void*>(std::uintptr_t{item.draw->first} * sizeof(std::uint32_t)));
      painted.triangles += item.draw->count / 3;
    }
    gl_.MultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, firsts.data(),
                          static_cast<GLsizei>(together));
    ++painted.draws;
    items = items.subspan(together);
  }
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_BLEND);
  return painted;
}

}  // namespace host
