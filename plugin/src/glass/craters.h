// Craters that raindrops threw up in the film a moment ago: what is seen of an impact before surface tension
// has levelled it. They hold no water; the film has it.
#pragma once

#include <vector>

#include "glass/airflow.h"
#include "glass/impact.h"
#include "glass/pane_map.h"
#include "saved/archive.h"
#include "shared/glass_crater.glsl"

namespace rg::glass {

class Craters {
 public:
  explicit Craters(const PaneMap& map);

  // A drop fell into a film of this thickness. One too small to be seen in the film's grid leaves none; one
  // that falls where another did takes its place, unless more of that is to be seen.
  void add(const Impact& impact, double film_m, const ForceField& forces, int64_t tick);
  // Those that are no more to be seen.
  void forget(int64_t tick);
  // Records as of a tick, of those that are still to be seen.
  std::vector<shared::CraterRecord> at(int64_t tick) const;
  void clear();
  void write(saved::Writer& a) const;
  void read(saved::Reader& a);

 private:
  struct Crater {
    shared::CraterRecord record{};  // its age unset
    int64_t tick = 0;
    static void visit(auto& a, auto& crater);
  };
  size_t cellOf(const Crater& crater) const;
  static double ageOf_s(const Crater& crater, int64_t tick);
  void findCells();

  const PaneMap& map_;
  glm::ivec2 cell_count_;
  std::vector<int32_t> of_cell_;  // its crater, or -1
  std::vector<Crater> craters_;
};

}  // namespace rg::glass
