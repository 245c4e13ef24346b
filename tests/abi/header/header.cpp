// The public header alone, as a C++11 (and later) host includes it.
#include "rainglass/rainglass.h"

static_assert(sizeof(rg_pose) == 104, "rg_pose is fixed");

extern const rg_api* (*const header_entry)(uint32_t);
const rg_api* (*const header_entry)(uint32_t) = rg_get_entry;
