// The ABI's calls that add and remove the host's objects.
#pragma once

#include "rainglass/rainglass.h"

namespace rg {

rg_result setVolume(rg_instance* instance, uint32_t id, const rg_volume_info* in);
rg_result removeVolume(rg_instance* instance, uint32_t id);
rg_result removeVehicle(rg_instance* instance, uint32_t id);
rg_result setPane(rg_instance* instance, uint32_t id, const rg_pane_info* in);
rg_result removePane(rg_instance* instance, uint32_t id);
rg_result setWiper(rg_instance* instance, uint32_t id, const rg_wiper_info* in);
rg_result removeWiper(rg_instance* instance, uint32_t id);
rg_result placeDrops(rg_instance* instance, uint32_t pane, const rg_glass_drop* in, uint32_t count);
rg_result wash(rg_instance* instance, const rg_wash_info* in);
rg_result setAirflow(rg_instance* instance, uint32_t pane, const rg_airflow* in);
rg_result setRainPattern(rg_instance* instance, const rg_rain_pattern* in);

}  // namespace rg
