// What the field knows, for the files that make it up.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

#include "rain/border.h"
#include "rain/cells.h"
#include "rain/class_frames.h"
#include "rain/drops.h"
#include "rain/field.h"
#include "rain/shelter.h"
#include "rain/standing.h"

namespace rg::rain {

inline constexpr uint32_t kEndUnits = 1024;  // of a tick, as shared::kRainEndUnits

inline bool isStone(uint32_t kind) { return kind >= kFirstHail && kind < kBouncedClass; }

struct Field::State {
  explicit State(const FieldSettings& given)
      : settings(given), drops(std::clamp(given.capacity, 1000u, 4000000u)), border(cells) {
    fallen.reserve(1u << 12);
  }

  const std::array<ClassLattice, kClasses>& lattices = classLattices();
  FieldSettings settings;
  Visibility visibility;
  WindProfile profile;  // from the next tick on
  Drops drops;
  Cells cells;
  Border border;
  Shelter shelter;
  ClassFrames frames;
  RateHistory rate;

  bool started = false;  // the lattice has its origin
  bool running = false;  // since the last seek a tick has been
  int64_t epoch = 0, tick = 0;
  double ceiling_m = 0.0;
  double ground_m = kNoGround_m;
  std::bitset<kClasses> followed, set_in;  // classes in this tick; of those the ones that were not before
  uint32_t bounced_cell = kNone;           // in which bounced stones hang
  std::vector<RainDrop> fallen;            // stones that came down in this tick
  double keep = 1.0;                       // share of the law's drops that is born
  std::array<double, kClasses> least_chance{};  // of a drop that is born at the wettest rate remembered
  // What cells that are filled will hold, unless a volume kept it off: all of one class.
  struct Coming {
    struct Cell {
      uint32_t index, end;  // its candidates are those before `end`, from the cell's before on
    };
    Candidates of;
    std::vector<const InTheAir*> then;  // where rates have changed: the air it fell into
    std::vector<float> diameter_m;
    std::vector<Cell> cells;
    std::vector<Drops::End> ends;  // of those of a cell that live
    std::vector<uint32_t> living;  // which these are
  };
  Coming coming;  // kept for its room
  uint64_t born = 0, died = 0, sheltered = 0, bounced = 0, uploaded = 0, tests_before = 0;

  double time_s() const { return static_cast<double>(tick - epoch) * kTickSeconds; }
  uint32_t now() const { return static_cast<uint32_t>(static_cast<uint64_t>(tick - epoch) * kEndUnits); }
  double reachPerDiameter() const { return visibility.factor * visibility.reference_px; }
  bool isAbout(uint32_t kind) const { return rate.most_m3(kind) > 0.0 || drops.liveOf(kind) > 0; }

  void start(const Tick& t);
  void moveTo(const Tick& t);
  void forgetCells();
  void clearCells();
  void findClasses();
  void followViews(const Tick& t);
  void emptyLeftCells();
  void expireDrops();
  void thin();

  // field_births.cpp: which drops a cell holds, and until when.
  void fillEnteredCells();
  void findComing(uint32_t cell);
  void keepThoseOfTheirTime(uint32_t kind, size_t first);
  void bear(uint32_t kind);
  void findDiameters(uint32_t kind);
  void findLiving(uint32_t kind, uint32_t first, uint32_t end, bool near_volume);
  void writeComing(uint32_t kind, uint32_t i, RainDrop& drop) const;
  const InTheAir& whenFallen(uint32_t kind, uint32_t i) const;
  double chanceAt(double density_m3, uint32_t kind) const;
  double fallsFor(const RainDrop& drop, const glm::dvec3& place_m, double enters_s) const;
  void bounce(const RainDrop& stone);
  void retest();
  void retestCell(uint32_t index);
  glm::dvec3 cellMiddle(const CellKey& key) const;
  bool lookAround(const CellKey& key, bool past);
  glm::dvec3 placeOf(const RainDrop& drop) const;
  Drops::End endOf(double after_s) const;

  // field_picture.cpp: what is handed out.
  void describe(Picture& picture) const;

  // field_saved.cpp
  static void visit(auto& a, auto& state);
  void writeCells(saved::Writer& a) const;
  void readCells(saved::Reader& a);
};

}  // namespace rg::rain
