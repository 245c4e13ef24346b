// Drops that touch become one: mass and momentum are conserved.
#include <algorithm>

#include "glass/drops.h"

namespace rg::glass {
namespace {
constexpr int kLargestStride = 32;  // ticks; between, the largest radius seen bounds those there are
constexpr double kTouch = 0.92;  // of the sum of radii: outlines are uneven, so circles must overlap a little
}  // namespace

void Drops::merge(const DropWorld& world) {
  if (world.tick % kLargestStride == 0) {
    largest_radius_m_ = 0.0;
    for (const Drop& drop : slots_.items) {
      if (drop.volume_pl != 0)
        largest_radius_m_ = std::max(largest_radius_m_, static_cast<double>(drop.base_radius_m));
    }
  }
  for (size_t i = 0; i < changed_.size(); ++i) {
    int slot = changed_[i];
    slots_.items[static_cast<size_t>(slot)].changed = false;
    for (int times = 0; times < 8 && slots_.items[static_cast<size_t>(slot)].volume_pl != 0; ++times) {
      const int other = touching(world, slot);
      if (other < 0) break;
      slot = unite(world, slot, other);
    }
  }
  changed_.clear();
}

// The first of those a drop touches, in the order of cells; -1: none.
int Drops::touching(const DropWorld& world, int slot) const {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const glm::dvec2 metres = world.forces.at(world.map, drop.place_m).metres;
  const double reach_m = static_cast<double>(drop.base_radius_m) + largest_radius_m_;
  const glm::ivec2 low =
      glm::clamp(glm::ivec2((drop.place_m - reach_m / metres) / kCell_m), glm::ivec2(0), cell_count_ - 1);
  const glm::ivec2 high =
      glm::clamp(glm::ivec2((drop.place_m + reach_m / metres) / kCell_m), glm::ivec2(0), cell_count_ - 1);
  // Neighbours lie anywhere in memory: all are asked for before the first is waited for.
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const int32_t first = cells_[static_cast<size_t>(y * cell_count_.x + x)];
      if (first >= 0) __builtin_prefetch(&slots_.items[static_cast<size_t>(first)]);
    }
  }
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      for (int other = cells_[static_cast<size_t>(y * cell_count_.x + x)]; other >= 0;
           other = slots_.items[static_cast<size_t>(other)].next) {
        if (other == slot) continue;
        const Drop& that = slots_.items[static_cast<size_t>(other)];
        const glm::dvec2 d = (that.place_m - drop.place_m) * metres;
        const double near_m = kTouch * static_cast<double>(drop.base_radius_m + that.base_radius_m);
        if (glm::dot(d, d) < near_m * near_m) return other;
      }
    }
  }
  return -1;
}

// The first drop that a place lies in; -1: none.
int Drops::covering(const DropWorld& world, glm::dvec2 place_m) const {
  const glm::dvec2 metres = world.forces.at(world.map, place_m).metres;
  const glm::ivec2 low = glm::clamp(glm::ivec2((place_m - largest_radius_m_ / metres) / kCell_m),
                                    glm::ivec2(0), cell_count_ - 1);
  const glm::ivec2 high = glm::clamp(glm::ivec2((place_m + largest_radius_m_ / metres) / kCell_m),
                                     glm::ivec2(0), cell_count_ - 1);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      for (int slot = cells_[static_cast<size_t>(y * cell_count_.x + x)]; slot >= 0;
           slot = slots_.items[static_cast<size_t>(slot)].next) {
        const Drop& drop = slots_.items[static_cast<size_t>(slot)];
        const glm::dvec2 d = (drop.place_m - place_m) * metres;
        const double radius_m = static_cast<double>(drop.base_radius_m);
        if (glm::dot(d, d) < radius_m * radius_m) return slot;
      }
    }
  }
  return -1;
}

// The larger one lives on.
int Drops::unite(const DropWorld& world, int a, int b) {
  if (slots_.items[static_cast<size_t>(b)].volume_pl > slots_.items[static_cast<size_t>(a)].volume_pl)
    std::swap(a, b);
  Drop& large = slots_.items[static_cast<size_t>(a)];
  const Drop& small = slots_.items[static_cast<size_t>(b)];
  const double share =
      static_cast<double>(small.volume_pl) / static_cast<double>(large.volume_pl + small.volume_pl);
  const glm::dvec2 between = small.place_m - large.place_m;
  const glm::dvec2 metres = world.forces.at(world.map, large.place_m).metres;
  const double distance_m = glm::length(between * metres);
  // Both bases together, less what they share, stay wetted; the union is longer along the line between both.
  const double r = static_cast<double>(large.base_radius_m), q = static_cast<double>(small.base_radius_m);
  const double longer = std::max(2.0 * r, r + q + distance_m) / (2.0 * r);
  const double apart = std::clamp((distance_m + q - r) / (2.0 * q), 0.0, 1.0);
  if (longer > 1.05 && !large.moving) {
    const glm::dvec2 axis = distance_m > 0.0 ? between * metres / distance_m : glm::dvec2(large.heading);
    if (static_cast<double>(large.elongation) < longer) large.heading = glm::vec2(axis);
    large.elongation =
        static_cast<float>(std::min(1.8, std::max(longer, 0.8 * static_cast<double>(large.elongation))));
  }
  large.velocity_mps += (small.velocity_mps - large.velocity_mps) * static_cast<float>(share);
  large.moving = large.moving || small.moving;
  const int64_t gained_pl = passed(LeakyKernel::merge, small.volume_pl);
  const glm::dvec2 place = large.place_m + share * between;
  remove(b);
  if (world.map.texelAt(place) >= 0) {
    unlink(a);
    large.place_m = place;
    large.texel = world.map.texelAt(place);
    link(a);
  }
  large.volume_pl += gained_pl;
  large.base_radius_m = static_cast<float>(std::sqrt(r * r + q * q * apart));
  large.age_s = 0.0f;
  settle(large);
  return a;
}

}  // namespace rg::glass
