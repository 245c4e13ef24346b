#include "rain/cells.h"

#include <cstddef>

namespace rg::rain {
namespace {
constexpr std::size_t kFirstTable = 1u << 15;  // of 16 384 cells: two views' worth
}

Cells::Cells() {
  table_.assign(kFirstTable, Entry{});
  pool_.reserve(kFirstTable / 2);
  free_.reserve(kFirstTable / 2);
}

uint32_t Cells::hashOf(const CellKey& key) {
  // Two multiplications mix enough for a table that is at most half full.
  const uint64_t xy =
      (uint64_t{static_cast<uint32_t>(key.x)} << 32 | static_cast<uint32_t>(key.y)) * 0x9e3779b97f4a7c15u;
  const uint64_t zk = (uint64_t{static_cast<uint32_t>(key.z)} << 32 | key.kind) + (xy ^ xy >> 32);
  return static_cast<uint32_t>(zk * 0xd6e8feb86659fd93u >> 32);
}

uint32_t Cells::find(const CellKey& key, uint32_t hash) const {
  const uint32_t mask = static_cast<uint32_t>(table_.size()) - 1u;
  uint32_t place = hash & mask;
  while (table_[place].index != kNone &&
         !(table_[place].hash == hash && pool_[table_[place].index].key == key))
    place = (place + 1u) & mask;
  return place;
}

void Cells::grow() {
  table_.assign(table_.size() * 2, Entry{});
  for (uint32_t i = 0; i < poolSize(); ++i) {
    if (pool_[i].views == 0) continue;
    const uint32_t hash = hashOf(pool_[i].key);
    table_[find(pool_[i].key, hash)] = {hash, i};
  }
  pool_.reserve(table_.size() / 2);
  free_.reserve(table_.size() / 2);
}

uint32_t Cells::acquire(const CellKey& key, bool& fresh) {
  if ((std::size_t{live_} + 1) * 2 > table_.size()) grow();
  const uint32_t hash = hashOf(key);
  Entry& entry = table_[find(key, hash)];
  fresh = entry.index == kNone;
  if (fresh) {
    if (free_.empty()) {
      pool_.emplace_back();
      free_.push_back(poolSize() - 1);
    }
    entry = {hash, free_.back()};
    free_.pop_back();
    pool_[entry.index] = Cell{key, kNone, 0, false};
    ++live_;
  }
  ++pool_[entry.index].views;
  return entry.index;
}

uint32_t Cells::release(const CellKey& key) {
  const uint32_t place = find(key, hashOf(key));
  const uint32_t index = table_[place].index;
  if (index == kNone || --pool_[index].views > 0) return kNone;
  takeOut(place);
  --live_;
  return index;
}

uint32_t Cells::indexOf(const CellKey& key) const { return table_[find(key, hashOf(key))].index; }

// Later entries of the same run move up, so that no search ends early (Knuth, The Art of Computer
// Programming 3, 6.4 algorithm R).
void Cells::takeOut(uint32_t hole) {
  const uint32_t mask = static_cast<uint32_t>(table_.size()) - 1u;
  for (uint32_t next = (hole + 1u) & mask; table_[next].index != kNone; next = (next + 1u) & mask) {
    const uint32_t home = table_[next].hash & mask;
    if (((next - home) & mask) < ((next - hole) & mask)) continue;
    table_[hole] = table_[next];
    hole = next;
  }
  table_[hole] = {};
}

void Cells::free(uint32_t index) { free_.push_back(index); }

void Cells::clear() {
  table_.assign(table_.size(), Entry{});
  pool_.clear();
  free_.clear();
  live_ = 0;
}

}  // namespace rg::rain
