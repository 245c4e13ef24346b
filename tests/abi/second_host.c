/* second_host PLUGIN PICTURE.ppm near|far [RAIN_MM_H]: another host than host_sim, in plain C and with other
 * habits. `near` draws with OpenGL's own depth at the origin; `far` with reversed infinite depth, clip space
 * from 0 to 1, 1000 km away. Both pictures are to be the same: rain from a moving car, a wall 6 m ahead on
 * the left that hides the rain behind it, and a small pane of glass on the right. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <glad/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rainglass/rainglass.h"

enum { WIDTH = 320, HEIGHT = 180, STEPS = 60 };
static const double kNear_m = 0.1, kFar_m = 1000.0, kWall_m = 6.0, kSpeed_mps = 15.0;

static void fail(const char* what) {
  fprintf(stderr, "second_host: %s\n", what);
  exit(1);
}
static void check(rg_result result, const rg_api* api, rg_instance* instance) {
  if (result < 0) fail(api->last_error(instance));
}
static void* get_proc(void* user, const char* name) {
  (void)user;
  void* address;
  void (*function)(void) = eglGetProcAddress(name);
  memcpy(&address, &function, sizeof address);
  return address;
}
static GLADapiproc glad_proc(const char* name) { return eglGetProcAddress(name); }

static void make_context(GladGLContext* gl) {
  PFNEGLGETPLATFORMDISPLAYEXTPROC get =
      (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
  EGLDisplay display =
      get ? get(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL) : eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API)) fail("no EGL");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    fail("no OpenGL 4.5");
  if (!gladLoadGLContext(gl, glad_proc)) fail("no OpenGL functions");
}

/* Looks along the world's +x from `eye`; 60 degrees across. */
static void set_view(rg_view* view, const double eye[3], int far_away) {
  const double m[16] = {0, 0, -1, 0, -1, 0, 0, 0, 0, 1, 0, 0, eye[1], -eye[2], eye[0], 1};
  const double focal = 1.0 / tan(0.5 * 60.0 * 3.14159265358979323846 / 180.0);
  memcpy(view->eye_from_world, m, sizeof m);
  memset(view->projection, 0, sizeof view->projection);
  view->projection[0] = focal;
  view->projection[5] = focal * WIDTH / HEIGHT;
  view->projection[11] = -1.0;
  view->projection[10] = far_away ? 0.0 : -(kFar_m + kNear_m) / (kFar_m - kNear_m);
  view->projection[14] = far_away ? kNear_m : -2.0 * kFar_m * kNear_m / (kFar_m - kNear_m);
  view->clip_zero_to_one = view->reversed_depth = far_away ? 1u : 0u;
  view->viewport_px[2] = WIDTH;
  view->viewport_px[3] = HEIGHT;
  view->vehicle = 1;
  view->eye_velocity_mps[0] = kSpeed_mps;
}

/* What the depth buffer holds at a distance. */
static float depth_at(double distance_m, int far_away) {
  if (far_away) return (float)(kNear_m / distance_m);
  const double ndc = (kFar_m + kNear_m - 2.0 * kFar_m * kNear_m / distance_m) / (kFar_m - kNear_m);
  return (float)(0.5 * ndc + 0.5);
}

static GLuint make_scene(GladGLContext* gl, int far_away) {
  GLuint framebuffer, textures[2];
  const float sky[4] = {0.3f, 0.35f, 0.4f, 1.0f}, wall[4] = {0.2f, 0.1f, 0.1f, 1.0f};
  const float at_infinity = far_away ? 0.0f : 1.0f, at_wall = depth_at(kWall_m, far_away);
  gl->CreateFramebuffers(1, &framebuffer);
  gl->CreateTextures(GL_TEXTURE_2D, 2, textures);
  gl->TextureStorage2D(textures[0], 1, GL_RGBA16F, WIDTH, HEIGHT);
  gl->TextureStorage2D(textures[1], 1, GL_DEPTH_COMPONENT32F, WIDTH, HEIGHT);
  gl->NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, textures[0], 0);
  gl->NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, textures[1], 0);
  gl->ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, sky);
  gl->ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &at_infinity);
  gl->Enable(GL_SCISSOR_TEST);
  gl->Scissor(0, 0, WIDTH / 2, HEIGHT);
  gl->ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, wall);
  gl->ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &at_wall);
  gl->Disable(GL_SCISSOR_TEST);
  if (far_away) gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  return framebuffer;
}

/* A square of glass 0.4 m wide, 1 m before the eye and to its right; its outer side looks ahead. */
static void add_pane(const rg_api* api, rg_instance* rain) {
  const float positions[] = {1, -0.1f, 1, 1, -0.5f, 1, 1, -0.5f, 1.4f, 1, -0.1f, 1.4f},
              uvs[] = {0, 0, 1, 0, 1, 1, 0, 1};
  const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
  const rg_glass_drop drops[] = {{0.0, 0.0, 0.02, 60.0}, {0.1, 0.05, 0.01, 50.0}, {-0.1, -0.08, 0.015, 70.0}};
  rg_pane_info pane;
  api->default_pane_info(&pane);
  pane.vehicle = 1;
  pane.positions_m = positions;
  pane.uvs = uvs;
  pane.indices = indices;
  pane.vertex_count = 4;
  pane.index_count = 6;
  check(api->set_pane(rain, 1, &pane), api, rain);
  check(api->place_drops(rain, 1, drops, 3), api, rain);
}

static void write_picture(GladGLContext* gl, GLuint framebuffer, const char* path) {
  static unsigned char pixels[WIDTH * HEIGHT * 3];
  FILE* file = fopen(path, "wb");
  gl->BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl->ReadPixels(0, 0, WIDTH, HEIGHT, GL_RGB, GL_UNSIGNED_BYTE, pixels);
  if (gl->GetError() != GL_NO_ERROR) fail("a GL error is pending");
  if (!file || fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT) < 0) fail("cannot write the picture");
  for (int y = HEIGHT; y-- > 0;) fwrite(pixels + y * WIDTH * 3, 3, WIDTH, file);
  fclose(file);
}

int main(int argc, char** argv) {
  if (argc < 4) fail("usage: second_host PLUGIN PICTURE.ppm near|far [RAIN_MM_H]");
  const int far_away = strcmp(argv[3], "far") == 0;
  const double origin_m = far_away ? 1.0e6 : 0.0;
  void* plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (!plugin) fail(dlerror());
  const rg_api* (*entry)(uint32_t);
  void* symbol = dlsym(plugin, "rg_get_entry");
  memcpy(&entry, &symbol, sizeof entry);
  const rg_api* api = entry(RG_ABI_MAJOR);
  if (!api) fail("the plugin speaks another ABI");

  static GladGLContext gl;
  make_context(&gl);
  rg_create_info create;
  rg_instance* rain = NULL;
  api->default_create_info(&create);
  check(api->create(&create, &rain), api, NULL);
  rg_gl_info gl_info;
  api->default_gl_info(&gl_info);
  gl_info.get_proc = get_proc;
  check(api->attach_gl(rain, &gl_info), api, rain);
  add_pane(api, rain);

  rg_weather weather;
  rg_vehicle vehicle;
  rg_view view;
  rg_sample sample;
  api->default_weather(&weather);
  api->default_vehicle(&vehicle);
  api->default_view(&view);
  api->default_sample(&sample);
  weather.rain_mm_h = argc > 4 ? atof(argv[4]) : 50.0;
  vehicle.id = 1;
  vehicle.pose.velocity_mps[0] = kSpeed_mps;
  sample.weather = &weather;
  sample.vehicles = &vehicle;
  sample.views = &view;
  sample.vehicle_count = sample.view_count = 1;
  for (int step = 0; step <= STEPS; ++step) {
    const double x = origin_m + kSpeed_mps * step / 60.0, eye[3] = {x, origin_m, 1.2};
    sample.time_ns = step * INT64_C(1000000000) / 60;
    vehicle.pose.position_m[0] = x;
    vehicle.pose.position_m[1] = origin_m;
    set_view(&view, eye, far_away);
    check(api->update(rain, sample.time_ns, &sample, 1, sizeof sample), api, rain);
    check(api->step_gpu(rain), api, rain);
  }

  rg_target target;
  rg_draw draw;
  api->default_target(&target);
  api->default_draw(&draw);
  target.framebuffer = make_scene(&gl, far_away);
  target.width_px = WIDTH;
  target.height_px = HEIGHT;
  draw.time_ns = sample.time_ns;
  draw.view = &view;
  draw.target = &target;
  check(api->draw_world(rain, &draw), api, rain);
  check(api->draw_glass(rain, &draw), api, rain);
  check(api->draw_finish(rain, &draw), api, rain);
  write_picture(&gl, target.framebuffer, argv[2]);
  check(api->detach_gl(rain), api, rain);
  api->destroy(rain);
  dlclose(plugin);
  return 0;
}
