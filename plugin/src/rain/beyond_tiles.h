// The picture's tiles for the rain beyond: which volumes each looks into, and which of their planes bound
// them there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/rain_beyond.glsl"
#include "shared/rain_drop.glsl"

namespace rg::rain {

// Tiles that know at most so many volumes are drawn by one program: most know few.
inline constexpr std::array<uint32_t, 5> kTileKinds{1, 2, 3, 5, shared::kRainTileVolumes};

// Tiles drawn together: of one kind, and alike in how large a pixel is on the pattern's map.
struct TileRun {
  size_t kind = 0;
  float pixel_level = 0.0f;  // log2 of a pixel there, radians
  uint32_t first = 0, count = 0;
};

struct Tiles {
  std::vector<shared::RainTile> tiles;
  std::vector<TileRun> runs;  // all of them, in order
};

// Covers a viewport. `beyond` has the view's rays; `shelter` the volumes, nearest first. Where a tile sees
// more volumes than it can know, the farther ones are left out; of a volume that has more planes than a tile
// can know (five far off, three near by: no box has), those that bind it in most of the tile.
class Tiler {
 public:
  // 32 px, more in large pictures: what is linear across a tile is a matter of angle, not of pixels.
  static float tileSide_px(const glm::ivec4& viewport_px);
  void cut(const glm::ivec4& viewport_px, const shared::RainBeyond& beyond,
           const shared::RainShelter& shelter, Tiles& out);

 private:
  // In one direction: the plane that bounds a volume far off, and near by.
  struct Bound {
    float leave = 0.0f, enter = shared::kRainNoBound;
    uint32_t far = shared::kRainNoPlane, near = shared::kRainNoPlane;
  };
  // A volume's plane: linear across the picture, as 1 / depth.
  struct Slope {
    float at_corner, by_x, by_y;  // at clip (-1, -1), and from there on
    bool near;
  };
  // Tiles of a row, from `first` to before `end`.
  struct Reach {
    int first = 0, end = 0;
  };
  void findSlopes(const shared::RainBeyond& beyond, std::span<const glm::vec4> planes);
  // Half of the picture: where `at_corner` and what is added across it is above 0.
  struct Half {
    float at_corner, by_y;
    float to_edge;  // across, of what is there; not finite where nothing changes that way
  };
  bool findHalves();  // false: the volume is not in the picture
  Reach reachOf(int row) const;
  void findBounds();
  Bound boundAt(glm::vec2 from_corner) const;
  std::optional<glm::uvec2> wordsOfAll(uint32_t volume) const;
  glm::uvec2 wordsOf(uint32_t volume, int column, int row, const std::array<const Bound*, 4>& corners) const;
  void addTo(std::vector<shared::RainTile>& tiles, uint32_t volume);
  int pixelLevel(const shared::RainBeyond& beyond, size_t tile, float pixel_slope) const;
  void sort(const shared::RainBeyond& beyond, float pixel_slope, Tiles& out);

  int columns_ = 0, rows_ = 0;
  glm::vec2 step_clip_{0.0f};
  std::vector<Slope> slopes_;     // of one volume
  std::vector<Half> halves_;      // of it
  std::vector<Reach> reach_;      // of it, by row
  std::vector<Bound> bounds_;     // of it, at the corners of the tiles it reaches
  std::vector<uint32_t> counts_;  // of volumes, by tile
  std::vector<shared::RainTile> all_;
  std::vector<uint32_t> keys_;  // of kind and level, by tile
};

}  // namespace rg::rain
