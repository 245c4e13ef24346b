// Drops on the glass as a saved state. The lists of cells go by the order in which drops were hung into them.
#include <algorithm>

#include "glass/drops.h"
#include "glass/saved_limits.h"

namespace rg::glass {
namespace {

// Of a drop: 100 L (1e12 pl are 1 L). A host may place one of 6.4 L, and those that touch merge.
constexpr int64_t kMostInDrop_pl = INT64_C(100'000'000'000'000);

}  // namespace

// A free slot has its count of lives alone.
void Drops::Slot::visit(auto& a, auto& slot) {
  a.within(slot.drop.volume_pl, 0, kMostInDrop_pl);
  a(slot.drop.life);
  auto pose = static_cast<uint8_t>(slot.drop.pose);
  if (slot.drop.volume_pl == 0) return;
  a.within(pose, static_cast<uint8_t>(Pose::uneasy), static_cast<uint8_t>(Pose::moving));
  a(slot.drop);
  a.within(slot.half_m, 0.0, 100.0);
  if constexpr (std::remove_reference_t<decltype(a)>::kReads) slot.drop.pose = static_cast<Pose>(pose);
  if (static_cast<Pose>(pose) == Pose::braced) a(slot.hold);
}

// As link() is to be called again.
std::vector<int32_t> Drops::linkOrder() const {
  std::vector<int32_t> order;
  for (const Cell& cell : cells_) {
    const auto begin = static_cast<std::ptrdiff_t>(order.size());
    for (int32_t slot = cell.first; slot >= 0; slot = nears_[static_cast<size_t>(slot)].next)
      order.push_back(slot);
    std::reverse(order.begin() + begin, order.end());
  }
  return order;
}

void Drops::write(saved::Writer& a) const {
  std::vector<Slot> slots(slots_.items.size());
  for (size_t i = 0; i < slots.size(); ++i) slots[i] = {slots_.items[i], holds_[i], nears_[i].half_m};
  a.list(slots, slots_.capacity_);
  const std::vector<int32_t> order = linkOrder();
  a.list(order, order.size());
  a.list(slots_.free, slots_.capacity_);
  a.list(changed_, changed_.size());
}

int64_t Drops::read(saved::Reader& a) {
  std::vector<Slot> slots;
  std::vector<int32_t> order, free, changed;
  a.list(slots, slots_.capacity_);
  a.list(order, slots_.capacity_);
  a.list(free, slots_.capacity_);
  a.list(changed, size_t{1} << 24);
  checkRead(a, slots, order, free, changed);
  int64_t sum_pl = 0;
  for (const Slot& slot : slots) {
    sum_pl += slot.drop.volume_pl;
    a.require(sum_pl <= kMostSaved_pl, "there is too much on the glass");
  }
  if (!a.commits()) return sum_pl;
  clear();
  hangIn(slots, order);
  slots_.free.assign(free.begin(), free.end());
  changed_ = std::move(changed);
  return sum_pl;
}

void Drops::hangIn(const std::vector<Slot>& slots, const std::vector<int32_t>& order) {
  for (const Slot& slot : slots) {
    slots_.items.push_back(slot.drop);
    slots_.items.back().pose = Pose::gone;
    holds_.push_back(slot.hold);
    holds_.back().tile = ForceField::tileAt(map_, slot.drop.place_m);
    nears_.emplace_back();
  }
  for (const int32_t slot : order) link(slot);
  for (const int32_t slot : order) {
    const Slot& saved = slots[static_cast<size_t>(slot)];
    become(slot, saved.drop.pose);
    nears_[static_cast<size_t>(slot)].half_m = saved.half_m;
    tellWidth(slot, saved.half_m);
  }
  live_ = static_cast<uint32_t>(order.size());
}

// Each slot is either hung in once or free once.
void Drops::checkRead(const saved::Reader& a, const std::vector<Slot>& slots,
                      const std::vector<int32_t>& order, const std::vector<int32_t>& free,
                      const std::vector<int32_t>& changed) const {
  std::vector<bool> seen(slots.size(), false);
  const auto see = [&](int32_t slot, bool is_free) {
    const auto i = static_cast<size_t>(slot);
    a.require(slot >= 0 && i < slots.size(), "there is no such slot");
    a.require(!seen[i] && (slots[i].drop.volume_pl == 0) == is_free, "a drop is hung in wrongly");
    seen[i] = true;
  };
  for (const int32_t slot : order) see(slot, false);
  for (const int32_t slot : free) see(slot, true);
  a.require(order.size() + free.size() == slots.size(), "a drop is not hung in");
  for (const int32_t slot : changed)
    a.require(slot >= 0 && static_cast<size_t>(slot) < slots.size(), "there is no such slot");
  for (const Slot& slot : slots) {
    const bool on_glass =
        slot.drop.volume_pl == 0 ||
        (slot.drop.texel >= 0 && slot.drop.texel < map_.texelCount() && map_.inside(slot.drop.texel));
    a.require(on_glass, "a drop lies off the pane");
  }
}

}  // namespace rg::glass
