/* Where EGL can draw without a window: for the host's headless runs, and for tests and bench/. In C, as one
 * of the hosts is. */
#ifndef RAINGLASS_EGL_DISPLAYS_H
#define RAINGLASS_EGL_DISPLAYS_H

#include <EGL/egl.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { kMostEglDisplays = 33 };

/* Fills `found` (of kMostEglDisplays) and returns how many: GPUs first, then Mesa's surfaceless platform,
 * then devices that are software. Some may be EGL_NO_DISPLAY, some may refuse to be initialised. */
int egl_displays(EGLDisplay* found);

/* The first of them that can be initialised, for OpenGL; EGL_NO_DISPLAY where there is none. */
EGLDisplay egl_first_display(void);

#ifdef __cplusplus
}
#endif
#endif
