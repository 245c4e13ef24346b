// One pane of glass: the water on it as drops, ticked at 120 Hz on the CPU, and the orders it gives to the
// film on the GPU and has back from it (pane_gl.h). What it holds after a tick depends on the ticks submitted
// and on nothing else: not on how they came bundled, not on draws.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/glass_crater.glsl"
#include "shared/glass_types.glsl"

namespace rg::saved {
class Reader;
class Writer;
}  // namespace rg::saved

namespace rg::glass {

class PaneMap;
class UnevenGlass;
class Pillar;
struct PaneMesh;
class Slide;
class Drops;
struct FilmOrder;
struct FilmReport;
struct FilmState;

// What a surface does to water: contact angles and how it treats thin films.
enum class Glass { uncoated, dirty, coated, new_coating };

struct PaneInfo {
  std::string name;
  std::span<const glm::vec3>
      positions_m;                 // vehicle frame; triangles counter-clockwise seen from the wet, outer side
  std::span<const glm::vec2> uvs;  // without overlap, any scale; in one even chart, or see chart.h
  std::span<const uint32_t> indices;
  Glass glass = Glass::uncoated;
  double advancing_rad = 0.0;  // 0 = the preset's
  double receding_rad = 0.0;
  double texel_m = 3e-3;
  uint32_t max_drops = 20000;  // 0: the film alone
  bool film_enabled = true;
  double unevenness = 1.0;  // 0: the same everywhere, see uneven_glass.h; tests of laws ask for that
  double demister = 0.0;    // share of its air that blows up the inner side
  double mirror = 0.0;  // share of the light that its silvered inner side reflects; 0: it is looked through
  double opening_m = 0.0;  // how far a window has slid before it is told otherwise
  // Of a window that slides, see slide.h. 0: down its own surface; its lower edge.
  glm::dvec3 slide_direction{0.0};  // unit
  glm::dvec4 sill{0.0};             // n, d: glass is seen where n . p <= d
};

struct WiperInfo {
  glm::dvec3 pivot_m{0.0};         // vehicle frame, as the rest
  glm::dvec3 axis{0.0, 0.0, 1.0};  // unit, out of the glass
  glm::dvec3 rest_direction{1.0, 0.0, 0.0};
  double arm_m = 0.5;  // pivot to the blade's middle
  double blade_m = 0.6;
  double blade_angle_rad = 0.0;   // from the arm's direction to the blade's, at angle 0
  double residual_film_m = 1e-7;  // what a pass leaves
  double blade_turn = 0.0;  // how far the blade turns on its arm for each radian of the arm: 0 rigid, -1 a
                            // pantograph, whose blade keeps its direction on the glass
  double wear = 0.0;        // 0 a new blade .. 1, see wear.h
  double lift_m = 2e-3;     // drops that stand higher are cut: the blade goes through them at this height
};

// Drops of one size, as they fall.
struct SizeClass {
  double diameter_m = 0.0;
  double number_per_m3 = 0.0;
  double fall_speed_mps = 0.0;
  glm::dvec3 drift_mps{0.0};  // beyond the air's velocity, in the pane's vehicle's frame
};

// A blade's way during a tick: from `from_rad` to `extreme_rad` (a reversal) to `to_rad`; without a reversal
// extreme = to.
struct WiperStroke {
  uint32_t wiper = 0;
  double from_rad = 0.0;
  double extreme_rad = 0.0;
  double to_rad = 0.0;
};

struct Airflow;
class Jet;

// What a jet brings in a tick.
struct Washing {
  std::shared_ptr<const Jet> jet;
  int64_t volume_pl = 0;
};

inline constexpr uint32_t kMostWashings = 8;
inline constexpr int kRegionsAcross = 8;  // the pane is cut in 8 x 8 regions (of its grid) for shelter
inline constexpr int kRegions = kRegionsAcross * kRegionsAcross;
inline constexpr int kMaxSizeClasses = 64;

// All a pane knows of the world during a tick. Vectors in the vehicle's frame.
struct PaneTick {
  int64_t index = 0;   // the pane's own count
  int64_t moment = 0;  // the same for all panes that are ticked together; ascends
  glm::dvec3 acceleration_mps2{
      0.0, 0.0, -9.81};     // what water at rest on the glass feels: gravity minus the vehicle's acceleration
  glm::dvec3 air_mps{0.0};  // of the free air relative to the vehicle
  glm::dvec3 down{0.0, 0.0, -1.0};  // unit, to which rain falls in still air
  double temperature_c = 12.0;
  double humidity = 0.9;
  uint32_t class_count = 0;  // 0: no rain
  std::array<SizeClass, kMaxSizeClasses> classes{};
  std::array<float, kRegions>
      wet_share{};  // 0 sheltered .. 1 open to the rain, per region (see PaneMap::regionCentre)
  uint32_t wiper_count = 0;
  std::array<WiperStroke, shared::kMaxGlassWipers> wipers{};
  uint32_t washing_count = 0;
  std::array<Washing, kMostWashings> washings{};
  double opening_m = 0.0;  // how far a window has slid; 0 while it has wipers
  double run_off = 0.0;    // share of what runs off at a pillar that comes onto the pane behind it
};

struct PlacedDrop {
  double u_m = 0.0, v_m = 0.0;  // glass metres: right of, up from the pane's middle, seen from inside
  double base_radius_m = 1e-3;
  double contact_angle_rad = 0.6;
};

// All in picolitres since the pane was made or reset. caught = on_glass + drained + wiped + blown +
// evaporated, to the last one.
struct PaneStats {
  uint32_t drops = 0;
  double area_m2 = 0.0;
  int64_t caught_pl = 0;
  int64_t run_on_pl = 0;    // of it
  int64_t on_glass_pl = 0;  // film + beads + drops + ridge + what travels between CPU and GPU, summed afresh
  int64_t drained_pl = 0, wiped_pl = 0, blown_pl = 0, evaporated_pl = 0;
  int64_t film_pl = 0, beads_pl = 0, drops_pl = 0, ridge_pl = 0, travelling_pl = 0;
  uint64_t dropped_ticks = 0;  // not run: the GPU's part was not called for more than five seconds
};

// A blade on its way with a ridge before it.
struct MovingBlade {
  WiperInfo wiper;
  double angle_rad = 0.0, speed_radps = 0.0;
  double direction = 1.0;  // +1: to greater angles
  int first_piece = 0;     // of the ridges
};

// Immutable; made after each submit that ran a tick, handed to the GL thread.
struct PaneSnapshot {
  int64_t tick = 0;
  std::vector<shared::GlassDropRecord> drops;
  std::vector<shared::CraterRecord> craters;
  std::vector<MovingBlade> blades;
  double advancing_rad = 0.0;  // contact angle of what is pushed
  double bead_contact_rad = 0.0;
};

// [thread: all functions may be called from any thread; the pane locks itself]
class PaneSim {
 public:
  // Throws std::invalid_argument naming the pane: uvs missing, overlapping or without area, degenerate mesh,
  // indices out of range.
  PaneSim(const PaneInfo& info, uint32_t id, uint64_t seed);
  ~PaneSim();
  PaneSim(const PaneSim&) = delete;
  PaneSim& operator=(const PaneSim&) = delete;

  const PaneMap& map() const;             // but for what is shown of it, immutable after construction
  const UnevenGlass& unevenness() const;  // immutable
  const PaneMesh& mesh() const;
  const Slide& slide() const;  // where it slides to never changes
  const std::string& name() const;

  // At most kMaxGlassWipers; throws std::invalid_argument. Setting an id again replaces it; its ridge's water
  // goes back to the film.
  void setWiper(uint32_t id, const WiperInfo& info);
  void removeWiper(uint32_t id);

  // How air runs over it, from the next tick on.
  void setAirflow(Airflow airflow);

  // What runs off where it is near another pane goes on over that one, and the other way round. The other
  // forgets it when this one is destroyed or forgets it.
  void setPillars(std::vector<std::shared_ptr<Pillar>> off, std::vector<std::shared_ptr<Pillar>> on);

  // Adds drops beside those there, counted as caught. Throws std::invalid_argument, placing none, when one
  // lies off the pane or they are too many.
  void placeDrops(std::span<const PlacedDrop> drops);

  // Runs a tick, or queues it where the film's answers that it needs are not there yet, or a neighbour's
  // ticks: then PaneGl::step runs it. Ticks ascend by one.
  void submit(const PaneTick& tick);

  // Back to a dry pane; the ledger starts anew. PaneGl clears its film when it is next called.
  void reset();

  // As it is between two ticks, PaneGl::finish() done. `film`: of a pane whose film is attached.
  void write(saved::Writer& a, const FilmState* film) const;
  // By a pane of the same glass and wipers. What is its film's is told, for PaneGl::setFilm.
  std::optional<FilmState> read(saved::Reader& a);
  bool filmAttached() const;

  std::shared_ptr<const PaneSnapshot> snapshot() const;
  // Exact after PaneGl::finish(); before it the film's share is as of its last report.
  PaneStats stats() const;
  // Of drops, orders under way and random state; PaneGl::hash adds the film's.
  uint64_t hash() const;

  // --- for pane_gl ---
  // While a film is attached orders wait for it. Without one (headless hosts, before attach) water meant for
  // the film is booked as drained at once and nothing is waited for. Detaching books what was on the film and
  // under way as drained.
  void attachFilm();
  void detachFilm();
  // Orders of film steps not yet fetched, oldest first.
  std::vector<FilmOrder> fetchOrders();
  // Answers, in order. Runs ticks that waited for them.
  void deliver(FilmReport&& report);
  bool waiting() const;  // a tick is queued that wants a report
  bool resume();         // runs ticks that waited for neighbours; false: there was none

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rg::glass
