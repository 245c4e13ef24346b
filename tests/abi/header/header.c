/* The public header alone, as a C11 host includes it: it must need nothing before it and be includable twice.
 */
#include "rainglass/rainglass.h"

/* The fixed structs never grow. */
_Static_assert(sizeof(rg_pose) == 104, "rg_pose is fixed");
_Static_assert(sizeof(rg_wiper_knot) == 24, "rg_wiper_knot is fixed");
_Static_assert(sizeof(rg_lamp) == 56, "rg_lamp is fixed");
_Static_assert(sizeof(rg_glass_drop) == 32, "rg_glass_drop is fixed");

const rg_api* (*const rg_header_entry)(uint32_t) = rg_get_entry;
