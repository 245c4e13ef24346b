#include "rain_only.h"

#include <cstring>

#include "checks.h"

extern "C" const rg_api* rgTable(uint32_t abi_major);

namespace oracle {
namespace {

bool forget_volumes = false;

rg_result create(const rg_create_info* in, rg_instance** out) {
  const rg_create_info info = rg::readCreateInfo(in);
  auto* made = new RainOnly;
  made->capacity_drops = info.max_drops;
  made->seed = info.seed;
  made->field = std::make_unique<rg::rain::Field>(rg::rain::FieldSettings{info.max_drops, info.seed});
  *out = reinterpret_cast<rg_instance*>(made);
  return RG_OK;
}

void destroy(rg_instance* instance) { delete &rainOnly(instance); }
const char* lastError(rg_instance*) { return "refused"; }
rg_result setPane(rg_instance*, uint32_t, const rg_pane_info*) { return RG_OK; }
rg_result setWiper(rg_instance*, uint32_t, const rg_wiper_info*) { return RG_OK; }

rg_result setVolume(rg_instance* instance, uint32_t id, const rg_volume_info* in) {
  if (forget_volumes) return RG_OK;
  std::vector<glm::dvec3> vertices;
  for (uint32_t i = 0; i < in->vertex_count; ++i)
    vertices.emplace_back(in->vertices_m[3 * i], in->vertices_m[3 * i + 1], in->vertices_m[3 * i + 2]);
  rg::rain::VolumeInfo info;
  info.vehicle = in->vehicle;
  info.name = in->name;
  info.vertices = vertices;
  return rainOnly(instance).field->setVolume(id, info).empty() ? RG_OK : RG_ERROR_BAD_ARGUMENT;
}

rg_result setParameter(rg_instance* instance, const char* name, double value) {
  RainOnly& rain = rainOnly(instance);
  for (const rg::SettingInfo& info : rg::kSettings) {
    if (std::strcmp(info.name, name) == 0) rain.settings.*info.value = value;
  }
  rain.timeline.setGusts({rain.seed, rain.settings.wind_gust_share, rain.settings.wind_gust_time_s});
  rain.profile = rg::rain::WindProfile::of(rain.settings.wind_roughness_m, rain.settings.wind_height_m);
  rain.field->setWindProfile(rain.profile);
  return RG_OK;
}

// Ticks run once their moment has come, as the plugin's do; the host's samples lie on them.
rg_result update(rg_instance* instance, int64_t time_ns, const rg_sample* in, uint32_t count, size_t stride) {
  RainOnly& rain = rainOnly(instance);
  for (uint32_t i = 0; i < count; ++i) {
    rain.timeline.add(
        rg::readSample(rg::element(in, stride, i), rain.timeline.empty() ? nullptr : &rain.timeline.last()));
  }
  if (rain.next_tick == INT64_MIN) rain.next_tick = 0;
  for (; rg::tickTimeNs(rain.next_tick) <= time_ns; ++rain.next_tick) {
    const rg::Tick& tick = rain.timeline.tick(rain.next_tick);
    rain.field->tick(tick);
    rain.wind_mps = tick.weather.wind_mps;
  }
  rain.timeline.prune(rain.next_tick - 1);
  return RG_OK;
}

}  // namespace

const rg_api& rainOnlyApi() {
  static const rg_api api = [] {
    rg_api a = *rgTable(RG_ABI_VERSION);
    a.create = create;
    a.destroy = destroy;
    a.last_error = lastError;
    a.set_pane = setPane;
    a.set_wiper = setWiper;
    a.set_volume = setVolume;
    a.update = update;
    a.set_parameter = setParameter;
    return a;
  }();
  return api;
}

void forgetVolumes(bool forget) { forget_volumes = forget; }

}  // namespace oracle
