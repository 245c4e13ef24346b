// Nonsense gets a code and a message, and changes nothing.
#include "bad_arguments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

namespace rg::test {
namespace {

TEST_F(BadArguments, aNullInstanceIsRefusedEverywhere) {
  const std::vector<rg_result> results{api.attach_gl(nullptr, nullptr),
                                       api.detach_gl(nullptr),
                                       api.context_lost(nullptr),
                                       api.set_volume(nullptr, 1, nullptr),
                                       api.remove_volume(nullptr, 1),
                                       api.remove_vehicle(nullptr, 1),
                                       api.set_pane(nullptr, 1, nullptr),
                                       api.remove_pane(nullptr, 1),
                                       api.set_wiper(nullptr, 1, nullptr),
                                       api.remove_wiper(nullptr, 1),
                                       api.place_drops(nullptr, 1, nullptr, 0),
                                       api.update(nullptr, 0, nullptr, 0, 0),
                                       api.step_gpu(nullptr),
                                       api.prepare_captures(nullptr, nullptr),
                                       api.draw_world(nullptr, nullptr),
                                       api.draw_glass(nullptr, nullptr),
                                       api.draw_finish(nullptr, nullptr),
                                       api.reset(nullptr),
                                       api.seek(nullptr, 0),
                                       api.prewarm(nullptr, 1.0),
                                       api.rebase_origin(nullptr, nullptr),
                                       api.save(nullptr, nullptr, nullptr),
                                       api.restore(nullptr, nullptr, 0),
                                       api.get_rain_stats(nullptr, nullptr),
                                       api.get_pane_stats(nullptr, 1, nullptr),
                                       api.get_stage_count(nullptr, nullptr),
                                       api.get_stage(nullptr, 0, nullptr),
                                       api.get_timer_kind(nullptr, nullptr),
                                       api.get_hash(nullptr, 0, nullptr),
                                       api.get_parameter_count(nullptr, nullptr),
                                       api.get_parameter(nullptr, 0, nullptr),
                                       api.set_parameter(nullptr, nullptr, 0.0),
                                       api.set_rain_pattern(nullptr, nullptr)};
  for (size_t i = 0; i < results.size(); ++i)
    EXPECT_EQ(results[i], RG_ERROR_BAD_ARGUMENT) << "function " << i;
  api.destroy(nullptr);
  EXPECT_NE(api.last_error(nullptr), nullptr);
}

TEST_F(BadArguments, aNullStructIsRefusedEverywhere) {
  rg_instance* const i = scene.instance;
  const std::vector<std::pair<const char*, std::function<rg_result()>>> calls{
      {"attach_gl", [&] { return api.attach_gl(i, nullptr); }},
      {"set_volume", [&] { return api.set_volume(i, 9, nullptr); }},
      {"set_pane", [&] { return api.set_pane(i, 9, nullptr); }},
      {"set_wiper", [&] { return api.set_wiper(i, 9, nullptr); }},
      {"place_drops", [&] { return api.place_drops(i, kPane, nullptr, 3); }},
      {"update", [&] { return api.update(i, scene.time_ns + 1, nullptr, 2, sizeof(rg_sample)); }},
      {"prepare_captures", [&] { return api.prepare_captures(i, nullptr); }},
      {"draw_world", [&] { return api.draw_world(i, nullptr); }},
      {"draw_glass", [&] { return api.draw_glass(i, nullptr); }},
      {"draw_finish", [&] { return api.draw_finish(i, nullptr); }},
      {"rebase_origin", [&] { return api.rebase_origin(i, nullptr); }},
      {"get_rain_stats", [&] { return api.get_rain_stats(i, nullptr); }},
      {"get_pane_stats", [&] { return api.get_pane_stats(i, kPane, nullptr); }},
      {"get_stage_count", [&] { return api.get_stage_count(i, nullptr); }},
      {"get_stage", [&] { return api.get_stage(i, 0, nullptr); }},
      {"get_timer_kind", [&] { return api.get_timer_kind(i, nullptr); }},
      {"get_hash", [&] { return api.get_hash(i, RG_HASH_RAIN, nullptr); }},
      {"get_parameter_count", [&] { return api.get_parameter_count(i, nullptr); }},
      {"get_parameter", [&] { return api.get_parameter(i, 0, nullptr); }},
      {"set_parameter", [&] { return api.set_parameter(i, nullptr, 1.0); }}};
  for (const auto& [name, call] : calls) expectRefused(name, call);
}

TEST_F(BadArguments, unknownIdsAreNotFound) {
  EXPECT_EQ(api.remove_volume(scene.instance, 77), RG_ERROR_NOT_FOUND);
  EXPECT_EQ(api.remove_pane(scene.instance, 77), RG_ERROR_NOT_FOUND);
  EXPECT_EQ(api.remove_wiper(scene.instance, 77), RG_ERROR_NOT_FOUND);
  EXPECT_EQ(api.set_parameter(scene.instance, "no.such", 1.0), RG_ERROR_NOT_FOUND);
  rg_stage_stats stage{};
  stage.struct_size = sizeof stage;
  EXPECT_EQ(api.get_stage(scene.instance, 1000, &stage), RG_ERROR_NOT_FOUND);
}

TEST_F(BadArguments, weatherThatIsNoNumberIsRefused) {
  rg_weather good;
  api.default_weather(&good);
  expectStructChecked<rg_weather>(
      "rg_weather", good,
      {offsetof(rg_weather, rain_mm_h), offsetof(rg_weather, snow_mm_h), offsetof(rg_weather, wind_mps),
       offsetof(rg_weather, wind_mps) + 8, offsetof(rg_weather, wind_mps) + 16,
       offsetof(rg_weather, temperature_c), offsetof(rg_weather, humidity),
       offsetof(rg_weather, visibility_m), offsetof(rg_weather, hail_mm_h),
       offsetof(rg_weather, ground_height_m)},
      [this](const rg_weather& w) { return updateWith([&](rg_sample& s) { s.weather = &w; }); });
}

TEST_F(BadArguments, weatherThatIsNotOfThisWorldIsRefusedByName) {
  rg_weather good;
  api.default_weather(&good);
  const auto refused = [&](const std::string& field, double rg_weather::*value, double wrong) {
    rg_weather bad = good;
    bad.*value = wrong;
    expectRefused(
        field + " of " + std::to_string(wrong),
        [&] { return updateWith([&](rg_sample& s) { s.weather = &bad; }); }, RG_ERROR_BAD_ARGUMENT, field);
  };
  for (const double rate : {-1e-9, -5.0, 300.1, 1e9})
    refused("rg_weather.rain_mm_h", &rg_weather::rain_mm_h, rate);
  for (int axis = 0; axis < 3; ++axis) {
    rg_weather bad = good;
    bad.wind_mps[axis] = axis == 1 ? -1e4 : 1e4;
    expectRefused(
        "a wind of 10 000 m/s", [&] { return updateWith([&](rg_sample& s) { s.weather = &bad; }); },
        RG_ERROR_BAD_ARGUMENT, "rg_weather.wind_mps");
  }
}

TEST_F(BadArguments, vehiclesThatAreNoNumbersAreRefused) {
  rg_vehicle good;
  api.default_vehicle(&good);
  good.id = kCar;
  const auto call = [this](const rg_vehicle& v) {
    return updateWith([&](rg_sample& s) {
      s.vehicles = &v;
      s.vehicle_count = 1;
    });
  };
  const size_t pose = offsetof(rg_vehicle, pose);
  expectStructChecked<rg_vehicle>(
      "rg_vehicle", good, {pose, pose + 16, pose + 24, pose + 48, pose + 56, pose + 72, pose + 80, pose + 96},
      call);
  rg_vehicle bad = good;
  bad.id = 0;
  expectRefused("vehicle 0", [&] { return call(bad); });
  bad = good;
  bad.pose.orientation[3] = 0.0;
  expectRefused("an orientation of length 0", [&] { return call(bad); });
}

TEST_F(BadArguments, viewsThatAreNoNumbersAreRefused) {
  const rg_view good = scene.view;
  const auto call = [this](const rg_view& v) {
    return updateWith([&](rg_sample& s) {
      s.views = &v;
      s.view_count = 1;
    });
  };
  expectStructChecked<rg_view>("rg_view", good,
                               {offsetof(rg_view, eye_from_world), offsetof(rg_view, eye_from_world) + 96,
                                offsetof(rg_view, projection), offsetof(rg_view, projection) + 80,
                                offsetof(rg_view, exposure_s), offsetof(rg_view, eye_velocity_mps)},
                               call);
  rg_view bad = good;
  bad.viewport_px[2] = -1;
  expectRefused("a viewport of negative width", [&] { return call(bad); });
  const auto spoilt = [&](const std::string& what, const std::string& because,
                          const std::function<void(rg_view&)>& spoil) {
    rg_view view = good;
    spoil(view);
    expectRefused(
        what, [&] { return call(view); }, RG_ERROR_BAD_ARGUMENT, because);
  };
  spoilt("a view volume of no width", "projection has no inverse", [](rg_view& v) { v.projection[0] = 0.0; });
  spoilt("a view volume of nothing", "projection has no inverse",
         [](rg_view& v) { std::fill(std::begin(v.projection), std::end(v.projection), 0.0); });
  spoilt("an orthographic view", "orthographic", [](rg_view& v) {
    v.projection[11] = 0.0;
    v.projection[15] = 1.0;
  });
  spoilt("a view turned inside out", "mirrors", [](rg_view& v) {
    for (int i = 0; i < 3; ++i) v.eye_from_world[4 * i] *= -1.0;
  });
}

TEST_F(BadArguments, samplesOutOfOrderAreRefused) {
  expectRefused("a sample in the past",
                [&] { return updateWith([&](rg_sample& s) { s.time_ns = scene.time_ns - 1; }); });
  expectRefused("a sample after the update",
                [&] { return updateWith([&](rg_sample& s) { s.time_ns = scene.time_ns + 2'000'000; }); });
  expectRefused("time that runs backwards",
                [&] { return api.update(scene.instance, 0, nullptr, 0, sizeof(rg_sample)); });
  expectRefused("a stride of 1", [&] {
    rg_sample sample;
    api.default_sample(&sample);
    return api.update(scene.instance, scene.time_ns, &sample, 1, 1);
  });
}

TEST_F(BadArguments, parametersOutOfRangeAreRefused) {
  uint32_t count = 0;
  ASSERT_EQ(api.get_parameter_count(scene.instance, &count), RG_OK);
  ASSERT_GT(count, 0u);
  for (uint32_t i = 0; i < count; ++i) {
    rg_parameter p{};
    p.struct_size = sizeof p;
    ASSERT_EQ(api.get_parameter(scene.instance, i, &p), RG_OK);
    for (const double value : {kNaN, kInfinity, p.minimum - 1.0, p.maximum + 1.0}) {
      expectRefused(
          p.name, [&] { return api.set_parameter(scene.instance, p.name, value); }, RG_ERROR_BAD_ARGUMENT,
          p.name);
    }
    rg_parameter after{};
    after.struct_size = sizeof after;
    ASSERT_EQ(api.get_parameter(scene.instance, i, &after), RG_OK);
    EXPECT_EQ(after.value, p.value) << p.name;
  }
}

}  // namespace
}  // namespace rg::test
