/* second_host PLUGIN RAIN_MM_H PICTURE.ppm: a whole host in plain C, of other habits than host_sim's: its
 * world's origin lies 1000 km away (where floats step by 6 cm), it samples that world at 60 Hz, its depth is
 * reversed, infinite, from 0 to 1. A car drives at dusk towards a street lamp; the wall on the left mirrors
 * the even sky and hides what is behind it. */
#include <dlfcn.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "offscreen.h"
#include "rainglass/rainglass.h"

enum { WIDTH = 320, HEIGHT = 180, STEPS = 60 };
static const double kOrigin_m = 1000000.3, kEye_m = 1.2, kSpeed_mps = 15, kWall_m = 6, kNear_m = 0.1;
static const float kSky = 128.5f / 16384, kWhite = 0.03125f, kLamp = 20; /* 1000 cd/m^2, 1000 cd */

static const rg_api* open_plugin(const char* path) {
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  require(library != NULL, "the plugin cannot be opened");
  const rg_api* (*entry)(uint32_t) = NULL;
  *(void**)&entry = dlsym(library, "rg_get_entry");
  const rg_api* api = entry != NULL ? entry(RG_ABI_VERSION) : NULL;
  require(api != NULL, "the plugin speaks another ABI");
  return api;
}

/* Along the world's +x, 60 degrees wide. */
static void look_from(const double eye_m[3], rg_view* view) {
  const double f = sqrt(3);
  const double eye[16] = {0, 0, -1, 0, -1, 0, 0, 0, 0, 1, 0, 0, eye_m[1], -eye_m[2], eye_m[0], 1};
  const double clip[16] = {f, 0, 0, 0, 0, f * WIDTH / HEIGHT, 0, 0, 0, 0, 0, -1, 0, 0, kNear_m, 0};
  memcpy(view->eye_from_world, eye, sizeof eye);
  memcpy(view->projection, clip, sizeof clip);
}

static void draw_scene(const GladGLContext* gl, rg_target* target) {
  const float sky[4] = {kSky, kSky, kSky, 1}, infinity = 0, wall = (float)(kNear_m / kWall_m);
  GLuint color, depth, framebuffer;
  gl->CreateTextures(GL_TEXTURE_2D, 1, &color);
  gl->CreateTextures(GL_TEXTURE_2D, 1, &depth);
  gl->TextureStorage2D(color, 1, GL_RGBA16F, WIDTH, HEIGHT);
  gl->TextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT);
  gl->ClearTexImage(color, 0, GL_RGBA, GL_FLOAT, sky);
  gl->ClearTexImage(depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &infinity);
  gl->ClearTexSubImage(depth, 0, 0, 0, 0, WIDTH / 2, HEIGHT, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &wall);
  gl->CreateFramebuffers(1, &framebuffer);
  gl->NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
  gl->NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
  target->framebuffer = framebuffer;
  target->color_texture = color;
  target->depth_texture = depth;
  target->width_px = WIDTH;
  target->height_px = HEIGHT;
}

int main(int argc, char** argv) {
  require(argc == 4, "usage: second_host PLUGIN RAIN_MM_H PICTURE.ppm");
  const rg_api* api = open_plugin(argv[1]);
  GladGLContext gl;
  make_context(&gl);
  rg_create_info create;
  rg_instance* rain;
  api->default_create_info(&create);
  require(api->create(&create, &rain) >= 0, api->last_error(NULL));
  const rg_gl_info gl_info = {.struct_size = sizeof gl_info, .get_proc = get_proc};
  require(api->attach_gl(rain, &gl_info) >= 0, api->last_error(rain));

  rg_weather weather;
  api->default_weather(&weather);
  weather.rain_mm_h = atof(argv[2]);
  rg_vehicle car;
  api->default_vehicle(&car);
  car.id = 1;
  rg_view view;
  api->default_view(&view);
  view.vehicle = car.id;
  view.viewport_px[2] = WIDTH;
  view.viewport_px[3] = HEIGHT;
  view.clip_zero_to_one = view.reversed_depth = 1;
  car.pose.velocity_mps[0] = view.eye_velocity_mps[0] = kSpeed_mps;
  rg_sample sample;
  api->default_sample(&sample);
  sample.weather = &weather;
  sample.vehicles = &car;
  sample.views = &view;
  sample.vehicle_count = sample.view_count = 1;
  for (int step = 0; step <= STEPS; ++step) {
    const double eye_m[3] = {kOrigin_m + kSpeed_mps * step / 60, kOrigin_m, kEye_m};
    look_from(eye_m, &view);
    memcpy(car.pose.position_m, eye_m, 2 * sizeof eye_m[0]);
    sample.time_ns = step * INT64_C(1000000000) / 60;
    require(api->update(rain, sample.time_ns, &sample, 1, sizeof sample) >= 0, api->last_error(rain));
    require(api->step_gpu(rain) >= 0, api->last_error(rain));
  }

  const rg_lamp lamp = {{kOrigin_m + 40, kOrigin_m - 6, 3}, {0, 0, -1}, {kLamp, kLamp, kLamp}, -1, -1};
  rg_lighting light = {.struct_size = sizeof light, .lamp_count = 1, .lamps = &lamp};
  for (int i = 0; i < 3; ++i) light.sky_radiance[i] = light.ground_radiance[i] = kSky;
  rg_target target;
  api->default_target(&target);
  draw_scene(&gl, &target);
  rg_draw draw = {.struct_size = sizeof draw, .time_ns = sample.time_ns};
  draw.view = &view;
  draw.target = &target;
  draw.lighting = &light;
  require(api->draw_world(rain, &draw) >= 0, api->last_error(rain));
  require(api->draw_glass(rain, &draw) >= 0, api->last_error(rain));
  require(api->draw_finish(rain, &draw) >= 0, api->last_error(rain));
  write_picture(&gl, target.color_texture, WIDTH, HEIGHT, kWhite, argv[3]);
  require(api->detach_gl(rain) >= 0, api->last_error(rain));
  api->destroy(rain);
  return 0;
}
