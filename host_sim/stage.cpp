#include "stage.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "drive/instruments.h"
#include "image/hdr.h"

namespace host {
namespace {

// A car's displays follow the light its driver is used to, down to a hundredth of what they can (chosen by
// eye).
constexpr double kDisplayGain = 3.0, kDimmestDisplay = 0.01;  // the former per 1000 cd/m^2
constexpr double kBrakeLights_mps2 = -0.7;                    // coasting does not light them
constexpr float kOpenPlace = 0.9F;  // a place that sees so much of the sky is lit as the open field is

// Panes are ticked on some of the machine's other cores too.
double threadsForPanes() {
  constexpr unsigned kMost = 3;
  return std::min(kMost, std::max(1U, std::thread::hardware_concurrency()) - 1);
}

bool hasModels(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_directory(folder / "scenarios", error) &&
         std::filesystem::is_directory(folder / "models", error);
}

std::optional<std::filesystem::path> upwards(std::filesystem::path folder) {
  for (; !folder.empty(); folder = folder.parent_path()) {
    if (hasModels(folder)) return folder;
    if (folder == folder.root_path()) break;
  }
  return std::nullopt;
}

// The light about a place that sees the share `open` of the sky: water on the glass of a car in a tunnel is
// not lit by the day outside.
LightSummary lightAt(LightSummary light, float open) {
  light.sky_radiance *= open;
  light.ground_radiance *= open;
  if (open < kOpenPlace) light.environment_cube = 0;
  return light;
}

}  // namespace

std::filesystem::path projectRoot() {
  std::error_code error;
  if (const auto root = upwards(std::filesystem::read_symlink("/proc/self/exe", error).parent_path()))
    return *root;
  if (const auto root = upwards(std::filesystem::current_path(error))) return *root;
  throw InputError(
      "neither this program nor the working folder lies below a folder with scenarios/ and models/");
}

Scenario chosenScenario(const Options& options) {
  Scenario s = loadScenario(options.scenario, options.changes, projectRoot());
  if (options.seconds) s.seconds = *options.seconds;
  if (options.seed) s.seed = *options.seed;
  if (!options.car.empty()) s.car = options.car;
  if (!options.road.empty()) s.road = options.road;
  if (!options.camera.empty()) s.camera = options.camera;
  return s;
}

Models loadModels(const Scenario& scenario) {
  Models models;
  if (!scenario.car.empty()) models.car = loadScene(scenario.car);
  if (!scenario.road.empty()) models.road = loadScene(scenario.road);
  return models;
}

Stage::Stage(const Options& options, const Scenario& scenario, Models models, Context& context)
    : scenario_(scenario),
      context_(context),
      car_scene_(std::move(models.car)),
      road_scene_(std::move(models.road)) {
  if (car_scene_) car_ = carView(*car_scene_);
  if (road_scene_) road_ = roadView(*road_scene_);
  if (scenario.glass) {
    for (PaneView& pane : car_.panes) pane.glass = *scenario.glass;
    for (MirrorView& mirror : car_.mirrors) mirror.face.glass = *scenario.glass;
  }
  if (!scenario.shelter) {
    car_.shelters.clear();
    road_.shelters.clear();
  }
  renderer_ = std::make_unique<Renderer>(context);
  if (road_scene_) addRoad();
  if (car_scene_) {
    const SceneId car = renderer_->addScene(*car_scene_, SceneFrame::Car);
    car_instance_ = renderer_->addInstance(car);
    for (const MirrorView& m : car_.mirrors) {
      renderer_->addMirror(*car_instance_, m.face.positions_m, m.face.indices, m.normal);
    }
    for (size_t k = 0; k < scenario.traffic.size(); ++k) traffic_.push_back(renderer_->addTraffic(car));
    poses_ = car_scene_->restPoses();
  }
  if (!options.environment.empty()) {
    const HdrImage hdr = loadHdr(options.environment);
    renderer_->setEnvironment(hdr.rgb, hdr.width_px, hdr.height_px);
  }
  plugin_ = std::make_unique<RainPlugin>("", scenario.seed);
  plugin_->attach(context);
  plugin_->addRoad(road_);
  plugin_->addCar(car_);
  plugin_->addTraffic(car_, scenario.traffic.size());
  // A budget is what the calling thread may take alone.
  if (options.budget.empty()) plugin_->setParameter("glass.threads", threadsForPanes());
  setParameters();
  simulation_ = std::make_unique<Simulation>(scenario, car_, road_, *plugin_, options.size_px);
  // By the sky as it is then, whether it is drawn or not: pictures are as bright whichever were drawn before.
  simulation_->adapting_luminance = [this](glm::dvec3 eye_m) {
    renderer_->lightSky(sky(std::llround(simulation_->timeS() * 1e9)));
    return renderer_->adaptingLuminance(eye_m);
  };
}

void Stage::setParameters() {
  for (const auto& [name, value] : scenario_.parameters) {
    try {
      plugin_->setParameter(name, value);
    } catch (const PluginError& e) {
      throw InputError(std::string("scenario's ") + e.what());
    }
  }
}

SavedRun Stage::save(int64_t time_ns) {
  SavedRun saved;
  saved.scenario = scenario_.name;
  saved.seed = scenario_.seed;
  saved.time_ns = time_ns;
  saved.simulation = fieldsOf(*simulation_);
  saved.plugin = plugin_->save();
  return saved;
}

int64_t Stage::restore(const SavedRun& saved) {
  const auto first_sky = sky(0);
  const glm::dvec3 first_eye_m = simulation_->eyeAt(0).position_m;
  const nlohmann::json before = fieldsOf(*simulation_);
  setFields(*simulation_, saved.simulation);
  try {
    plugin_->restore(saved.plugin);
  } catch (const PluginError& e) {
    setFields(*simulation_, before);
    throw InputError(e.what());
  }
  setParameters();  // the scenario's, which --set may have changed
  simulation_->resume();
  // The light that the sky lays changes in steps from where it was first laid: as in a run from its
  // beginning.
  renderer_->beginFrame(first_sky, first_eye_m);
  renderer_->beginFrame(sky(saved.time_ns), simulation_->eyeAt(saved.time_ns).position_m);
  return saved.time_ns;
}

void Stage::addRoad() {
  road_instance_ = renderer_->addInstance(renderer_->addScene(*road_scene_, SceneFrame::Road));
  Sky sky;
  sky.to_sun = toSun();
  Placement placement;
  placement.lamp_levels[static_cast<size_t>(LightRole::Street)] = streetLampGain(sky);
  placement.display_level = litWindowLevel(sky);
  renderer_->place(*road_instance_, placement);
}

void Stage::update(int64_t time_ns) {
  simulation_->advance(time_ns);
  plugin_->update(simulation_->pluginTime(time_ns));
  plugin_->stepGpu();
}

void Stage::prewarm() {
  const auto whole_ns = static_cast<int64_t>(std::ceil(scenario_.prewarm_s)) * 1'000'000'000;
  constexpr int64_t kPiece_ns = 100'000'000;
  renderer_->beginFrame(sky(0), simulation_->eyeAt(0).position_m);
  for (int64_t t = -whole_ns; t < 0; t += kPiece_ns) {
    update(t);
    if (isatty(2) != 0 && t % 1'000'000'000 == 0)
      std::fprintf(stderr, "\rrain before the first picture: %lld s ",
                   static_cast<long long>(-t / 1'000'000'000));
  }
  update(0);
}

Sky Stage::sky(int64_t time_ns) const {
  const Weather w = simulation_->weather();
  Sky sky;
  sky.rain_mm_h = w.rain_mm_h;
  sky.snow_mm_h = w.snow_mm_h;
  sky.hail_mm_h = w.hail_mm_h;
  sky.visibility_m = w.visibility_m;
  sky.wetness = simulation_->wetness();
  sky.time_s = static_cast<double>(time_ns) * 1e-9;
  sky.to_sun = toSun();
  return sky;
}

glm::vec3 Stage::toSun() const {
  const double up = glm::radians(scenario_.sun_elevation_deg),
               round = glm::radians(scenario_.sun_azimuth_deg);
  return {std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up)};
}

void Stage::pose(int64_t time_ns) {
  if (!car_instance_) return;
  const CarState car = simulation_->carAt(time_ns);
  for (const Animation& a : car_scene_->animations)
    animate(a,
            static_cast<float>(std::fmod(static_cast<double>(time_ns) * 1e-9, std::max(1e-3F, a.duration_s))),
            poses_);
  for (const WiperView& w : car_.wipers)
    turnNode(*car_scene_, w.node, {0.0F, 1.0F, 0.0F},
             w.sweep_rad * static_cast<float>(simulation_->wiperShare()), poses_);
  if (car_.steering_wheel) {
    const float angle = static_cast<float>(car.steering_rad) * car_.steering_wheel->ratio;
    turnNode(*car_scene_, car_.steering_wheel->node, {0.0F, 1.0F, 0.0F}, angle, poses_);
  }
  for (const WheelView& w : car_.wheels) {
    const auto spin = static_cast<float>(
        std::fmod(car.driven_m / static_cast<double>(w.radius_m), 2.0 * glm::pi<double>()));
    turnNode(*car_scene_, w.node, {1.0F, 0.0F, 0.0F}, spin, poses_);
  }
  poseInstruments(*car_scene_, car_, car.speed_mps, poses_);
  Placement placement;
  placement.world_from_host = glm::mat4_cast(car.orientation);
  placement.world_from_host[3] = glm::dvec4(car.position_m, 1.0);
  placement.poses = poses_;
  placement.lamp_levels[static_cast<size_t>(LightRole::Head)] = scenario_.headlights ? 1.0F : 0.0F;
  placement.lamp_levels[static_cast<size_t>(LightRole::Tail)] = scenario_.headlights ? 1.0F : 0.0F;
  placement.lamp_levels[static_cast<size_t>(LightRole::Brake)] =
      car.acceleration_mps2 < kBrakeLights_mps2 ? 1.0F : 0.0F;
  placement.display_level =
      static_cast<float>(std::clamp(kDisplayGain * simulation_->adaptedLuminance(), kDimmestDisplay, 1.0));
  renderer_->place(*car_instance_, placement);
  poseTraffic(time_ns);
}

// Others drive with their lights on, whatever we do.
void Stage::poseTraffic(int64_t time_ns) {
  const std::vector<CarState> cars = simulation_->trafficAt(time_ns);
  for (size_t k = 0; k < traffic_.size(); ++k) {
    Placement placement;
    placement.world_from_host = glm::mat4_cast(cars[k].orientation);
    placement.world_from_host[3] = glm::dvec4(cars[k].position_m, 1.0);
    placement.lamp_levels[static_cast<size_t>(LightRole::Head)] = 1.0F;
    placement.lamp_levels[static_cast<size_t>(LightRole::Tail)] = 1.0F;
    placement.display_level = static_cast<float>(kDimmestDisplay);
    renderer_->place(traffic_[k], placement);
  }
}

void Stage::draw(int64_t time_ns, const Target& target, uint32_t framebuffer, int captures) {
  const Eye eye = simulation_->eyeAt(time_ns);
  const rg_view view = simulation_->pluginViewAt(time_ns);
  const int64_t plugin_ns = simulation_->pluginTime(time_ns);
  pose(time_ns);
  renderer_->beginFrame(sky(time_ns), eye.position_m);
  const LightSummary light = renderer_->lighting();
  plugin_->capture(*renderer_, view, captures);
  const bool inside = eye.inside && car_instance_.has_value();
  if (inside || !car_instance_)
    renderer_->drawWorld(eye.view, target);
  else
    renderer_->drawWorld(eye.view, target, std::span(&*car_instance_, 1));
  if (inside) renderer_->drawParts(eye.view, target, *car_instance_, kBody | kWipers);
  renderer_->drawMirrors(eye.view, target);
  const double exposure =
      scenario_.white_cd_m2 ? 1000.0 / *scenario_.white_cd_m2 : exposureFor(simulation_->adaptedLuminance());
  renderer_->smooth(target, exposure);
  plugin_->drawWorld(plugin_ns, view, target, light);
  plugin_->drawGlass(plugin_ns, view, target,
                     lightAt(light, static_cast<float>(renderer_->skyVisibility(eye.position_m))));
  plugin_->drawFinish(plugin_ns, view, target, light);
  if (scenario_.white_cd_m2)
    renderer_->encodeSrgb(target, framebuffer, exposure);
  else
    renderer_->toneMap(target, framebuffer, exposure);
}

void Stage::fillReport(Report& report) {
  report.gl_vendor = context_.vendor();
  report.gl_renderer = context_.rendererName();
  report.gl_version = context_.version();
  report.gpu_timer = plugin_->gpuTimer();
  report.scenario = scenario_.name;
  report.seed = scenario_.seed;
  report.stages = plugin_->stages();
  report.rain = plugin_->rainStats();
  report.panes = plugin_->paneStats();
  report.rain_hash = plugin_->hash(RG_HASH_RAIN);
  report.state_hash = plugin_->hash(RG_HASH_STATE);
  report.gl_errors = context_.glErrors();
}

}  // namespace host
