// Which slots of a list are of one kind: a bit for each, so that those few that are need no look at the
// others.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rg::glass {

class SlotSet {
 public:
  static constexpr int kInWord = 64;

  void put(int slot, bool in) {
    const auto word = static_cast<size_t>(slot) / kInWord;
    if (word >= words_.size()) words_.resize(word + 1, 0);
    const uint64_t bit = uint64_t{1} << (static_cast<size_t>(slot) % kInWord);
    words_[word] = in ? words_[word] | bit : words_[word] & ~bit;
  }
  void clear() { words_.clear(); }
  size_t words() const { return words_.size(); }  // none beyond has any
  uint64_t word(size_t i) const { return i < words_.size() ? words_[i] : 0; }

 private:
  std::vector<uint64_t> words_;
};

// Of each slot of a word, in ascending order.
template <class Work>
void forEachSlot(size_t word, uint64_t bits, const Work& work) {
  for (; bits != 0; bits &= bits - 1)
    work(static_cast<int>(word) * SlotSet::kInWord + std::countr_zero(bits));
}

}  // namespace rg::glass
