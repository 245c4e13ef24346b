#include "frame_gl.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "gl/program.h"
#include "glass/wiper.h"
#include "rain/picture.h"

namespace rg {
namespace {

// What stepping and drawing touch; the host's framebuffer is only needed for drawing.
constexpr uint32_t kStepTouches = RG_TOUCHED_PROGRAM | RG_TOUCHED_BUFFERS | RG_TOUCHED_TEXTURES |
                                  RG_TOUCHED_IMAGES | RG_TOUCHED_PIXEL_STORE;
// A cabin is a dark room by day: share of the light from outside that the glass shows from within
// (unsourced).
constexpr float kCabinLight = 0.05f;
constexpr uint32_t kDrawTouches = RG_TOUCHED_PROGRAM | RG_TOUCHED_VERTEX_ARRAY | RG_TOUCHED_BUFFERS |
                                  RG_TOUCHED_TEXTURES | RG_TOUCHED_FRAMEBUFFER | RG_TOUCHED_VIEWPORT |
                                  RG_TOUCHED_BLEND | RG_TOUCHED_DEPTH | RG_TOUCHED_RASTER |
                                  RG_TOUCHED_PIXEL_STORE;

constexpr int64_t kLatestPicture_ns =
    1'000'000'000;  // header: a picture is of no time more than this before the last tick

void requireTarget(const gl::Context& context, const DrawRequest& request) {
  gl::requireDrawable(context, request.target.framebuffer);
  gl::requireAttached(context, request.target.framebuffer, GL_COLOR_ATTACHMENT0, request.target.color_texture,
                      "rg_target.color_texture");
  gl::requireAttached(context, request.target.framebuffer, GL_DEPTH_ATTACHMENT, request.depth_texture,
                      "rg_target.depth_texture");
  gl::requireCube(context, request.lighting.environment_cube, "rg_lighting.environment_cube");
}

rain::BeyondLook beyondLook(const Settings& s) {
  return {s.rain_beyond,
          {s.rain_near_bias, s.rain_middle_bias, s.rain_far_bias, s.rain_haze_bias},
          {s.rain_near_contrast, s.rain_middle_contrast, s.rain_far_contrast}};
}

// As drawing of rain wants it; the request must outlive it.
rain::RainDraw rainDraw(const DrawRequest& request) {
  rain::RainDraw draw;
  draw.view = &request.view;
  draw.viewport_px = request.viewport_px;
  draw.time_ns = request.time_ns;
  draw.target = {request.target.framebuffer, request.target.color_texture, request.depth_texture,
                 request.target.width_px,    request.target.height_px,     request.target.srgb,
                 request.target.exposure};
  draw.lighting = request.lighting;
  draw.lighting.lamps = request.lamps;
  return draw;
}

glm::dmat4 worldFromVehicle(const Pose& pose) {
  glm::dmat4 m = glm::mat4_cast(pose.orientation);
  m[3] = glm::dvec4(pose.position_m, 1.0);
  return m;
}

glass::LookPane lookPane(const glass::PaneDrawn& d, const Pose& vehicle, int64_t time_ns, int64_t drops_ns) {
  glass::LookPane p = lookPaneOf(d);
  p.worldFromVehicle = glm::translate(worldFromVehicle(vehicle), d.slid_m);
  const double age_s = static_cast<double>(time_ns - drops_ns) * 1e-9;
  p.drop_age_s = static_cast<float>(age_s);
  for (const glass::MovingBlade& blade : d.blades) {
    const glass::BladePose pose = bladePose(blade.wiper, blade.angle_rad + blade.speed_radps * age_s);
    p.blades.push_back({glm::vec3(pose.middle_m), glm::vec3(pose.along),
                        glm::vec3(blade.direction * pose.across), static_cast<float>(blade.wiper.blade_m),
                        blade.first_piece});
  }
  return p;
}

}  // namespace

Frame::Gl::Gl(const rg_gl_info& info, uint32_t capacity)
    : context(gl::loadContext(info.get_proc, info.get_proc_user)),
      host_resets_state(info.host_resets_state != 0) {
  const gl::StateGuard guarded = guard(kDrawTouches | kStepTouches);
  gl::BegunPrograms programs(context->gl);
  rain = std::make_unique<rain::RainRenderer>(*context, capacity);
  beyond = std::make_unique<rain::BeyondRenderer>(*context);
  splashes = std::make_unique<surroundings::SplashRenderer>(*context);
  wetness = std::make_unique<surroundings::WetnessRenderer>(*context);
  glow = std::make_unique<surroundings::GlowRenderer>(*context);
  film_programs = glass::makeFilmPrograms(context->gl);
  look = std::make_unique<glass::GlassLook>(context->gl);
  programs.finish();
  gl::throwOnError(context->gl, "attach_gl");
}

uint64_t Frame::Gl::filmHash(uint32_t pane) const {
  const gl::StateGuard guarded = guard(kStepTouches);
  return panes.at(pane).gl->hash();
}

void Frame::Gl::forget() {
  rain->forget();
  beyond->forget();
  splashes->forget();
  wetness->forget();
  glow->forget();
  look->abandon();
  for (auto& [id, half] : panes) half.gl->abandon();
  glass::abandonFilmPrograms(*film_programs);
}

Frame::Gl& Frame::attached() {
  if (!gl_) refuse("attach_gl first", RG_ERROR_WRONG_ORDER);
  return *gl_;
}

// Ticks may run while the driver compiles.
void Frame::attach(const rg_gl_info& info) {
  if (gl_) refuse("the instance is attached already; detach_gl first", RG_ERROR_WRONG_ORDER);
  auto made = std::make_unique<Gl>(info, capacity_);
  const std::lock_guard lock(sim_);
  timers_.attach(*made->context, info.force_finish_timer != 0);
  field_.publishAll(upload_);
  gl_ = std::move(made);
  for (auto& [id, p] : panes_) p.sim->attachFilm();
}

void Frame::detach() {
  Gl& gl = attached();
  const std::lock_guard lock(sim_);
  {
    const gl::StateGuard guarded = gl.guard(kStepTouches | kDrawTouches);
    timers_.detach();
    gl.panes.clear();
    gl.rain.reset();
    gl.beyond.reset();
    gl.splashes.reset();
    gl.wetness.reset();
    gl.glow.reset();
    gl.look.reset();
    gl.film_programs.reset();
  }
  leaveGl();
}

void Frame::contextLost() {
  Gl& gl = attached();
  const std::lock_guard lock(sim_);
  timers_.forget();
  gl.forget();
  leaveGl();
}

void Frame::leaveGl() {
  gl_.reset();
  for (auto& [id, p] : panes_) p.sim->detachFilm();
  // What waited for films runs; where it waited for a neighbour's ticks too, turn by turn.
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (auto& [id, p] : panes_) goes_on = p.sim->resume() || goes_on;
  }
}

// Panes are made by the CPU's side at any time, and what they ask of their film waits; their GL half follows
// here, where the context is current.
void Frame::syncPanes(Gl& gl) {
  std::erase_if(gl.panes, [this](const auto& half) {
    const auto found = panes_.find(half.first);
    return found == panes_.end() || found->second.sim != half.second.sim;
  });
  for (auto& [id, p] : panes_) {
    if (gl.panes.contains(id)) continue;
    gl.panes[id] = {p.sim, std::make_unique<glass::PaneGl>(gl.context->gl, gl.film_programs, p.sim)};
  }
}

void Frame::finishGlass() {
  if (!gl_) return;
  const gl::StateGuard guarded = gl_->guard(kStepTouches);
  syncPanes(*gl_);
  std::vector<glass::PaneGl*> panes;
  for (auto& [id, half] : gl_->panes) panes.push_back(half.gl.get());
  glass::PaneGl::finish(panes);
}

Frame::FilmStates Frame::filmStates() {
  FilmStates films;
  if (!gl_) return films;
  const gl::StateGuard guarded = gl_->guard(kStepTouches);
  for (auto& [id, half] : gl_->panes) {
    if (half.sim->filmAttached()) films.emplace(id, half.gl->filmState());
  }
  return films;
}

void Frame::setFilms(const FilmStates& films) {
  if (films.empty()) return;
  const gl::StateGuard guarded = gl_->guard(kStepTouches);
  for (const auto& [id, film] : films) gl_->panes.at(id).gl->setFilm(film);
}

void Frame::stepGpu() {
  Gl& gl = attached();
  std::unique_lock lock(sim_);
  // Buffers are written through direct state access; only kernels and new objects need state of the host's.
  const bool binds = !panes_.empty() || !gl.panes.empty() || gl.rain->uploadBinds(upload_) ||
                     gl.pattern_version != pattern_version_;
  // The timers' queries want no query buffer bound.
  const gl::StateGuard guarded = gl.guard(binds ? kStepTouches : uint32_t{RG_TOUCHED_BUFFERS});
  timers_.collect();
  {
    const gl::ScopedStage timed(timers_, stage_.rain_upload);
    gl.rain->upload(upload_);
    gl.beyond->take(beyond_picture_);
    gl.splashes->take(splash_picture_);
    gl.wetness->take(wetness_picture_);
    if (gl.pattern_version != pattern_version_)
      gl.beyond->setPattern(pattern_.rgba.empty() ? rain::generatePattern() : pattern_);
    gl.pattern_version = pattern_version_;
  }
  const gl::ScopedStage timed(timers_, stage_.glass_step);
  syncPanes(gl);
  lock.unlock();
  std::vector<glass::PaneGl*> panes;
  for (auto& [id, half] : gl.panes) panes.push_back(half.gl.get());
  glass::PaneGl::step(panes);
  gl::throwOnError(gl.context->gl, "step_gpu");
}

uint32_t Frame::prepareCaptures(const ViewState& view, int max_faces, const glass::DrawScene& draw) {
  Gl& gl = attached();
  gl::StateGuard guarded = gl.guard(kDrawTouches);
  const gl::ScopedStage timed(timers_, stage_.captures);
  gl.look->settings.capture_size_px = static_cast<int>(settings().glass_capture_px);
  if (draw)
    gl.look->capture(view.eyeFromWorld, max_faces, draw, {view.clip_zero_to_one, view.reversed_depth});
  else
    gl.look->dropCapture();
  gl::throwOnError(gl.context->gl, "prepare_captures");
  return guarded.touched();
}

void Frame::requireMoment(int64_t time_ns) const {
  const std::lock_guard lock(sim_);
  if (!started_ || time_ns >= tickTimeNs(next_tick_ - 1) - kLatestPicture_ns) return;
  refuse("rg_draw.time_ns lies more than 1 s before the last tick", RG_ERROR_WRONG_ORDER);
}

uint32_t Frame::drawWorld(const DrawRequest& request) {
  Gl& gl = attached();
  requireMoment(request.time_ns);
  gl::StateGuard guarded = gl.guard(kDrawTouches);
  requireTarget(*gl.context, request);
  guarded.drawInto(request.target.framebuffer);
  const Settings now = settings();
  rain::RainDraw draw = rainDraw(request);
  draw.gain = static_cast<float>(now.rain_gain);
  {
    const gl::ScopedStage timed(timers_, stage_.wetness);
    rain::RainDraw wet = draw;
    // Water mirrors what stands about, where that is known.
    if (gl.look->captured() != 0) wet.lighting.environment_cube = gl.look->captured();
    gl.wetness->draw(wet, now.wetness_strength);
  }
  {
    const gl::ScopedStage timed(timers_, stage_.splashes);
    splashes_kept_ = gl.splashes->draw(draw, {now.splashes_gain, now.splashes_reach_m});
  }
  {
    const gl::ScopedStage timed(timers_, stage_.rain_beyond);
    const rain::BeyondLook look = beyondLook(now);
    for (int i = 0; i < static_cast<int>(now.bench_repeat); ++i) gl.beyond->draw(draw, look);
  }
  const gl::ScopedStage timed(timers_, stage_.rain_draw);
  for (int i = 0; i < static_cast<int>(now.bench_repeat); ++i) gl.rain->draw(draw);
  gl::throwOnError(gl.context->gl, "draw_world");
  return guarded.touched();
}

uint32_t Frame::drawGlass(const DrawRequest& request) {
  Gl& gl = attached();
  requireMoment(request.time_ns);
  gl::StateGuard guarded = gl.guard(kDrawTouches);
  requireTarget(*gl.context, request);
  guarded.drawInto(request.target.framebuffer);
  if (request.target.color_texture == 0) guarded.readFrom(request.target.framebuffer);
  const gl::ScopedStage timed(timers_, stage_.glass_draw);
  std::vector<glass::LookPane> seen;
  {
    const std::lock_guard lock(sim_);
    for (auto& [id, half] : gl.panes) {
      const auto object = panes_.find(id);
      // Replaced since the last step_gpu, a pane has nothing to be drawn yet.
      if (object == panes_.end() || object->second.sim != half.sim || !object->second.active) continue;
      const auto vehicle = timeline_.vehicleAt(object->second.vehicle, request.time_ns);
      if (!vehicle) continue;
      const glass::PaneDrawn drawn = half.gl->drawn(openingOf_m(id, object->second, request.time_ns));
      if (drawn.index_count == 0) continue;
      // The pane's own count of ticks has no gaps; the world's tick it stands for is so far behind the
      // newest. After reset() the records are of a count that is no more.
      const int64_t behind = std::max<int64_t>(0, object->second.tick - drawn.drop_tick);
      const int64_t world_tick = next_tick_ - 1 - behind;
      seen.push_back(lookPane(drawn, vehicle->pose, request.time_ns, tickTimeNs(world_tick)));
      seen.back().mirror = static_cast<float>(object->second.mirror);
      if (const glass::Fog& fog = *object->second.fog; !fog.empty())
        seen.back().fog = {fog.covered(), glass::Fog::kCells};
    }
    gl.look->settings.brightness = static_cast<float>(settings_.glass_brightness);
    gl.look->settings.blur = static_cast<float>(settings_.glass_blur);
    gl.look->settings.pupil_m = static_cast<float>(settings_.glass_pupil_m);
    gl.look->settings.internal_reflections = static_cast<int>(settings_.glass_internal_reflections);
  }
  const glass::LookView view{request.view.eyeFromWorld, request.view.clipFromEye, request.viewport_px,
                             request.view.clip_zero_to_one, request.view.reversed_depth};
  glass::LookTarget target = request.target;
  target.depth_texture = request.depth_texture;
  glass::LookLight light;
  light.environment_cube = request.lighting.environment_cube;
  light.sky_radiance = request.lighting.sky_radiance;
  light.ground_radiance = request.lighting.ground_radiance;
  for (const rain::DropLamp& lamp : std::span(request.lamps).first(request.lamps_on_glass))
    light.lamps.push_back({lamp.position_m, lamp.direction, lamp.intensity, lamp.cos_inner, lamp.cos_outer});
  light.cabin_share = request.view.vehicle != 0 ? kCabinLight : 1.0f;
  for (int i = 0; i < static_cast<int>(settings().bench_repeat); ++i)
    gl.look->drawPanes(seen, view, target, light);
  gl::throwOnError(gl.context->gl, "draw_glass");
  return guarded.touched();
}

uint32_t Frame::drawFinish(const DrawRequest& request) {
  Gl& gl = attached();
  requireMoment(request.time_ns);
  const double strength = settings().glow_strength;
  gl::StateGuard guarded = gl.guard(strength > 0.0 ? kDrawTouches : 0);
  requireTarget(*gl.context, request);
  const gl::ScopedStage timed(timers_, stage_.finish);
  if (strength <= 0.0) return guarded.touched();
  guarded.drawInto(request.target.framebuffer);
  if (request.target.color_texture == 0) guarded.readFrom(request.target.framebuffer);
  gl.glow->draw(rainDraw(request), strength);
  gl::throwOnError(gl.context->gl, "draw_finish");
  return guarded.touched();
}

}  // namespace rg
