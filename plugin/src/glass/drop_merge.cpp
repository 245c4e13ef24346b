// Drops that touch become one: mass and momentum are conserved.
#include <algorithm>

#include "glass/drop_shape.h"
#include "glass/drops.h"

namespace rg::glass {
namespace {
constexpr int kLargestStride = 32;  // ticks; between, the largest radius seen bounds those there are
constexpr double kTouch = 0.92;  // of the sum of radii: outlines are uneven, so circles must overlap a little
}  // namespace

void Drops::merge(const DropWorld& world) {
  if (world.tick % kLargestStride == 0) findWidest();
  for (size_t i = 0; i < changed_.size(); ++i) {
    constexpr size_t kAhead = 4;
    if (i + kAhead < changed_.size()) fetchAbout(changed_[i + kAhead]);
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

// Cells lie anywhere in memory: they are asked for before they are waited for.
void Drops::fetchAbout(int slot) const {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const glm::ivec2 cell = cellAt(drop.place_m);
  for (int y = std::max(0, cell.y - 1); y <= std::min(cell.y + 1, cell_count_.y - 1); ++y)
    __builtin_prefetch(&cells_[static_cast<size_t>(y * cell_count_.x + cell.x)]);
}

// Some drops are far wider than most: a look for neighbours goes as far as the widest of the blocks about
// reaches, and leaves out the cells whose own widest does not reach back.
void Drops::findWidest() {
  largest_radius_m_ = 0.0;
  for (Cell& cell : cells_) cell.widest_m = 0.0f;
  std::fill(widest_m_.begin(), widest_m_.end(), 0.0f);
  for (const Drop& drop : slots_.items) {
    if (drop.volume_pl != 0) noteWidth(drop);
  }
}

void Drops::noteWidth(const Drop& drop) {
  const float reach_m = halfLength_m(drop);
  const glm::ivec2 at = cellAt(drop.place_m), block = at / kBlock;
  for (float* widest_m : {&cells_[static_cast<size_t>(at.y * cell_count_.x + at.x)].widest_m,
                          &widest_m_[static_cast<size_t>(block.y * block_count_.x + block.x)]})
    *widest_m = std::max(*widest_m, reach_m);
  largest_radius_m_ = std::max(largest_radius_m_, static_cast<double>(reach_m));
}

double Drops::widestAbout_m(glm::dvec2 place_m, glm::dvec2 reach_m) const {
  const glm::ivec2 low = cellAt(place_m - reach_m) / kBlock, high = cellAt(place_m + reach_m) / kBlock;
  float widest_m = 0.0f;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x)
      widest_m = std::max(widest_m, widest_m_[static_cast<size_t>(y * block_count_.x + x)]);
  }
  return static_cast<double>(widest_m);
}

// The first drop about a place, in the order of cells, that `met` is true of; -1: none. None is left out that
// reaches nearer than `beyond_m` to the place.
template <class Met>
int Drops::firstAbout(const DropWorld& world, glm::dvec2 place_m, double beyond_m, const Met& met) const {
  const glm::dvec2 metres = ForceField::metresAt(world.map, place_m);
  const double widest_m = widestAbout_m(place_m, (beyond_m + largest_radius_m_) / metres);
  const glm::dvec2 reach_m = (beyond_m + widest_m) / metres;
  const glm::ivec2 low = cellAt(place_m - reach_m), high = cellAt(place_m + reach_m);
  const glm::vec2 at_m(place_m * metres), cell_m(kCell_m * metres);
  const float own_m = static_cast<float>(beyond_m) + 1e-6f;  // and what floats round
  for (int y = low.y; y <= high.y; ++y) {
    const float below_m = static_cast<float>(y) * cell_m.y - at_m.y;
    const float dy_m = std::max(0.0f, std::max(below_m, -below_m - cell_m.y));
    const Cell* row = &cells_[static_cast<size_t>(y * cell_count_.x)];
    for (int x = low.x; x <= high.x; ++x) {
      const Cell& cell = row[x];
      if (cell.first < 0) continue;
      const float left_m = static_cast<float>(x) * cell_m.x - at_m.x;
      const float dx_m = std::max(0.0f, std::max(left_m, -left_m - cell_m.x));
      const float reaches_m = own_m + cell.widest_m;
      if (dx_m * dx_m + dy_m * dy_m > reaches_m * reaches_m) continue;
      for (int slot = cell.first; slot >= 0; slot = slots_.items[static_cast<size_t>(slot)].next) {
        const Drop& drop = slots_.items[static_cast<size_t>(slot)];
        if (met(slot, drop, (drop.place_m - place_m) * metres)) return slot;
      }
    }
  }
  return -1;
}

// The first of those a drop touches; -1: none.
int Drops::touching(const DropWorld& world, int slot) const {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const float half_m = halfLength_m(drop);
  return firstAbout(world, drop.place_m, static_cast<double>(half_m),
                    [&](int other, const Drop& that, glm::dvec2 d) {
                      const double apart2_m2 = glm::dot(d, d);
                      double near_m = kTouch * static_cast<double>(half_m + halfLength_m(that));
                      if (other == slot || apart2_m2 >= near_m * near_m) return false;
                      near_m = kTouch * (reachTowards_m(drop, d) + reachTowards_m(that, d));
                      return apart2_m2 < near_m * near_m;
                    });
}

// The first drop that a place lies in; -1: none.
int Drops::covering(const DropWorld& world, glm::dvec2 place_m) const {
  return firstAbout(world, place_m, 0.0, [](int, const Drop& drop, glm::dvec2 d) {
    const double reach_m = reachTowards_m(drop, d);
    return glm::dot(d, d) < reach_m * reach_m;
  });
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
  const glm::dvec2 metres = ForceField::metresAt(world.map, large.place_m);
  const double distance_m = glm::length(between * metres);
  // Both bases together, less what they share, stay wetted; the union is longer along the line between both.
  const double r = static_cast<double>(large.base_radius_m), q = static_cast<double>(small.base_radius_m);
  const double longer = std::max(2.0 * r, r + q + distance_m) / (2.0 * r);
  const double apart = std::clamp((distance_m + q - r) / (2.0 * q), 0.0, 1.0);
  if (longer > 1.05 && !large.moving) {
    const glm::dvec2 axis = distance_m > 0.0 ? between * metres / distance_m : glm::dvec2(large.heading);
    if (static_cast<double>(large.elongation) < longer) {
      large.heading = glm::vec2(axis);
      large.corner = 0.0f;
    }
    large.elongation =
        static_cast<float>(std::min(1.8, std::max(longer, 0.8 * static_cast<double>(large.elongation))));
  }
  large.velocity_mps += (small.velocity_mps - large.velocity_mps) * static_cast<float>(share);
  large.moving = large.moving || small.moving;
  const int64_t gained_pl = passed(LeakyKernel::merge, small.volume_pl);
  const glm::dvec2 place = large.place_m + share * between;
  remove(b);
  if (world.map.texelAt(place) >= 0) {
    moveTo(a, place);
    large.texel = world.map.texelAt(place);
  }
  large.volume_pl += gained_pl;
  large.base_radius_m = static_cast<float>(std::sqrt(r * r + q * q * apart));
  noteWidth(large);
  settle(large);
  return a;
}

}  // namespace rg::glass
