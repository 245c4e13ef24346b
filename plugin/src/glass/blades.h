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
  void write(saved::Writer& a) const;
  void read(saved::Reader& a);  // of the same wipers
  // The list of the blade whose ridge begins at that piece; null: there is none.
  std::shared_ptr<const std::vector<shared::SweptTexel>> sweptBy(int first_piece) const;
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
    static void visit(auto& a, auto& blade) {
      a.within(blade.angle_rad, -10.0, 10.0);
      a.within(blade.direction, -1.0, 1.0);
      a.within(blade.speed_radps, -1e4, 1e4);
      a.within(blade.began_rad, -10.0, 10.0);
      a.within(blade.fastest_radps, 0.0, 1e4);
    }
  };
  void move(const DropWorld& world, Drops& drops, Blade& blade, double to_rad);
  void findMet(const Drops& drops, const Wiper& wiper, const Sweep& sweep);
  static void meet(const DropWorld& world, Drops& drops, const Wiper& wiper, const Sweep& sweep, int slot);
  static void turn(const DropWorld& world, Blade& blade);
  static void layDown(FilmLink& film, Blade& blade, const Surface* surface);
  static void leaveOffGlass(FilmLink& film, const Blade& blade);

  std::map<uint32_t, Blade> blades_;
  SlotSet met_;  // by a blade on its way, or nearly
};

}  // namespace rg::glass
