// The field of falling drops, flakes and stones ("drops" all of them below) round the views: who lives,
// where, and until when.
//
// In the frame that moves with a class's fall speed and the wind, the drops of that class are a standing
// Poisson field, hashed by (seed, class, cell). A drop is born when its cell comes into a view's volume and
// dies when the cell has left all of them, or when its path meets a shelter. Where it is at any time is
// closed form, so a tick costs births + deaths + cells at the border, not drops alive.
//
// A hailstone that comes down bounces once: from then it is a drop of its own, in no cell of a view, which
// ends where it comes down again. Those are the only drops that depend on which others were followed.
//
// State depends on the ticks alone: same seed, same objects, same ticks, same drops. The lattice of cells has
// its origin where the first vehicle (without one, the first view's eye) stands at the first tick after
// construction, reset(), or seek() by an unstarted field, and its clock starts at that tick. So the same
// scene played elsewhere in the world, or at another hour, sees the same rain.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rain/hydrometeors.h"
#include "rain/picture.h"
#include "rain/region.h"
#include "rain/volume.h"
#include "rain/wind_profile.h"
#include "saved/archive.h"
#include "tick.h"

namespace rg::rain {

struct FieldSettings {
  uint32_t capacity = 65536;  // drops alive at most, 1000 .. 4000000
  uint64_t seed = 1;
};

struct FieldStats {
  Rates rates;            // as of the last tick
  double thinning = 1.0;  // share of the law's drops that exist; 1 = all
  uint64_t live = 0, born = 0, died = 0;
  std::array<uint64_t, kHydrometeors> live_of{};  // of `live`
  uint64_t bounced = 0;                           // stones so far; they are of `born` too
  uint64_t sheltered_at_birth = 0;  // drops of the field that a volume kept from being born at all
  uint64_t shelter_tests = 0;       // drop-against-volume tests done
  uint64_t uploaded_bytes = 0;      // handed out by publish()
};

// How far drops are drawn: a drop of diameter D is a particle to the distance `visibility_factor *
// reference_px * D` and fades before it. Flakes count as no larger than 5 mm for it, stones than 12
// (shared::rainReachDiameter), and of ten flakes seven are drawn half as far.
struct Visibility {
  double factor = 1.25;  // 0.25 .. 4; 1: until it is one reference pixel wide
  double reference_px =
      1663.0;  // focal length of 1920 x 1080 at 60 deg horizontally: 960 / tan(30 deg); never the view's own
};

// A streak as drawn for a view, after clipping, in world coordinates.
struct Streak {
  uint32_t slot = 0;
  uint32_t kind = 0;  // speed class
  double diameter_m = 0.0;
  glm::dvec3 drop_m{0.0};  // where the drop is
  glm::dvec3 from_m{0.0}, to_m{0.0};
  double fade = 1.0;  // 0 .. 1 towards the end of its class's reach
};

class Field {
 public:
  explicit Field(const FieldSettings& settings = {});
  ~Field();
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  // Adds or replaces a volume. Returns an empty text, or what is wrong (then nothing changed). Takes effect
  // with the next tick: drops inside it end, drops on their way into it will end there; where one is taken
  // away the sky fills from above.
  [[nodiscard]] std::string setVolume(uint32_t id, const VolumeInfo& info);
  bool removeVolume(uint32_t id);        // false: no such volume
  void removeVehicle(uint32_t vehicle);  // with its volumes

  // Drops that are born from now on reach as far as this says. Values are clamped to their range.
  void setVisibility(const Visibility& visibility);
  // What share of the ticks' wind drops have, from the next tick on.
  void setWindProfile(const WindProfile& profile);

  // Takes the field to the tick's time. Ticks may leave out indices (time passes); one that lies before the
  // last is taken as seek() to it. No allocation, but for a view or number of cells not met before.
  void tick(const Tick& tick);

  void reset();                   // as constructed; volumes stay
  void seek(int64_t tick_index);  // rain as it is at that tick (wind and rate as now); the next tick() is of
                                  // that index or later
  void rebase(const glm::dvec3& shift_m);  // the host's world moved: p_new = p_old - shift

  // Whether rain that falls with `velocity_mps` reaches a place as things stand at the last tick; volumes of
  // the vehicle `without` (0: none) do not count.
  bool openToSky(const glm::dvec3& place_m, const glm::dvec3& velocity_mps, uint32_t without);

  // As Shelter::seen, as things stand at the last tick.
  void volumesSeen(std::span<const Cone> views, double radius_m, std::vector<NearVolume>& out) const;

  // As Shelter::near, likewise.
  void volumesNear(std::span<const glm::dvec3> eyes_m, double radius_m, std::vector<NearVolume>& out) const;

  // As it is between two ticks, but for volumes, visibility and wind profile, which stay those there are.
  // Goes on with the same drops in the same slots.
  void write(saved::Writer& a) const;
  void read(saved::Reader& a);

  FieldStats stats() const;
  uint64_t hash() const;  // over the live drops; independent of the order they came in

  // Hands what changed since the last publish to `upload`, adding to what is still in it. Call on the thread
  // that ticks, under the lock that guards `upload`.
  void publish(Upload& upload);
  void publishAll(Upload& upload);  // every live drop: for a fresh GL context; replaces what is in it

  // The streaks that would be drawn for a view at a time, by the very kernel that draws them (which then
  // leaves out what is behind the eye or nearer than kRainNearest_m). For tests and debugging.
  void streaks(const ViewState& view, int64_t time_ns, std::vector<Streak>& out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rg::rain
