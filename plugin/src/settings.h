// What a host may tune while it runs, as data: one list that the ABI's parameters, their checks and the code
// all read.
#pragma once

#include <span>

#include "tick.h"

namespace rg {

struct Settings {
  double rain_gain = 5.0;
  double rain_visibility_factor = 1.2;
  double rain_reference_px = 1663.0;
  double rain_beyond = 1.0;
  double rain_near_bias = 1.0, rain_near_contrast = 0.4;
  double rain_middle_bias = 1.0, rain_middle_contrast = 0.3;
  double rain_far_bias = 1.0, rain_far_contrast = 0.15;
  double rain_haze_bias = 1.0;
  double splashes_gain = 3.0;
  double splashes_reach_m = 20.0;
  double wetness_strength = 0.0;
  double glow_strength = 0.0;
  double glass_brightness = 1.0;
  double glass_blur = 1.0;
  double glass_pupil_m = 0.0;
  double glass_run_off = 0.5;
  double glass_threads = 0.0;
  double glass_internal_reflections = 3.0;
  double glass_capture_px = 256.0;
  double fog_cabin_temperature_c = 20.0;
  double fog_cabin_humidity = 0.0;
  double fog_demister = 0.0;
  double fog_demister_c = 45.0;
  double wind_gust_share = 0.0;
  double wind_gust_time_s = 10.0;
  double wind_roughness_m = 0.0;
  double wind_height_m = 1.5;
  double precipitation_by_temperature = 0.0;
  double time_catch_up_s = double{kLongestCatchUp_s};
  double bench_repeat = 1.0;
};

struct SettingInfo {
  const char* name;
  const char* unit;
  const char* group;
  const char* text;
  double minimum, maximum;
  double Settings::*value;
};

inline constexpr SettingInfo kSettings[] = {
    {"rain.gain", "1", "rain",
     "how much stronger than in nature a streak covers what is behind it, where that is as bright as the "
     "streak; less before the dark; 1 = physical everywhere, for camera-sensor work",
     0.0, 50.0, &Settings::rain_gain},
    {"rain.visibility_factor", "1", "rain",
     "a drop is a particle to the distance factor * reference_px * diameter", 0.25, 4.0,
     &Settings::rain_visibility_factor},
    {"rain.reference_px", "px", "rain",
     "focal length of the reference picture; never the view's own resolution", 100.0, 20000.0,
     &Settings::rain_reference_px},
    {"rain.beyond", "1", "rain",
     "how much is drawn of the rain that is too far off to be particles; 0 = none, 1 = as much as there is",
     0.0, 1.0, &Settings::rain_beyond},
    {"rain.near_bias", "1", "rain", "how dense rain looks up to 16 m; 1 = as it is", 0.0, 4.0,
     &Settings::rain_near_bias},
    {"rain.near_contrast", "1", "rain", "how much it shows of the pattern; 0 = an even haze, 1 = all of it",
     0.0, 1.0, &Settings::rain_near_contrast},
    {"rain.middle_bias", "1", "rain", "how dense rain looks from 16 to 40 m; 1 = as it is", 0.0, 4.0,
     &Settings::rain_middle_bias},
    {"rain.middle_contrast", "1", "rain", "how much it shows of the pattern; 0 = an even haze, 1 = all of it",
     0.0, 1.0, &Settings::rain_middle_contrast},
    {"rain.far_bias", "1", "rain", "how dense rain looks from 40 to 100 m; 1 = as it is", 0.0, 4.0,
     &Settings::rain_far_bias},
    {"rain.far_contrast", "1", "rain", "how much it shows of the pattern; 0 = an even haze, 1 = all of it",
     0.0, 1.0, &Settings::rain_far_contrast},
    {"rain.haze_bias", "1", "rain", "how dense rain looks beyond 100 m; 1 = as it is", 0.0, 4.0,
     &Settings::rain_haze_bias},
    {"splashes.gain", "1", "splashes",
     "how much stronger than in nature splashes cover what is behind them; 1 = physical, 0 = there are none",
     0.0, 20.0, &Settings::splashes_gain},
    {"splashes.reach_m", "m", "splashes", "how far from the eye splashes are drawn, the last third fading",
     0.0, 40.0, &Settings::splashes_reach_m},
    {"wetness.strength", "1", "wetness",
     "how wet rain makes what the host has drawn look, darker and mirroring; 0 = not at all: for hosts that "
     "draw wet surfaces themselves",
     0.0, 1.0, &Settings::wetness_strength},
    {"glow.strength", "1", "glow",
     "how much of the picture's light draw_finish spreads as the driver's eye does; 1 = as that of a driver "
     "of "
     "40, 0 = none: for hosts that draw a glow themselves",
     0.0, 4.0, &Settings::glow_strength},
    {"glass.brightness", "1", "glass", "of what is seen through water", 0.0, 2.0,
     &Settings::glass_brightness},
    {"glass.blur", "1", "glass", "of what is seen through droplets too small to be drawn", 0.0, 4.0,
     &Settings::glass_blur},
    {"glass.pupil_m", "m", "glass",
     "width of the pupil of the eye or camera, which is focused on what is far: water on glass that it looks "
     "through is out of focus as much, where depth_texture is given; 0 = all is sharp",
     0.0, 0.05, &Settings::glass_pupil_m},
    {"glass.run_off", "1", "glass",
     "share of the water that runs off a pane at a pillar and goes on over the pane behind it; 0 = the car "
     "has "
     "gutters there",
     0.0, 1.0, &Settings::glass_run_off},
    {"glass.threads", "1", "glass",
     "threads of the instance's own among which panes are shared out, besides that which calls update, or as "
     "many as the system gives; on its cores and at its priority; what comes of it is the same; no part of a "
     "saved state",
     0.0, 16.0, &Settings::glass_threads},
    {"glass.internal_reflections", "1", "glass", "followed inside a drop", 0.0, 6.0,
     &Settings::glass_internal_reflections},
    {"glass.capture_px", "px", "glass", "side of a face of the captured surroundings", 32.0, 2048.0,
     &Settings::glass_capture_px},
    {"fog.cabin_temperature_c", "deg C", "fog", "of the air in the cabin", -40.0, 60.0,
     &Settings::fog_cabin_temperature_c},
    {"fog.cabin_humidity", "1", "fog",
     "of the air in the cabin, relative: panes fog inside where they are colder than its dew point; 0 = none "
     "ever does",
     0.0, 1.0, &Settings::fog_cabin_humidity},
    {"fog.demister", "1", "fog",
     "share of its full flow with which the demister blows up those panes that it reaches (rg_pane_info)",
     0.0, 1.0, &Settings::fog_demister},
    {"fog.demister_c", "deg C", "fog", "of the air it blows, which comes from outside", -40.0, 90.0,
     &Settings::fog_demister_c},
    {"wind.gust_share", "1", "wind",
     "how gusty: standard deviation of the wind's speed by its mean (0.17 over open country at 10 m)", 0.0,
     0.5, &Settings::wind_gust_share},
    {"wind.gust_time_s", "s", "wind", "how long a gust lasts (integral time scale)", 5.0, 600.0,
     &Settings::wind_gust_time_s},
    {"wind.roughness_m", "m", "wind",
     "of the ground (0.03 grass, 0.5 park, 1 suburb): the wind is told at 10 m and is less below; 0 = it is "
     "alike at every height",
     0.0, 1.0, &Settings::wind_roughness_m},
    {"wind.height_m", "m", "wind",
     "of drops and glass above ground, where they have what wind.roughness_m leaves of the wind", 1.0, 10.0,
     &Settings::wind_height_m},
    {"precipitation.by_temperature", "1", "precipitation",
     "1: rain and snow together are shared out anew by temperature and humidity; 0: they fall as told", 0.0,
     1.0, &Settings::precipitation_by_temperature},
    {"time.catch_up_s", "s", "time",
     "the longest stall that is caught up with; of a longer one the rest is left out", 0.1,
     double{kLongestCatchUp_s}, &Settings::time_catch_up_s},
    {"bench.repeat", "1", "bench",
     "draws rain and glass so many times in one stage, to see a frame budget trip", 1.0, 16.0,
     &Settings::bench_repeat},
};

}  // namespace rg
