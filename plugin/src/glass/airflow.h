// How air runs over a pane and what it and gravity do to water there: fields at the corners of tiles.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

// Parameters of the field, all unsourced: in the order of what flow pictures over car bodies show.
struct AirflowShape {
  double stagnation = 0.65;      // share of the speed missing at the lower edge of a pane that faces the wind
  double outward = 0.35;         // towards the pillars, of the component that blows against the pane
  double lee = 0.25;             // share of the speed behind a pane that faces away
  double drag_friction = 0.004;  // C_f of tau = rho_a C_f U^2 / 2; 0.003..0.005
};

// What a host knows of its vehicle's air: velocity along the glass over the free air's speed, vehicle frame,
// for air from dead ahead. Row by row from the pane's lower edge, each from its left seen from inside.
struct AirflowField {
  int columns = 0, rows = 0;  // 0: nothing is known
  std::vector<glm::vec3> share;
  glm::dvec3 at(double across, double height) const;  // as of PaneNode; bilinear
};

struct Airflow {
  AirflowShape shape;
  AirflowField ahead;  // takes the shape's place for the part of the air that comes from ahead
};

// Velocity of the air just above a node's boundary layer, along the glass, vehicle frame. `air_mps` is the
// free air's, relative to the vehicle.
glm::dvec3 airOverGlass(const PaneMap& map, const PaneNode& node, const glm::dvec3& air_mps,
                        const Airflow& airflow = {});

// What pushes water at a place, grid axes, in real units.
struct Push {
  glm::dvec2 acceleration_mps2{0.0};
  glm::dvec2 air_mps{0.0};
  glm::dvec2 metres{1.0};  // real for one grid metre along x, y
  int tile = 0;            // that it lies on
};

// Fields of one tick.
class ForceField {
 public:
  // Air runs over the car as it does, wherever a window has slid to.
  void make(const PaneMap& map, const glm::dvec3& acceleration_mps2, const glm::dvec3& air_mps,
            const glm::dvec3& slid_m = glm::dvec3(0.0));
  void setAirflow(Airflow airflow);  // of the next make()
  void clear() { nodes_.clear(); }   // the airflow stays
  Push at(const PaneMap& map, glm::dvec2 grid_m) const;
  static glm::dvec2 metresAt(const PaneMap& map, glm::dvec2 grid_m);  // Push's alone
  // What air of this velocity just above it does to water's surface: tau = rho_a C_f U^2 / 2 along it.
  glm::dvec2 shear_pa(const glm::dvec2& air_mps) const;
  // Per node, for the film: xy acceleration, zw shear stress.
  std::vector<shared::vec4> filmDrive() const;
  bool empty() const { return nodes_.empty(); }
  // Of all places of a tile: what lies between nodes is a mean of theirs.
  struct About {
    glm::vec2 acceleration_mps2{0.0f}, air2_m2_s2{0.0f};          // the mean; air times its speed
    float most_acceleration_mps2 = 0.0f, most_air2_m2_s2 = 0.0f;  // nowhere is either greater
  };
  const About& about(int tile) const { return tiles_[static_cast<size_t>(tile)]; }
  static int tileAt(const PaneMap& map, glm::dvec2 grid_m);
  double airSpeed_mps(const PaneMap& map, glm::dvec2 grid_m) const;  // length of Push's

 private:
  void findAbout(const PaneMap& map);
  // xy acceleration, zw air: mixed together.
  using NodePush = glm::vec4;
  Airflow airflow_;
  std::vector<NodePush> nodes_;
  glm::dvec3 acceleration_mps2_{1e300}, air_mps_{0.0}, slid_m_{0.0};
  std::vector<About> tiles_, at_nodes_;  // these of each node alone
};

}  // namespace rg::glass
