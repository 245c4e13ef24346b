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

// Of the whole pane. Where all of it faces the stream, or none does, one product tells it.
double reached_m3_s(const PaneMap& map, const PaneTick& tick, const glm::dvec3& open_m2,
                    const glm::dvec3& v) {
  const double against = -glm::dot(v, map.meanNormal()), bend = glm::length(v) * map.mostBentSine();
  if (against >= bend) return -glm::dot(v, open_m2);
  if (against <= -bend) return 0.0;
  double sum = 0.0;
  for (int r = 0; r < kRegions; ++r) sum += reached_m3_s(map, tick, r, v);
  return sum;
}

glm::dvec3 openArea_m2(const PaneMap& map, const PaneTick& tick) {
  glm::dvec3 open_m2(0.0);
  for (int r = 0; r < kRegions; ++r)
    open_m2 += static_cast<double>(tick.wet_share[static_cast<size_t>(r)]) * map.regionArea_m2(r);
  return open_m2;
}

double weber(double diameter_m, double speed_mps) {
  return kRho_kg_m3 * speed_mps * speed_mps * diameter_m / kGamma_n_m;
}

// A texel of the region with the odds of its area and incidence, by trying. What is true of all its texels
// mostly tells the outcome; looking them up one by one would cost more than all else about an impact.
int pickTexel(const PaneMap& map, int region, const glm::dvec3& v, Stream& random) {
  const std::vector<int>& texels = map.regionTexels(region);
  const double speed = glm::length(v), most = speed * 1.5 * map.grid().texel_m * map.grid().texel_m;
  const RegionBounds& bounds = map.regionBounds(region);
  constexpr double kRounding = 1e-9;
  const double against = -glm::dot(v, bounds.normal), bend = speed * (bounds.bend + kRounding);
  const double surely = std::max(0.0, against - bend) * bounds.least_m2 * (1.0 - kRounding),
               hardly = std::max(0.0, against + bend) * bounds.most_m2 * (1.0 + kRounding);
  for (int tries = 0;; ++tries) {
    const int& index = texels[static_cast<size_t>(random.unit() * static_cast<double>(texels.size()))];
    const double chance = random.unit() * most;
    if (chance < surely || tries == 200) return index;
    if (chance >= hardly) continue;
    const PaneTexel& texel = map.texel(index);
    if (chance < -glm::dot(v, glm::dvec3(texel.normal)) * static_cast<double>(texel.area_m2)) return index;
  }
}

}  // namespace

double weber(const Impact& impact) { return weber(impact.diameter_m, impact.speed_mps); }

double lamellaRadius_m(double diameter_m, double speed_mps) {
  const double reynolds = kRho_kg_m3 * speed_mps * diameter_m / kMu_pa_s;
  return 0.5 * diameter_m *
         std::min(std::sqrt(std::sqrt(weber(diameter_m, speed_mps))), std::pow(reynolds, 0.2));
}

double lamellaRadius_m(const Impact& impact) { return lamellaRadius_m(impact.diameter_m, impact.speed_mps); }

double lamellae_hz(const PaneMap& map, const PaneTick& tick) {
  const glm::dvec3 open_m2 = openArea_m2(map, tick);
  const double area_m2 = glm::length(open_m2);
  if (area_m2 == 0.0) return 0.0;
  double wetted_m2_s = 0.0;
  for (uint32_t c = 0; c < tick.class_count; ++c) {
    const SizeClass& size = tick.classes[c];
    const double reached_m3_s = std::max(0.0, -glm::dot(dropVelocity(tick, size), open_m2));
    const double radius_m = lamellaRadius_m(size.diameter_m, reached_m3_s / area_m2);
    wetted_m2_s += size.number_per_m3 * reached_m3_s * std::numbers::pi * radius_m * radius_m;
  }
  return wetted_m2_s / area_m2;
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
  const glm::dvec3 open_m2 = openArea_m2(map, tick);
  for (uint32_t c = 0; c < tick.class_count; ++c) {
    const SizeClass& size = tick.classes[c];
    const glm::dvec3 v = dropVelocity(tick, size);
    const double mean = reached_m3_s(map, tick, open_m2, v) * size.number_per_m3 * kTickSeconds;
    if (mean <= 0.0) continue;
    Stream random(seed, pane, static_cast<uint64_t>(tick.index), c);
    const uint32_t count = poisson(random, mean);
    if (count == 0) continue;
    std::array<double, kRegions> sums{};
    double reached = 0.0;
    for (int r = 0; r < kRegions; ++r)
      sums[static_cast<size_t>(r)] = reached += reached_m3_s(map, tick, r, v);
    if (reached <= 0.0) continue;
    const int64_t volume_pl = picolitres(dropVolume_m3(size.diameter_m));
    for (uint32_t i = 0; i < count; ++i) {
      const auto region =
          std::lower_bound(sums.begin(), sums.end() - 1, random.unit() * reached) - sums.begin();
      Impact impact;
      impact.texel = pickTexel(map, static_cast<int>(region), v, random);
      const glm::dvec2 corner = map.middleOf(impact.texel) - 0.5 * map.grid().texel_m;
      impact.place_m = corner + map.grid().texel_m * glm::dvec2(random.unit(), random.unit());
      impact.diameter_m = size.diameter_m;
      impact.speed_mps = std::max(0.0, -glm::dot(v, glm::dvec3(map.texel(impact.texel).normal)));
      impact.volume_pl = volume_pl;
      impact.hash = random.next();
      out.push_back(impact);
    }
  }
}

}  // namespace rg::glass
