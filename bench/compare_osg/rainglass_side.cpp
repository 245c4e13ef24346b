#include "rainglass_side.h"

#include <dlfcn.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "off_screen.h"
#include "target.h"

namespace compare {
namespace {

constexpr double kRate_mm_h = 100.0;
constexpr uint32_t kMostDrops = 400000;
constexpr GLenum kCounts[] = {0x82EE,
                              0x82EF};  // ARB_pipeline_statistics_query: vertices and primitives submitted

}  // namespace

RainglassSide::RainglassSide(const GladGLContext& gl, uint32_t framebuffer, const std::string& library)
    : gl_(gl), framebuffer_(framebuffer), library_(dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (library_ == nullptr) throw std::runtime_error(dlerror());
  const auto entry = reinterpret_cast<const rg_api* (*)(uint32_t)>(dlsym(library_, "rg_get_entry"));
  if (entry == nullptr || (api_ = entry(RG_ABI_VERSION)) == nullptr)
    throw std::runtime_error(library + " is no Rainglass of this version");
  rg_create_info create;
  api_->default_create_info(&create);
  create.max_drops = kMostDrops;
  check(api_->create(&create, &instance_));
  rg_gl_info info;
  api_->default_gl_info(&info);
  info.get_proc = bench::getProc;
  check(api_->attach_gl(instance_, &info));
  check(api_->set_parameter(instance_, "rain.beyond", 0.0));  // OpenSceneGraph draws no far rain either
  gl_.GenQueries(2, queries_);
}

RainglassSide::~RainglassSide() {
  gl_.DeleteQueries(2, queries_);
  api_->detach_gl(instance_);
  api_->destroy(instance_);
  dlclose(library_);
}

void RainglassSide::check(rg_result result) {
  if (result < 0) throw std::runtime_error(std::string("rainglass: ") + api_->last_error(instance_));
}

void RainglassSide::setReference(double px) {
  check(api_->set_parameter(instance_, "rain.reference_px", px));
}

rg_view RainglassSide::viewAt(const Moment& m) const {
  rg_view view;
  api_->default_view(&view);
  view.id = 1;
  const double y = 1.0 / std::tan(0.5 * kFieldOfView_rad), x = y * kHeight_px / kWidth_px;
  const double eye[16] = {0, 0, -1, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, -kEyeHeight_m, m.x_m(), 1};
  const double depth = kFar_m - kNear_m;
  const double projection[16] = {
      x, 0, 0, 0, 0, y, 0, 0, 0, 0, -(kFar_m + kNear_m) / depth, -1, 0, 0, -2.0 * kFar_m * kNear_m / depth,
      0};
  std::memcpy(view.eye_from_world, eye, sizeof eye);
  std::memcpy(view.projection, projection, sizeof projection);
  view.viewport_px[2] = kWidth_px;
  view.viewport_px[3] = kHeight_px;
  view.exposure_s = kExposure_s;
  view.eye_velocity_mps[0] = m.speed_mps;
  return view;
}

void RainglassSide::drawEmpty(const Moment&) {
  const float black[4] = {}, far = 1.0f;
  gl_.ClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, black);
  gl_.ClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far);
}

void RainglassSide::draw(const Moment& moment) {
  drawEmpty(moment);
  rg_weather weather;
  api_->default_weather(&weather);
  weather.rain_mm_h = kRate_mm_h;
  const rg_view view = viewAt(moment);
  rg_sample sample;
  api_->default_sample(&sample);
  sample.time_ns = moment.time_ns();
  sample.weather = &weather;
  sample.views = &view;
  sample.view_count = 1;
  check(api_->update(instance_, sample.time_ns, &sample, 1, sizeof sample));
  check(api_->step_gpu(instance_));
  rg_target target;
  api_->default_target(&target);
  target.framebuffer = framebuffer_;
  target.width_px = kWidth_px;
  target.height_px = kHeight_px;
  rg_draw draw;
  api_->default_draw(&draw);
  draw.time_ns = sample.time_ns;
  draw.view = &view;
  draw.target = &target;
  if (counts_) {
    for (size_t i = 0; i < 2; ++i) gl_.BeginQuery(kCounts[i], queries_[i]);
  }
  check(api_->draw_world(instance_, &draw));
  if (!counts_) return;
  double counts[2];
  for (size_t i = 0; i < 2; ++i) {
    GLuint64 count = 0;
    gl_.EndQuery(kCounts[i]);
    gl_.GetQueryObjectui64v(queries_[i], GL_QUERY_RESULT, &count);
    counts[i] = static_cast<double>(count);
  }
  // A thin streak is a line of two vertices, any other two triangles of six in all.
  const double vertices = counts[0], primitives = counts[1];
  seen_ = 2.0 * primitives - 0.5 * vertices;
}

}  // namespace compare
