// What keeps rain off: static volumes in a tree and the volumes of moving bodies, and the one question asked
// of them: when does a drop's path, known where it came from and where it goes, meet any of them?
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rain/motion.h"
#include "rain/picture.h"
#include "rain/region.h"
#include "rain/volume.h"
#include "tick.h"

namespace rg::rain {

inline constexpr double kNever_s = std::numeric_limits<double>::infinity();

// A stretch of a class's path: relative to where a drop is now, world axes; times relative to now.
struct PathPiece {
  double from_s = 0.0, to_s = 0.0;
  glm::dvec3 from_m{0.0};  // from the drop's place now to its place at from_s
  glm::dvec3 velocity_mps{0.0};
};

// What a stone hits: unit normal out of it, its velocity there, and how far outside of it the place is.
struct Surface {
  glm::dvec3 normal{0, 0, 1};
  glm::dvec3 velocity_mps{0.0};
  double outside_m = 0.0;
};

// The path of a class: the first piece is the way to come, the others the way it came, newest first.
struct ClassPath {
  static constexpr uint32_t kMost = 1 + WindPath::Past::kMost;
  std::array<PathPiece, kMost> pieces;
  uint32_t count = 0;
  bool falls = true;      // all the way it came, downwards
  bool straight = false;  // it came as it will go on: one line
};

// What a drop's path meets.
struct Passage {
  bool came_through = false;  // a volume, or it is in one
  double enters_s = kNever_s;
};

class Shelter {
 public:
  // Far enough to have come from any cloud's side of any roof, or to have left any view.
  static constexpr double kPath_m = 300.0;

  std::string set(uint32_t id, const VolumeInfo& info);
  bool remove(uint32_t id);
  void removeVehicle(uint32_t vehicle);
  bool empty() const { return volumes_.empty(); }
  void shift(const glm::dvec3& shift_m);

  // What became different at a tick.
  struct Changes {
    bool volumes = false;  // some were set or removed
    bool bodies = false;   // one departed from its prediction
  };
  Changes advance(double time_s, std::span<const VehicleState> vehicles);
  void restart();  // what moved before is forgotten; the next advance() begins afresh

  // Finds what the paths through a box (middle, half size) may meet; the next questions are about drops in
  // it. `past`: also the way they came. Returns whether there is anything.
  bool lookAround(const glm::dvec3& middle_m, const glm::dvec3& half_m, const ClassPath& path, double now_s,
                  bool past);
  // Whether a drop that is at `place_m` now came through a volume, or is in one.
  bool cameThrough(const glm::dvec3& place_m, const ClassPath& path, double now_s);
  // Both at once, after lookAround() with the past.
  Passage passage(const glm::dvec3& place_m, const ClassPath& path, double now_s);
  // When it will enter one, relative to now; 0 when it is inside, kNever_s when it will not.
  double willEnter(const glm::dvec3& place_m, const ClassPath& path, double now_s);

  // Whether rain that falls with `velocity_mps` reaches a place: no volume, as they stand now, lies up-stream
  // of it. Volumes of the body `without` do not count (a pane lies against its own cabin).
  bool openToSky(const glm::dvec3& place_m, const glm::dvec3& velocity_mps, uint32_t without);

  // The face of a volume that a place within `within_m` of it touches, as things stood `ago_s` before the
  // last advance(); of several volumes the nearest. False, and `out` as it was, when there is none.
  bool surfaceAt(const glm::dvec3& place_m, double ago_s, double within_m, Surface& out);

  uint64_t tests() const { return tests_; }
  void clearTests() { tests_ = 0; }

  // How bodies moved. The volumes stay those there are; other ones than there were when it was written count
  // as set since.
  void write(saved::Writer& a) const;
  void read(saved::Reader& a);
  void takeVolumes(const Shelter& from) { volumes_ = from.volumes_; }

  // Adds the volumes that come nearer than `radius_m` to any of the eyes, for clipping streaks.
  void near(std::span<const glm::dvec3> eyes_m, double radius_m, std::vector<NearVolume>& out) const;
  // Adds the volumes that any of the views looks into within `radius_m` of its eye and that are not too small
  // in it to matter.
  void seen(std::span<const Cone> views, double radius_m, std::vector<NearVolume>& out) const;

 private:
  struct Volume {
    uint32_t id = 0;
    uint32_t vehicle = 0;
    bool active = true;
    Convex shape;
  };
  struct Node {
    Box box;
    uint32_t first = 0;  // of order_, or the left child (the right one follows it)
    uint32_t count = 0;  // 0: inner
  };
  struct Body {
    BodyPath path;
    bool known = false;
    double radius_m = 0.0;  // about its origin
    Box box;                // of all its volumes, in its frame
    std::vector<uint32_t> volumes;
  };

  uint64_t volumesFingerprint() const;
  void rebuild();
  void split(uint32_t node, uint32_t first, uint32_t count);
  void gatherStatic(const glm::dvec3& middle_m, const glm::dvec3& half_m, const PathPiece& piece);
  uint32_t lowPieces(const glm::dvec3& middle_m, const glm::dvec3& half_m, const ClassPath& path) const;
  void prepareGates(const glm::dvec3& velocity_mps);
  void gatherBodies(const glm::dvec3& middle_m, double radius_m, const ClassPath& path, double now_s,
                    bool past);
  void gatherBody(const Body& body, const glm::dvec3& middle_m, double radius_m, const PathPiece& piece,
                  uint32_t number, double now_s);
  // A piece of a body's path during which it comes near a cell's drops, as they are in a piece of theirs.
  struct Meeting {
    const Body* body;
    const BodyPath::Piece* motion;
    uint32_t piece;
    double from_s, to_s;
    glm::dvec3 past_mps;  // how they pass it, its axes when its piece began
  };
  using Meetings = std::vector<Meeting>::const_iterator;
  double entryDuring(const Meeting& meeting, const glm::dvec3& from_m, const glm::dvec3& velocity_mps);
  double entryOfBody(Meetings& at, const glm::dvec3& place_m, const ClassPath& path, double now_s);

  template <class F>
  void nearStatic(uint32_t node, const F& closeTo, std::vector<NearVolume>& out) const;

  std::map<uint32_t, std::shared_ptr<Volume>> volumes_;
  bool changed_ = false;
  std::vector<std::shared_ptr<const Volume>>
      list_;  // all active ones; static first, in the order of the tree's leaves
  uint32_t statics_ = 0;
  std::vector<Node> nodes_;
  std::map<uint32_t, Body> bodies_;
  std::vector<uint32_t> met_;      // found by lookAround: static volumes
  std::vector<Meeting> meetings_;  // and bodies: piece by piece of the path, body by body, newest first
  // A static volume for drops of one velocity: its planes by how these pass them, and where each sort ends.
  struct GatePlane {
    glm::dvec3 normal{0.0};
    double d = 0.0, per_rate_s = 0.0;  // passed 1 m/s / rate after it is 1 m away
  };
  struct Gate {
    uint32_t along = 0, inwards = 0, outwards = 0;
  };
  std::vector<GatePlane> gate_planes_;  // of the volumes in `met_`, when the path is straight
  std::vector<Gate> gates_;
  uint32_t low_pieces_ = 0;  // of the path, low enough for static volumes
  std::vector<uint32_t> stack_;
  uint64_t tests_ = 0;
};

}  // namespace rg::rain
