// A tick's rain update against the naive way: every drop against every volume in every frame. Both at the same number of live drops, with the
// same 64 volumes, driving at 100 km/h under 25 mm/h. Counters tell the work: births, bytes of records and shelter tests per tick.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "rain/field.h"

namespace {

using glm::dvec3;
using namespace rg;
using namespace rg::rain;

constexpr double kSpeed_mps = 100.0 / 3.6;
constexpr uint32_t kVolumes = 64;

std::vector<Plane> boxPlanes(uint32_t i) {  // canopies over the road, 10 m long, every 40 m
  const double x = 40.0 * i;
  return {{{1, 0, 0}, x + 10}, {{-1, 0, 0}, -x}, {{0, 1, 0}, 6}, {{0, -1, 0}, 6}, {{0, 0, 1}, 5}, {{0, 0, -1}, -4}};
}

struct Drive {
  explicit Drive(double factor) : field({.capacity = 400000, .seed = 1}) {
    field.setVisibility({.factor = factor, .reference_px = 1663.0});
    for (uint32_t i = 0; i < kVolumes; ++i) {
      const auto planes = boxPlanes(i);
      VolumeInfo info;
      info.planes = planes;
      if (!field.setVolume(i + 1, info).empty()) std::abort();
    }
    view.id = 1;
    view.clipFromEye = glm::perspective(0.63, 16.0 / 9.0, 0.1, 1000.0);
    view.eye_velocity_mps = {kSpeed_mps, 0, 0};
  }
  void tick() {
    const dvec3 eye(kSpeed_mps * static_cast<double>(index) * kTickSeconds, 0, 1.5);
    view.eyeFromWorld = glm::lookAt(dvec3(0), dvec3(1, 0, 0), dvec3(0, 0, 1)) * glm::translate(glm::dmat4(1), -eye);
    Tick t;
    t.index = index;
    t.time_ns = tickTimeNs(index++);
    t.weather.rain_mm_h = 25.0;
    t.views = {&view, 1};
    field.tick(t);
  }
  Field field;
  ViewState view;
  int64_t index = 0;
};

// The live number goes with the cube of how far drops are seen.
double factorFor(double live) {
  double factor = 1.0;
  for (int i = 0; i < 6; ++i) {
    Drive trial(factor);
    for (int k = 0; k < 30; ++k) trial.tick();
    factor = std::clamp(factor * std::cbrt(live / static_cast<double>(trial.field.stats().live)), 0.25, 4.0);
  }
  return factor;
}

void RainUpdate(benchmark::State& state) {
  Drive drive(factorFor(static_cast<double>(state.range(0))));
  for (int k = 0; k < 60; ++k) drive.tick();
  const FieldStats before = drive.field.stats();
  Upload upload;
  for (auto _ : state) {
    drive.tick();
    state.PauseTiming();  // the copy to the GL thread is counted in bytes, not in time
    drive.field.publish(upload);
    upload.slots.clear();
    upload.records.clear();
    state.ResumeTiming();
  }
  const FieldStats after = drive.field.stats();
  const auto ticks = static_cast<double>(state.iterations());
  state.counters["live"] = static_cast<double>(after.live);
  state.counters["births_per_tick"] = static_cast<double>(after.born - before.born) / ticks;
  state.counters["record_bytes_per_tick"] = static_cast<double>(after.uploaded_bytes - before.uploaded_bytes) / ticks;
  state.counters["shelter_tests_per_tick"] = static_cast<double>(after.shelter_tests - before.shelter_tests) / ticks;
}
BENCHMARK(RainUpdate)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMicrosecond);

// Structure of arrays, moved on and tested in one pass, leaving each volume at the first plane that has the drop outside.
void RainUpdateNaive(benchmark::State& state) {
  const auto count = static_cast<size_t>(state.range(0));
  std::vector<float> x(count), y(count), z(count), fall(count);
  std::vector<uint8_t> dead(count);
  for (size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    x[i] = static_cast<float>(20.0 * std::fmod(n * 0.7548776662, 1.0));
    y[i] = static_cast<float>(20.0 * std::fmod(n * 0.5698402910, 1.0) - 10.0);
    z[i] = static_cast<float>(10.0 * std::fmod(n * 0.3141592653, 1.0));
    fall[i] = static_cast<float>(2.0 + 7.0 * std::fmod(n * 0.618033988, 1.0)) / 120.0f;
  }
  struct Flat {
    float nx, ny, nz, d;
  };
  std::vector<Flat> planes;
  for (uint32_t i = 0; i < kVolumes; ++i) {
    for (const Plane& p : boxPlanes(i)) {
      planes.push_back({static_cast<float>(p.normal.x), static_cast<float>(p.normal.y), static_cast<float>(p.normal.z), static_cast<float>(p.d)});
    }
  }
  for (auto _ : state) {
    for (size_t i = 0; i < count; ++i) {
      z[i] -= fall[i];
      if (z[i] < 0.0f) z[i] += 10.0f;
      uint8_t inside_any = 0;
      for (size_t v = 0; v < planes.size() && !inside_any; v += 6) {
        size_t k = 0;
        while (k < 6 && planes[v + k].nx * x[i] + planes[v + k].ny * y[i] + planes[v + k].nz * z[i] <= planes[v + k].d) ++k;
        inside_any = k == 6;
      }
      dead[i] = inside_any;
    }
    benchmark::DoNotOptimize(dead.data());
    benchmark::ClobberMemory();
  }
  state.counters["live"] = static_cast<double>(count);
  state.counters["shelter_tests_per_tick"] = static_cast<double>(count * kVolumes);
}
BENCHMARK(RainUpdateNaive)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
