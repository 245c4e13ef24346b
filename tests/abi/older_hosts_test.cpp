// A newer plugin under a host that was compiled against an older header: its structs have less room, and what
// lies behind them is its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "small_scene.h"

namespace rg::test {
namespace {

constexpr uint32_t kBare = UINT32_MAX;  // the version of a host that passes the major alone

uint32_t versionOf(uint32_t minor) { return minor == kBare ? RG_ABI_MAJOR : RG_ABI_MAJOR << 16 | minor; }

// One default_* function: its struct's sizes in bytes from the minors on in which they came, as compilers
// laid out each header that was (x86-64).
struct Default {
  const char* name;
  std::map<uint32_t, size_t> sizes;
  size_t newest;  // in this header
  void (*fill)(const rg_api&, void*);

  size_t sizeIn(uint32_t minor) const {
    if (minor == kBare || minor < sizes.begin()->first) return sizes.begin()->second;
    return std::prev(sizes.upper_bound(minor))->second;
  }
};

template <auto kFunction, typename T>
void call(const rg_api& api, void* out) {
  (api.*kFunction)(static_cast<T*>(out));
}

#define RG_DEFAULT(name, ...) \
  Default { #name, __VA_ARGS__, sizeof(rg_##name), call < &rg_api::default_##name, rg_##name> }
const std::vector<Default> kDefaults = {
    RG_DEFAULT(create_info, {{0, 32}}),
    RG_DEFAULT(gl_info, {{0, 32}}),
    RG_DEFAULT(vehicle, {{0, 120}}),
    RG_DEFAULT(weather, {{0, 72}, {1, 88}}),
    RG_DEFAULT(view, {{0, 344}}),
    RG_DEFAULT(sample, {{0, 72}, {4, 88}}),
    RG_DEFAULT(volume_info, {{0, 48}}),
    RG_DEFAULT(pane_info, {{0, 112}, {3, 120}, {4, 184}}),
    RG_DEFAULT(wiper_info, {{0, 120}, {2, 144}}),
    RG_DEFAULT(target, {{0, 48}}),
    RG_DEFAULT(lighting, {{0, 72}, {3, 80}}),
    RG_DEFAULT(draw, {{0, 40}}),
    RG_DEFAULT(capture_info, {{0, 32}}),
    RG_DEFAULT(rain_pattern, {{1, 32}}),
    RG_DEFAULT(wash_info, {{2, 88}}),
    RG_DEFAULT(airflow, {{3, 56}}),
};
#undef RG_DEFAULT

// A struct as a host has it on its stack: something lay there before, and other things lie behind it.
struct Stack {
  explicit Stack(unsigned char was) { bytes.fill(was); }
  uint32_t structSize() const {
    uint32_t size = 0;
    std::memcpy(&size, bytes.data(), sizeof size);
    return size;
  }
  bool isSince(size_t from, unsigned char was) const {
    return std::all_of(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(),
                       [was](unsigned char byte) { return byte == was; });
  }
  alignas(16) std::array<unsigned char, 1024> bytes;
};

std::vector<uint32_t> allMinors() {
  std::vector<uint32_t> minors = {kBare};
  for (uint32_t minor = 0; minor <= RG_ABI_MINOR + 1; ++minor) minors.push_back(minor);  // one to come
  return minors;
}

TEST(OlderHosts, defaultsFillTheirStructsWhollyAndWriteNothingBehindThem) {
  const PluginLibrary library;
  for (const uint32_t minor : allMinors()) {
    const rg_api* api = library.entry(versionOf(minor));
    ASSERT_NE(api, nullptr);
    for (const Default& d : kDefaults) {
      SCOPED_TRACE(std::string(d.name) + " for version " + std::to_string(versionOf(minor)));
      const size_t size = d.sizeIn(minor);
      Stack a(0xa5), b(0x5a);
      d.fill(*api, a.bytes.data());
      d.fill(*api, b.bytes.data());
      EXPECT_EQ(a.structSize(), size);
      EXPECT_TRUE(
          std::equal(a.bytes.begin(), a.bytes.begin() + static_cast<std::ptrdiff_t>(size), b.bytes.begin()))
          << "some of it is as it lay there";
      EXPECT_TRUE(a.isSince(size, 0xa5)) << "something behind it was overwritten";
    }
  }
}

TEST(OlderHosts, haveTheSameDefaultsAsTheNewestAsFarAsTheirStructsGo) {
  const PluginLibrary library;
  for (const Default& d : kDefaults) {
    SCOPED_TRACE(d.name);
    EXPECT_EQ(d.sizeIn(RG_ABI_MINOR), d.newest);
    Stack newest(0);
    d.fill(*library.api, newest.bytes.data());
    for (const uint32_t minor : allMinors()) {
      Stack older(0);
      d.fill(*library.entry(versionOf(minor)), older.bytes.data());
      EXPECT_TRUE(std::equal(older.bytes.begin() + sizeof(uint32_t),
                             older.bytes.begin() + static_cast<std::ptrdiff_t>(d.sizeIn(minor)),
                             newest.bytes.begin() + sizeof(uint32_t)))
          << "for version " << versionOf(minor);
    }
  }
}

// One that knows no hail and no ground gets none, whatever lies behind its weather.
TEST(OlderHosts, areNotAskedForWhatTheirStructsDoNotHave) {
  const PluginLibrary library;
  const SmallScene scene(*library.api);
  const rg_api& older = *library.entry(RG_ABI_MAJOR);
  rg_weather weather;
  weather.hail_mm_h = weather.ground_height_m = std::numeric_limits<double>::quiet_NaN();
  older.default_weather(&weather);
  weather.rain_mm_h = 10.0;
  rg_sample sample;
  sample.opening_knot_count = 7;
  sample.opening_knots = nullptr;
  older.default_sample(&sample);
  sample.weather = &weather;
  scene.expect(older.update(scene.instance, 0, &sample, 1, sizeof sample));
  rg_rain_stats stats{};
  stats.struct_size = sizeof stats;
  scene.expect(older.get_rain_stats(scene.instance, &stats));
  EXPECT_EQ(stats.rate_mm_h, 10.0);
  EXPECT_EQ(stats.hail_mm_h, 0.0);
}

TEST(OlderHosts, areToldWhatThePluginIs) {
  const PluginLibrary library;
  for (const uint32_t minor : allMinors()) {
    const rg_api* api = library.entry(versionOf(minor));
    ASSERT_NE(api, nullptr);
    EXPECT_EQ(api->abi_minor, RG_ABI_MINOR);
    EXPECT_EQ(api->struct_size, sizeof(rg_api));
  }
}

// They may be of any minor from 0 to 7, and lose what came since 0.
TEST(OlderHosts, areWarnedWhereTheyDoNotSayWhatTheyAre) {
  const PluginLibrary library;
  for (const uint32_t version : {RG_ABI_MAJOR, versionOf(0), RG_ABI_VERSION}) {
    const rg_api* api = library.entry(version);
    rg_create_info info;
    api->default_create_info(&info);
    int warnings = 0;
    info.log_user = &warnings;
    info.log = [](void* user, int32_t level, uint32_t, const char*) {
      *static_cast<int*>(user) += level == RG_LOG_WARNING ? 1 : 0;
    };
    rg_instance* instance = nullptr;
    ASSERT_EQ(api->create(&info, &instance), RG_OK);
    EXPECT_EQ(warnings, version == RG_ABI_MAJOR ? 1 : 0) << version;
    api->destroy(instance);
  }
}

// What the header says of them, and 0 where it says nothing.
TEST(Defaults, areAsTheHeaderSays) {
  const PluginLibrary library;
  const rg_api& api = *library.api;
  const auto expect = [](const char* name, auto fill, auto say) {
    Stack got(0xa5), said(0);
    fill(got.bytes.data());
    const uint32_t size = got.structSize();
    std::memcpy(said.bytes.data(), &size, sizeof size);
    say(said.bytes.data());
    EXPECT_TRUE(std::equal(got.bytes.begin(), got.bytes.begin() + size, said.bytes.begin())) << name;
  };
#define RG_SAYS(name, ...)                                                         \
  expect(                                                                          \
      #name, [&](void* out) { api.default_##name(static_cast<rg_##name*>(out)); }, \
      [](void* out) {                                                              \
        [[maybe_unused]] rg_##name& s = *static_cast<rg_##name*>(out);             \
        __VA_ARGS__;                                                               \
      })
  RG_SAYS(create_info, s.max_drops = 131072, s.seed = 1);
  RG_SAYS(gl_info, );
  RG_SAYS(vehicle, s.pose.orientation[3] = 1);
  RG_SAYS(weather, s.temperature_c = 12, s.humidity = 0.9, s.visibility_m = 40000, s.ground_height_m = -1e8);
  RG_SAYS(view, s.id = 1, s.exposure_s = 1.0 / 60;
          for (int i = 0; i < 16; i += 5) s.eye_from_world[i] = s.projection[i] = 1);
  RG_SAYS(sample, s.vehicle_stride = sizeof(rg_vehicle), s.view_stride = sizeof(rg_view));
  RG_SAYS(volume_info, s.active = 1);
  RG_SAYS(pane_info, s.glass = RG_GLASS_UNCOATED, s.active = 1, s.texel_m = 3e-3, s.max_drops = 20000,
          s.film_enabled = 1);
  RG_SAYS(wiper_info, s.axis[2] = 1, s.rest_direction[0] = 1, s.arm_m = 0.5, s.blade_m = 0.6,
          s.residual_film_m = 1e-7, s.lift_m = 2e-3);
  RG_SAYS(wash_info, s.duration_s = 1, s.volume_m3 = 2e-5, s.direction[0] = 1, s.fan_rad = 0.2);
  RG_SAYS(airflow, s.stagnation = 0.65, s.outward = 0.35, s.lee = 0.25, s.drag_friction = 0.004);
  RG_SAYS(target, s.samples = 1, s.color_space = RG_LINEAR_HDR, s.exposure = 1);
  RG_SAYS(lighting, for (int i = 0; i < 3; ++i) s.sky_radiance[i] = 1.0f, s.ground_radiance[i] = 0.2f);
  RG_SAYS(draw, );
  RG_SAYS(capture_info, s.max_faces = 1);
  RG_SAYS(rain_pattern, );
#undef RG_SAYS
}

}  // namespace
}  // namespace rg::test
