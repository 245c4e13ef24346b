// Known drops on a flat pane before an environment: pictures that can be held against path-traced ones.
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image/hdr.h"
#include "image/png.h"
#include "report.h"
#include "run.h"
#include "stage.h"

namespace host {
namespace {

// As the file says: pane through the world's origin, u right, v up the pane; the eye looks along +x.
struct DropList {
  double angle_rad = 0.0;
  glm::dvec3 eye_m{0.0};
  double fov_rad = 0.0;
  std::vector<rg_glass_drop> drops;
};

double number(const nlohmann::json& object, const char* key, double least, double most,
              const std::string& where) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_number())
    throw InputError(where + "." + key + ": must be a number");
  const double value = object[key].get<double>();
  if (!(value >= least && value <= most))
    throw InputError(where + "." + key + " is " + std::to_string(value) + ", must be " +
                     std::to_string(least) + " .. " + std::to_string(most));
  return value;
}

DropList readDrops(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::ifstream in(file);
  std::error_code error;
  if (!in || !std::filesystem::is_regular_file(file, error)) throw InputError(name + ": cannot be read");
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) throw InputError(name + ": is not a JSON object");
  DropList list;
  constexpr double kRad = 3.14159265358979323846 / 180.0;
  list.angle_rad =
      number(json.value("pane", nlohmann::json()), "angle_from_horizontal_deg", 0.0, 90.0, name + ": pane") *
      kRad;
  const nlohmann::json eye = json.value("eye_m", nlohmann::json());
  if (!eye.is_array() || eye.size() != 3) throw InputError(name + ": eye_m must be three numbers");
  for (size_t i = 0; i < 3; ++i) {
    if (!eye[i].is_number() || !(std::abs(eye[i].get<double>()) <= 100.0))
      throw InputError(name + ": eye_m must be three numbers within 100 m");
    list.eye_m[static_cast<int>(i)] = eye[i].get<double>();
  }
  list.fov_rad = number(json, "horizontal_fov_deg", 1.0, 170.0, name + ": ") * kRad;
  const nlohmann::json drops = json.value("drops", nlohmann::json());
  if (!drops.is_array() || drops.empty()) throw InputError(name + ": drops must be a list");
  for (size_t i = 0; i < drops.size(); ++i) {
    const std::string where = name + ": drops[" + std::to_string(i) + "]";
    list.drops.push_back({number(drops[i], "u_m", -10.0, 10.0, where),
                          number(drops[i], "v_m", -10.0, 10.0, where),
                          number(drops[i], "base_radius_m", 1e-5, 0.02, where),
                          number(drops[i], "contact_angle_deg", 1.0, 170.0, where)});
  }
  return list;
}

// A flat pane about the origin, as large as the drops want, in the world's frame (the vehicle stands in its
// origin).
CarView flatPane(const DropList& list) {
  double half_u = 0.1, half_v = 0.1;
  for (const rg_glass_drop& d : list.drops) {
    half_u = std::max(half_u, std::abs(d.u_m) + 3.0 * d.base_radius_m + 0.02);
    half_v = std::max(half_v, std::abs(d.v_m) + 3.0 * d.base_radius_m + 0.02);
  }
  const glm::dvec3 right(0.0, -1.0, 0.0), up(-std::cos(list.angle_rad), 0.0, std::sin(list.angle_rad));
  PaneView pane;
  pane.name = "pane";
  for (const glm::dvec2 corner :
       {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
    pane.positions_m.push_back(glm::vec3(right * (corner.x * half_u) + up * (corner.y * half_v)));
    pane.uv.push_back(glm::vec2(corner * 0.5 + 0.5) * glm::vec2(1.0F, static_cast<float>(half_v / half_u)));
  }
  // Counter-clockwise seen from outside, that is from ahead and above; u runs to the driver's right.
  pane.indices = {0, 2, 1, 0, 3, 2};
  CarView car;
  car.panes.push_back(pane);
  return car;
}

}  // namespace

int runDrops(const Options& options) {
  const DropList list = readDrops(options.drops);
  if (options.environment.empty()) throw InputError("--drops needs --environment FILE.hdr");
  const HdrImage hdr = loadHdr(options.environment);
  makeOutFolder(options.out);
  const auto context = makeHeadlessContext(options.gl_debug);
  Renderer renderer(*context);
  renderer.setEnvironment(hdr.rgb, hdr.width_px, hdr.height_px);
  RainPlugin plugin("", options.seed.value_or(1));
  plugin.attach(*context);
  plugin.setParameter("glass.internal_reflections", 6.0);
  plugin.addCar(flatPane(list));

  View eye;
  eye.eye_from_world =
      glm::lookAt(list.eye_m, list.eye_m + glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0));
  eye.projection = reversedPerspective(list.fov_rad, options.size_px, 0.01);
  const rg_view view = pluginView(plugin.api(), eye, options.size_px, glm::dvec3(0.0), kCarId);
  Moment moment;
  plugin.api().default_weather(&moment.weather);
  moment.view = view;
  plugin.tell(moment);
  plugin.update(0);
  plugin.placeDrops(1, list.drops);  // after the tick: none has begun to run or to merge
  plugin.stepGpu();

  const Target target(*context, options.size_px);
  const Picture picture(*context, options.size_px);
  renderer.beginFrame(Sky{}, list.eye_m);
  plugin.capture(renderer, view, 6);
  renderer.drawWorld(eye, target);
  plugin.drawGlass(0, view, target, renderer.lighting());
  renderer.encodeSrgb(target, picture.framebuffer());
  writePng(options.out / "shot_0.00.png", picture.read(), options.size_px.x, options.size_px.y);

  Report report;
  report.gl_vendor = context->vendor();
  report.gl_renderer = context->rendererName();
  report.gl_version = context->version();
  report.scenario = options.drops.filename().string();
  report.size_px = options.size_px;
  report.frames = 1;
  report.gpu_timer = plugin.gpuTimer();
  report.stages = plugin.stages();
  report.rain = plugin.rainStats();
  report.panes = plugin.paneStats();
  report.rain_hash = plugin.hash(RG_HASH_RAIN);
  report.state_hash = plugin.hash(RG_HASH_STATE);
  report.gl_errors = context->glErrors();
  writeReport(options.out / "report.json", report);
  return 0;
}

}  // namespace host
