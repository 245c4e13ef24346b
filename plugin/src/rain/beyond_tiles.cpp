#include "rain/beyond_tiles.h"

#include <algorithm>
#include <cmath>

namespace rg::rain {
namespace {

using glm::vec3;
using shared::kRainNoPlane, shared::RainTile;

constexpr uint32_t kNoPlanes = kRainNoPlane | kRainNoPlane << 6 | kRainNoPlane << 12 | kRainNoPlane << 18;
// Where a tile's corners do not agree: of its sides, the middles that are asked too, and its own.
constexpr std::array<glm::vec2, 5> kMiddles{
    {{0.5f, 0.5f}, {0.5f, 0.0f}, {0.0f, 0.5f}, {1.0f, 0.5f}, {0.5f, 1.0f}}};

// Planes by how often they bind; few do in one tile.
class Votes {
 public:
  void add(uint32_t plane) {
    if (plane == kRainNoPlane) return;
    const auto known = std::find(planes_.begin(), planes_.begin() + size_, plane);
    const auto at = static_cast<size_t>(known - planes_.begin());
    if (known == planes_.begin() + size_) {
      if (size_ == static_cast<std::ptrdiff_t>(planes_.size())) return;
      planes_[at] = plane;
      ++size_;
    }
    ++counts_[at];
  }
  // The one with the most votes, which are taken from it; of equals the first plane.
  uint32_t next() {
    size_t most = 0;
    for (size_t i = 1; i < static_cast<size_t>(size_); ++i) {
      const bool more =
          counts_[i] > counts_[most] || (counts_[i] == counts_[most] && planes_[i] < planes_[most]);
      most = more ? i : most;
    }
    if (counts_[most] == 0) return kRainNoPlane;
    counts_[most] = 0;
    return planes_[most];
  }

 private:
  // As many as are asked: by a tile's corners and middles.
  std::array<uint32_t, 4 + kMiddles.size()> planes_{};
  std::array<int, 4 + kMiddles.size()> counts_{};
  std::ptrdiff_t size_ = 0;
};

void put(uint32_t& word, int shift, uint32_t plane) {
  word &= ~(63u << shift);
  word |= plane << shift;
}

glm::uvec2 packed(uint32_t volume, uint32_t far, uint32_t near) {
  glm::uvec2 words(kNoPlanes | 1u << 31 | volume << 24, kNoPlanes);
  put(words.x, 0, far);
  put(words.y, 6, near);
  return words;
}

glm::uvec2 packed(uint32_t volume, Votes far, Votes near) {
  glm::uvec2 words = packed(volume, far.next(), near.next());
  for (const int shift : {6, 12, 18}) put(words.x, shift, far.next());
  put(words.y, 0, far.next());
  for (const int shift : {12, 18}) put(words.y, shift, near.next());
  return words;
}

}  // namespace

float Tiler::tileSide_px(const glm::ivec4& viewport_px) {
  constexpr int kSide_px = 32, kMost = 60;  // along a side of the picture: 1920 px
  return static_cast<float>(std::max(kSide_px, (std::max(viewport_px.z, viewport_px.w) + kMost - 1) / kMost));
}

void Tiler::findSlopes(const shared::RainBeyond& beyond, std::span<const glm::vec4> planes) {
  slopes_.clear();
  for (const glm::vec4& plane : planes) {
    const float middle = shared::rainPlaneBound(plane, vec3(beyond.ray_middle)),
                by_x = shared::rainPlaneBound(plane, vec3(beyond.ray_right)),
                by_y = shared::rainPlaneBound(plane, vec3(beyond.ray_up));
    slopes_.push_back({middle - by_x - by_y, by_x, by_y, plane.w < 0.0f});
  }
}

Tiler::Bound Tiler::boundAt(glm::vec2 from_corner) const {
  Bound bound;
  for (uint32_t i = 0; i < slopes_.size(); ++i) {
    const Slope& slope = slopes_[i];
    const float at = slope.at_corner + slope.by_x * from_corner.x + slope.by_y * from_corner.y;
    if (slope.near) {
      if (at < bound.enter) bound = {bound.leave, at, bound.far, i};
    } else if (at > bound.leave) {
      bound = {at, bound.enter, i, bound.near};
    }
  }
  return bound;
}

// Of all planes, where a tile can know them.
std::optional<glm::uvec2> Tiler::wordsOfAll(uint32_t volume) const {
  const auto nears = static_cast<size_t>(std::ranges::count(slopes_, true, &Slope::near));
  if (nears > shared::kRainTileNear || slopes_.size() - nears > shared::kRainTileFar) return {};
  Votes far, near;
  for (uint32_t i = 0; i < slopes_.size(); ++i) (slopes_[i].near ? near : far).add(i);
  return packed(volume, far, near);
}

glm::uvec2 Tiler::wordsOf(uint32_t volume, int column, int row,
                          const std::array<const Bound*, 4>& corners) const {
  Votes far, near;
  const auto vote = [&](const Bound& bound) {
    far.add(bound.far);
    near.add(bound.near);
  };
  for (const Bound* corner : corners) vote(*corner);
  for (const glm::vec2& in_tile : kMiddles) vote(boundAt((glm::vec2(column, row) + in_tile) * step_clip_));
  return packed(volume, far, near);
}

// Where a ray meets the volume it enters it before it leaves it: each plane near by, farther off than each
// plane far off, and before the eye. Both are linear across the picture, so each pair leaves a half of it:
// positive.
bool Tiler::findHalves() {
  halves_.clear();
  const glm::vec2 size = glm::vec2(columns_, rows_) * step_clip_;
  bool seen = true;
  const auto leave = [&](float at_corner, float by_x, float by_y) {
    halves_.push_back({at_corner, by_y, -1.0f / by_x});
    seen = seen && at_corner + std::max(by_x, 0.0f) * size.x + std::max(by_y, 0.0f) * size.y > 0.0f;
  };
  for (const Slope& near : slopes_) {
    if (!near.near) continue;
    leave(near.at_corner, near.by_x, near.by_y);
    for (const Slope& far : slopes_) {
      if (!far.near) leave(near.at_corner - far.at_corner, near.by_x - far.by_x, near.by_y - far.by_y);
    }
  }
  return seen;
}

// All halves leave a row of tiles an interval; a sliver too much, as a rounded edge must not lose a tile.
Tiler::Reach Tiler::reachOf(int row) const {
  const float low = static_cast<float>(row) * step_clip_.y, high = low + step_clip_.y;
  float from = 0.0f, to = static_cast<float>(columns_) * step_clip_.x;
  for (const Half& half : halves_) {
    const float most = half.at_corner + half.by_y * (half.by_y > 0.0f ? high : low);
    if (!std::isfinite(half.to_edge)) {
      if (!(most > 0.0f)) return {};
    } else if (half.to_edge < 0.0f) {
      from = std::max(from, most * half.to_edge);
    } else {
      to = std::min(to, most * half.to_edge);
    }
  }
  constexpr float kSliver = 0.05f;  // of a tile
  const float first = std::floor(from / step_clip_.x - kSliver), end = std::ceil(to / step_clip_.x + kSliver);
  const auto columns = static_cast<float>(columns_);
  return {static_cast<int>(std::clamp(first, 0.0f, columns)),
          static_cast<int>(std::clamp(end, 0.0f, columns))};
}

void Tiler::findBounds() {
  reach_.clear();
  for (int row = 0; row < rows_; ++row) reach_.push_back(reachOf(row));
  bounds_.resize(static_cast<size_t>((rows_ + 1) * (columns_ + 1)));
  for (int row = 0; row <= rows_; ++row) {
    Reach corners{columns_, 0};
    for (const int beside : {row - 1, row}) {
      if (beside < 0 || beside >= rows_) continue;
      const Reach& tiles = reach_[static_cast<size_t>(beside)];
      if (tiles.first >= tiles.end) continue;
      corners = {std::min(corners.first, tiles.first), std::max(corners.end, tiles.end + 1)};
    }
    for (int column = corners.first; column < corners.end; ++column)
      bounds_[static_cast<size_t>(row * (columns_ + 1) + column)] =
          boundAt(glm::vec2(column, row) * step_clip_);
  }
}

void Tiler::addTo(std::vector<RainTile>& tiles, uint32_t volume) {
  if (!findHalves()) return;
  findBounds();
  const std::optional<glm::uvec2> all = wordsOfAll(volume);
  for (int row = 0; row < rows_; ++row) {
    const Reach& reach = reach_[static_cast<size_t>(row)];
    for (int column = reach.first; column < reach.end; ++column) {
      const Bound* below = &bounds_[static_cast<size_t>(row * (columns_ + 1) + column)];
      const Bound* above = below + columns_ + 1;
      const std::array<const Bound*, 4> corners{below, below + 1, above, above + 1};
      const Bound& one = *corners[0];
      // Where a plane binds is convex: what binds at all corners does so all over the tile.
      const bool agreed = std::ranges::all_of(
          corners, [&](const Bound* b) { return b->near == one.near && b->far == one.far; });
      const bool missed =
          agreed && std::ranges::all_of(corners, [](const Bound* b) { return b->enter <= b->leave; });
      const bool behind_eye = std::ranges::all_of(
          corners, [&](const Bound* b) { return b->enter <= 0.0f && b->near == one.near; });
      if (missed || behind_eye) continue;
      const auto tile = static_cast<size_t>(row * columns_ + column);
      const uint32_t slot = counts_[tile];
      if (slot == shared::kRainTileVolumes) continue;
      ++counts_[tile];
      const glm::uvec2 words = agreed ? packed(volume, one.far, one.near)
                               : all  ? *all
                                      : wordsOf(volume, column, row, corners);
      glm::uvec4& both = tiles[tile].bounds[slot / 2];
      if (slot % 2 == 0) {
        both.x = words.x;
        both.y = words.y;
      } else {
        both.z = words.x;
        both.w = words.y;
      }
    }
  }
}

void Tiler::cut(const glm::ivec4& viewport_px, const shared::RainBeyond& beyond,
                const shared::RainShelter& shelter, Tiles& out) {
  const auto tile_px = static_cast<int>(beyond.scroll.w);
  columns_ = (viewport_px.z + tile_px - 1) / tile_px;
  rows_ = (viewport_px.w + tile_px - 1) / tile_px;
  step_clip_ = 2.0f * static_cast<float>(tile_px) / glm::vec2(viewport_px.z, viewport_px.w);
  const auto size = static_cast<size_t>(columns_ * rows_);
  counts_.assign(size, 0);
  all_.assign(size, RainTile{});
  for (size_t i = 0; i < size; ++i) {
    all_[i].place = static_cast<uint32_t>(i) % static_cast<uint32_t>(columns_) |
                    static_cast<uint32_t>(i) / static_cast<uint32_t>(columns_) << 16;
  }
  for (uint32_t volume = 0; volume < shelter.volume_count; ++volume) {
    const shared::RainVolume& v = shelter.volumes[volume];
    // Planes are told apart by 6 bits, of which one value says "none".
    findSlopes(beyond, std::span(shelter.planes + v.first, std::min(v.count, kRainNoPlane)));
    addTo(all_, volume);
  }
  const float pixel_slope = 2.0f * glm::length(vec3(beyond.ray_up)) / static_cast<float>(viewport_px.w);
  sort(beyond, pixel_slope, out);
}

// In the tile's middle, in half levels. Near the axis the map shrinks to nothing.
int Tiler::pixelLevel(const shared::RainBeyond& beyond, size_t tile, float pixel_slope) const {
  const auto columns = static_cast<size_t>(columns_);
  const glm::vec2 clip = (glm::vec2(tile % columns, tile / columns) + 0.5f) * step_clip_ - 1.0f;
  const vec3 ray = vec3(beyond.ray_middle) + clip.x * vec3(beyond.ray_right) + clip.y * vec3(beyond.ray_up);
  const float off_axis = glm::length(glm::cross(ray, vec3(beyond.axis)));  // times the ray's length
  return static_cast<int>(
      std::lround(2.0f * std::log2(pixel_slope / std::max(off_axis, 0.02f * glm::length(ray)))));
}

// By kind and level, counted: there are few of both.
void Tiler::sort(const shared::RainBeyond& beyond, float pixel_slope, Tiles& out) {
  constexpr int kLevels = 64, kLeast = -48;  // of half levels: a pixel of 6e-8 to 180 radians
  std::array<uint32_t, kTileKinds.size() * kLevels + 1> starts{};
  keys_.clear();
  for (size_t i = 0; i < all_.size(); ++i) {
    const auto kind =
        static_cast<uint32_t>(std::ranges::lower_bound(kTileKinds, counts_[i]) - kTileKinds.begin());
    const int level = std::clamp(pixelLevel(beyond, i, pixel_slope) - kLeast, 0, kLevels - 1);
    keys_.push_back(kind * kLevels + static_cast<uint32_t>(level));
    ++starts[keys_.back() + 1];
  }
  out.runs.clear();
  for (size_t key = 0; key + 1 < starts.size(); ++key) {
    const uint32_t count = starts[key + 1];
    starts[key + 1] += starts[key];
    if (count == 0) continue;
    const int level = static_cast<int>(key % kLevels) + kLeast;
    out.runs.push_back({key / kLevels, 0.5f * static_cast<float>(level), starts[key], count});
  }
  out.tiles.resize(all_.size());
  for (size_t i = 0; i < all_.size(); ++i) out.tiles[starts[keys_[i]]++] = all_[i];
}

}  // namespace rg::rain
