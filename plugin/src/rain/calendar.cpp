#include "rain/calendar.h"

namespace rg::rain {

// Room for as many wrong entries as right ones, and a page begun on each day. Clearing up leaves the right
// ones: so at least as many as there are drops come between one and the next.
Calendar::Calendar(uint32_t capacity) : pages_(2 * (capacity / Page::kMost) + kDays + 2) { start(0); }

void Calendar::start(uint32_t now) {
  turned_to_ = now;
  days_.fill(kNone);
  free_ = kNone;
  for (uint32_t page = static_cast<uint32_t>(pages_.size()); page-- > 0;) {
    pages_[page].next = free_;
    free_ = page;
  }
}

}  // namespace rg::rain
