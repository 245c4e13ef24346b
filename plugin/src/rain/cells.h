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
  static void visit(auto& a, auto& key) { a(key.x, key.y, key.z, key.kind); }
};

struct Cell {
  CellKey key;
  uint32_t bunch = kNone;    // of its drops, the first
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
  // Counts one view less. When that was the last, the cell's index is returned (else kNone): it is not found
  // any more, and stays as it is until it is freed.
  uint32_t release(const CellKey& key);
  void free(uint32_t index);
  void clear();
  uint32_t indexOf(const CellKey& key) const;  // kNone: nobody looks into it

  Cell& operator[](uint32_t index) { return pool_[index]; }
  const Cell& operator[](uint32_t index) const { return pool_[index]; }
  uint32_t poolSize() const { return static_cast<uint32_t>(pool_.size()); }  // walk all: cells with views > 0
  uint32_t live() const { return live_; }

 private:
  // With the hash beside the index a search hardly ever looks at a cell that is not the one.
  struct Entry {
    uint32_t hash = 0;
    uint32_t index = kNone;  // into the pool; kNone: empty
  };
  static uint32_t hashOf(const CellKey& key);
  // Place in the table: of the key, or the empty one where it would be.
  uint32_t find(const CellKey& key, uint32_t hash) const;
  void grow();
  void takeOut(uint32_t place);

  std::vector<Cell> pool_;
  std::vector<uint32_t> free_;
  std::vector<Entry> table_;  // open addressing, at most half full
  uint32_t live_ = 0;
};

}  // namespace rg::rain
