// A tick of the drops on a windscreen: by their number, one in twenty sliding, and in rain at 80 km/h by its
// rate. CPU time of the thread; counters are means over the run.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "drops_on_glass.h"
#include "glass/film_order.h"
#include "glass/pane.h"
#include "glass/pane_map.h"
#include "measure_cpu.h"

namespace {

using namespace rg;
using glass::PaneSim;

constexpr int kTicksToSettle = 16;  // sliding drops find their speed
constexpr int kTicksToCount = 8;    // from one count of them to the next: it costs as much as a tick
constexpr int kTicksOfRun = 32;     // then their way has swept up too many others, and all begins anew

// A raked windscreen at a walk, in moist air without rain.
class Windscreen {
 public:
  explicit Windscreen(int number, double speed_mps = 1.0) : drops_(bench::dropsOnGlass(number)) {
    pane_ = std::make_unique<PaneSim>(bench::windscreenInfo(number), 1, 7);
    pane_->attachFilm();
    tick_.air_mps = {-speed_mps, 0.0, 0.0};
  }
  void rain(double rate_mm_h) {
    tick_.wet_share.fill(1.0f);
    bench::setRain(tick_, rate_mm_h);
  }
  void begin() {
    pane_->reset();
    pane_->placeDrops(drops_);
    for (int i = 0; i < kTicksToSettle; ++i) tick();
  }
  // Seconds the drops took.
  double tick() {
    ++tick_.index;
    const double took_s = 1e-3 * bench::cpuMilliseconds([this] { pane_->submit(tick_); });
    for (const glass::FilmOrder& order : pane_->fetchOrders()) answer(order);
    return took_s;
  }
  std::shared_ptr<const glass::PaneSnapshot> drawn() const { return pane_->snapshot(); }

 private:
  // As a film answers that is dry: all water has run off it.
  void answer(const glass::FilmOrder& order) {
    if (order.clear) return;
    glass::FilmReport report;
    report.step = order.step;
    report.tiles.assign(pane_->map().tileArea_m2().size(), shared::FilmTile{-1, 0, 0, 0, 0, 0, 0, 0});
    report.taken_pl.assign(order.takes.size(), 0);
    pane_->deliver(std::move(report));
  }
  std::vector<glass::PlacedDrop> drops_;
  std::unique_ptr<PaneSim> pane_;
  glass::PaneTick tick_;
};

void DropTick(benchmark::State& state) {
  Windscreen windscreen(static_cast<int>(state.range(0)));
  double live = 0.0, sliding = 0.0, counts = 0.0, total_s = 0.0;
  int ticks = kTicksOfRun;
  for ([[maybe_unused]] auto _ : state) {
    if (ticks == kTicksOfRun) {
      windscreen.begin();
      ticks = 0;
    }
    const double took_s = windscreen.tick();
    state.SetIterationTime(took_s);
    total_s += took_s;
    ++ticks;
    if (ticks % kTicksToCount != 0) continue;
    ++counts;
    const auto drawn = windscreen.drawn();
    live += static_cast<double>(drawn->drops.size());
    for (const shared::GlassDropRecord& drop : drawn->drops)
      sliding += drop.velocity_mps.x != 0.0f || drop.velocity_mps.y != 0.0f ? 1.0 : 0.0;
  }
  if (counts == 0.0) return;
  state.counters["live"] = live / counts;
  state.counters["sliding"] = sliding / counts;
  state.counters["ns_a_drop"] = 1e9 * total_s / static_cast<double>(state.iterations()) / (live / counts);
}
// From when as many drops run off as come.
void RainTick(benchmark::State& state) {
  constexpr int kSlots = 20000, kTicksUntilSteady = 1200;
  constexpr double kSpeed_mps = 80.0 / 3.6;
  Windscreen windscreen(kSlots / 2, kSpeed_mps);
  windscreen.rain(static_cast<double>(state.range(0)));
  for (int i = 0; i < kTicksUntilSteady; ++i) windscreen.tick();
  double live = 0.0, counts = 0.0;
  int ticks = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.SetIterationTime(windscreen.tick());
    if (++ticks % kTicksToCount != 0) continue;
    ++counts;
    live += static_cast<double>(windscreen.drawn()->drops.size());
  }
  if (counts > 0.0) state.counters["live"] = live / counts;
}
BENCHMARK(RainTick)->Arg(5)->Arg(30)->Arg(100)->UseManualTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(DropTick)->Arg(5000)->Arg(10000)->Arg(20000)->Arg(40000)->UseManualTime()->Unit(
    benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
