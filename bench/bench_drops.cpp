// A tick of the drops on a windscreen by their number, one in twenty sliding. CPU time of the thread;
// counters are means over the run.
#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <memory>
#include <numbers>
#include <vector>

#include "glass/film_order.h"
#include "glass/pane.h"
#include "glass/pane_map.h"
#include "shared/hash.glsl"

namespace {

using namespace rg;
using glass::PaneSim;

constexpr double kWidth_m = 1.5, kHeight_m = 0.8, kSlope_rad = std::numbers::pi / 6.0;
constexpr int kOneInSlides = 20;
constexpr int kTicksToSettle = 16;  // sliding drops find their speed
constexpr int kTicksToCount = 8;    // from one count of them to the next: it costs as much as a tick
constexpr int kTicksOfRun = 32;     // then their way has swept up too many others, and all begins anew

double unit(uint32_t i, uint32_t what) {
  return static_cast<double>(shared::unitFloat(shared::pcg(i + shared::pcg(what))));
}

// In cells of a grid, off their middles, so that hardly two touch.
std::vector<glass::PlacedDrop> drops(int number) {
  const double cell_m = std::sqrt(kWidth_m * kHeight_m / number) * 0.98;
  const int columns = static_cast<int>(kWidth_m / cell_m);
  std::vector<glass::PlacedDrop> placed;
  for (int i = 0; i < number; ++i) {
    const auto n = static_cast<uint32_t>(i);
    glass::PlacedDrop drop;
    drop.u_m = (i % columns + 0.35 + 0.3 * unit(n, 1)) * cell_m - 0.5 * columns * cell_m;
    drop.v_m = (static_cast<double>(i / columns) + 0.35 + 0.3 * unit(n, 2)) * cell_m - 0.49 * kHeight_m;
    drop.base_radius_m = i % kOneInSlides == 0 ? 3.0e-3 + 0.5e-3 * unit(n, 3) : 0.4e-3 + 0.6e-3 * unit(n, 4);
    drop.contact_angle_rad = i % kOneInSlides == 0 ? 0.9 : 0.6;
    placed.push_back(drop);
  }
  return placed;
}

double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// A raked windscreen at a walk, in moist air without rain.
class Windscreen {
 public:
  explicit Windscreen(int number) : drops_(drops(number)) {
    const glm::vec3 across(0.0f, -kWidth_m, 0.0f);
    const glm::vec3 up(-kHeight_m * std::cos(kSlope_rad), 0.0f, kHeight_m * std::sin(kSlope_rad));
    const std::vector<glm::vec3> corners{{}, across, across + up, up};
    const std::vector<glm::vec2> uvs{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<uint32_t> indices{0, 2, 1, 0, 3, 2};
    glass::PaneInfo info;
    info.name = "windscreen";
    info.positions_m = corners;
    info.uvs = uvs;
    info.indices = indices;
    info.max_drops = static_cast<uint32_t>(2 * number);
    pane_ = std::make_unique<PaneSim>(info, 1, 7);
    pane_->attachFilm();
    tick_.air_mps = {-1.0, 0.0, 0.0};
  }
  void begin() {
    pane_->reset();
    pane_->placeDrops(drops_);
    for (int i = 0; i < kTicksToSettle; ++i) tick();
  }
  // Seconds the drops took.
  double tick() {
    ++tick_.index;
    const double from_s = threadSeconds();
    pane_->submit(tick_);
    const double took_s = threadSeconds() - from_s;
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
  for (auto _ : state) {
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
BENCHMARK(DropTick)->Arg(5000)->Arg(10000)->Arg(20000)->Arg(40000)->UseManualTime()->Unit(
    benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
