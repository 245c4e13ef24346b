// The ABI's edge: checks arguments, catches everything, returns a code. No maths here.
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include "api_call.h"
#include "api_objects.h"
#include "checks.h"
#include "defaults.h"
#include "frame.h"

namespace rg {
namespace {

constexpr uint32_t kMostLamps = 4096;

// Numbers of log messages: the negated result code for refused calls, from 100 on for remarks.
enum : uint32_t {
  kLogThinned = 101,
  kLogTimeDropped = 102,
  kLogAttached = 103,
  kLogNearVolumes = 104,
  kLogBareMajor = 105
};
glm::vec3 radiance(const float v[3], const char* name) {
  for (int i = 0; i < 3; ++i) checkRange(static_cast<double>(v[i]), 0.0, 1e9, name);
  return {v[0], v[1], v[2]};
}

// ---- life ----

rg_result create(const rg_create_info* in, rg_instance** out) {
  if (out == nullptr) return failed(nullptr, RG_ERROR_BAD_ARGUMENT, "create: out is null");
  *out = nullptr;
  try {
    const rg_create_info info = readCreateInfo(in);
    *out = new rg_instance{Frame(info), info.log, info.log_user};
    return RG_OK;
  } catch (const ApiError& e) {
    return failed(nullptr, e.code(), e.what());
  } catch (const std::bad_alloc&) {
    return failed(nullptr, RG_ERROR_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& e) {
    return failed(nullptr, RG_ERROR_INTERNAL, e.what());
  } catch (...) {
    return failed(nullptr, RG_ERROR_INTERNAL, "unknown failure");
  }
}

// For hosts that pass the bare major: whoever was compiled against a later minor than 0 is told what it
// lacks.
rg_result createForBareMajor(const rg_create_info* in, rg_instance** out) {
  const rg_result result = create(in, out);
  if (result == RG_OK)
    say(**out, RG_LOG_WARNING, kLogBareMajor,
        "rg_get_entry was told the major alone: structs are taken for those of minor 0, what came since is "
        "as by default; pass RG_ABI_VERSION");
  return result;
}

void destroy(rg_instance* instance) { delete instance; }

const char* lastError(rg_instance* instance) {
  return instance != nullptr ? instance->frame.last_error.get() : createError();
}

// ---- GL ----

rg_result attachGl(rg_instance* instance, const rg_gl_info* in) {
  return guarded(instance, [&](Frame& frame) {
    const rg_gl_info info = readStruct(in, "rg_gl_info");
    if (info.get_proc == nullptr) refuse("rg_gl_info.get_proc is null");
    frame.attach(info);
    say(*instance, RG_LOG_INFO, kLogAttached, "attached");
  });
}

rg_result detachGl(rg_instance* instance) {
  return guarded(instance, [](Frame& frame) { frame.detach(); });
}

rg_result contextLost(rg_instance* instance) {
  return guarded(instance, [](Frame& frame) { frame.contextLost(); });
}
// ---- frame ----

rg_result update(rg_instance* instance, int64_t time_ns, const rg_sample* in, uint32_t count, size_t stride) {
  return guarded(instance, [&](Frame& frame) {
    checkTime(time_ns, "update's time_ns");
    checkArray(in, count, stride, kFirstSize<rg_sample>, 1000000, "samples");
    std::vector<Sample> samples;
    samples.reserve(count);
    const Sample* before = frame.lastSample();
    for (uint32_t i = 0; i < count; ++i) {
      const rg_sample* sample = element(in, stride, i);
      if (count > 1 && sample->struct_size > stride)
        refuse("samples' stride is less than rg_sample.struct_size", RG_ERROR_BAD_STRUCT);
      samples.push_back(readSample(sample, before));
      before = &samples.back();
    }
    const rg_result result = frame.update(time_ns, samples);
    if (result == RG_REMARK_TIME_DROPPED)
      say(*instance, RG_LOG_WARNING, kLogTimeDropped,
          "a stall was longer than time.catch_up_s: simulated time was left out");
    if (!instance->told_of_near_volumes && !frame.nearVolumesFit()) {
      instance->told_of_near_volumes = true;
      say(*instance, RG_LOG_WARNING, kLogNearVolumes,
          "more than 64 volumes, or 512 of their planes, are near a view: rain is drawn only before the "
          "first "
          "that is left out");
    }
    return result;
  });
}

rg_result stepGpu(rg_instance* instance) {
  return guarded(instance, [](Frame& frame) { frame.stepGpu(); });
}

rg_result prepareCaptures(rg_instance* instance, const rg_capture_info* in) {
  return guarded(instance, [&](Frame& frame) {
    const rg_capture_info info = readStruct(in, "rg_capture_info");
    const ViewState view = readView(info.view);
    checkRange(info.max_faces, 0.0, 6.0, "rg_capture_info.max_faces");
    glass::DrawScene draw;
    if (info.draw_scene != nullptr) {
      draw = [&info](uint32_t framebuffer, int size_px, const glm::dmat4& eyeFromWorld,
                     const glm::dmat4& clipFromEye) {
        double eye[16], projection[16];
        std::memcpy(eye, &eyeFromWorld[0][0], sizeof eye);
        std::memcpy(projection, &clipFromEye[0][0], sizeof projection);
        info.draw_scene(info.user, framebuffer, size_px, size_px, eye, projection);
      };
    }
    frame.prepareCaptures(view, static_cast<int>(info.max_faces), draw);
  });
}

void readLamps(const rg_lighting& in, DrawRequest& out) {
  checkArray(in.lamps, in.lamp_count, sizeof(rg_lamp), sizeof(rg_lamp), kMostLamps, "rg_lighting.lamps");
  for (uint32_t i = 0; i < in.lamp_count; ++i) {
    const rg_lamp& lamp = in.lamps[i];
    rain::DropLamp l;
    l.position_m = finiteVector(lamp.position_m, "rg_lamp.position_m");
    for (int k = 0; k < 3; ++k) {
      checkRange(static_cast<double>(lamp.direction[k]), -1.001, 1.001, "rg_lamp.direction");
      l.direction[k] = lamp.direction[k];
    }
    l.intensity = radiance(lamp.intensity, "rg_lamp.intensity");
    checkRange(static_cast<double>(lamp.cos_inner), -1.0, 1.0, "rg_lamp.cos_inner");
    checkRange(static_cast<double>(lamp.cos_outer), -1.0, 1.0, "rg_lamp.cos_outer");
    l.cos_inner = lamp.cos_inner;
    l.cos_outer = lamp.cos_outer;
    out.lamps.push_back(l);
  }
  checkRange(in.lamps_on_glass, 0.0, in.lamp_count, "rg_lighting.lamps_on_glass");
  out.lamps_on_glass = in.lamps_on_glass;
}

void readLighting(const rg_lighting* in, DrawRequest& out) {
  const rg_lighting light = in != nullptr ? readStruct(in, "rg_lighting") : defaults<rg_lighting>();
  out.lighting.sky_radiance = radiance(light.sky_radiance, "rg_lighting.sky_radiance");
  out.lighting.ground_radiance = radiance(light.ground_radiance, "rg_lighting.ground_radiance");
  out.lighting.sun_irradiance = radiance(light.sun_irradiance, "rg_lighting.sun_irradiance");
  for (int i = 0; i < 3; ++i) {
    checkRange(static_cast<double>(light.sun_direction[i]), -1.001, 1.001, "rg_lighting.sun_direction");
    out.lighting.sun_direction[i] = light.sun_direction[i];
  }
  out.lighting.environment_cube = light.environment_cube;
  readLamps(light, out);
}

void readTarget(const rg_target* in, DrawRequest& out) {
  const rg_target t = readStruct(in, "rg_target");
  if (t.width_px < 1 || t.height_px < 1 || t.width_px > 32768 || t.height_px > 32768)
    refuse("rg_target size must be 1 .. 32768 pixels a side");
  if (t.samples < 1) refuse("rg_target.samples is " + std::to_string(t.samples) + ", must be 1");
  if (t.samples != 1)
    refuse("rg_target.samples: this build draws into single-sampled targets", RG_ERROR_MISSING_FEATURE);
  if (t.layer != 0) refuse("rg_target.layer: this build draws into layer 0", RG_ERROR_MISSING_FEATURE);
  if (t.color_space != RG_LINEAR_HDR && t.color_space != RG_SRGB)
    refuse("rg_target.color_space is no rg_color_space");
  checkRange(t.exposure, 1e-9, 1e9, "rg_target.exposure");
  out.target = {t.framebuffer, t.color_texture,          t.width_px,
                t.height_px,   t.color_space == RG_SRGB, static_cast<float>(t.exposure)};
  out.depth_texture = t.depth_texture;
}

using DrawStage = uint32_t (Frame::*)(const DrawRequest&);

rg_result draw(rg_instance* instance, rg_draw* in, DrawStage stage) {
  return guarded(instance, [&](Frame& frame) {
    const rg_draw d = readStruct(in, "rg_draw");
    DrawRequest request;
    checkTime(d.time_ns, "rg_draw.time_ns");
    request.time_ns = d.time_ns;
    request.view = readView(d.view);
    std::memcpy(&request.viewport_px[0], d.view->viewport_px, sizeof d.view->viewport_px);
    readTarget(d.target, request);
    readLighting(d.lighting, request);
    in->touched = (frame.*stage)(request);
  });
}

rg_result drawWorld(rg_instance* instance, rg_draw* in) { return draw(instance, in, &Frame::drawWorld); }
rg_result drawGlass(rg_instance* instance, rg_draw* in) { return draw(instance, in, &Frame::drawGlass); }
rg_result drawFinish(rg_instance* instance, rg_draw* in) { return draw(instance, in, &Frame::drawFinish); }

// ---- time ----

rg_result reset(rg_instance* instance) {
  return guarded(instance, [](Frame& frame) { frame.reset(); });
}

rg_result seek(rg_instance* instance, int64_t time_ns) {
  return guarded(instance, [&](Frame& frame) {
    checkTime(time_ns, "seek's time_ns");
    frame.seek(time_ns);
  });
}

rg_result prewarm(rg_instance* instance, double seconds) {
  return guarded(instance, [&](Frame& frame) {
    checkRange(seconds, 0.0, 600.0, "prewarm's seconds");
    frame.prewarm(seconds);
  });
}

rg_result rebaseOrigin(rg_instance* instance, const double shift_m[3]) {
  return guarded(instance, [&](Frame& frame) {
    if (shift_m == nullptr) refuse("rebase_origin's shift is null");
    for (int i = 0; i < 3; ++i) checkRange(shift_m[i], -1e8, 1e8, "rebase_origin's shift");
    frame.rebase({shift_m[0], shift_m[1], shift_m[2]});
  });
}

rg_result save(rg_instance* instance, void* buffer, size_t* size) {
  return guarded(instance, [&](Frame& frame) {
    checkOut(size, "save's size");
    const size_t room = *size;
    const std::vector<unsigned char> bytes = frame.save();
    *size = bytes.size();
    if (buffer == nullptr) return;
    if (room < bytes.size())
      refuse("save's buffer has room for " + std::to_string(room) + " bytes, the state has " +
             std::to_string(bytes.size()));
    std::memcpy(buffer, bytes.data(), bytes.size());
  });
}

rg_result restore(rg_instance* instance, const void* buffer, size_t size) {
  return guarded(instance, [&](Frame& frame) {
    if (buffer == nullptr) refuse("restore's buffer is null");
    frame.restore({static_cast<const unsigned char*>(buffer), size});
  });
}

// ---- questions ----

rg_result getRainStats(rg_instance* instance, rg_rain_stats* out) {
  return guarded(instance, [&](Frame& frame) {
    const rain::FieldStats s = frame.rainStats();
    rg_rain_stats r{};
    using rain::Hydrometeor;
    const auto live = [&s](Hydrometeor h) { return s.live_of[static_cast<uint32_t>(h)]; };
    r.rate_mm_h = s.rates[Hydrometeor::kRain];
    r.thinning = s.thinning;
    r.live = s.live;
    r.born = s.born;
    r.died = s.died;
    r.sheltered_at_birth = s.sheltered_at_birth;
    r.shelter_tests = s.shelter_tests;
    r.uploaded_bytes = s.uploaded_bytes;
    r.snow_mm_h = s.rates[Hydrometeor::kSnow] + s.rates[Hydrometeor::kMeltingSnow];
    r.hail_mm_h = s.rates[Hydrometeor::kHail];
    r.live_snow = live(Hydrometeor::kSnow);
    r.live_melting = live(Hydrometeor::kMeltingSnow);
    r.live_hail = live(Hydrometeor::kHail);
    r.live_bounced = live(Hydrometeor::kBouncedHail);
    r.bounced = s.bounced;
    r.ground_water_mm = frame.waterOnGround_mm();
    r.splash_thinning = frame.splashesKept();
    writeStruct(out, r, "rg_rain_stats");
  });
}

rg_result getPaneStats(rg_instance* instance, uint32_t pane, rg_pane_stats* out) {
  return guarded(instance, [&](Frame& frame) {
    constexpr double kMl = 1e-9;  // mL in a picolitre
    const glass::PaneStats s = frame.paneStats(pane);
    rg_pane_stats r{};
    r.drops = s.drops;
    r.area_m2 = s.area_m2;
    r.caught_ml = static_cast<double>(s.caught_pl) * kMl;
    r.on_glass_ml = static_cast<double>(s.on_glass_pl) * kMl;
    r.drained_ml = static_cast<double>(s.drained_pl) * kMl;
    r.wiped_ml = static_cast<double>(s.wiped_pl) * kMl;
    r.blown_ml = static_cast<double>(s.blown_pl) * kMl;
    r.evaporated_ml = static_cast<double>(s.evaporated_pl) * kMl;
    r.film_ml = static_cast<double>(s.film_pl) * kMl;
    r.drops_ml = static_cast<double>(s.drops_pl + s.beads_pl) * kMl;
    r.ridge_ml = static_cast<double>(s.ridge_pl) * kMl;
    r.dropped_s = static_cast<double>(s.dropped_ticks) * kTickSeconds;
    r.run_on_ml = static_cast<double>(s.run_on_pl) * kMl;
    const double found_ml = r.on_glass_ml + r.drained_ml + r.wiped_ml + r.blown_ml + r.evaporated_ml;
    r.ledger_error = std::abs(r.caught_ml - found_ml) / std::max(r.caught_ml, 1.0);
    writeStruct(out, r, "rg_pane_stats");
  });
}

rg_result getStageCount(rg_instance* instance, uint32_t* out) {
  return guarded(instance, [&](Frame& frame) {
    *checkOut(out, "out") = static_cast<uint32_t>(frame.timers().stageCount());
  });
}

rg_result getStage(rg_instance* instance, uint32_t index, rg_stage_stats* out) {
  return guarded(instance, [&](Frame& frame) {
    if (index >= frame.timers().stageCount())
      refuse("there is no stage " + std::to_string(index), RG_ERROR_NOT_FOUND);
    const gl::StageTimes t = frame.timers().times(index);
    rg_stage_stats r{};
    r.gpu = t.gpu ? 1 : 0;
    std::strncpy(r.name, t.name.c_str(), sizeof r.name - 1);
    r.cpu_ms_p50 = t.cpu_ms.p50;
    r.cpu_ms_p95 = t.cpu_ms.p95;
    r.cpu_ms_p99 = t.cpu_ms.p99;
    r.gpu_ms_p50 = t.gpu_ms.p50;
    r.gpu_ms_p95 = t.gpu_ms.p95;
    r.gpu_ms_p99 = t.gpu_ms.p99;
    r.samples = t.samples;
    writeStruct(out, r, "rg_stage_stats");
  });
}

rg_result getTimerKind(rg_instance* instance, int32_t* out) {
  return guarded(instance, [&](Frame& frame) {
    *checkOut(out, "out") = frame.timers().kind() == gl::TimerKind::kGpu ? RG_TIMER_GPU : RG_TIMER_FINISH;
  });
}

rg_result getHash(rg_instance* instance, int32_t kind, uint64_t* out) {
  return guarded(instance, [&](Frame& frame) {
    if (kind != RG_HASH_RAIN && kind != RG_HASH_STATE) refuse("kind is no rg_hash_kind");
    checkOut(out, "out");
    *out = frame.hash(kind == RG_HASH_STATE);
  });
}

// ---- parameters ----

rg_result getParameterCount(rg_instance* instance, uint32_t* out) {
  return guarded(instance,
                 [&](Frame&) { *checkOut(out, "out") = static_cast<uint32_t>(std::size(kSettings)); });
}

void copyText(const char* from, char* to, size_t size) {
  std::strncpy(to, from, size - 1);
  to[size - 1] = '\0';
}

rg_result getParameter(rg_instance* instance, uint32_t index, rg_parameter* out) {
  return guarded(instance, [&](Frame& frame) {
    if (index >= std::size(kSettings))
      refuse("there is no parameter " + std::to_string(index), RG_ERROR_NOT_FOUND);
    const SettingInfo& info = kSettings[index];
    rg_parameter p{};
    copyText(info.name, p.name, sizeof p.name);
    copyText(info.unit, p.unit, sizeof p.unit);
    copyText(info.group, p.group, sizeof p.group);
    copyText(info.text, p.text, sizeof p.text);
    p.minimum = info.minimum;
    p.maximum = info.maximum;
    p.preset = Settings{}.*info.value;
    p.value = frame.settings().*info.value;
    writeStruct(out, p, "rg_parameter");
  });
}

rg_result setParameter(rg_instance* instance, const char* name, double value) {
  return guarded(instance, [&](Frame& frame) {
    if (name == nullptr) refuse("set_parameter's name is null");
    for (const SettingInfo& info : kSettings) {
      if (std::strcmp(info.name, name) != 0) continue;
      checkRange(value, info.minimum, info.maximum, name);
      frame.set(info.value, value);
      return;
    }
    refuse("there is no parameter \"" + std::string(name, strnlen(name, 63)) + "\"", RG_ERROR_NOT_FOUND);
  });
}

// As hosts of that minor have it.
template <uint32_t kMinor>
constexpr rg_api kApi = {
    sizeof(rg_api),
    RG_ABI_MINOR,
    RG_VERSION,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    fillDefaults<kMinor>,
    create,
    destroy,
    lastError,
    attachGl,
    detachGl,
    contextLost,
    setVolume,
    removeVolume,
    removeVehicle,
    setPane,
    removePane,
    setWiper,
    removeWiper,
    placeDrops,
    update,
    stepGpu,
    prepareCaptures,
    drawWorld,
    drawGlass,
    drawFinish,
    reset,
    seek,
    prewarm,
    rebaseOrigin,
    save,
    restore,
    getRainStats,
    getPaneStats,
    getStageCount,
    getStage,
    getTimerKind,
    getHash,
    getParameterCount,
    getParameter,
    setParameter,
    fillDefaults<kMinor>,
    setRainPattern,
    fillDefaults<kMinor>,
    wash,
    fillDefaults<kMinor>,
    setAirflow,
};

template <size_t... kMinors>
constexpr std::array<rg_api, sizeof...(kMinors)> tables(std::index_sequence<kMinors...>) {
  return {kApi<uint32_t{kMinors}>...};
}
constexpr auto kTables = tables(std::make_index_sequence<RG_ABI_MINOR + 1>());

constexpr rg_api kBareTable = [] {
  rg_api table = kTables.front();
  table.create = createForBareMajor;
  return table;
}();

}  // namespace

// A bare major tells no minor: only what minor 0 had has room in all hosts' structs.
const rg_api* tableFor(uint32_t version) {
  if (version == RG_ABI_MAJOR) return &kBareTable;
  const uint32_t major = version >> 16, minor = version & 0xffff;
  return major == RG_ABI_MAJOR ? &kTables[std::min(minor, RG_ABI_MINOR)] : nullptr;
}

}  // namespace rg

extern "C" const rg_api* rgTable(uint32_t abi_version);
const rg_api* rgTable(uint32_t abi_version) { return rg::tableFor(abi_version); }
