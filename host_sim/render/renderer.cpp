#include "render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>

#include "render/car_mirrors.h"
#include "render/draw_list.h"
#include "render/environment.h"
#include "render/filters.h"
#include "render/glares.h"
#include "render/gpu_scene.h"
#include "render/instance.h"
#include "render/painter.h"
#include "render/shadow.h"

namespace host {
namespace {

/// From below the ground nothing hides what is far, so all of it would be drawn; and far ground has left the
/// plane.
constexpr float kMirrorReach_m = 120.0F;
/// What a driver is adapted to at night, 1000 cd/m^2: a road that lamps light (1 cd/m^2 by CIE 115:2010,
/// class M3; those of our village, 2500 cd at a height of 6 m, give some 3).
constexpr double kLitRoad = 2.0e-3;
/// Share of the light outside that lamps and walls keep up in the darkest shelter.
constexpr double kBounceInShelter = 0.02;
/// What is seen from a shelter is more than the mean over all directions: its mouth lies ahead, at the height
/// of the eyes. Chosen by eye.
constexpr double kPartOfAdaptation = 0.7;

glm::dvec3 eyeOf(const glm::dmat4& eye_from_world) { return glm::dvec3(glm::inverse(eye_from_world)[3]); }

/// Clip from directions in world axes.
glm::mat4 turnedOnly(const View& view) {
  return glm::mat4(view.projection * glm::dmat4(glm::dmat3(view.eye_from_world)));
}

}  // namespace

struct Renderer::Self {
  using What = std::vector<std::pair<const Instance*, unsigned>>;

  explicit Self(const Context& context)
      : gl(context.gl()),
        environment(gl),
        shadow(gl),
        painter(gl),
        background(gl, {"full.vert"}, {"frame.glsl", "background.frag"}),
        picture_background(gl, {"full.vert"}, {"latlong.glsl", "background.frag"}, {"PICTURE"}),
        filters(gl),
        glare_painter(gl),
        reflecting(gl, {"mirror.vert"}, {"mirror.frag"}) {
    gl.CreateVertexArrays(1, &no_vertices);
  }
  ~Self() {
    gl.DeleteVertexArrays(1, &no_vertices);
    for (const CarMirror& mirror : mirrors) {
      gl.DeleteBuffers(1, &mirror.corners);
      gl.DeleteVertexArrays(1, &mirror.layout);
    }
  }
  Self(const Self&) = delete;
  Self& operator=(const Self&) = delete;

  const GladGLContext& gl;
  Environment environment;
  Shadow shadow;
  Painter painter;
  Program background, picture_background;
  Filters filters;
  GlarePainter glare_painter;
  Program reflecting;
  GLuint no_vertices = 0;
  struct CarMirror {
    InstanceId car;
    std::vector<glm::vec3> corners_m;  ///< of its triangles, host frame
    glm::vec3 normal;
    GLuint corners = 0, layout = 0;
    std::unique_ptr<MirrorPicture> shown;
  };
  std::vector<CarMirror> mirrors;
  std::unique_ptr<MirrorPicture> mirror_picture;
  const Instance* nearest_car = nullptr;  ///< its wheels stand on the ground that mirrors, and it shades it
  std::deque<GpuScene> scenes;
  std::deque<Instance> instances;
  std::vector<PlacedGrid> grids;
  std::vector<LampNow> lamps;
  std::vector<Glare> glares;
  Sky sky;
  bool timing = false;
  std::vector<PassTime> times;

  bool isRoad(const Instance& instance) const { return instance.scene->frame == SceneFrame::Road; }
  What world() const;
  void placeGrids();
  void gatherLamps(glm::dvec3 eye_m);
  FrameBlock frameFor(const View& view, glm::ivec2 size_px, glm::dvec3 eye_m) const;
  void findCar(glm::dvec3 eye_m);
  bool paintMirror(const View& view, glm::ivec2 size_px, const What& what);
  Painted paintCarMirror(CarMirror& mirror, const View& view, const Target& target);
  void begin(GLuint framebuffer, glm::ivec2 size_px) { beginPicture(gl, framebuffer, size_px); }
  Painted paintFrom(const View& view, glm::ivec2 size_px, const What& what, float least_size,
                    bool mirror = false);
  void paintSky(const glm::mat4& clip_from_rel);
  glm::vec4 lightAt(glm::dvec3 point_m, float& share) const;

  template <typename Work>
  void timed(const char* pass, Work work) {
    if (!timing) {
      work();
      return;
    }
    gl.Finish();
    const auto start = std::chrono::steady_clock::now();
    const Painted painted = work();
    gl.Finish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    times.push_back({pass, took.count(), painted.triangles, painted.draws});
  }
};

void Renderer::Self::placeGrids() {
  grids.clear();
  for (const Instance& instance : instances) {
    for (const GpuGrid& grid : instance.scene->grids) {
      grids.push_back(
          {&grid, glm::dmat4(grid.grid.box_from_scene) * glm::inverse(instance.worldFromHost()), &instance});
    }
  }
}

void Renderer::Self::gatherLamps(glm::dvec3 eye_m) {
  lamps.clear();
  for (const Instance& instance : instances)
    lamps.insert(lamps.end(), instance.lamps.begin(), instance.lamps.end());
  std::stable_sort(lamps.begin(), lamps.end(), [&](const LampNow& a, const LampNow& b) {
    return glm::distance(a.position_m, eye_m) < glm::distance(b.position_m, eye_m);
  });
  if (lamps.size() > kMaxLamps) lamps.resize(kMaxLamps);
  glares.clear();
  for (const Instance& instance : instances) {
    if (!isRoad(instance)) instance.addGlares(eye_m, glares);
  }
}

/// Roads and the cars among which ours drives.
Renderer::Self::What Renderer::Self::world() const {
  What what;
  for (const Instance& instance : instances) {
    if (isRoad(instance) || instance.traffic) what.emplace_back(&instance, kBody | kWipers | kPanes);
  }
  return what;
}

void Renderer::Self::findCar(glm::dvec3 eye_m) {
  nearest_car = nullptr;
  double nearest_m = 30.0;
  for (const Instance& instance : instances) {
    const double distance_m = glm::distance(glm::dvec3(instance.worldFromHost()[3]), eye_m);
    if (isRoad(instance) || instance.traffic || distance_m > nearest_m) continue;
    nearest_m = distance_m;
    nearest_car = &instance;
  }
}

FrameBlock Renderer::Self::frameFor(const View& view, glm::ivec2 size_px, glm::dvec3 eye_m) const {
  FrameBlock frame;
  frame.clip_from_rel = turnedOnly(view);
  frame.sh = environment.irradiance();
  const bool sunny = !environment.isPicture() && cloudCover(sky) < 1.0;
  frame.to_sun = glm::vec4(glm::normalize(sky.to_sun), sunny ? 1.0F : 0.0F);
  frame.sun = glm::vec4(sunIrradiance(sky), 0.0F);
  if (sunny) frame.shadow_from_rel = shadow.mapFromRel(eye_m);
  frame.haze = glm::vec4(environment.horizonRadiance(), static_cast<float>(extinction(sky)));
  frame.air = {static_cast<float>(sky.wetness), environment.lastMip(), environment.brightness(), kGlow};
  frame.eye = glm::vec4(glm::vec3(glm::mod(eye_m, 1024.0)), 0.0F);
  frame.screen = glm::vec4(1.0F / glm::vec2(size_px), 0.0F, static_cast<float>(extinctionOfAir(sky)));
  if (nearest_car == nullptr) return frame;
  glm::dmat4 rel_from_car = nearest_car->worldFromHost();
  rel_from_car[3] -= glm::dvec4(eye_m, 0.0);
  const glm::dvec3 up(rel_from_car[2]);
  frame.plane = glm::vec4(glm::vec3(up), static_cast<float>(glm::dot(up, glm::dvec3(rel_from_car[3]))));
  frame.car_from_rel = glm::mat4(glm::inverse(rel_from_car));
  frame.car = nearest_car->scene->footprint;
  return frame;
}

Painted Renderer::Self::paintFrom(const View& view, glm::ivec2 size_px, const What& what, float least_size,
                                  bool mirror) {
  const glm::dvec3 eye_m = eyeOf(view.eye_from_world);
  FrameBlock frame = frameFor(view, size_px, eye_m);
  frame.screen.z = mirror ? 1.0F : 0.0F;
  DrawList list(eye_m, frame.clip_from_rel, least_size);
  for (const auto& [instance, parts] : what) list.add(*instance, parts);
  list.sort();
  painter.setFrame(frame, eye_m, lamps, grids,
                   {environment.mirrored(), shadow.texture(), mirror ? mirror_picture->texture() : 0});
  return painter.paint(list);
}

/// The world above the wet ground as its mirror shows it, at a quarter of the size. False where no ground is
/// known or it is dry. Nothing is clipped at the ground: from below, its own faces are turned away, and feet
/// that reach into it look as long as they are. (Clip distances make Mesa 22's llvmpipe slow and lose
/// triangles.)
bool Renderer::Self::paintMirror(const View& view, glm::ivec2 size_px, const What& what) {
  if (nearest_car == nullptr || sky.wetness <= 0.0) return false;
  const glm::ivec2 small = glm::max(size_px / 4, glm::ivec2(16));
  if (!mirror_picture || mirror_picture->sizePx() != small)
    mirror_picture = std::make_unique<MirrorPicture>(gl, small);
  const glm::dvec3 eye_m = eyeOf(view.eye_from_world);
  FrameBlock frame = frameFor(view, small, eye_m);
  const glm::vec3 n(frame.plane);
  if (frame.plane.w > -0.05F) return false;  // the eye is not above the ground
  glm::mat4 mirror_from_rel(1.0F);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) mirror_from_rel[column][row] -= 2.0F * n[row] * n[column];
  }
  const glm::mat4 turned = frame.clip_from_rel * mirror_from_rel;
  mirror_from_rel[3] = glm::vec4(2.0F * frame.plane.w * n, 1.0F);
  frame.clip_from_rel = frame.clip_from_rel * mirror_from_rel;
  frame.air.x = 0.0F;

  begin(mirror_picture->framebuffer(), small);
  const float far = 0.0F;
  gl.ClearNamedFramebufferfv(mirror_picture->framebuffer(), GL_DEPTH, 0, &far);
  gl.FrontFace(GL_CW);
  DrawList list(eye_m, frame.clip_from_rel, 0.02F, kMirrorReach_m);
  for (const auto& [instance, parts] : what) list.add(*instance, parts);
  list.sort();
  painter.setFrame(frame, eye_m, lamps, grids, {environment.mirrored(), shadow.texture(), 0});
  painter.paint(list);
  gl.FrontFace(GL_CCW);
  paintSky(turned);
  gl.GenerateTextureMipmap(mirror_picture->texture());
  return true;
}

/// The world and the car itself as its mirror shows them.
Painted Renderer::Self::paintCarMirror(CarMirror& mirror, const View& view, const Target& target) {
  constexpr float kLeastSize = 0.004F;
  const glm::dvec3 eye_m = eyeOf(view.eye_from_world);
  const Instance& car = instances.at(mirror.car);
  glm::dmat4 rel_from_host = car.worldFromHost();
  rel_from_host[3] -= glm::dvec4(eye_m, 0.0);
  std::vector<glm::vec3> corners_rel;
  for (const glm::vec3& p : mirror.corners_m)
    corners_rel.emplace_back(rel_from_host * glm::dvec4(glm::dvec3(p), 1.0));
  const glm::vec3 normal(glm::dmat3(rel_from_host) * glm::dvec3(mirror.normal));
  const glm::mat4 clip_from_rel = turnedOnly(view);
  const auto seen = seenMirror(corners_rel, normal, clip_from_rel, target.sizePx());
  if (!seen) return {};
  if (!mirror.shown || glm::any(glm::lessThan(mirror.shown->sizePx(), seen->size_px)))
    mirror.shown = std::make_unique<MirrorPicture>(gl, seen->size_px);

  FrameBlock frame = frameFor(view, seen->size_px, eye_m);
  frame.clip_from_rel = clipOfMirrored(*seen, clip_from_rel, target.sizePx());
  begin(mirror.shown->framebuffer(), seen->size_px);
  const float far = 0.0F;
  gl.ClearNamedFramebufferfv(mirror.shown->framebuffer(), GL_DEPTH, 0, &far);
  gl.FrontFace(GL_CW);
  DrawList list(eye_m, frame.clip_from_rel, kLeastSize);
  for (const auto& [instance, parts] : world()) list.add(*instance, parts);
  list.add(car, kBody);
  list.sort();
  painter.setFrame(frame, eye_m, lamps, grids, {environment.mirrored(), shadow.texture(), 0});
  const Painted painted = painter.paint(list);
  gl.FrontFace(GL_CCW);
  SeenMirror far_off = *seen;
  far_off.offset_m = 0.0F;  // as directions are mirrored
  paintSky(clipOfMirrored(far_off, clip_from_rel, target.sizePx()));

  begin(target.framebuffer(), target.sizePx());
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.DepthMask(GL_FALSE);  // it lies a little before its glass, which its drops lie on
  gl.Disable(GL_CULL_FACE);
  gl.BindTextureUnit(0, mirror.shown->texture());
  reflecting.set("u_clip_from_host", clip_from_rel * glm::mat4(rel_from_host));
  reflecting.set("u_corner_px", glm::vec2(seen->corner_px));
  reflecting.set("u_texel", 1.0F / glm::vec2(mirror.shown->sizePx()));
  reflecting.set("u_reflects", kCarMirror);
  reflecting.use();
  gl.BindVertexArray(mirror.layout);
  gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(mirror.corners_m.size()));
  gl.DepthMask(GL_TRUE);
  return painted;
}

void Renderer::Self::paintSky(const glm::mat4& clip_from_rel) {
  const Program& program = environment.isPicture() ? picture_background : background;
  program.use();
  program.set("u_rel_from_clip", glm::inverse(clip_from_rel));
  gl.BindTextureUnit(0, environment.picture());
  gl.BindTextureUnit(4, environment.sky());
  gl.BindVertexArray(no_vertices);
  gl.Disable(GL_BLEND);
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GEQUAL);
  gl.DepthMask(GL_FALSE);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.DepthMask(GL_TRUE);
}

glm::vec4 Renderer::Self::lightAt(glm::dvec3 point_m, float& share) const {
  glm::vec4 light(0.0F);
  share = 0.0F;
  for (const PlacedGrid& placed : grids) {
    if (!isRoad(*placed.owner)) continue;
    const glm::vec3 scene_m(glm::inverse(placed.owner->worldFromHost()) * glm::dvec4(point_m, 1.0));
    const float part = placed.grid->grid.share(scene_m) * (1.0F - share);
    if (part <= 0.0F) continue;
    light += part * placed.grid->grid.at(scene_m);
    share += part;
  }
  return light;
}

Renderer::Renderer(const Context& context) : self_(std::make_unique<Self>(context)) {}
Renderer::~Renderer() = default;

SceneId Renderer::addScene(const Scene& scene, SceneFrame frame) {
  self_->scenes.emplace_back(self_->gl, scene, frame);
  return static_cast<SceneId>(self_->scenes.size() - 1);
}

InstanceId Renderer::addTraffic(SceneId scene) {
  const InstanceId id = addInstance(scene);
  self_->instances.at(id).traffic = true;
  return id;
}

InstanceId Renderer::addInstance(SceneId scene) {
  Instance instance;
  instance.scene = &self_->scenes.at(scene);
  instance.place({});
  self_->instances.push_back(std::move(instance));
  return static_cast<InstanceId>(self_->instances.size() - 1);
}

void Renderer::place(InstanceId instance, const Placement& placement) {
  self_->instances.at(instance).place(placement);
}

void Renderer::addMirror(InstanceId car, std::span<const glm::vec3> positions_m,
                         std::span<const std::uint32_t> indices, glm::vec3 normal) {
  const GladGLContext& gl = self_->gl;
  Self::CarMirror& mirror = self_->mirrors.emplace_back();
  mirror.car = car;
  mirror.normal = normal;
  for (const std::uint32_t i : indices) mirror.corners_m.push_back(positions_m[i]);
  gl.CreateBuffers(1, &mirror.corners);
  gl.NamedBufferStorage(mirror.corners, static_cast<GLsizeiptr>(mirror.corners_m.size() * sizeof(glm::vec3)),
                        mirror.corners_m.data(), 0);
  gl.CreateVertexArrays(1, &mirror.layout);
  gl.EnableVertexArrayAttrib(mirror.layout, 0);
  gl.VertexArrayAttribFormat(mirror.layout, 0, 3, GL_FLOAT, GL_FALSE, 0);
  gl.VertexArrayAttribBinding(mirror.layout, 0, 0);
  gl.VertexArrayVertexBuffer(mirror.layout, 0, mirror.corners, 0, sizeof(glm::vec3));
}

void Renderer::setEnvironment(std::span<const float> rgb, int width, int height) {
  self_->environment.setPicture(rgb, width, height);
}

void Renderer::lightSky(const Sky& sky) { self_->environment.update(sky); }

void Renderer::beginFrame(const Sky& sky, glm::dvec3 eye_m) {
  Self& self = *self_;
  self.times.clear();
  self.sky = sky;
  self.gl.BindVertexArray(self.no_vertices);
  self.timed("sky", [&] {
    self.environment.update(sky);
    return Painted{};
  });
  self.placeGrids();
  self.gatherLamps(eye_m);
  self.findCar(eye_m);
  for (Instance& instance : self.instances) {
    if (self.isRoad(instance)) continue;
    instance.open = static_cast<float>(
        skyVisibility(glm::dvec3(instance.worldFromHost() * glm::dvec4(1.3, 0.0, 1.0, 1.0))));
  }
  if (self.environment.isPicture() || cloudCover(sky) >= 1.0) return;
  self.timed("shadow", [&] {
    std::vector<const Instance*> all;
    for (const Instance& instance : self.instances) all.push_back(&instance);
    self.shadow.draw(all, sky.to_sun, eye_m);
    return Painted{};
  });
}

void Renderer::drawWorld(const View& view, const Target& target, std::span<const InstanceId> whole) {
  Self& self = *self_;
  Self::What what = self.world();
  for (InstanceId id : whole) what.emplace_back(&self.instances.at(id), kBody | kWipers);
  bool mirror = false;
  self.timed("mirror", [&] {
    mirror = self.paintMirror(view, target.sizePx(), what);
    return Painted{};
  });
  self.begin(target.framebuffer(), target.sizePx());
  const float far = 0.0F;
  self.gl.ClearNamedFramebufferfv(target.framebuffer(), GL_DEPTH, 0, &far);
  self.timed("world", [&] {
    const Painted painted = self.paintFrom(view, target.sizePx(), what, 0.001F, mirror);
    self.paintSky(turnedOnly(view));
    self.glare_painter.paint(self.glares, view, target.sizePx(), extinction(self.sky));
    return painted;
  });
}

void Renderer::drawParts(const View& view, const Target& target, InstanceId instance, unsigned parts) {
  Self& self = *self_;
  self.begin(target.framebuffer(), target.sizePx());
  self.timed(parts & kBody ? "cabin" : "wipers", [&] {
    return self.paintFrom(view, target.sizePx(), {{&self.instances.at(instance), parts}}, 0.0F);
  });
}

void Renderer::drawMirrors(const View& view, const Target& target) {
  self_->timed("car_mirrors", [&] {
    Painted all;
    for (Self::CarMirror& mirror : self_->mirrors) {
      const Painted painted = self_->paintCarMirror(mirror, view, target);
      all.triangles += painted.triangles;
      all.draws += painted.draws;
    }
    return all;
  });
}

void Renderer::drawScene(std::uint32_t framebuffer, glm::ivec2 size_px, const glm::dmat4& eye_from_world,
                         const glm::dmat4& projection) {
  Self& self = *self_;
  self.begin(framebuffer, size_px);
  const float far = 0.0F;
  self.gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
  const View view{eye_from_world, projection};
  self.timed("capture", [&] {
    self.painter.showLamps(false);
    const Painted painted = self.paintFrom(view, size_px, self.world(), 0.012F);
    self.painter.showLamps(true);
    self.paintSky(turnedOnly(view));
    return painted;
  });
}

void Renderer::smooth(const Target& target, double exposure) {
  self_->timed("smooth", [&] {
    self_->filters.smooth(target, exposure);
    return Painted{};
  });
}

void Renderer::toneMap(const Target& target, std::uint32_t framebuffer, double exposure) {
  self_->timed("tone", [&] {
    self_->filters.write(target, framebuffer, exposure, true);
    return Painted{};
  });
}

void Renderer::encodeSrgb(const Target& target, std::uint32_t framebuffer, double exposure) {
  self_->filters.write(target, framebuffer, exposure, false);
}

double Renderer::skyVisibility(glm::dvec3 point_m) const {
  float share = 0.0F;
  const glm::vec4 light = self_->lightAt(point_m, share);
  return static_cast<double>((1.0F - share) + std::min(light.x / kOpenSky.x, share));
}

LightSummary Renderer::lighting() const {
  const Self& self = *self_;
  LightSummary light;
  light.sky_radiance = self.environment.skyRadiance();
  light.ground_radiance = self.environment.groundRadiance();
  if (!self.environment.isPicture()) {
    light.to_sun = glm::normalize(self.sky.to_sun);
    light.sun_irradiance = sunIrradiance(self.sky);
  }
  light.lamps = self.lamps;
  light.glares = self.glares;
  light.environment_cube = self.environment.mirrored();
  return light;
}

double Renderer::adaptingLuminance(glm::dvec3 eye_m) const {
  const glm::vec3 around = 0.5F * (self_->environment.skyRadiance() + self_->environment.groundRadiance());
  const double open = glm::dot(glm::dvec3(around), glm::dvec3(0.2126, 0.7152, 0.0722));
  const double seen =
      open * std::pow(kBounceInShelter + (1.0 - kBounceInShelter) * skyVisibility(eye_m), kPartOfAdaptation);
  return std::max(seen, kLitRoad);
}

void Renderer::setTiming(bool on) { self_->timing = on; }
std::vector<PassTime> Renderer::times() const { return self_->times; }

glm::dmat4 reversedPerspective(double fov_rad, glm::ivec2 size_px, double near_m) {
  const double f = 1.0 / std::tan(0.5 * fov_rad);
  glm::dmat4 projection(0.0);
  projection[0][0] = f;
  projection[1][1] = f * size_px.x / size_px.y;
  projection[2][3] = -1.0;
  projection[3][2] = near_m;
  return projection;
}

double exposureFor(double luminance) { return 0.5 / std::max(luminance, 1e-4); }

}  // namespace host
