// All blades of a pane during a tick: drops they meet go to the ridge they push, the film's steps learn what
// to sweep, ridges are left behind where a blade turns round or stops.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "glass/drops.h"
#include "glass/wiper.h"

namespace rg::glass {

class Blades {
 public:
  // Throws std::invalid_argument for a ninth wiper or nonsense in `info`.
  void set(uint32_t id, const WiperInfo& info, const PaneMap& map, FilmLink& film);
  void remove(uint32_t id, FilmLink& film);
  void stroke(const DropWorld& world, Drops& drops, const WiperStroke& stroke);
  std::vector<MovingBlade> moving() const;
  // Ridges are gone with the water: directions are forgotten.
  void clear();

 private:
  struct Blade {
    std::unique_ptr<Wiper> wiper;
    double angle_rad = 0.0;
    double direction = 0.0;  // of its last way; 0: it rests and carries nothing
    double speed_radps = 0.0;
    double began_rad = 0.0;      // where that way began,
    double fastest_radps = 0.0;  // and its greatest speed so far
  };
  static void move(const DropWorld& world, Drops& drops, Blade& blade, double to_rad);
  static void meet(const DropWorld& world, Drops& drops, const Wiper& wiper, const Sweep& sweep, int slot);
  static void turn(const DropWorld& world, Blade& blade);
  static void layDown(FilmLink& film, Blade& blade, const Surface* surface);
  static void leaveOffGlass(FilmLink& film, const Blade& blade);

  std::map<uint32_t, Blade> blades_;
};

}  // namespace rg::glass
