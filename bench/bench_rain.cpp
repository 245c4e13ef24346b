// A tick's rain update against the naive way, every drop against every volume in every frame, at the same
// number of live drops among the same volumes, and against a mere copy of their records. CPU time of the
// thread. Counters, means over the run, tell the work.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "rain/field.h"

namespace {

using glm::dvec3;
using namespace rg;
using namespace rg::rain;

constexpr double kCanopies_m = 10.0;  // from one to the next

std::vector<Plane> boxPlanes(uint32_t i) {  // canopies over the road, each over a quarter of its length
  const double x = kCanopies_m * i;
  return {{{1, 0, 0}, x + 2.5}, {{-1, 0, 0}, -x}, {{0, 1, 0}, 6},
          {{0, -1, 0}, 6},      {{0, 0, 1}, 5},   {{0, 0, -1}, -4}};
}

// What makes so many drops live: how far they are seen, and the rate; and how many of them come and go in a
// tick: the speed.
struct Load {
  int64_t live;
  double factor, rain_mm_h, speed_mps;
  double births;  // a tick; 0: what that makes
};
constexpr Load kLoads[] = {{20000, 1.4, 31.5, 17.8, 1500},
                           {200000, 4.43, 7.6, 1.4, 1500},
                           // A drizzle, rain and a cloudburst at 100 km/h.
                           {1000, 0.89, 2, 27.8, 0},
                           {10000, 1.027, 25, 27.8, 0},
                           {100000, 1.76, 100, 27.8, 0}};

const Load& loadOf(int64_t live) {
  return *std::find_if(std::begin(kLoads), std::end(kLoads), [&](const Load& l) { return l.live == live; });
}

// From ahead; gusts swing it as over open country, by a sixth of itself in some ten seconds.
enum class Wind { kNone, kSteady, kGusty };

// A drive along the canopies, again and again.
class Drive {
 public:
  Drive(const Load& load, uint32_t volumes)
      : field({.capacity = 800000, .seed = 1}), load_(load), road_m_(kCanopies_m * (volumes - 16)) {
    // The factor as asked may go beyond its range; the reference takes what is left.
    const double within = std::clamp(load.factor, 0.25, 4.0);
    field.setVisibility({.factor = within, .reference_px = 1663.0 * load.factor / within});
    for (uint32_t i = 0; i < volumes; ++i) {
      const auto planes = boxPlanes(i);
      VolumeInfo info;
      info.planes = planes;
      if (!field.setVolume(i + 1, info).empty()) std::abort();
    }
    view.id = 1;
    view.clipFromEye = glm::perspective(0.63, 16.0 / 9.0, 0.1, 1000.0);  // 60 deg horizontally
    view.eye_velocity_mps = {load.speed_mps, 0, 0};
  }
  bool atRoadsEnd() const { return eye_x >= road_m_; }
  void toRoadsStart() {
    eye_x = 0.0;
    view.discontinuity = true;
    for (int i = 0; i < 10; ++i) tick();
    field.publish(upload);
  }
  void tick() {
    eye_x += load_.speed_mps * kTickSeconds;
    view.eyeFromWorld = glm::lookAt(dvec3(0), dvec3(1, 0, 0), dvec3(0, 0, 1)) *
                        glm::translate(glm::dmat4(1), -dvec3(eye_x, 0, 1.5));
    Tick t;
    t.index = index;
    t.time_ns = tickTimeNs(index++);
    t.weather.rain_mm_h = load_.rain_mm_h;
    t.weather.wind_mps = windAt(t.index);
    t.views = {&view, 1};
    field.tick(t);
    view.discontinuity = false;
  }

  Field field;
  Upload upload;
  double eye_x = 0.0;
  Wind wind = Wind::kNone;

 private:
  dvec3 windAt(int64_t tick) const {
    if (wind == Wind::kNone) return dvec3(0.0);
    constexpr double kMean_mps = 6.0, kShare = 0.17, kAlong_s = 11.0, kAcross_s = 7.0;
    const double time_s = static_cast<double>(tick) * kTickSeconds,
                 swing_mps = wind == Wind::kGusty ? kShare * std::numbers::sqrt2 * kMean_mps : 0.0;
    return {-kMean_mps + swing_mps * std::sin(time_s * 2.0 * std::numbers::pi / kAlong_s),
            0.8 * swing_mps * std::sin(time_s * 2.0 * std::numbers::pi / kAcross_s), 0.0};
  }

  Load load_;
  double road_m_;
  ViewState view;
  int64_t index = 0;
};

void count(benchmark::State& state, const char* name, double total) {
  state.counters[name] = total / static_cast<double>(state.iterations());
}

void tellLoad(benchmark::State& state, const Load& load) {
  state.counters["volumes"] = static_cast<double>(state.range(1));
  state.counters["rate_mm_h"] = load.rain_mm_h;
  state.counters["visibility_factor"] = load.factor;
  state.counters["speed_mps"] = load.speed_mps;
}

// A load that has become another one with the field must be set anew.
void check(const char* what, double is, double wanted) {
  if (std::abs(is / wanted - 1.0) < 0.05) return;
  std::fprintf(stderr, "bench_rain: %.0f %s instead of %.0f: set kLoads anew\n", is, what, wanted);
}

// A tick and the hand-over of its new records to the GL thread.
void update(benchmark::State& state, Wind wind) {
  const Load& load = loadOf(state.range(0));
  Drive drive(load, static_cast<uint32_t>(state.range(1)));
  drive.wind = wind;
  drive.toRoadsStart();
  const FieldStats before = drive.field.stats();
  uint64_t cut = 0, cut_bytes = 0;  // born on the way back
  double live = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    drive.upload.slots.clear();
    drive.upload.records.clear();
    drive.tick();
    drive.field.publish(drive.upload);
    live += static_cast<double>(drive.field.stats().live);
    if (!drive.atRoadsEnd()) continue;
    state.PauseTiming();
    const FieldStats end = drive.field.stats();
    drive.toRoadsStart();
    cut += drive.field.stats().born - end.born;
    cut_bytes += drive.field.stats().uploaded_bytes - end.uploaded_bytes;
    state.ResumeTiming();
  }
  const FieldStats after = drive.field.stats();
  const double births = static_cast<double>(after.born - before.born - cut);
  count(state, "live", live);
  count(state, "births", births);
  count(state, "record_bytes", static_cast<double>(after.uploaded_bytes - before.uploaded_bytes - cut_bytes));
  count(state, "shelter_tests", static_cast<double>(after.shelter_tests - before.shelter_tests));
  tellLoad(state, load);
  if (wind != Wind::kNone || state.iterations() < 1000) return;  // too short a way for a mean
  check("live drops", live / static_cast<double>(state.iterations()), static_cast<double>(load.live));
  if (load.births > 0.0)
    check("births a tick", births / static_cast<double>(state.iterations()), load.births);
}
void RainUpdate(benchmark::State& state) { update(state, Wind::kNone); }
void RainUpdateInWind(benchmark::State& state) { update(state, Wind::kSteady); }
void RainUpdateInGusts(benchmark::State& state) { update(state, Wind::kGusty); }
void rainLoads(benchmark::internal::Benchmark* b) {
  for (const int64_t live : {200000, 20000, 1000, 10000, 100000}) b->Args({live, 64});
  b->Unit(benchmark::kMicrosecond);
}
BENCHMARK(RainUpdate)->Apply(rainLoads);
BENCHMARK(RainUpdateInWind)->Apply(rainLoads);
BENCHMARK(RainUpdateInGusts)->Apply(rainLoads);

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
      const float ahead = x.back() - static_cast<float>(drive.eye_x);
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
  const Load& load = loadOf(state.range(0));
  Drive drive(load, static_cast<uint32_t>(state.range(1)));
  drive.toRoadsStart();
  NaiveDrops drops(drive, number);
  std::vector<uint8_t> hidden(number);
  std::vector<Flat> planes;
  for (uint32_t i = 0; i < static_cast<uint32_t>(state.range(1)); ++i) {
    for (const Plane& p : boxPlanes(i)) {
      planes.push_back({static_cast<float>(p.normal.x), static_cast<float>(p.normal.y),
                        static_cast<float>(p.normal.z), static_cast<float>(p.d)});
    }
  }
  const float depth = drops.high_x - drops.low_x, height = drops.high_z - drops.low_z;
  float eye_x = static_cast<float>(drive.eye_x);
  for ([[maybe_unused]] auto _ : state) {
    eye_x += static_cast<float>(load.speed_mps * kTickSeconds);
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
  }
  state.counters["live"] = static_cast<double>(number);
  state.counters["shelter_tests"] = static_cast<double>(state.range(0) * state.range(1));
  tellLoad(state, load);
}
BENCHMARK(RainUpdateNaive)->Apply(rainLoads);

// What it costs to hand over all records anew in every frame.
void RecordCopy(benchmark::State& state) {
  const std::vector<RainDrop> from(static_cast<size_t>(state.range(0)), RainDrop{1, 2, 3, 4, 5, 1e-3f, 6, 7});
  std::vector<RainDrop> to(from.size());
  for ([[maybe_unused]] auto _ : state) {
    std::memcpy(to.data(), from.data(), from.size() * sizeof(RainDrop));
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  state.counters["record_bytes"] = static_cast<double>(from.size() * sizeof(RainDrop));
}
BENCHMARK(RecordCopy)->Arg(200000)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
