#include "window/egl_displays.h"

#include <EGL/eglext.h>
#include <string.h>

enum { kMostDevices = kMostEglDisplays - 1 };

static int has(const char* extensions, const char* name) {
  return extensions != NULL && strstr(extensions, name) != NULL;
}

int egl_displays(EGLDisplay* found) {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
      (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
  const PFNEGLQUERYDEVICESEXTPROC query_devices =
      (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
  const PFNEGLQUERYDEVICESTRINGEXTPROC query_string =
      (PFNEGLQUERYDEVICESTRINGEXTPROC)eglGetProcAddress("eglQueryDeviceStringEXT");
  EGLDeviceEXT devices[kMostDevices];
  EGLDisplay software[kMostDevices];
  EGLint device_count = 0;
  int count = 0, software_count = 0;
  if (get_display == NULL) return 0;
  if (has(client, "EGL_EXT_platform_device") && query_devices != NULL)
    query_devices(kMostDevices, devices, &device_count);
  for (EGLint i = 0; i < device_count; ++i) {
    const EGLDisplay display = get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
    if (query_string != NULL && has(query_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software"))
      software[software_count++] = display;
    else
      found[count++] = display;
  }
  if (has(client, "EGL_MESA_platform_surfaceless"))
    found[count++] = get_display(EGL_PLATFORM_SURFACELESS_MESA, NULL, NULL);
  for (int i = 0; i < software_count; ++i) found[count++] = software[i];
  return count;
}

EGLDisplay egl_first_display(void) {
  EGLDisplay displays[kMostEglDisplays];
  const int count = egl_displays(displays);
  for (int i = 0; i < count; ++i) {
    if (displays[i] != EGL_NO_DISPLAY && eglInitialize(displays[i], NULL, NULL) && eglBindAPI(EGL_OPENGL_API))
      return displays[i];
  }
  return EGL_NO_DISPLAY;
}
