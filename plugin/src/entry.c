/* The one exported symbol. In C, so that nothing of the C++ behind it can leak into the interface. */
#include "rainglass/rainglass.h"

const rg_api* rgTable(uint32_t abi_version);

const rg_api* rg_get_entry(uint32_t abi_version) { return rgTable(abi_version); }
