#include "glass/impact.h"

#include <algorithm>
#include <numbers>

#include "glass/random.h"
#include "glass/water.h"
#include "tick.h"

namespace rg::glass {
namespace {

glm::dvec3 dropVelocity(const PaneTick& tick, const SizeClass& size) {
  return tick.air_mps + size.drift_mps + size.fall_speed_mps * tick.down;
}

double dropVolume_m3(double diameter_m) {
  return std::numbers::pi / 6.0 * diameter_m * diameter_m * diameter_m;
}

// Swept volume per second of a region by drops of velocity v.
double reached_m3_s(const PaneMap& map, const PaneTick& tick, int region, const glm::dvec3& v) {
  const double open = static_cast<double>(tick.wet_share[static_cast<size_t>(region)]);
  return open * std::max(0.0, -glm::dot(v, map.regionArea_m2(region)));
}

// A texel of the region with the odds of its area and incidence, by trying.
int pickTexel(const PaneMap& map, int region, const glm::dvec3& v, Stream& random) {
  const std::vector<int>& texels = map.regionTexels(region);
  const double most = glm::length(v) * 1.5 * map.grid().texel_m * map.grid().texel_m;
  for (int tries = 0;; ++tries) {
    const int index = texels[static_cast<size_t>(random.unit() * static_cast<double>(texels.size()))];
    const PaneTexel& texel = map.texel(index);
    const double weight = -glm::dot(v, glm::dvec3(texel.normal)) * static_cast<double>(texel.area_m2);
    if (random.unit() * most < weight || tries == 200) return index;
  }
}

}  // namespace

double weber(const Impact& impact) {
  return kRho_kg_m3 * impact.speed_mps * impact.speed_mps * impact.diameter_m / kGamma_n_m;
}

double lamellaRadius_m(const Impact& impact) {
  return 0.5 * impact.diameter_m * std::sqrt(std::sqrt(weber(impact)));
}

double catchRate_m3_s(const PaneMap& map, const PaneTick& tick) {
  double sum = 0.0;
  for (uint32_t c = 0; c < tick.class_count; ++c) {
    const SizeClass& size = tick.classes[c];
    for (int r = 0; r < kRegions; ++r) {
      sum += size.number_per_m3 * dropVolume_m3(size.diameter_m) *
             reached_m3_s(map, tick, r, dropVelocity(tick, size));
    }
  }
  return sum;
}

void findImpacts(const PaneMap& map, const PaneTick& tick, uint64_t seed, uint32_t pane,
                 std::vector<Impact>& out) {
  out.clear();
  for (uint32_t c = 0; c < tick.class_count; ++c) {
    const SizeClass& size = tick.classes[c];
    const glm::dvec3 v = dropVelocity(tick, size);
    std::array<double, kRegions> sums{};
    double reached = 0.0;
    for (int r = 0; r < kRegions; ++r)
      sums[static_cast<size_t>(r)] = reached += reached_m3_s(map, tick, r, v);
    if (reached <= 0.0) continue;
    Stream random(seed, pane, static_cast<uint64_t>(tick.index), c);
    const uint32_t count = poisson(random, reached * size.number_per_m3 * kTickSeconds);
    for (uint32_t i = 0; i < count; ++i) {
      const auto region =
          std::lower_bound(sums.begin(), sums.end() - 1, random.unit() * reached) - sums.begin();
      Impact impact;
      impact.texel = pickTexel(map, static_cast<int>(region), v, random);
      const glm::dvec2 corner = map.middleOf(impact.texel) - 0.5 * map.grid().texel_m;
      impact.place_m = corner + map.grid().texel_m * glm::dvec2(random.unit(), random.unit());
      impact.diameter_m = size.diameter_m;
      impact.speed_mps = std::max(0.0, -glm::dot(v, glm::dvec3(map.texel(impact.texel).normal)));
      impact.volume_pl = picolitres(dropVolume_m3(size.diameter_m));
      impact.hash = random.next();
      out.push_back(impact);
    }
  }
}

}  // namespace rg::glass
