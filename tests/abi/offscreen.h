/* What a host has before it meets the plugin, in plain C: an OpenGL 4.5 context, here without a window, and a
 * way to show its pictures. */
#ifndef RAINGLASS_TESTS_OFFSCREEN_H
#define RAINGLASS_TESTS_OFFSCREEN_H

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <glad/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "window/egl_displays.h"

static inline void require(int met, const char* what) {
  if (met) return;
  fprintf(stderr, "%s\n", what);
  exit(1);
}

/* As rg_gl_info wants it. */
static inline void* get_proc(void* user, const char* name) {
  void (*function)(void) = eglGetProcAddress(name);
  (void)user;
  return *(void**)&function;
}

static inline void make_context(GladGLContext* gl) {
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  EGLDisplay display = egl_first_display();
  require(display != EGL_NO_DISPLAY, "there is no EGL");
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
  require(context != EGL_NO_CONTEXT, "there is no OpenGL 4.5");
  require(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE,
          "EGL wants a surface");
  require(gladLoadGLContext(gl, eglGetProcAddress), "OpenGL's functions cannot be loaded");
}

/* Of linear light, 0 to 1 (IEC 61966-2-1). */
static inline int srgb(float light) {
  const float c = fminf(fmaxf(light, 0), 1);
  return (int)(255 * (c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1 / 2.4f) - 0.055f) + 0.5f);
}

/* A texture of linear radiance as an sRGB picture in which the radiance `white` is white. */
static inline void write_picture(const GladGLContext* gl, GLuint texture, int width, int height, float white,
                                 const char* path) {
  const size_t row = 3 * (size_t)width, count = row * (size_t)height;
  float* rgb = malloc(count * sizeof *rgb);
  FILE* file = fopen(path, "wb");
  require(rgb != NULL && file != NULL, "the picture cannot be written");
  gl->GetTextureImage(texture, 0, GL_RGB, GL_FLOAT, (GLsizei)(count * sizeof *rgb), rgb);
  require(gl->GetError() == GL_NO_ERROR, "a GL error is pending");
  fprintf(file, "P6\n%d %d\n255\n", width, height);
  for (size_t y = (size_t)height; y-- > 0;) {
    for (size_t x = 0; x < row; ++x) fputc(srgb(rgb[y * row + x] / white), file);
  }
  free(rgb);
  require(fclose(file) == 0, "the picture cannot be written");
}

#endif
