// What a pane knows, for the files that make it up.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "glass/blades.h"
#include "glass/craters.h"
#include "glass/drops.h"
#include "glass/film_link.h"
#include "glass/impact.h"
#include "glass/pane.h"
#include "glass/pillar.h"
#include "glass/slide.h"
#include "glass/uneven_glass.h"

namespace rg::glass {

struct PaneSim::State {
  State(const PaneInfo& info, uint32_t pane_id, uint64_t pane_seed);

  struct Waiting {
    PaneTick tick;
    std::vector<PlacedDrop> placed;  // after it
  };

  DropWorld world() {
    return {map,
            uneven,
            surface,
            forces,
            film,
            ledger,
            seed,
            id,
            now.index,
            now.humidity,
            saturatedVapour_kg_m3(now.temperature_c)};
  }
  bool ready() const {
    const int64_t moment = waiting.front().tick.moment;
    return ((ticks + 1) % kTicksPerFilmStep != 0 || film.reported(stepUsedBy(ticks + 1))) &&
           std::ranges::all_of(pillars_on, [moment](const auto& pillar) { return pillar->knows(moment); });
  }
  static int64_t stepUsedBy(int64_t tick) { return (tick - kReportLatency_ticks) / kTicksPerFilmStep; }
  void runWaiting();
  void leaveOutATick();
  void run(const PaneTick& tick);
  void slideWindow();
  void useReport();
  void catchRain();
  void catchRunOff();
  void addDrop(glm::dvec2 place_m, int texel, int64_t volume_pl);
  double restingRadius_m(int64_t volume_pl) const {
    return std::cbrt(cubicMetres(volume_pl) / capShape(meanAngle(surface)));
  }
  void runOff(size_t tile, int64_t volume_pl) const;
  void tellOwed() const;
  void wash(const Washing& washing, uint32_t number);
  void closeFilmStep();
  void place(std::span<const PlacedDrop> list);
  void checkPlaces(std::span<const PlacedDrop> list) const;

  // pane_saved.cpp
  static uint64_t fingerprintOf(const PaneInfo& info);
  template <class Self>
  static auto sweptBy(Self& self) {
    return [&self](int first_piece) { return self.blades.sweptBy(first_piece); };
  }
  void slideTo(size_t gone);
  void takeFilm(FilmLink&& link, size_t gone_on_film);
  std::vector<bool> hiddenOnFilm(const saved::Reader& a, const FilmLink& link, size_t gone_on_film);

  uint32_t chance() const { return id ^ static_cast<uint32_t>(seed); }
  // Outward; where the pane bends not of unit length, so that products with it are the pane's means.
  static glm::dvec3 meanNormal(const PaneMap& map) {
    glm::dvec3 sum(0.0);
    for (int region = 0; region < kRegions; ++region) sum += map.regionArea_m2(region);
    return sum / map.area_m2();
  }

  static float mostPer_m2(const PaneMap& map) {
    float most = 0.0f;
    for (const shared::vec4& node : map.nodeMetric()) most = std::max(most, node.z);
    return most;
  }

  mutable std::mutex mutex;
  std::string name;
  uint32_t id;
  uint64_t seed;
  bool film_enabled;
  uint64_t fingerprint;  // of what was told of it, see pane_saved.cpp
  Surface surface;
  PaneMap map;
  glm::dvec3 mean_normal;
  float most_per_m2;  // 1 / the least area of a texel
  UnevenGlass uneven;
  PaneMesh mesh;
  Slide slide;
  size_t slid = 0, slid_on_film = 0;  // texels behind the sill, of slide's order; of which the film knows
  Ledger ledger;
  FilmLink film;
  Drops drops;
  Craters craters;
  Blades blades;
  ForceField forces;
  std::vector<Impact> impacts;
  PaneTick now;
  int64_t ticks = 0;  // run since the pane was made
  std::deque<Waiting> waiting;
  std::vector<std::shared_ptr<Pillar>> pillars_off, pillars_on;  // to other panes, from them
  uint64_t dropped_ticks = 0;
  mutable std::shared_ptr<const PaneSnapshot> snapshot;  // null: to be made
};

}  // namespace rg::glass
