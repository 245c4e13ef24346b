// The ABI's default_* functions. Null does nothing.
#pragma once

#include "rainglass/rainglass.h"

namespace rg {

void defaultCreateInfo(rg_create_info* out);
void defaultGlInfo(rg_gl_info* out);
void defaultVehicle(rg_vehicle* out);
void defaultWeather(rg_weather* out);
void defaultView(rg_view* out);
void defaultSample(rg_sample* out);
void defaultVolumeInfo(rg_volume_info* out);
void defaultPaneInfo(rg_pane_info* out);
void defaultWiperInfo(rg_wiper_info* out);
void defaultWashInfo(rg_wash_info* out);
void defaultAirflow(rg_airflow* out);
void defaultTarget(rg_target* out);
void defaultLighting(rg_lighting* out);
void defaultDraw(rg_draw* out);
void defaultCaptureInfo(rg_capture_info* out);
void defaultRainPattern(rg_rain_pattern* out);

}  // namespace rg
