// Drops on the glass as a saved state. The lists of cells go by the order in which drops were hung into them.
#include <algorithm>

#include "glass/drops.h"

namespace rg::glass {
namespace {

constexpr int64_t kMostInDrop_pl =
    INT64_C(1'000'000'000'000);  // of a drop: 1 mL, a hundred times what stays whole

// A free slot has its count of lives alone.
void visitSlot(auto& a, auto& drop) {
  a.within(drop.volume_pl, 0, kMostInDrop_pl);
  a(drop.life);
  if (drop.volume_pl > 0) a(drop);
}

}  // namespace

// As link() is to be called again.
std::vector<int32_t> Drops::linkOrder() const {
  std::vector<int32_t> order;
  for (const Cell& cell : cells_) {
    const auto begin = static_cast<std::ptrdiff_t>(order.size());
    for (int32_t slot = cell.first; slot >= 0; slot = slots_.items[static_cast<size_t>(slot)].next)
      order.push_back(slot);
    std::reverse(order.begin() + begin, order.end());
  }
  return order;
}

void Drops::write(saved::Writer& a) const {
  a.list(slots_.items, slots_.capacity_, [&a](const Drop& drop) { visitSlot(a, drop); });
  const std::vector<int32_t> order = linkOrder();
  a.list(order, order.size());
  a.list(slots_.free, slots_.capacity_);
  a.list(changed_, changed_.size());
}

int64_t Drops::read(saved::Reader& a) {
  Slots slots;
  slots.capacity_ = slots_.capacity_;
  slots.items.reserve(slots.capacity_);
  slots.free.reserve(slots.capacity_);
  std::vector<int32_t> order, changed;
  a.list(slots.items, slots.capacity_, [&a](Drop& drop) { visitSlot(a, drop); });
  a.list(order, slots.capacity_);
  a.list(slots.free, slots.capacity_);
  a.list(changed, size_t{1} << 24);
  checkRead(a, slots, order, changed);
  int64_t sum_pl = 0;
  for (const Drop& drop : slots.items) sum_pl += drop.volume_pl;
  if (!a.commits()) return sum_pl;
  clear();
  slots_ = std::move(slots);
  changed_ = std::move(changed);
  live_ = static_cast<uint32_t>(order.size());
  for (const int32_t slot : order) link(slot);
  return sum_pl;
}

// Each slot is either hung in once or free once.
void Drops::checkRead(const saved::Reader& a, const Slots& slots, const std::vector<int32_t>& order,
                      const std::vector<int32_t>& changed) const {
  std::vector<bool> seen(slots.items.size(), false);
  const auto see = [&](int32_t slot, bool is_free) {
    const auto i = static_cast<size_t>(slot);
    a.require(slot >= 0 && i < slots.items.size(), "there is no such slot");
    a.require(!seen[i] && (slots.items[i].volume_pl == 0) == is_free, "a drop is hung in wrongly");
    seen[i] = true;
  };
  for (const int32_t slot : order) see(slot, false);
  for (const int32_t slot : slots.free) see(slot, true);
  a.require(order.size() + slots.free.size() == slots.items.size(), "a drop is not hung in");
  for (const int32_t slot : changed)
    a.require(slot >= 0 && static_cast<size_t>(slot) < slots.items.size(), "there is no such slot");
  for (const Drop& drop : slots.items) {
    const bool on_glass =
        drop.volume_pl == 0 || (drop.texel >= 0 && drop.texel < map_.texelCount() && map_.inside(drop.texel));
    a.require(on_glass, "a drop lies off the pane");
  }
}

}  // namespace rg::glass
