#include "glass/pillar.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "glass/saved_limits.h"
#include "shared/hash.glsl"
#include "tick.h"

namespace rg::glass {
namespace {

// A way over a pillar begins along the one pane and ends along the other: the cosines of both to the line
// between are together no less, and both edges run side by side, to within the angle of the other cosine (by
// eye).
constexpr double kLooksAt = 0.5, kSideBySide = 0.7;

// A pane that has not been ticked for so long is inactive, for others wait no longer for their films: what
// comes to it runs past.
constexpr int64_t kLongestAway_ticks = 10 * kTickHz;

// A texel beside which there is no glass.
struct Edge {
  glm::dvec3 place_m{0.0};
  glm::dvec3 outward{0.0};  // unit, along the glass
  glm::dvec3 along{0.0};    // unit, along the edge
  int texel = 0;
};

// Across the edge, away from where the glass about it lies: edges go askew through the grid.
glm::dvec2 awayFromGlass(const PaneMap& map, glm::ivec2 at) {
  constexpr int kAbout = 4;
  const glm::ivec2 size = map.grid().size;
  glm::dvec2 sum(0.0);
  for (int y = -kAbout; y <= kAbout; ++y) {
    for (int x = -kAbout; x <= kAbout; ++x) {
      const glm::ivec2 q = at + glm::ivec2(x, y);
      const bool known = q.x >= 0 && q.y >= 0 && q.x < size.x && q.y < size.y;
      if (known && map.inside(q.y * size.x + q.x)) sum -= glm::dvec2(x, y);
    }
  }
  return sum;
}

std::vector<Edge> edgesOf(const PaneMap& map) {
  const int columns = map.grid().size.x;
  std::vector<Edge> edges;
  for (int i = 0; i < map.texelCount(); ++i) {
    if (!map.inside(i)) continue;
    // A rim of one texel lies off the pane, so that all of its glass has four neighbours.
    if (map.inside(i - 1) && map.inside(i + 1) && map.inside(i - columns) && map.inside(i + columns))
      continue;
    const PaneTexel& t = map.texel(i);
    const glm::dvec2 away = awayFromGlass(map, {i % columns, i / columns});
    const glm::dvec3 outward = away.x * glm::dvec3(t.along_x) + away.y * glm::dvec3(t.along_y);
    if (glm::length(outward) < 1e-6) continue;
    const glm::dvec3 unit = glm::normalize(outward);
    edges.push_back({glm::dvec3(t.position_m), unit, glm::cross(glm::dvec3(t.normal), unit), i});
  }
  return edges;
}

struct Box {
  glm::dvec3 low{1e9}, high{-1e9};
  bool holds(const glm::dvec3& p, double margin_m) const {
    return glm::all(glm::greaterThan(p, low - margin_m)) && glm::all(glm::lessThan(p, high + margin_m));
  }
};

Box boxOf(const std::vector<Edge>& edges) {
  Box box;
  for (const Edge& edge : edges) {
    box.low = glm::min(box.low, edge.place_m);
    box.high = glm::max(box.high, edge.place_m);
  }
  return box;
}

// The other pane's edge that is nearest, where this one looks at it.
std::optional<int> seenFrom(const Edge& edge, const std::vector<Edge>& others) {
  double nearest2_m2 = kWidestPillar_m * kWidestPillar_m;
  const Edge* nearest = nullptr;
  for (const Edge& other : others) {
    const glm::dvec3 way = other.place_m - edge.place_m;
    const double way2_m2 = glm::dot(way, way);
    if (way2_m2 >= nearest2_m2) continue;
    nearest2_m2 = way2_m2;
    nearest = &other;
  }
  if (nearest == nullptr) return std::nullopt;
  const glm::dvec3 way = nearest->place_m - edge.place_m;
  const bool looks = glm::dot(way, edge.outward - nearest->outward) > kLooksAt * glm::length(way);
  const bool beside = std::abs(glm::dot(edge.along, nearest->along)) > kSideBySide;
  if (!looks || !beside) return std::nullopt;
  return nearest->texel;
}

}  // namespace

Pillar::Pillar(const PaneMap& from, const PaneMap& to)
    : crossings_(from.tileArea_m2().size()), texels_there_(to.texelCount()) {
  if (glm::distance(from.centre_m(), to.centre_m()) >
      from.radius_m() + to.radius_m() + static_cast<float>(kWidestPillar_m))
    return;
  const std::vector<Edge> edges = edgesOf(from);
  std::vector<Edge> others = edgesOf(to);
  const Box box = boxOf(edges), other_box = boxOf(others);
  std::erase_if(others, [&](const Edge& other) { return !box.holds(other.place_m, kWidestPillar_m); });
  std::vector<int> sides(crossings_.size(), 0);
  std::vector<std::vector<int>> seen(crossings_.size());
  for (const Edge& edge : edges) {
    const size_t tile = from.tileOf(edge.texel);
    ++sides[tile];
    if (!other_box.holds(edge.place_m, kWidestPillar_m)) continue;
    if (const auto texel = seenFrom(edge, others)) seen[tile].push_back(*texel);
  }
  for (size_t tile = 0; tile < crossings_.size(); ++tile) {
    if (seen[tile].empty()) continue;
    const uint32_t chosen =
        shared::pcg(static_cast<uint32_t>(tile)) % static_cast<uint32_t>(seen[tile].size());
    crossings_[tile] = {static_cast<float>(seen[tile].size()) / static_cast<float>(sides[tile]),
                        seen[tile][chosen]};
    joins_ = true;
  }
}

void Pillar::give(int64_t moment, size_t tile, int64_t volume_pl, double share) {
  Crossing& crossing = crossings_[tile];
  if (crossing.texel < 0 || volume_pl <= 0) return;
  const std::lock_guard lock(mutex_);
  crossing.gathered_pl +=
      static_cast<int64_t>(static_cast<double>(volume_pl) * share * static_cast<double>(crossing.share));
  if (crossing.gathered_pl < kTrickle_pl) return;
  while (!under_way_.empty() && under_way_.front().moment < moment - kLongestAway_ticks)
    under_way_.pop_front();
  under_way_.push_back({moment, {crossing.texel, std::exchange(crossing.gathered_pl, 0)}});
}

void Pillar::owes(int64_t moment) {
  const std::lock_guard lock(mutex_);
  owes_ = moment;
}

bool Pillar::knows(int64_t moment) const {
  const std::lock_guard lock(mutex_);
  return owes_ > moment - kPillarTicks;
}

std::vector<Trickle> Pillar::arrived(int64_t moment) {
  const std::lock_guard lock(mutex_);
  std::vector<Trickle> out;
  while (!under_way_.empty() && under_way_.front().moment <= moment - kPillarTicks) {
    out.push_back(under_way_.front().trickle);
    under_way_.pop_front();
  }
  return out;
}

void Pillar::clear() {
  const std::lock_guard lock(mutex_);
  under_way_.clear();
  for (Crossing& crossing : crossings_) crossing.gathered_pl = 0;
}

uint64_t Pillar::hash() const {
  saved::Writer all;
  write(all);
  return saved::fingerprintOf(all.bytes);
}

void Pillar::write(saved::Writer& a) const {
  const std::lock_guard lock(mutex_);
  std::vector<int64_t> gathered_pl;
  for (const Crossing& crossing : crossings_) gathered_pl.push_back(crossing.gathered_pl);
  a.list(gathered_pl, gathered_pl.size());
  a.list(under_way_, under_way_.size(),
         [&a](const UnderWay& water) { a(water.moment, water.trickle.texel, water.trickle.volume_pl); });
}

void Pillar::read(saved::Reader& a, int64_t now) {
  constexpr size_t kMostUnderWay = size_t{1} << 24;
  std::vector<int64_t> gathered_pl;
  std::deque<UnderWay> under_way;
  a.list(gathered_pl, crossings_.size(),
         [&a](int64_t& volume_pl) { a.within(volume_pl, int64_t{0}, kTrickle_pl); });
  a.require(gathered_pl.size() == crossings_.size(), "another number of tiles is beside it");
  int64_t last = 0;
  a.list(under_way, kMostUnderWay, [&](UnderWay& water) {
    a.within(water.moment, last, now);
    a.within(water.trickle.texel, 0, texels_there_ - 1);
    a.within(water.trickle.volume_pl, int64_t{1}, kMostSaved_pl);
    last = water.moment;
  });
  if (!a.commits()) return;
  const std::lock_guard lock(mutex_);
  for (size_t tile = 0; tile < crossings_.size(); ++tile) crossings_[tile].gathered_pl = gathered_pl[tile];
  under_way_ = std::move(under_way);
}

}  // namespace rg::glass
