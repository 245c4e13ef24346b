// Drops on the glass: they stick, slide, merge, leave trails, run off, dry. Volumes are whole picolitres and
// only ever move from one place to another.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "glass/airflow.h"
#include "glass/film_link.h"
#include "glass/impact.h"
#include "glass/ledger.h"
#include "glass/pane_map.h"
#include "glass/slot_set.h"
#include "glass/uneven_glass.h"
#include "glass/water.h"
#include "saved/archive.h"

namespace rg::glass {

enum class Pose : uint8_t {
  gone,    // the slot is free
  uneasy,  // at rest, to be looked at
  braced,  // at rest, and has its size and shape of when it came to rest
  moving,
};

// In thirds of 32 bytes, none of them across two lines of the cache.
struct alignas(32) Drop {
  glm::dvec2 place_m{0.0};     // grid metres
  float base_radius_m = 0.0f;  // of a circle of the base's area, real
  float elongation = 1.0f;     // length over width of the base, an ellipse; see drop_shape.h
  int32_t cell = 0;            // of the neighbour grid, that it is in
  float corner = 0.0f;         // of its tail, at the end its heading leaves; < 0: at the other

  int64_t volume_pl = 0;          // 0: the slot is free
  glm::vec2 heading{1.0f, 0.0f};  // along the base
  float height_m = 0.0f;
  int32_t texel = 0;
  float braced_pl = 0.0f;  // its volume when it came to rest
  Pose pose = Pose::gone;
  bool changed = false;  // has to be looked at for neighbours it touches

  glm::vec2 velocity_mps{0.0f};  // real, grid axes
  float since_pearl_m = 0.0f;    // way since it last left a droplet behind
  uint32_t seed = 0;
  uint32_t life = 0;  // counts the drops that had this slot

  // Of one that is there, but for where it hangs.
  static void visit(auto& a, auto& drop) {
    a.within(drop.place_m, 0.0, 100.0);
    a.within(drop.base_radius_m, 1e-9, 10.0);
    a.within(drop.elongation, 1.0, 100.0);
    a.within(drop.corner, -1.001, 1.001);
    a.within(drop.braced_pl, 0.0, 3.4e38);
    a(drop.changed);
    a.within(drop.heading, -1.1, 1.1);
    a(drop.texel);
    a.within(drop.velocity_mps, -1000.0, 1000.0);
    a.within(drop.height_m, 0.0, 10.0);
    a.within(drop.since_pearl_m, 0.0, 1e6);
    a(drop.seed);
  }
};

inline float halfLength_m(const Drop& drop) { return drop.base_radius_m * std::sqrt(drop.elongation); }
// From the middle of the base to its outline, along a vector.
double reachTowards_m(const Drop& drop, glm::dvec2 way_m);
// How wide the base is, seen along a unit vector.
double widthAcross_m(const Drop& drop, glm::dvec2 along);
// Of the cap of its base and volume; sooner found the nearer it is to its height so far.
float heightOf_m(const Drop& drop);

// What drops of a pane have in common during a tick.
struct DropWorld {
  const PaneMap& map;
  const UnevenGlass& glass;
  const Surface& surface;
  const ForceField& forces;
  FilmLink& film;
  Ledger& ledger;
  uint64_t seed = 0;
  uint32_t pane = 0;
  int64_t tick = 0;
  double humidity = 1.0;
  double saturated_kg_m3 = 0.0;
};

// One that ran over the pane's edge, from this texel.
struct GoneDrop {
  int texel = 0;
  int64_t volume_pl = 0;
};

class Drops {
 public:
  Drops(const PaneMap& map, const Surface& surface, uint32_t capacity);

  uint32_t count() const { return live_; }
  uint32_t capacity() const { return static_cast<uint32_t>(slots_.capacity_); }
  int64_t volume_pl() const;  // summed afresh
  const std::vector<Drop>& all() const { return slots_.items; }
  void clear();
  float widest_m() const { return largest_radius_m_; }  // no drop's base has a greater half length
  // Calls each(slot, place, half length) for those whose middle lies in a box of the grid, and a few about.
  template <class Each>
  void forEachIn(glm::dvec2 low_m, glm::dvec2 high_m, const Each& each) const {
    const glm::vec2 low(low_m), high(high_m);
    for (int y = rowAt(low.y); y <= rowAt(high.y); ++y) {
      for (int x = columnAt(low.x); x <= columnAt(high.x); ++x) {
        for (int slot = cells_[static_cast<size_t>(y * cell_count_.x + x)].first; slot >= 0;) {
          const Near& near = nears_[static_cast<size_t>(slot)];
          each(slot, near.place_m, near.half_m);
          slot = near.next;
        }
      }
    }
  }

  // A drop of this base; its contact angle is kept between receding and advancing by a wider or narrower base
  // unless `as_told`. Returns its slot, or -1 when there is no room (nothing happened).
  int add(const DropWorld& world, glm::dvec2 place_m, int64_t volume_pl, double base_radius_m, uint32_t seed,
          bool as_told = false);
  // A raindrop: is film where that is thick or rain keeps the glass wet (true), `rewetting_hz` as
  // lamellae_hz(); joins the drop it falls on; lies as a bead when it is small; breaks up into beads when it
  // is fast, or where slots run short; else a new drop.
  bool impact(const DropWorld& world, const Impact& impact, double rewetting_hz);
  // Water a drop ran over; goes to the film again when the drop is no more.
  void give(const DropWorld& world, const Taker& taker, int64_t volume_pl);
  // Removes a drop and says how much it was.
  int64_t remove(int slot);
  // Removes those behind the sill and says how much they were.
  int64_t removeHidden();
  // Takes all of a drop but `keep_pl` and says how much that was; nothing worth a drop is kept.
  int64_t cut(int slot, int64_t keep_pl);

  void move(const DropWorld& world);  // forces, sliding, trails, the pane's edge
  const std::vector<GoneDrop>& overEdges() const { return over_edges_; }  // in the last move()
  void merge(const DropWorld& world);                                     // those that touch become one
  void age(const DropWorld& world);                                       // evaporation, sinking into film

  uint64_t hash(uint64_t start) const;

  void write(saved::Writer& a) const;
  int64_t read(saved::Reader& a);  // says how much water that is

 private:
  struct Slots {
    std::vector<Drop> items;
    std::vector<int32_t> free;
    size_t capacity_ = 0;
  };
  // What a neighbour asks of a drop.
  struct Near {
    glm::vec2 place_m{0.0f};
    float half_m = 0.0f;  // its base's half length
    int32_t next = -1;    // in its cell's list
  };
  // What forces that may set a braced drop going ask of it, as shares of what dry glass holds it with.
  struct Hold {
    float acceleration_s2_m = 0.0f;  // an acceleration of 1 m/s^2
    float air2_s2_m2 = 0.0f;         // air of 1 m/s, with its square
    glm::vec2 share{0.0f};           // the forces about it, of when it came to rest
    int32_t tile = 0;

    static void visit(auto& a, auto& hold) {
      constexpr double kAny = 3.4e38;
      a.within(hold.acceleration_s2_m, -kAny, kAny);
      a.within(hold.air2_s2_m2, -kAny, kAny);
      a.within(hold.share, -kAny, kAny);
    }
  };
  struct Cell {
    int32_t first = -1;     // of its drops
    float widest_m = 0.0f;  // none of them has a greater half length
  };
  // As a saved state has a slot.
  struct Slot {
    Drop drop;
    Hold hold;            // of a braced one
    float half_m = 0.0f;  // as nears_ has it

    static void visit(auto& a, auto& slot);
  };
  void become(int slot, Pose pose) {
    if (slots_.items[static_cast<size_t>(slot)].pose != pose) change(slot, pose);
  }
  void change(int slot, Pose pose);
  std::vector<int32_t> linkOrder() const;
  void checkRead(const saved::Reader& a, const std::vector<Slot>& slots, const std::vector<int32_t>& order,
                 const std::vector<int32_t>& free, const std::vector<int32_t>& changed) const;
  void hangIn(const std::vector<Slot>& slots, const std::vector<int32_t>& order);
  void slide(const DropWorld& world, int slot);
  void brace(const DropWorld& world, int slot, int tile, double mass_kg, double drag_s2_m2,
             double dry_hold_n);
  bool mayMove(const DropWorld& world, int slot) const;
  double dryShare(double film_m) const;
  double heldBy(double film_m) const;
  double heldAt(const DropWorld& world, int texel) const;
  // Whether a film holds drops less anywhere on the pane.
  bool filmLetsGo(const DropWorld& world) const { return world.film.thickest_m() > 0.5 * surface_.wetting_m; }
  bool reshape(int slot, glm::dvec2 along, double force_n, double speed_mps, double seconds);
  void leaveTrail(const DropWorld& world, int slot, glm::dvec2 ahead, double speed_mps, glm::dvec2 metres);
  void leavePearl(const DropWorld& world, Drop& drop, glm::dvec2 ahead, glm::dvec2 metres);
  void takeOnTheWay(const DropWorld& world, int slot, glm::dvec2 from_m, glm::dvec2 ahead, double width_m);
  void takeAcross(const DropWorld& world, int slot, glm::dvec2 place_m, glm::dvec2 ahead, double width_m);
  bool overEdge(const DropWorld& world, int slot, int texel);
  void shatter(const DropWorld& world, const Impact& impact, int64_t volume_pl);
  bool staysFilm(const DropWorld& world, const Impact& impact, double wide_m, double rewetting_hz);
  double largestBead_m3(double texel_m2) const;
  bool lieAsBead(const DropWorld& world, glm::dvec2 place_m, int64_t volume_pl);
  void takeUnder(const DropWorld& world, int slot);
  int covering(const DropWorld& world, glm::dvec2 place_m) const;
  int touching(const DropWorld& world, int slot) const;
  int unite(const DropWorld& world, int a, int b);
  void age(const DropWorld& world, int slot);
  bool sinks(const DropWorld& world, int slot) const;
  void dry(const DropWorld& world, int slot);
  void settle(int slot);
  void fitAngle(int slot);
  void fetch(int slot) const {
    for (const int third : {0, 2})
      __builtin_prefetch(reinterpret_cast<const char*>(&slots_.items[static_cast<size_t>(slot)]) +
                         32 * third);
  }
  void fetchAbout(int slot) const;
  void findWidest();
  void noteWidth(int slot);
  void tellWidth(int slot, float half_m);
  float widestAbout_m(glm::vec2 place_m, glm::vec2 reach_m) const;
  template <class Met>
  int firstAbout(const DropWorld& world, glm::dvec2 place_m, float own_m, float overlap,
                 const Met& met) const;
  void link(int slot);
  void unlink(int slot);
  void moveTo(int slot, glm::dvec2 place_m);
  // The cell of a place; of one off the pane, the nearest.
  static int within(float cells, int count) {
    return static_cast<int>(std::clamp(cells, 0.0f, static_cast<float>(count - 1)));
  }
  int columnAt(float x_m) const { return within(x_m * kPerMetre, cell_count_.x); }
  int rowAt(float y_m) const { return within(y_m * kPerMetre, cell_count_.y); }
  int32_t cellOf(glm::dvec2 place_m) const {
    return rowAt(static_cast<float>(place_m.y)) * cell_count_.x + columnAt(static_cast<float>(place_m.x));
  }

  const PaneMap& map_;
  const Surface& surface_;
  Slots slots_;
  std::vector<Near> nears_;  // of each slot, as the next
  std::vector<Hold> holds_;
  SlotSet moving_, uneasy_, braced_;
  std::vector<Cell> cells_;
  std::vector<int32_t> block_of_;   // of each cell
  static constexpr int kBlock = 8;  // cells along a block's side
  std::vector<float> widest_m_;     // the same of each block's
  glm::ivec2 block_count_{0};
  static constexpr double kCell_m = 8e-3;  // of the neighbour grid: few drops are wider
  static constexpr float kPerMetre = static_cast<float>(1.0 / kCell_m);
  glm::ivec2 cell_count_{0};
  std::vector<int32_t> changed_;
  std::vector<int32_t> under_;  // of staysFilm
  std::vector<GoneDrop> over_edges_;
  uint32_t live_ = 0;
  double shape_advancing_, shape_receding_, shape_mean_;  // V / R^3 at these angles
  double least_bead_m3_, most_bead_m3_;                   // that some texel holds alone, of all of them
  double hold_per_m_;                                     // retention for a metre of width, N/m
  double advancing_mps_, receding_mps_;                   // of a contact line that nothing else moves
  double tan_half_advancing_, tan_half_receding_;
  float largest_radius_m_ = 0.0f;
};

}  // namespace rg::glass
