// A tick's rain update against the naive way, every drop against every volume in every frame, at the same
// number of live drops, among the same volumes, at 100 km/h. CPU time of the thread. Counters,
// means over the run, tell the work.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <vector>

#include "rain/field.h"

namespace {

using glm::dvec3;
using namespace rg;
using namespace rg::rain;

constexpr double kSpeed_mps = 100.0 / 3.6;
constexpr uint32_t kVolumes = 64;
constexpr double kCanopies_m = 40.0;  // from one to the next
constexpr int kTicksACanopy =
    173;  // 1.44 s for 40 m: what is averaged over, as a canopy keeps many drops off
constexpr int kTicks = 6 * kTicksACanopy;

std::vector<Plane> boxPlanes(uint32_t i) {  // canopies over the road, 10 m long
  const double x = kCanopies_m * i;
  return {{{1, 0, 0}, x + 10}, {{-1, 0, 0}, -x}, {{0, 1, 0}, 6},
          {{0, -1, 0}, 6},     {{0, 0, 1}, 5},   {{0, 0, -1}, -4}};
}

double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Drive {
  Drive(double factor, double rain_mm_h) : field({.capacity = 400000, .seed = 1}), rate_mm_h(rain_mm_h) {
    // The factor as asked may go beyond its range; the reference takes what is left.
    const double within = std::clamp(factor, 0.25, 4.0);
    field.setVisibility({.factor = within, .reference_px = 1663.0 * factor / within});
    for (uint32_t i = 0; i < kVolumes; ++i) {
      const auto planes = boxPlanes(i);
      VolumeInfo info;
      info.planes = planes;
      if (!field.setVolume(i + 1, info).empty()) std::abort();
    }
    view.id = 1;
    view.clipFromEye = glm::perspective(0.63, 16.0 / 9.0, 0.1, 1000.0);  // 60 deg horizontally
    view.eye_velocity_mps = {kSpeed_mps, 0, 0};
  }
  double eyeX() const { return kSpeed_mps * static_cast<double>(index) * kTickSeconds; }
  void tick() {
    view.eyeFromWorld = glm::lookAt(dvec3(0), dvec3(1, 0, 0), dvec3(0, 0, 1)) *
                        glm::translate(glm::dmat4(1), -dvec3(eyeX(), 0, 1.5));
    Tick t;
    t.index = index;
    t.time_ns = tickTimeNs(index++);
    t.weather.rain_mm_h = rate_mm_h;
    t.views = {&view, 1};
    field.tick(t);
  }
  // Live drops, mean over a canopy's distance.
  double meanLive() {
    double sum = 0.0;
    for (int k = 0; k < kTicksACanopy; ++k) {
      tick();
      sum += static_cast<double>(field.stats().live);
    }
    return sum / kTicksACanopy;
  }
  Field field;
  double rate_mm_h;
  ViewState view;
  int64_t index = 0;
};

// A thousand drops are a drizzle's, a hundred thousand a cloudburst's: the rest of the way is in how far they
// are seen.
double rateFor(int64_t live) { return live <= 1000 ? 2.0 : live <= 10000 ? 25.0 : 100.0; }

// How far drops must be seen for `live` of them, to 1 %: secants in logarithms.
double factorFor(int64_t live) {
  static std::map<int64_t, double> known;
  if (const auto found = known.find(live); found != known.end()) return found->second;
  double factor = 1.25, slope = 2.5, last_factor = 0.0, last_got = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double got = Drive(factor, rateFor(live)).meanLive(), share = static_cast<double>(live) / got;
    if (std::abs(share - 1.0) < 0.01) return known[live] = factor;
    if (last_got > 0.0)
      slope = std::clamp(std::log(got / last_got) / std::log(factor / last_factor), 0.5, 4.0);
    last_factor = factor;
    last_got = got;
    factor *= std::pow(share, 1.0 / slope);
  }
  std::fprintf(stderr, "bench_rain: no visibility found for %lld live drops\n", static_cast<long long>(live));
  std::exit(1);
}

void count(benchmark::State& state, const char* name, double total) {
  state.counters[name] = total / static_cast<double>(state.iterations());
}

// A tick and the hand-over of its new records to the GL thread.
void RainUpdate(benchmark::State& state) {
  const double factor = factorFor(state.range(0));
  Drive drive(factor, rateFor(state.range(0)));
  drive.meanLive();  // warm-up
  Upload upload;
  drive.field.publish(upload);
  const FieldStats before = drive.field.stats();
  double live = 0.0;
  while (state.KeepRunning()) {
    upload.slots.clear();
    upload.records.clear();
    const double from = cpuSeconds();
    drive.tick();
    drive.field.publish(upload);
    state.SetIterationTime(cpuSeconds() - from);
    live += static_cast<double>(drive.field.stats().live);
  }
  const FieldStats after = drive.field.stats();
  count(state, "live", live);
  count(state, "births", static_cast<double>(after.born - before.born));
  count(state, "record_bytes", static_cast<double>(after.uploaded_bytes - before.uploaded_bytes));
  count(state, "shelter_tests", static_cast<double>(after.shelter_tests - before.shelter_tests));
  state.counters["volumes"] = kVolumes;
  state.counters["rate_mm_h"] = rateFor(state.range(0));
  state.counters["visibility_factor"] = factor;
}
BENCHMARK(RainUpdate)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime()
    ->Iterations(kTicks);

struct Flat {
  float nx, ny, nz, d;
};

// The drops of the field above, by coordinate.
struct NaiveDrops {
  std::vector<float> x, y, z, fall;
  float low_x = 1e9f, high_x = -1e9f, low_z = 1e9f, high_z = -1e9f;  // of the box they fill, from the eye
  explicit NaiveDrops(Drive& drive, size_t number) {
    Upload upload;
    drive.field.publishAll(upload);
    for (size_t i = 0; i < number; ++i) {
      const RainDrop& d = upload.records[i % upload.records.size()];
      const ClassPicture& c = upload.picture.classes[shared::rainClassOf(d)];
      const dvec3 fraction(d.fraction_xy & 0xffffu, d.fraction_xy >> 16, d.fraction_z_class & 0xffffu);
      const dvec3 p = c.origin_m + (dvec3(d.cell_x, d.cell_y, d.cell_z) + fraction / 65536.0) * c.cell_m;
      x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y)),
          z.push_back(static_cast<float>(p.z));
      fall.push_back(static_cast<float>(-c.velocity_mps.z * kTickSeconds));
      const float ahead = x.back() - static_cast<float>(drive.eyeX());
      low_x = std::min(low_x, ahead), high_x = std::max(high_x, ahead);
      low_z = std::min(low_z, z.back()), high_z = std::max(high_z, z.back());
    }
  }
};

// Structure of arrays; one pass moves each drop, puts it in again at the other side when it has left the box
// about the view, and asks each volume, leaving a volume at the first plane that has the drop outside, and
// the list at the first volume that holds it.
void RainUpdateNaive(benchmark::State& state) {
  const auto number = static_cast<size_t>(state.range(0));
  Drive drive(factorFor(state.range(0)), rateFor(state.range(0)));
  drive.meanLive();
  NaiveDrops drops(drive, number);
  std::vector<uint8_t> hidden(number);
  std::vector<Flat> planes;
  for (uint32_t i = 0; i < kVolumes; ++i) {
    for (const Plane& p : boxPlanes(i)) {
      planes.push_back({static_cast<float>(p.normal.x), static_cast<float>(p.normal.y),
                        static_cast<float>(p.normal.z), static_cast<float>(p.d)});
    }
  }
  const float depth = drops.high_x - drops.low_x, height = drops.high_z - drops.low_z;
  float eye_x = static_cast<float>(drive.eyeX());
  while (state.KeepRunning()) {
    const double from = cpuSeconds();
    eye_x += static_cast<float>(kSpeed_mps * kTickSeconds);
    for (size_t i = 0; i < number; ++i) {
      float x = drops.x[i], z = drops.z[i] - drops.fall[i];
      const float y = drops.y[i];
      if (z < drops.low_z) z += height;
      if (x < eye_x + drops.low_x) x += depth;
      drops.x[i] = x;
      drops.z[i] = z;
      uint8_t inside_any = 0;
      for (size_t v = 0; v < planes.size() && !inside_any; v += 6) {
        size_t k = 0;
        while (k < 6 && planes[v + k].nx * x + planes[v + k].ny * y + planes[v + k].nz * z <= planes[v + k].d)
          ++k;
        inside_any = k == 6;
      }
      hidden[i] = inside_any;
    }
    benchmark::DoNotOptimize(hidden.data());
    benchmark::ClobberMemory();
    state.SetIterationTime(cpuSeconds() - from);
  }
  state.counters["live"] = static_cast<double>(number);
  state.counters["births"] = 0.0;
  state.counters["record_bytes"] = 0.0;
  state.counters["shelter_tests"] = static_cast<double>(number * kVolumes);
  state.counters["volumes"] = kVolumes;
  state.counters["rate_mm_h"] = rateFor(state.range(0));
  state.counters["visibility_factor"] = factorFor(state.range(0));
}
BENCHMARK(RainUpdateNaive)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime()
    ->Iterations(kTicks);

}  // namespace

BENCHMARK_MAIN();
