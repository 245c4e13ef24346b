#include "rain_plugin.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace host {
namespace {

void log(void*, int32_t level, uint32_t message, const char* text) {
  // Errors come back as results, with the same words.
  if (level == RG_LOG_WARNING) std::fprintf(stderr, "rainglass %u: %s\n", message, text);
}

std::filesystem::path besideThisProgram() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path() / "librainglass.so";
}

// A washer as cars have: 15 mL from each nozzle in a second, from a hand's breadth off the glass, in a fan.
constexpr double kNozzleOff_m = 0.08, kJetFan_rad = 0.35, kJet_m3 = 15e-6;

void copyVector(const glm::dvec3& from, double to[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

void copyVector(const glm::vec3& from, float to[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

// The plugin's lamps are cones. One that a low beam fits into lies below the horizon: no light on the drops
// above it, less than a beam's brightest on those that the cone's middle meets in its stead (chosen by eye).
constexpr float kBeamHalf_rad = 0.24F, kBeamDown_rad = 0.18F, kBeamShare = 0.4F;
void dip(rg_lamp& lamp) {
  const float level = std::hypot(lamp.direction[0], lamp.direction[1]);
  const float down = std::atan2(-lamp.direction[2], level) + kBeamDown_rad;
  for (int i = 0; i < 2; ++i) lamp.direction[i] *= std::cos(down) / level;
  lamp.direction[2] = -std::sin(down);
  for (float& c : lamp.intensity) c *= kBeamShare;
  lamp.cos_outer = std::cos(kBeamHalf_rad);
}

rg_pane_info paneInfo(const rg_api& api, const PaneView& pane) {
  rg_pane_info info;
  api.default_pane_info(&info);
  info.vehicle = kCarId;
  info.name = pane.name.c_str();
  info.positions_m = &pane.positions_m.data()->x;
  info.uvs = &pane.uv.data()->x;
  info.indices = pane.indices.data();
  info.vertex_count = static_cast<uint32_t>(pane.positions_m.size());
  info.index_count = static_cast<uint32_t>(pane.indices.size());
  info.glass = static_cast<int32_t>(pane.glass);
  return info;
}

// Those that light falling drops.
std::vector<rg_lamp> lampsOf(const LightSummary& light) {
  std::vector<rg_lamp> lamps;
  for (const LampNow& lamp : light.lamps) {
    rg_lamp out{};
    copyVector(lamp.position_m, out.position_m);
    copyVector(lamp.direction, out.direction);
    copyVector(lamp.intensity, out.intensity);
    out.cos_inner = lamp.cos_inner;
    out.cos_outer = lamp.cos_outer;
    if (lamp.low_beam) dip(out);
    lamps.push_back(out);
  }
  return lamps;
}

// Those that drops on the glass show, as bright to all sides as they are to the eye.
std::vector<rg_lamp> glaresOf(const LightSummary& light) {
  std::vector<rg_lamp> lamps;
  for (const Glare& glare : light.glares) {
    rg_lamp out{};
    copyVector(glare.position_m, out.position_m);
    copyVector(glare.intensity, out.intensity);
    out.cos_inner = out.cos_outer = -1.0F;
    lamps.push_back(out);
  }
  return lamps;
}

}  // namespace

RainPlugin::RainPlugin(const std::filesystem::path& library, uint64_t seed) {
  const std::filesystem::path file = library.empty() ? besideThisProgram() : library;
  library_ = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) throw PluginError(std::string("the plugin cannot be loaded: ") + dlerror());
  const auto entry = reinterpret_cast<const rg_api* (*)(uint32_t)>(dlsym(library_, "rg_get_entry"));
  if (entry == nullptr) throw PluginError(file.string() + " has no rg_get_entry");
  api_ = entry(RG_ABI_VERSION);
  if (api_ == nullptr) throw PluginError(file.string() + " does not speak this ABI");
  create(seed);
}

RainPlugin::RainPlugin(const rg_api& api, uint64_t seed) : api_(&api) { create(seed); }

void RainPlugin::create(uint64_t seed) {
  rg_create_info info;
  api_->default_create_info(&info);
  info.seed = seed;
  info.log = log;
  const rg_result result = api_->create(&info, &instance_);
  if (result < 0) throw PluginError(std::string("create: ") + api_->last_error(nullptr));
}

RainPlugin::~RainPlugin() {
  if (instance_ != nullptr) {
    if (attached_) api_->detach_gl(instance_);
    api_->destroy(instance_);
  }
  if (library_ != nullptr) dlclose(library_);
}

void RainPlugin::check(rg_result result, const char* call) {
  if (result < 0) throw PluginError(std::string(call) + ": " + api_->last_error(instance_));
}

void RainPlugin::attach(Context& context) {
  rg_gl_info info;
  api_->default_gl_info(&info);
  info.get_proc = Context::getProc;
  info.get_proc_user = &context;
  check(api_->attach_gl(instance_, &info), "attach_gl");
  attached_ = true;
}

void RainPlugin::addVolume(uint32_t id, uint32_t vehicle, const ShelterView& shelter) {
  std::vector<double> points;
  for (const glm::vec3& p : shelter.points_m) points.insert(points.end(), {p.x, p.y, p.z});
  rg_volume_info info;
  api_->default_volume_info(&info);
  info.vehicle = vehicle;
  info.name = shelter.name.c_str();
  info.vertices_m = points.data();
  info.vertex_count = static_cast<uint32_t>(shelter.points_m.size());
  check(api_->set_volume(instance_, id, &info), "set_volume");
}

void RainPlugin::addRoad(const RoadView& road) {
  for (const ShelterView& s : road.shelters) addVolume(++volumes_, 0, s);
}

void RainPlugin::addTraffic(const CarView& car, size_t count) {
  for (uint32_t k = 0; k < count; ++k) {
    for (const ShelterView& s : car.shelters) addVolume(++volumes_, kFirstTrafficId + k, s);
  }
}

void RainPlugin::addPane(const std::string& name, const rg_pane_info& info) {
  panes_.push_back(name);
  check(api_->set_pane(instance_, static_cast<uint32_t>(panes_.size()), &info), "set_pane");
}

void RainPlugin::addCar(const CarView& car) {
  for (const ShelterView& s : car.shelters) addVolume(++volumes_, kCarId, s);
  for (const PaneView& p : car.panes) {
    rg_pane_info info = paneInfo(*api_, p);
    // What no wiper clears is looked through less: a quarter of the cells and drops.
    const bool wiped = std::ranges::any_of(car.wipers, [&](const WiperView& w) { return w.pane == p.name; });
    if (!wiped && car.panes.size() > 1) {
      info.texel_m *= 2.0;
      info.max_drops /= 4;
    }
    if (wiped) info.demister = 1.0;
    addPane(p.name, info);
  }
  for (const MirrorView& m : car.mirrors) {
    if (!m.wet) continue;
    rg_pane_info info = paneInfo(*api_, m.face);
    info.max_drops /= 4;
    info.mirror = static_cast<double>(kCarMirror);
    addPane(m.name, info);
  }
  for (size_t i = 0; i < car.wipers.size(); ++i) {
    const WiperView& w = car.wipers[i];
    rg_wiper_info info;
    api_->default_wiper_info(&info);
    info.pane = static_cast<uint32_t>(w.pane_index + 1);
    info.name = w.name.c_str();
    copyVector(glm::dvec3(w.pivot_m), info.pivot_m);
    copyVector(glm::normalize(glm::dvec3(w.axis)), info.axis);
    copyVector(glm::normalize(glm::dvec3(w.rest_direction)), info.rest_direction);
    info.arm_m = static_cast<double>(w.arm_m);
    info.blade_m = static_cast<double>(w.blade_m);
    info.blade_angle_rad = static_cast<double>(w.blade_angle_rad);
    info.blade_turn = static_cast<double>(w.blade_turn);
    info.wear = static_cast<double>(w.wear);
    check(api_->set_wiper(instance_, static_cast<uint32_t>(i + 1), &info), "set_wiper");
  }
}

// A nozzle beside each pivot, off the glass, aimed at the middle of what the wiper sweeps.
void RainPlugin::wash(const CarView& car, int64_t time_ns) {
  for (const WiperView& w : car.wipers) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(w.axis)), rest(w.rest_direction);
    const double half_rad = 0.5 * static_cast<double>(w.sweep_rad);
    const glm::dvec3 middle = std::cos(half_rad) * rest + std::sin(half_rad) * glm::cross(axis, rest);
    const glm::dvec3 nozzle = glm::dvec3(w.pivot_m) + kNozzleOff_m * axis;
    const glm::dvec3 aim = glm::dvec3(w.pivot_m) + static_cast<double>(w.arm_m) * middle;
    rg_wash_info info;
    api_->default_wash_info(&info);
    info.pane = static_cast<uint32_t>(w.pane_index + 1);
    info.time_ns = time_ns;
    copyVector(nozzle, info.nozzle_m);
    copyVector(glm::normalize(aim - nozzle), info.direction);
    info.fan_rad = kJetFan_rad;
    info.volume_m3 = kJet_m3;
    check(api_->wash(instance_, &info), "wash");
  }
}

void RainPlugin::setParameter(const std::string& name, double value) {
  check(api_->set_parameter(instance_, name.c_str(), value), ("parameter " + name).c_str());
}

std::vector<unsigned char> RainPlugin::save() {
  size_t size = 0;
  check(api_->save(instance_, nullptr, &size), "save");
  std::vector<unsigned char> state(size);
  check(api_->save(instance_, state.data(), &size), "save");
  return state;
}

void RainPlugin::restore(const std::vector<unsigned char>& state) {
  check(api_->restore(instance_, state.data(), state.size()), "restore");
  waiting_.clear();
}

void RainPlugin::prewarm(double seconds) { check(api_->prewarm(instance_, seconds), "prewarm"); }

void RainPlugin::update(int64_t time_ns) {
  std::vector<rg_vehicle> vehicles;
  size_t most = 0;
  for (const Moment& m : waiting_) most += 1 + m.traffic.size();
  vehicles.reserve(most);
  std::vector<rg_sample> samples;
  for (Moment& m : waiting_) {
    vehicles.push_back(pluginVehicle(*api_, m.car));
    const rg_vehicle* first = &vehicles.back();
    for (size_t k = 0; k < m.traffic.size(); ++k)
      vehicles.push_back(pluginVehicle(*api_, m.traffic[k], kFirstTrafficId + static_cast<uint32_t>(k)));
    rg_sample s;
    api_->default_sample(&s);
    s.time_ns = m.time_ns;
    s.weather = &m.weather;
    s.vehicles = first;
    s.vehicle_count = static_cast<uint32_t>(1 + m.traffic.size());
    s.vehicle_stride = sizeof(rg_vehicle);
    s.views = &m.view;
    s.view_count = 1;
    s.view_stride = sizeof(rg_view);
    s.wiper_knots = m.knots.data();
    s.wiper_knot_count = static_cast<uint32_t>(m.knots.size());
    s.opening_knots = m.openings.data();
    s.opening_knot_count = static_cast<uint32_t>(m.openings.size());
    samples.push_back(s);
  }
  check(api_->update(instance_, time_ns, samples.data(), static_cast<uint32_t>(samples.size()),
                     sizeof(rg_sample)),
        "update");
  waiting_.clear();
}

void RainPlugin::stepGpu() { check(api_->step_gpu(instance_), "step_gpu"); }

void RainPlugin::capture(Renderer& renderer, const rg_view& view, int max_faces) {
  rg_capture_info info;
  api_->default_capture_info(&info);
  info.max_faces = static_cast<uint32_t>(max_faces);
  info.view = &view;
  info.user = &renderer;
  info.draw_scene = [](void* user, uint32_t framebuffer, int32_t width, int32_t height, const double eye[16],
                       const double projection[16]) {
    glm::dmat4 eye_from_world, clip;
    std::memcpy(&eye_from_world[0][0], eye, sizeof eye_from_world);
    std::memcpy(&clip[0][0], projection, sizeof clip);
    static_cast<Renderer*>(user)->drawScene(framebuffer, {width, height}, eye_from_world, clip);
  };
  check(api_->prepare_captures(instance_, &info), "prepare_captures");
}

void RainPlugin::draw(DrawCall call, const char* name, int64_t time_ns, const rg_view& view,
                      const Target& target, const LightSummary& light, std::span<const rg_lamp> lamps,
                      bool on_glass) {
  rg_target t;
  api_->default_target(&t);
  t.framebuffer = target.framebuffer();
  t.color_texture = target.colour();
  t.depth_texture = target.depth();
  t.width_px = target.sizePx().x;
  t.height_px = target.sizePx().y;
  rg_lighting l;
  api_->default_lighting(&l);
  copyVector(light.sky_radiance, l.sky_radiance);
  copyVector(light.ground_radiance, l.ground_radiance);
  copyVector(light.to_sun, l.sun_direction);
  copyVector(light.sun_irradiance, l.sun_irradiance);
  l.environment_cube = light.environment_cube;
  l.lamps = lamps.data();
  l.lamp_count = static_cast<uint32_t>(lamps.size());
  l.lamps_on_glass = on_glass ? l.lamp_count : 0;
  rg_draw d;
  api_->default_draw(&d);
  d.time_ns = time_ns;
  d.view = &view;
  d.target = &t;
  d.lighting = &l;
  check(call(instance_, &d), name);
}

void RainPlugin::drawWorld(int64_t time_ns, const rg_view& view, const Target& target,
                           const LightSummary& light) {
  draw(api_->draw_world, "draw_world", time_ns, view, target, light, lampsOf(light));
}

void RainPlugin::drawGlass(int64_t time_ns, const rg_view& view, const Target& target,
                           const LightSummary& light) {
  draw(api_->draw_glass, "draw_glass", time_ns, view, target, light, glaresOf(light), true);
}

void RainPlugin::drawFinish(int64_t time_ns, const rg_view& view, const Target& target,
                            const LightSummary& light) {
  draw(api_->draw_finish, "draw_finish", time_ns, view, target, light, {});
}

rg_rain_stats RainPlugin::rainStats() {
  rg_rain_stats stats{};
  stats.struct_size = sizeof stats;
  check(api_->get_rain_stats(instance_, &stats), "get_rain_stats");
  return stats;
}

std::vector<std::pair<std::string, rg_pane_stats>> RainPlugin::paneStats() {
  std::vector<std::pair<std::string, rg_pane_stats>> all;
  for (size_t i = 0; i < panes_.size(); ++i) all.emplace_back(panes_[i], paneStats(static_cast<int>(i)));
  return all;
}

rg_pane_stats RainPlugin::paneStats(int pane_index) {
  rg_pane_stats stats{};
  stats.struct_size = sizeof stats;
  check(api_->get_pane_stats(instance_, static_cast<uint32_t>(pane_index + 1), &stats), "get_pane_stats");
  return stats;
}

std::vector<rg_stage_stats> RainPlugin::stages() {
  uint32_t count = 0;
  check(api_->get_stage_count(instance_, &count), "get_stage_count");
  std::vector<rg_stage_stats> all(count);
  for (uint32_t i = 0; i < count; ++i) {
    all[i].struct_size = sizeof all[i];
    check(api_->get_stage(instance_, i, &all[i]), "get_stage");
  }
  return all;
}

std::vector<rg_parameter> RainPlugin::parameters() {
  uint32_t count = 0;
  check(api_->get_parameter_count(instance_, &count), "get_parameter_count");
  std::vector<rg_parameter> all(count);
  for (uint32_t i = 0; i < count; ++i) {
    all[i].struct_size = sizeof all[i];
    check(api_->get_parameter(instance_, i, &all[i]), "get_parameter");
  }
  return all;
}

bool RainPlugin::gpuTimer() {
  int32_t kind = 0;
  check(api_->get_timer_kind(instance_, &kind), "get_timer_kind");
  return kind == RG_TIMER_GPU;
}

uint64_t RainPlugin::hash(rg_hash_kind kind) {
  uint64_t value = 0;
  check(api_->get_hash(instance_, kind, &value), "get_hash");
  return value;
}

void RainPlugin::placeDrops(uint32_t pane, std::span<const rg_glass_drop> drops) {
  check(api_->place_drops(instance_, pane, drops.data(), static_cast<uint32_t>(drops.size())), "place_drops");
}

rg_view pluginView(const rg_api& api, const View& view, glm::ivec2 size_px, glm::dvec3 eye_velocity_mps,
                   uint32_t vehicle) {
  rg_view v;
  api.default_view(&v);
  v.id = kViewId;
  v.viewport_px[2] = size_px.x;
  v.viewport_px[3] = size_px.y;
  std::memcpy(v.eye_from_world, &view.eye_from_world[0][0], sizeof v.eye_from_world);
  std::memcpy(v.projection, &view.projection[0][0], sizeof v.projection);
  v.clip_zero_to_one = 1;
  v.reversed_depth = 1;
  v.vehicle = vehicle;
  copyVector(eye_velocity_mps, v.eye_velocity_mps);
  return v;
}

rg_vehicle pluginVehicle(const rg_api& api, const CarState& car, uint32_t id) {
  rg_vehicle v;
  api.default_vehicle(&v);
  v.id = id;
  copyVector(car.position_m, v.pose.position_m);
  copyVector(car.velocity_mps, v.pose.velocity_mps);
  copyVector(car.angular_velocity_radps, v.pose.angular_velocity_radps);
  v.pose.orientation[0] = car.orientation.x;
  v.pose.orientation[1] = car.orientation.y;
  v.pose.orientation[2] = car.orientation.z;
  v.pose.orientation[3] = car.orientation.w;
  return v;
}

}  // namespace host
