#include "glass/airflow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "glass/water.h"
#include "shared/glass_film.glsl"

namespace rg::glass {

namespace {

glm::vec2 accelerationOf(const glm::vec4& push) { return {push.x, push.y}; }
glm::vec2 airOf(const glm::vec4& push) { return {push.z, push.w}; }

// The free air as it comes to all nodes of a pane.
struct FreeAir {
  glm::dvec3 air_mps;
  double speed_mps;
  glm::dvec2 right;  // a metre to the right, grid axes
  FreeAir(const PaneMap& map, const glm::dvec3& air)
      : air_mps(air),
        speed_mps(glm::length(air)),
        right(map.gridFromGlass({1.0, 0.0}) - map.gridFromGlass({0.0, 0.0})) {}
  glm::dvec3 over(const PaneNode& node, const AirflowShape& shape) const;
};

glm::dvec3 FreeAir::over(const PaneNode& node, const AirflowShape& shape) const {
  if (speed_mps < 1e-6) return glm::dvec3(0.0);
  const double into = -glm::dot(air_mps, node.normal);  // > 0: blows against the glass
  glm::dvec3 along = air_mps + into * node.normal;
  // A windscreen raked at 30 degrees meets the wind with half its speed: that counts as facing it.
  const double facing = std::clamp(2.0 * into / speed_mps, -1.0, 1.0);
  if (facing <= 0.0) return along * (1.0 + facing * (1.0 - shape.lee));
  along *= 1.0 - shape.stagnation * facing * (1.0 - node.height);
  const glm::dvec3 right_m = node.along_x * right.x + node.along_y * right.y;
  return along + right_m * (shape.outward * into * node.across);
}

// What a host's field tells of the air from ahead, and the shape of the rest.
struct AirOverPane {
  const Airflow& airflow;
  double from_ahead_mps;
  FreeAir by_shape;
  AirOverPane(const PaneMap& map, const glm::dvec3& air_mps, const Airflow& airflow_over_it)
      : airflow(airflow_over_it),
        from_ahead_mps(std::max(0.0, -air_mps.x)),
        by_shape(map, known() ? air_mps + glm::dvec3(from_ahead_mps, 0.0, 0.0) : air_mps) {}
  bool known() const { return !airflow.ahead.share.empty(); }
  glm::dvec3 at(const PaneNode& node) const {
    const glm::dvec3 rest_mps = by_shape.over(node, airflow.shape);
    return known() ? from_ahead_mps * airflow.ahead.at(node.across, node.height) + rest_mps : rest_mps;
  }
};

// Of a place between the corners of its tile.
struct InTile {
  size_t node;  // its first corner's
  int row;      // from a corner to the next one up
  glm::vec2 f;
  InTile(const PaneMap& map, glm::dvec2 grid_m) : row(map.nodeCount().x) {
    const glm::vec2 place = glm::clamp(glm::vec2(grid_m / (map.grid().texel_m * shared::kTileSize)),
                                       glm::vec2(0.0f), glm::vec2(map.nodeCount() - 1) - 1e-3f);
    const glm::ivec2 cell(place);
    f = place - glm::vec2(cell);
    node = static_cast<size_t>(cell.y * row + cell.x);
  }
  glm::vec4 mix(const std::vector<glm::vec4>& nodes) const {
    const glm::vec4* low = &nodes[node];
    const glm::vec4* high = low + row;
    return glm::mix(glm::mix(low[0], low[1], f.x), glm::mix(high[0], high[1], f.x), f.y);
  }
  glm::dvec2 metres(const PaneMap& map) const {
    return static_cast<double>(shared::kFilmStep_s) / map.grid().texel_m /
           glm::dvec2(shared::xy(mix(map.nodeMetric())));
  }
};

}  // namespace

glm::dvec3 AirflowField::at(double across, double height) const {
  const glm::dvec2 most(columns - 1, rows - 1);
  const glm::dvec2 place = glm::clamp(glm::dvec2(0.5 * (across + 1.0), height), 0.0, 1.0) * most;
  const glm::ivec2 low(place), high = glm::min(low + 1, glm::ivec2(most));
  const glm::dvec2 f = place - glm::dvec2(low);
  const auto value = [this](int x, int y) {
    return glm::dvec3(share[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)]);
  };
  return glm::mix(glm::mix(value(low.x, low.y), value(high.x, low.y), f.x),
                  glm::mix(value(low.x, high.y), value(high.x, high.y), f.x), f.y);
}

glm::dvec3 airOverGlass(const PaneMap& map, const PaneNode& node, const glm::dvec3& air_mps,
                        const Airflow& airflow) {
  return AirOverPane(map, air_mps, airflow).at(node);
}

void ForceField::setAirflow(Airflow airflow) {
  airflow_ = std::move(airflow);
  acceleration_mps2_ = glm::dvec3(1e300);  // no tick's: the next is made anew
}

void ForceField::make(const PaneMap& map, const glm::dvec3& acceleration_mps2, const glm::dvec3& air_mps,
                      const glm::dvec3& slid_m) {
  if (!nodes_.empty() && acceleration_mps2 == acceleration_mps2_ && air_mps == air_mps_ && slid_m == slid_m_)
    return;
  acceleration_mps2_ = acceleration_mps2;
  air_mps_ = air_mps;
  slid_m_ = slid_m;
  const glm::dvec2 slid = map.acrossAndHeight(slid_m);
  const AirOverPane air(map, air_mps, airflow_);
  nodes_.resize(map.nodes().size());
  for (size_t i = 0; i < nodes_.size(); ++i) {
    PaneNode node = map.nodes()[i];
    node.across = std::clamp(node.across + slid.x, -1.0, 1.0);
    node.height = std::clamp(node.height + slid.y, 0.0, 1.0);
    const GlassAxes axes(node);
    nodes_[i] = glm::vec4(glm::vec2(axes.along(acceleration_mps2)), glm::vec2(axes.along(air.at(node))));
  }
  findAbout(map);
}

void ForceField::findAbout(const PaneMap& map) {
  const glm::ivec2 count = map.nodeCount();
  at_nodes_.resize(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const glm::vec2 acceleration = accelerationOf(nodes_[i]), air = airOf(nodes_[i]);
    const float air_mps = glm::length(air);
    at_nodes_[i] = {acceleration, air_mps * air, glm::length(acceleration), air_mps * air_mps};
  }
  tiles_.assign(nodes_.size(), {});  // a tile has its first corner's number
  for (int y = 0; y + 1 < count.y; ++y) {
    for (int x = 0; x + 1 < count.x; ++x) {
      About& tile = tiles_[static_cast<size_t>(y * count.x + x)];
      for (const int corner : {0, 1, count.x, count.x + 1}) {
        const About& node = at_nodes_[static_cast<size_t>(y * count.x + x + corner)];
        tile.acceleration_mps2 += 0.25f * node.acceleration_mps2;
        tile.air2_m2_s2 += 0.25f * node.air2_m2_s2;
        tile.most_acceleration_mps2 = std::max(tile.most_acceleration_mps2, node.most_acceleration_mps2);
        tile.most_air2_m2_s2 = std::max(tile.most_air2_m2_s2, node.most_air2_m2_s2);
      }
    }
  }
}

int ForceField::tileAt(const PaneMap& map, glm::dvec2 grid_m) {
  return static_cast<int>(InTile(map, grid_m).node);
}

double ForceField::airSpeed_mps(const PaneMap& map, glm::dvec2 grid_m) const {
  return static_cast<double>(glm::length(airOf(InTile(map, grid_m).mix(nodes_))));
}

Push ForceField::at(const PaneMap& map, glm::dvec2 grid_m) const {
  const InTile in(map, grid_m);
  const glm::vec4 push = in.mix(nodes_);
  return {glm::dvec2(accelerationOf(push)), glm::dvec2(airOf(push)), in.metres(map),
          static_cast<int>(in.node)};
}

glm::dvec2 ForceField::metresAt(const PaneMap& map, glm::dvec2 grid_m) {
  return InTile(map, grid_m).metres(map);
}

glm::dvec2 ForceField::shear_pa(const glm::dvec2& air_mps) const {
  return 0.5 * kRhoAir_kg_m3 * airflow_.shape.drag_friction * glm::length(air_mps) * air_mps;
}

std::vector<shared::vec4> ForceField::filmDrive() const {
  std::vector<shared::vec4> out;
  out.reserve(nodes_.size());
  for (const NodePush& node : nodes_) {
    const glm::vec2 shear(shear_pa(glm::dvec2(airOf(node))));
    out.emplace_back(node.x, node.y, shear.x, shear.y);
  }
  return out;
}

}  // namespace rg::glass
