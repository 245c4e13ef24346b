// Where a pane's water went, in whole picolitres: each term is counted where it happens, so that
// caught = on glass + drained + wiped + blown + evaporated holds to the last one.
#pragma once

#include <cstdint>

namespace rg::glass {

struct Ledger {
  int64_t caught_pl = 0;   // from the sky, jets, lists of drops and other panes
  int64_t run_on_pl = 0;   // of it: ran off other panes, see pillar.h
  int64_t drained_pl = 0;  // over the lower edge and the pillars
  int64_t wiped_pl = 0;    // thrown off by blades
  int64_t blown_pl = 0;    // over the upper edge
  int64_t evaporated_pl = 0;

  int64_t gone_pl() const { return drained_pl + wiped_pl + blown_pl + evaporated_pl; }
};

// A test build can let one kernel at a time lose 1 % of what passes through it, to prove that the ledger's
// test sees it. In other builds it is what it is given.
enum class LeakyKernel { none, impact, merge, evaporation, trail, collect, exchange };
#ifdef RG_TEST_LEAKS
inline LeakyKernel leaky_kernel = LeakyKernel::none;
inline int64_t passed(LeakyKernel kernel, int64_t volume_pl) {
  return leaky_kernel == kernel ? volume_pl - volume_pl / 100 : volume_pl;
}
#else
inline int64_t passed(LeakyKernel, int64_t volume_pl) { return volume_pl; }
#endif

}  // namespace rg::glass
