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
  const int cell = slots_.items[static_cast<size_t>(slot)].cell, last = static_cast<int>(cells_.size()) - 1;
  for (const int row : {-cell_count_.x, 0, cell_count_.x})
    __builtin_prefetch(&cells_[static_cast<size_t>(std::clamp(cell + row, 0, last))]);
}

// Some drops are far wider than most: a look for neighbours goes as far as the widest of the blocks about
// reaches.
void Drops::findWidest() {
  largest_radius_m_ = 0.0f;
  std::fill(widest_m_.begin(), widest_m_.end(), 0.0f);
  for (Cell& cell : cells_) cell.widest_m = 0.0f;
  for (size_t slot = 0; slot < slots_.items.size(); ++slot) {
    if (slots_.items[slot].volume_pl != 0) tellWidth(static_cast<int>(slot), nears_[slot].half_m);
  }
}

// Its cell knows of what is no wider than before.
void Drops::noteWidth(int slot) {
  const float half_m = halfLength_m(slots_.items[static_cast<size_t>(slot)]);
  float& known_m = nears_[static_cast<size_t>(slot)].half_m;
  if (half_m > known_m) tellWidth(slot, half_m);
  known_m = half_m;
}

void Drops::tellWidth(int slot, float half_m) {
  const auto cell = static_cast<size_t>(slots_.items[static_cast<size_t>(slot)].cell);
  float& cell_m = cells_[cell].widest_m;
  cell_m = std::max(cell_m, half_m);
  float& block_m = widest_m_[static_cast<size_t>(block_of_[cell])];
  block_m = std::max(block_m, half_m);
  largest_radius_m_ = std::max(largest_radius_m_, half_m);
}

float Drops::widestAbout_m(glm::vec2 place_m, glm::vec2 reach_m) const {
  const glm::vec2 least_m = place_m - reach_m, most_m = place_m + reach_m;
  const int left = columnAt(least_m.x) / kBlock, right = columnAt(most_m.x) / kBlock;
  const int low = rowAt(least_m.y) / kBlock, high = rowAt(most_m.y) / kBlock;
  float widest_m = 0.0f;
  for (int y = low; y <= high; ++y) {
    for (int x = left; x <= right; ++x)
      widest_m = std::max(widest_m, widest_m_[static_cast<size_t>(y * block_count_.x + x)]);
  }
  return widest_m;
}

// The first drop about a place, in the order of cells, that `met` is true of; -1: none. None is left out that
// is nearer than `overlap` of both reaches, `own_m` its own.
template <class Met>
int Drops::firstAbout(const DropWorld& world, glm::dvec2 place_m, float own_m, float overlap,
                      const Met& met) const {
  constexpr float kRounding_m = 2e-5f;  // of what floats round of places and reaches
  const glm::dvec2 metres = ForceField::metresAt(world.map, place_m);
  const glm::vec2 scale(metres), per_metre = 1.0f / scale, at_m(place_m);
  const float farthest_m = own_m + widestAbout_m(at_m, (own_m + largest_radius_m_) * per_metre);
  const float far_m = overlap * farthest_m + kRounding_m, far2_m2 = far_m * far_m;
  const float bottom_m = at_m.y - far_m * per_metre.y, top_m = at_m.y + far_m * per_metre.y;
  const float row_m = static_cast<float>(kCell_m);
  const int low = rowAt(bottom_m), high = rowAt(top_m);
  for (int y = low; y <= high; ++y) {
    const float below_m = static_cast<float>(y) * row_m - at_m.y;
    const float dy_m = scale.y * std::max(0.0f, std::max(below_m, -below_m - row_m));
    const float aside_m = std::sqrt(std::max(0.0f, far2_m2 - dy_m * dy_m)) * per_metre.x;
    const Cell* row = &cells_[static_cast<size_t>(y * cell_count_.x)];
    const int right = columnAt(at_m.x + aside_m);
    for (int x = columnAt(at_m.x - aside_m); x <= right; ++x) {
      const Cell& cell = row[x];
      const float left_m = static_cast<float>(x) * row_m - at_m.x;
      const float dx_m = scale.x * std::max(0.0f, std::max(left_m, -left_m - row_m));
      const float reach_m = overlap * (own_m + cell.widest_m) + kRounding_m;
      if (dx_m * dx_m + dy_m * dy_m >= reach_m * reach_m) continue;  // too far from all in it
      for (int slot = cell.first; slot >= 0;) {
        const Near& near = nears_[static_cast<size_t>(slot)];
        const glm::vec2 away_m = (near.place_m - at_m) * scale;
        const float near_m = overlap * (own_m + near.half_m) + kRounding_m;
        if (glm::dot(away_m, away_m) < near_m * near_m) {
          const Drop& drop = slots_.items[static_cast<size_t>(slot)];
          if (met(slot, drop, (drop.place_m - place_m) * metres)) return slot;
        }
        slot = near.next;
      }
    }
  }
  return -1;
}

// The first of those a drop touches; -1: none.
int Drops::touching(const DropWorld& world, int slot) const {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  return firstAbout(world, drop.place_m, nears_[static_cast<size_t>(slot)].half_m, static_cast<float>(kTouch),
                    [&](int other, const Drop& that, glm::dvec2 d) {
                      if (other == slot) return false;
                      const double near_m = kTouch * (reachTowards_m(drop, d) + reachTowards_m(that, d));
                      return glm::dot(d, d) < near_m * near_m;
                    });
}

// The first drop that a place lies in; -1: none.
int Drops::covering(const DropWorld& world, glm::dvec2 place_m) const {
  return firstAbout(world, place_m, 0.0f, 1.0f, [](int, const Drop& drop, glm::dvec2 d) {
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
  if (longer > 1.05 && large.pose != Pose::moving) {
    const glm::dvec2 axis = distance_m > 0.0 ? between * metres / distance_m : glm::dvec2(large.heading);
    if (static_cast<double>(large.elongation) < longer) {
      large.heading = glm::vec2(axis);
      large.corner = 0.0f;
    }
    large.elongation =
        static_cast<float>(std::min(1.8, std::max(longer, 0.8 * static_cast<double>(large.elongation))));
  }
  large.velocity_mps += (small.velocity_mps - large.velocity_mps) * static_cast<float>(share);
  if (small.pose == Pose::moving) become(a, Pose::moving);
  const int64_t gained_pl = passed(LeakyKernel::merge, small.volume_pl);
  const glm::dvec2 place = large.place_m + share * between;
  remove(b);
  if (world.map.texelAt(place) >= 0) {
    moveTo(a, place);
    large.texel = world.map.texelAt(place);
  }
  large.volume_pl += gained_pl;
  large.base_radius_m = static_cast<float>(std::sqrt(r * r + q * q * apart));
  noteWidth(a);
  settle(a);
  return a;
}

}  // namespace rg::glass
