#include "glass/look_gl.h"

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "gl/objects.h"
#include "gl/program.h"
#include "glass/look_capture_gl.h"
#include "glass/look_fog_gl.h"
#include "glass/look_lamps_gl.h"
#include "glass/look_order.h"
#include "glass/look_picture_gl.h"
#include "glass/look_programs_gl.h"
#include "glass/look_water_gl.h"
#include "glass/pane_gl.h"
#include "glass/water.h"
#include "shared/glass_tile.glsl"

namespace rg::glass {
namespace {

constexpr int kMeshStride = 8 * sizeof(float);
constexpr size_t kSeenDropBytes = 160;  // shaders/optics/seen_drop.glsl
constexpr uintptr_t kArraysCommandBytes = 16;
constexpr int kPlaceGroup = 64;          // drops in a group of look_place.comp
constexpr float kCoarseTexel_px = 6.0f;  // a film of larger texels would show facets
constexpr float kFineRadius_px = 3.0f;
constexpr float kSteepestRidge_rad = 1.4f;

// Texels off which film is seen: its surface is a spline of the texel's neighbours, and is looked up between
// two texels or, where they are large, among four.
constexpr int kSmoothReach = 2, kCoarseReach = 3;
// Where it is seen out of focus, too, as far as cells can tell of each other: kFarthestPoint of
// look_pane.frag is two texels more than the smooth surface's.
constexpr int kSoftReach = shared::kCellSize;

enum Unit : GLuint { kPicture = 0, kSurroundings = 1, kFirst = 2, kSecond = 3, kThird = 4, kDepth = 5 };

// As in shaders/optics/look_frame.glsl (std140).
struct FrameBlock {
  glm::mat4 clip_from_eye, eye_from_vehicle, eye_from_world, world_from_vehicle;
  glm::vec4 eye_in_vehicle, sky_radiance, ground_radiance, viewport, depth_rows;
  glm::vec2 uv_per_m;
  float drop_age_s;
  int32_t drop_count;
  float exposure, pixels_per_rad, environment_texels_per_rad, cabin_share;
  float brightness, blur, fine_radius_px;
  uint32_t depth_seen;
  uint32_t internal_reflections, dry_reflection;
  float mirror, film_unit_m3;
  int32_t blade_count;
  float ridge_tan_contact;
  float bead_mm3_per_unit, bead_sine;
  float pupil_m;
  float unused[3];
  glm::vec4 sill;
  struct Blade {
    glm::vec4 middle_length, along_first, ahead;
  } blades[shared::kMaxGlassWipers];
};
static_assert(sizeof(FrameBlock) == 448 + 48 * shared::kMaxGlassWipers, "std140 lays it out so");

glm::mat4 rotationOf(const glm::dmat4& m) { return glm::mat4(glm::dmat4(glm::dmat3(m))); }

float texelsPerRadian(const GladGLContext& gl, uint32_t cube) {
  GLint size_px = 0;
  gl.GetTextureLevelParameteriv(cube, 0, GL_TEXTURE_WIDTH, &size_px);
  return static_cast<float>(size_px) / glm::half_pi<float>();
}

bool isWet(const LookPane& pane) { return pane.film != 0 || pane.beads != 0 || pane.drop_count > 0; }

}  // namespace

LookPane lookPaneOf(const PaneDrawn& d) {
  LookPane p;
  p.vertex_buffer = d.vertex_buffer;
  p.index_buffer = d.index_buffer;
  p.index_count = d.index_count;
  p.sill = d.sill;
  p.centre_m = d.centre_m;
  p.radius_m = d.radius_m;
  p.film_size = d.film_size;
  p.texel_m = d.texel_m;
  p.position = d.position;
  p.metric = d.metric;
  p.frame = d.frame;
  p.film = d.film;
  p.film_unit_m3 = d.film_unit_m3;
  p.beads = d.beads;
  if (d.bead_contact_rad > 0.0) p.bead_contact_rad = static_cast<float>(d.bead_contact_rad);
  p.drop_buffer = d.drop_buffer;
  p.drop_count = d.drop_count;
  p.crater_buffer = d.crater_buffer;
  p.crater_count = d.crater_count;
  p.piece_buffer = d.piece_buffer;
  p.piece_index_count = d.piece_index_count;
  p.ridge_buffer = d.ridge_buffer;
  p.ridge_contact_rad = static_cast<float>(d.advancing_rad);
  return p;
}

struct GlassLook::Parts {
  explicit Parts(const GladGLContext& context)
      : gl(context),
        programs(gl),
        frame_block(gl, sizeof(FrameBlock)),
        mesh_layout(gl),
        no_layout(gl),
        smooth(gl, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE),
        stepped(gl, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_CLAMP_TO_EDGE),
        mipped(gl, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE),
        exact(gl, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE),
        no_environment(gl, GL_RGBA16F, 1),
        no_film(gl, GL_RGBA16F, 1, 1),
        water(gl, programs),
        picture(gl, programs),
        layers(gl, true),
        layer(gl),
        capture(gl),
        lamps(gl, programs),
        fog(gl) {
    no_film.zero();
    mesh_layout.attribute(0, 0, 3, GL_FLOAT, 0);
    mesh_layout.attribute(1, 0, 3, GL_FLOAT, 3 * sizeof(float));
    mesh_layout.attribute(2, 0, 2, GL_FLOAT, 6 * sizeof(float));
  }

  void choose(LookVariant bit, bool on) {
    variant = on ? variant | bit : variant & ~static_cast<uint32_t>(bit);
  }
  void fillFrame(const LookPane& pane, const LookView& view, const LookTarget& target, const LookLight& light,
                 const LookSettings& settings);
  void bindLook(const LookLight& light, const LookTarget& target);
  void setState(const LookView& view, const LookTarget& target);
  void bindMesh(const LookPane& pane, uint32_t indices);
  void leaveMesh();
  void drawWater(const LookPane& pane, uint32_t parts);
  void drawInside(const LookPane& pane, uint32_t parts);
  void drawPieces(const LookPane& pane, uint32_t parts);
  void placeDrops(const LookPane& pane);
  void drawDrops();
  void drawUnsharp(const LookPane& pane, const LookView& view, const LookTarget& target);
  void drawFog(const LookPane& pane);
  void forget();
  uint32_t environmentOf(const LookLight& light) const {
    return capture.cube() != 0 ? capture.cube() : light.environment_cube;
  }

  const GladGLContext& gl;
  LookPrograms programs;
  gl::Buffer frame_block, seen_drops, drop_kinds, picked_drops, drop_commands;
  gl::VertexArray mesh_layout, no_layout;
  gl::Sampler smooth, stepped, mipped, exact;
  gl::TextureCube no_environment;  // black
  gl::Texture2D no_film;           // a dry texel
  LookWater water;
  uint32_t variant = kPlain;  // of the pane being drawn and the light it is drawn in
  LookPicture picture;
  gl::Canvases layers;  // of drops out of focus
  gl::Framebuffer layer;
  LookCapture capture;
  LookLamps lamps;
  FogPainter fog;
};

void GlassLook::Parts::fillFrame(const LookPane& pane, const LookView& view, const LookTarget& target,
                                 const LookLight& light, const LookSettings& settings) {
  const glm::dmat4 eyeFromVehicle = view.eyeFromWorld * pane.worldFromVehicle;
  const uint32_t environment = environmentOf(light);
  FrameBlock block{};
  block.clip_from_eye = view.clipFromEye;
  block.eye_from_vehicle = eyeFromVehicle;
  block.eye_from_world = rotationOf(view.eyeFromWorld);
  block.world_from_vehicle = rotationOf(pane.worldFromVehicle);
  block.sill = pane.sill;
  block.eye_in_vehicle = glm::inverse(eyeFromVehicle)[3];
  block.sky_radiance = glm::vec4(light.sky_radiance, 0.0f);
  block.ground_radiance = glm::vec4(light.ground_radiance, 0.0f);
  block.viewport = glm::vec4(view.viewport_px);
  const glm::dmat4& clip = view.clipFromEye;
  block.depth_rows = glm::dvec4(clip[2][2], clip[3][2], clip[2][3], clip[3][3]);
  block.uv_per_m = 1.0f / (pane.texel_m * glm::vec2(glm::max(pane.film_size, glm::ivec2(1))));
  block.drop_age_s = pane.drop_age_s;
  block.drop_count = pane.drop_count;
  block.exposure = target.exposure;
  block.pixels_per_rad =
      static_cast<float>(std::abs(view.clipFromEye[1][1])) * 0.5f * static_cast<float>(view.viewport_px.w);
  const float distance_m = glm::distance(glm::vec3(block.eye_in_vehicle), pane.centre_m);
  const bool coarse = pane.texel_m * block.pixels_per_rad > kCoarseTexel_px * distance_m;
  choose(kCoarse, coarse);
  choose(kMirror, pane.mirror > 0.0f);
  block.environment_texels_per_rad = environment != 0 ? texelsPerRadian(gl, environment) : 0.0f;
  block.cabin_share = light.cabin_share;
  block.brightness = settings.brightness;
  block.blur = settings.blur;
  block.fine_radius_px = kFineRadius_px;
  if (target.depth_texture != 0) block.depth_seen = view.clip_zero_to_one ? 2 : 1;
  block.internal_reflections = static_cast<uint32_t>(std::clamp(settings.internal_reflections, 0, 6));
  block.dry_reflection = settings.dry_reflection;
  block.film_unit_m3 = pane.film_unit_m3;
  block.bead_mm3_per_unit =
      1e9f * pane.film_unit_m3 / static_cast<float>(capShape(static_cast<double>(pane.bead_contact_rad)));
  block.mirror = pane.mirror;
  block.pupil_m = settings.pupil_m;
  block.bead_sine = std::sin(std::min(pane.bead_contact_rad, glm::half_pi<float>()));
  block.ridge_tan_contact = std::tan(std::min(pane.ridge_contact_rad, kSteepestRidge_rad));
  for (const LookBlade& blade : pane.blades) {
    if (pane.film == 0 || block.blade_count == shared::kMaxGlassWipers) break;
    block.blades[block.blade_count++] = {glm::vec4(blade.middle_m, blade.blade_m),
                                         glm::vec4(blade.along, static_cast<float>(blade.first_piece)),
                                         glm::vec4(blade.ahead, 0.0f)};
  }
  frame_block.write(0, &block, sizeof(block));
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, frame_block.name());
}

// What all of the look's shaders see by: the fetched picture, the environment, the target's depth.
void GlassLook::Parts::bindLook(const LookLight& light, const LookTarget& target) {
  gl.BindTextureUnit(kPicture, picture.texture());
  gl.BindSampler(kPicture, mipped.name());
  const uint32_t environment = environmentOf(light);
  choose(kEnvironment, environment != 0);
  choose(kEncoded, target.srgb);
  gl.BindTextureUnit(kSurroundings, environment != 0 ? environment : no_environment.name());
  gl.BindSampler(kSurroundings, mipped.name());
  gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl.BindTextureUnit(kDepth, target.depth_texture != 0 ? target.depth_texture : no_film.name());
  gl.BindSampler(kDepth, exact.name());
  gl.TextureBarrier();  // read while it is tested against, which is allowed as it is not written
}

void GlassLook::Parts::setState(const LookView& view, const LookTarget& target) {
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
  const glm::vec4 viewport(view.viewport_px);
  gl.ViewportIndexedfv(0, &viewport.x);
  gl.ClipControl(GL_LOWER_LEFT, view.clip_zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(view.reversed_depth ? GL_GEQUAL : GL_LEQUAL);
  gl.DepthMask(GL_FALSE);
  // A picture drawn mirrored turns faces round.
  const double handed =
      glm::determinant(glm::dmat3(view.eyeFromWorld)) * view.clipFromEye[0][0] * view.clipFromEye[1][1];
  gl.FrontFace(handed < 0.0 ? GL_CW : GL_CCW);
  gl.Disable(GL_CULL_FACE);
  gl.Disablei(GL_SCISSOR_TEST, 0);
  gl.BlendEquationi(0, GL_FUNC_ADD);
  gl.BlendFuncSeparatei(0, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);  // the target's alpha stays
}

// Film, beads and ridges, those of `parts`.
void GlassLook::Parts::drawWater(const LookPane& pane, uint32_t parts) {
  gl.Disablei(GL_BLEND, 0);
  gl.BindTextureUnit(kFirst, water.film());
  gl.BindTextureUnit(kSecond, water.beads());
  for (const GLuint unit : {kFirst, kSecond}) gl.BindSampler(unit, smooth.name());
  gl.BindSampler(kPicture, stepped.name());  // one mip level: a quarter of the pass cheaper
  if (!pane.blades.empty()) gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, pane.ridge_buffer);
  // Front faces are the outer side; the eye sees one pane from inside and, at its far end, another from
  // outside.
  gl.Enable(GL_CULL_FACE);
  gl.CullFace(GL_FRONT);
  if (pane.mirror <= 0.0f) drawInside(pane, parts);  // a mirror's silver lets nothing through
  gl.CullFace(GL_BACK);
  bindMesh(pane, pane.index_buffer);
  const uint32_t ridges = pane.blades.empty() ? kPlain : kRidges;
  if (parts & kFilm) {
    programs.use(LookStage::pane, (variant & ~kCoarse) | kFilm | kBeads | ridges);
    gl.DrawElements(GL_TRIANGLES, pane.index_count, GL_UNSIGNED_INT, nullptr);
  }
  leaveMesh();
}

void GlassLook::Parts::drawInside(const LookPane& pane, uint32_t parts) {
  if (pane.piece_buffer != 0) return drawPieces(pane, parts);
  bindMesh(pane, pane.index_buffer);
  const uint32_t all = kFilm | kBeads | (pane.blades.empty() ? kPlain : kRidges);
  programs.use(LookStage::pane, variant | kInside | (all & parts) | (parts & (kApart | kSoft)));
  gl.DrawElements(GL_TRIANGLES, pane.index_count, GL_UNSIGNED_INT, nullptr);
}

// Those that show water, each kind by a program that does no more than it needs.
void GlassLook::Parts::drawPieces(const LookPane& pane, uint32_t parts) {
  bindMesh(pane, water.indices());
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, water.commands());
  const auto draw = [&](uint32_t kind, uint32_t all) {
    if ((all & parts) == 0) return;
    programs.use(LookStage::pane, variant | kInside | (all & parts) | (parts & (kApart | kSoft)));
    const auto at = static_cast<uintptr_t>(shared::listOf(kind)) * sizeof(GLuint) * 5;
    gl.DrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(at));
  };
  draw(shared::kFilm, kFilm);
  draw(shared::kBeads, kBeads);
  draw(shared::kFilm | shared::kBeads, kFilm | kBeads);
  if (!pane.blades.empty()) draw(shared::kRidge, kFilm | kBeads | kRidges);
}

// Made ready to be drawn, and bound.
void GlassLook::Parts::bindMesh(const LookPane& pane, uint32_t indices) {
  mesh_layout.bindBuffer(0, pane.vertex_buffer, 0, kMeshStride);
  mesh_layout.bindIndices(indices);
  gl.BindVertexArray(mesh_layout.name());
  if (pane.sill != glm::vec4(0.0f)) gl.Enable(GL_CLIP_DISTANCE0);
}

// What else is drawn says nothing of a sill.
void GlassLook::Parts::leaveMesh() {
  gl.Disable(GL_CLIP_DISTANCE0);
  gl.Disable(GL_CULL_FACE);
}

void GlassLook::Parts::placeDrops(const LookPane& pane) {
  const auto count = static_cast<size_t>(pane.drop_count);
  const auto reserve = [&](gl::Buffer& buffer, size_t bytes) {
    if (buffer.bytes() < bytes) buffer = gl::Buffer(gl, bytes + bytes / 2, 0);
  };
  reserve(seen_drops, count * kSeenDropBytes);
  reserve(drop_kinds, count * sizeof(uint32_t));
  reserve(picked_drops, 2 * count * sizeof(uint32_t));
  reserve(drop_commands, 2 * kArraysCommandBytes);
  gl.BindTextureUnit(kFirst, pane.position);
  gl.BindTextureUnit(kSecond, pane.frame);
  gl.BindTextureUnit(kThird, pane.metric);
  for (const GLuint unit : {kFirst, kSecond, kThird}) gl.BindSampler(unit, smooth.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, pane.drop_buffer);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, pane.vertex_buffer);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, seen_drops.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, drop_kinds.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, picked_drops.name());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, drop_commands.name());
  gl.BindSampler(kPicture, mipped.name());
  programs.use(LookStage::place, variant);
  gl.DispatchCompute(static_cast<GLuint>(pane.drop_count + kPlaceGroup - 1) / kPlaceGroup, 1, 1);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  programs.use(LookStage::pick);
  gl.DispatchCompute(1, 1, 1);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void GlassLook::Parts::drawDrops() {
  gl.Enablei(GL_BLEND, 0);
  gl.BindSampler(kPicture, mipped.name());
  gl.BindVertexArray(no_layout.name());
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, drop_commands.name());
  programs.use(LookStage::small_drops);
  gl.DrawArraysIndirect(GL_TRIANGLES, nullptr);
  programs.use(LookStage::drops, variant);
  gl.DrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(kArraysCommandBytes));
}

// Beads and drops apart from the picture, whose depth hides them as it does on the glass, and blurred over
// it. Film bends the picture itself, and is drawn into it as the pupil's points see it (kSoft).
void GlassLook::Parts::drawUnsharp(const LookPane& pane, const LookView& view, const LookTarget& target) {
  gl::Texture2D& apart = layers.ofSize(target.width_px, target.height_px).texture;
  const float nothing[4] = {};
  layer.attachColor(0, apart.name());
  layer.attachDepth(target.depth_texture);
  gl.ClearNamedFramebufferfv(layer.name(), GL_COLOR, 0, nothing);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, layer.name());
  if (pane.beads != 0) drawWater(pane, kBeads | kApart);
  gl.BlendFunci(0, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (pane.drop_count > 0) {
    placeDrops(pane);
    drawDrops();
  }
  layer.attachDepth(0);
  apart.generateMipmaps();

  setState(view, target);
  gl.Enablei(GL_BLEND, 0);
  bindMesh(pane, pane.index_buffer);
  gl.BindTextureUnit(kFirst, apart.name());
  gl.BindSampler(kFirst, mipped.name());
  programs.use(LookStage::unsharp);
  gl.DrawElements(GL_TRIANGLES, pane.index_count, GL_UNSIGNED_INT, nullptr);
  leaveMesh();
}

// Between the eye and the water, of which it shows no more than of the rest: over the picture with both.
void GlassLook::Parts::drawFog(const LookPane& pane) {
  gl.Disablei(GL_BLEND, 0);
  fog.bind(pane.fog, kFirst);
  programs.use(LookStage::fog, variant);
  gl.BindSampler(kFirst, smooth.name());
  bindMesh(pane, pane.index_buffer);
  gl.Enable(GL_CULL_FACE);
  gl.CullFace(GL_FRONT);
  gl.DrawElements(GL_TRIANGLES, pane.index_count, GL_UNSIGNED_INT, nullptr);
  leaveMesh();
}

void GlassLook::Parts::forget() {
  programs.forget();
  for (gl::Buffer* buffer : {&frame_block, &seen_drops, &drop_kinds, &picked_drops, &drop_commands})
    buffer->forget();
  mesh_layout.forget();
  no_layout.forget();
  for (gl::Sampler* sampler : {&smooth, &stepped, &mipped, &exact}) sampler->forget();
  no_environment.forget();
  no_film.forget();
  water.forget();
  picture.forget();
  layers.forget();
  layer.forget();
  capture.forget();
  lamps.forget();
  fog.forget();
}

GlassLook::GlassLook(const GladGLContext& gl) : parts_(std::make_unique<Parts>(gl)) {}
GlassLook::~GlassLook() = default;

void GlassLook::drawPanes(std::span<const LookPane> panes, const LookView& view, const LookTarget& target,
                          const LookLight& light) {
  Parts& p = *parts_;
  const bool with_lamps = p.lamps.put(light.lamps, glm::dvec3(glm::inverse(view.eyeFromWorld)[3]));
  p.choose(kLamps, with_lamps);
  std::vector<SeenPane> drawn;  // since the picture was fetched
  for (const SeenPane& seen : seenPanes(panes, view)) {
    const LookPane& pane = *seen.pane;
    if (!isWet(pane) && pane.fog.covered.empty() && (!settings.dry_reflection || pane.mirror > 0.0f))
      continue;
    const bool stale =
        std::any_of(drawn.begin(), drawn.end(), [&](const SeenPane& far) { return liesBehind(far, seen); });
    if (drawn.empty() || stale) {
      p.picture.fetch(view.viewport_px, target, with_lamps);
      drawn.clear();
    }
    drawn.push_back(seen);
    p.fillFrame(pane, view, target, light, settings);
    const bool unsharp = settings.pupil_m > 0.0f && target.depth_texture != 0 && pane.mirror <= 0.0f;
    p.water.prepare(pane, unsharp ? kSoftReach : p.variant & kCoarse ? kCoarseReach : kSmoothReach);
    p.setState(view, target);
    p.bindLook(light, target);
    if (with_lamps) p.lamps.hide();
    p.drawWater(pane, unsharp ? kFilm | kRidges | kSoft : kFilm | kBeads | kRidges);
    if (unsharp) {
      p.drawUnsharp(pane, view, target);
    } else if (pane.drop_count > 0) {
      p.placeDrops(pane);
      p.drawDrops();
    }
    p.gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // the next pane's lists do not overtake these
    if (!pane.fog.covered.empty()) {
      p.picture.fetch(view.viewport_px, target, with_lamps);
      drawn = {seen};
      p.setState(view, target);
      p.bindLook(light, target);
      p.drawFog(pane);
    }
  }
}

void GlassLook::capture(const glm::dmat4& eyeFromWorld, int max_faces, const DrawScene& draw,
                        DepthUse depth) {
  parts_->capture.renew(eyeFromWorld, settings.capture_size_px, max_faces, draw, depth);
}

uint32_t GlassLook::captured() const { return parts_->capture.cube(); }

void GlassLook::dropCapture() { parts_->capture.drop(); }

void GlassLook::abandon() { parts_->forget(); }

}  // namespace rg::glass
