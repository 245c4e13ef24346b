// The cells that some view looks into, found by class and place.
#pragma once

#include <cstdint>
#include <vector>

namespace rg::rain {

inline constexpr uint32_t kNone = 0xffffffffu;

struct CellKey {
  int32_t x = 0, y = 0, z = 0;
  uint32_t kind = 0;  // speed class
  bool operator==(const CellKey&) const = default;
};

struct Cell {
  CellKey key;
  uint32_t first_drop = kNone;
  uint16_t views = 0;        // that look into it; 0: free
  bool near_volume = false;  // some drop of it was tested against a volume
};

// A pool of cells with a hash table on it. Indices stay valid while the cell lives. Grows when more cells are
// looked into than ever before.
class Cells {
 public:
  Cells();
  // Counts one more view for the cell and returns its index; `fresh` tells that it was not there.
  uint32_t acquire(const CellKey& key, bool& fresh);
  // Counts one view less and returns the index of the cell when that was the last (then free() it), else
  // kNone.
  uint32_t release(const CellKey& key);
  void free(uint32_t index);
  void clear();

  Cell& operator[](uint32_t index) { return pool_[index]; }
  const Cell& operator[](uint32_t index) const { return pool_[index]; }
  uint32_t poolSize() const { return static_cast<uint32_t>(pool_.size()); }  // walk all: cells with views > 0
  uint32_t live() const { return live_; }

 private:
  static uint32_t hashOf(const CellKey& key);
  uint32_t find(
      const CellKey& key) const;  // place in the table: of the key, or the empty one where it would be
  void grow();

  std::vector<Cell> pool_;
  std::vector<uint32_t> free_;
  std::vector<uint32_t> table_;  // index into the pool, or kNone; open addressing, at most half full
  uint32_t live_ = 0;
};

}  // namespace rg::rain
