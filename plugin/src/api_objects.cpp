#include "api_objects.h"

#include <cmath>
#include <vector>

#include "api_call.h"

namespace rg {
namespace {

constexpr uint32_t kMostPlacedDrops = 1000000, kMostVertices = 1000000;
constexpr size_t kLongestRow = size_t{1} << 20;  // bytes; a longer stride is a mistake
constexpr double kMostAirflowSamples = 256;      // along a side
constexpr double kAcross = 0.01;                 // cosine of a right angle, within half a degree

glm::dvec3 unitVector(const double v[3], const char* name) {
  const glm::dvec3 vector = finiteVector(v, name);
  if (std::abs(glm::length(vector) - 1.0) > 1e-3) refuse(std::string(name) + " is not of unit length");
  return glm::normalize(vector);
}

template <typename Vector>
std::vector<Vector> readFloats(const float* data, uint32_t count, size_t stride, const std::string& name) {
  const size_t step = stride == 0 ? sizeof(Vector) : stride;
  checkArray(data, count, step, sizeof(Vector), kMostVertices, name.c_str());
  std::vector<Vector> out(count);
  for (uint32_t i = 0; i < count; ++i) {
    std::memcpy(&out[i], element(data, step, i), sizeof(Vector));
    for (glm::length_t k = 0; k < Vector::length(); ++k) {
      if (!std::isfinite(out[i][k])) refuse(name + "[" + std::to_string(i) + "] is not a number");
    }
  }
  return out;
}

}  // namespace

rg_result setVolume(rg_instance* instance, uint32_t id, const rg_volume_info* in) {
  return guarded(instance, [&](Frame& frame) {
    checkId(id, "volume");
    const rg_volume_info info = readStruct(in, "rg_volume_info");
    rain::VolumeInfo volume;
    volume.vehicle = info.vehicle;
    volume.name = readName(info.name, "rg_volume_info.name");
    volume.active = info.active != 0;
    if ((info.vertices_m == nullptr) == (info.planes == nullptr))
      refuse("volume \"" + volume.name + "\": give vertices or planes, not both or none");
    std::vector<glm::dvec3> vertices;
    std::vector<rain::Plane> planes;
    if (info.vertices_m != nullptr) {
      checkArray(info.vertices_m, info.vertex_count, 3 * sizeof(double), 3 * sizeof(double),
                 rain::Convex::kMaxVertices, "rg_volume_info.vertices_m");
      for (uint32_t i = 0; i < info.vertex_count; ++i)
        vertices.emplace_back(info.vertices_m[3 * i], info.vertices_m[3 * i + 1], info.vertices_m[3 * i + 2]);
    } else {
      checkArray(info.planes, info.plane_count, 4 * sizeof(double), 4 * sizeof(double),
                 rain::Convex::kMaxPlanes, "rg_volume_info.planes");
      for (uint32_t i = 0; i < info.plane_count; ++i) {
        const double* p = info.planes + 4 * i;
        planes.push_back({{p[0], p[1], p[2]}, p[3]});
      }
    }
    volume.vertices = vertices;
    volume.planes = planes;
    frame.setVolume(id, volume);
  });
}

rg_result removeVolume(rg_instance* instance, uint32_t id) {
  return guarded(instance, [&](Frame& frame) { frame.removeVolume(id); });
}

rg_result removeVehicle(rg_instance* instance, uint32_t id) {
  return guarded(instance, [&](Frame& frame) {
    checkId(id, "vehicle");
    frame.removeVehicle(id);
  });
}

rg_result setPane(rg_instance* instance, uint32_t id, const rg_pane_info* in) {
  return guarded(instance, [&](Frame& frame) {
    checkId(id, "pane");
    const rg_pane_info info = readStruct(in, "rg_pane_info");
    checkId(info.vehicle, "rg_pane_info.vehicle");
    glass::PaneInfo pane;
    pane.name = readName(info.name, "rg_pane_info.name");
    if (pane.name.empty()) pane.name = std::to_string(id);
    const std::string of_pane = "pane '" + pane.name + "': rg_pane_info.";
    if (info.vertex_count == 0 || info.index_count == 0)
      refuse(of_pane + (info.vertex_count == 0 ? "vertex_count" : "index_count") + " is 0");
    const auto positions = readFloats<glm::vec3>(info.positions_m, info.vertex_count, info.position_stride,
                                                 of_pane + "positions_m");
    const auto uvs = readFloats<glm::vec2>(info.uvs, info.vertex_count, info.uv_stride, of_pane + "uvs");
    checkArray(info.indices, info.index_count, sizeof(uint32_t), sizeof(uint32_t),
               6 * uint64_t{kMostVertices}, (of_pane + "indices").c_str());
    if (info.index_count % 3 != 0) refuse(of_pane + "index_count is no multiple of 3");
    if (info.glass < RG_GLASS_UNCOATED || info.glass > RG_GLASS_NEW_COATING)
      refuse("rg_pane_info.glass is no rg_glass");
    checkRange(info.advancing_deg, 0.0, 175.0, "rg_pane_info.advancing_deg");
    checkRange(info.receding_deg, 0.0, 175.0, "rg_pane_info.receding_deg");
    checkRange(info.texel_m, 0.5e-3, 20e-3, "rg_pane_info.texel_m");
    checkRange(info.max_drops, 0.0, 1e6, "rg_pane_info.max_drops");
    checkRange(info.opening_m, 0.0, kWidestOpening_m, "rg_pane_info.opening_m");
    checkRange(info.demister, 0.0, 1.0, "rg_pane_info.demister");
    pane.opening_m = info.opening_m;
    checkRange(info.mirror, 0.0, 1.0, "rg_pane_info.mirror");
    pane.demister = info.demister;
    pane.mirror = info.mirror;
    if (finiteVector(info.slide_direction, "rg_pane_info.slide_direction") != glm::dvec3(0.0))
      pane.slide_direction = unitVector(info.slide_direction, "rg_pane_info.slide_direction");
    if (finiteVector(info.sill, "rg_pane_info.sill") != glm::dvec3(0.0)) {
      checkRange(info.sill[3], -100.0, 100.0, "rg_pane_info.sill");
      pane.sill = glm::dvec4(unitVector(info.sill, "rg_pane_info.sill"), info.sill[3]);
    } else if (info.sill[3] != 0.0) {
      refuse("rg_pane_info.sill: its normal is 0, its distance is not");
    }
    pane.positions_m = positions;
    pane.uvs = uvs;
    pane.indices = {info.indices, info.index_count};
    pane.glass = static_cast<glass::Glass>(info.glass);
    pane.advancing_rad = glm::radians(info.advancing_deg);
    pane.receding_rad = glm::radians(info.receding_deg);
    pane.texel_m = info.texel_m;
    pane.max_drops = info.max_drops;
    pane.film_enabled = info.film_enabled != 0;
    frame.setPane(id, info.vehicle, info.active != 0, pane);
  });
}

rg_result removePane(rg_instance* instance, uint32_t id) {
  return guarded(instance, [&](Frame& frame) { frame.removePane(id); });
}

rg_result setWiper(rg_instance* instance, uint32_t id, const rg_wiper_info* in) {
  return guarded(instance, [&](Frame& frame) {
    checkId(id, "wiper");
    const rg_wiper_info info = readStruct(in, "rg_wiper_info");
    glass::WiperInfo wiper;
    wiper.pivot_m = finiteVector(info.pivot_m, "rg_wiper_info.pivot_m");
    wiper.axis = unitVector(info.axis, "rg_wiper_info.axis");
    wiper.rest_direction = unitVector(info.rest_direction, "rg_wiper_info.rest_direction");
    if (std::abs(glm::dot(wiper.axis, wiper.rest_direction)) > kAcross)
      refuse("rg_wiper_info.rest_direction is not across axis");
    checkRange(info.arm_m, 0.01, 5.0, "rg_wiper_info.arm_m");
    checkRange(info.blade_m, 0.01, 5.0, "rg_wiper_info.blade_m");
    checkRange(info.blade_angle_rad, -3.2, 3.2, "rg_wiper_info.blade_angle_rad");
    checkRange(info.residual_film_m, 0.0, 1e-4, "rg_wiper_info.residual_film_m");
    checkRange(info.blade_turn, -2.0, 2.0, "rg_wiper_info.blade_turn");
    checkRange(info.wear, 0.0, 1.0, "rg_wiper_info.wear");
    checkRange(info.lift_m, 1e-5, 1.0, "rg_wiper_info.lift_m");
    wiper.blade_turn = info.blade_turn;
    wiper.wear = info.wear;
    wiper.lift_m = info.lift_m;
    wiper.arm_m = info.arm_m;
    wiper.blade_m = info.blade_m;
    wiper.blade_angle_rad = info.blade_angle_rad;
    wiper.residual_film_m = info.residual_film_m;
    frame.setWiper(id, info.pane, wiper);
  });
}

rg_result removeWiper(rg_instance* instance, uint32_t id) {
  return guarded(instance, [&](Frame& frame) { frame.removeWiper(id); });
}

rg_result placeDrops(rg_instance* instance, uint32_t pane, const rg_glass_drop* in, uint32_t count) {
  return guarded(instance, [&](Frame& frame) {
    checkArray(in, count, sizeof(rg_glass_drop), sizeof(rg_glass_drop), kMostPlacedDrops, "drops");
    std::vector<glass::PlacedDrop> drops;
    for (uint32_t i = 0; i < count; ++i) {
      checkRange(in[i].u_m, -100.0, 100.0, "rg_glass_drop.u_m");
      checkRange(in[i].v_m, -100.0, 100.0, "rg_glass_drop.v_m");
      checkRange(in[i].base_radius_m, 1e-5, 0.02, "rg_glass_drop.base_radius_m");
      checkRange(in[i].contact_angle_deg, 1.0, 170.0, "rg_glass_drop.contact_angle_deg");
      drops.push_back({in[i].u_m, in[i].v_m, in[i].base_radius_m, glm::radians(in[i].contact_angle_deg)});
    }
    frame.placeDrops(pane, drops);
  });
}

rg_result wash(rg_instance* instance, const rg_wash_info* in) {
  return guarded(instance, [&](Frame& frame) {
    const rg_wash_info info = readStruct(in, "rg_wash_info");
    checkTime(info.time_ns, "rg_wash_info.time_ns");
    checkRange(info.duration_s, 0.01, 60.0, "rg_wash_info.duration_s");
    checkRange(info.volume_m3, 0.0, 1e-3, "rg_wash_info.volume_m3");
    checkRange(info.fan_rad, 0.01, 3.0, "rg_wash_info.fan_rad");
    WashOrder order;
    order.pane = info.pane;
    order.jet.nozzle_m = finiteVector(info.nozzle_m, "rg_wash_info.nozzle_m");
    order.jet.direction = unitVector(info.direction, "rg_wash_info.direction");
    order.jet.fan_rad = info.fan_rad;
    order.time_ns = info.time_ns;
    order.duration_s = info.duration_s;
    order.volume_m3 = info.volume_m3;
    frame.wash(order);
  });
}

rg_result setAirflow(rg_instance* instance, uint32_t pane, const rg_airflow* in) {
  return guarded(instance, [&](Frame& frame) {
    glass::Airflow airflow;
    if (in != nullptr) {
      const rg_airflow info = readStruct(in, "rg_airflow");
      checkRange(info.stagnation, 0.0, 1.0, "rg_airflow.stagnation");
      checkRange(info.outward, 0.0, 2.0, "rg_airflow.outward");
      checkRange(info.lee, 0.0, 1.0, "rg_airflow.lee");
      checkRange(info.drag_friction, 0.0, 0.1, "rg_airflow.drag_friction");
      checkRange(info.columns, 0.0, kMostAirflowSamples, "rg_airflow.columns");
      checkRange(info.rows, 0.0, kMostAirflowSamples, "rg_airflow.rows");
      if ((info.columns == 0) != (info.rows == 0))
        refuse("rg_airflow: of columns and rows one is 0, the other not");
      airflow.shape = {info.stagnation, info.outward, info.lee, info.drag_friction};
      const size_t count = size_t{info.columns} * info.rows;
      checkArray(info.ahead, count, 3 * sizeof(float), 3 * sizeof(float), count, "rg_airflow.ahead");
      airflow.ahead = {static_cast<int>(info.columns), static_cast<int>(info.rows), {}};
      for (size_t i = 0; i < 3 * count; ++i)
        checkRange(static_cast<double>(info.ahead[i]), -5.0, 5.0, "rg_airflow.ahead");
      for (size_t i = 0; i < count; ++i)
        airflow.ahead.share.emplace_back(info.ahead[3 * i], info.ahead[3 * i + 1], info.ahead[3 * i + 2]);
    }
    frame.setAirflow(pane, std::move(airflow));
  });
}

rg_result setRainPattern(rg_instance* instance, const rg_rain_pattern* in) {
  return guarded(instance, [&](Frame& frame) {
    rain::RainPattern pattern;
    if (in != nullptr) {
      const rg_rain_pattern info = readStruct(in, "rg_rain_pattern");
      checkRange(info.width_px, rain::RainPattern::kSmallest_px, rain::RainPattern::kLargest_px,
                 "rg_rain_pattern.width_px");
      checkRange(info.height_px, rain::RainPattern::kSmallest_px, rain::RainPattern::kLargest_px,
                 "rg_rain_pattern.height_px");
      if (info.rgba == nullptr) refuse("rg_rain_pattern.rgba is null");
      const size_t row = size_t{4} * info.width_px;
      const size_t stride = info.row_stride_bytes == 0 ? row : info.row_stride_bytes;
      if (stride < row || stride > kLongestRow)
        refuse("rg_rain_pattern.row_stride_bytes is " + std::to_string(stride) + ", must be 0 or " +
               std::to_string(row) + " .. " + std::to_string(kLongestRow));
      std::vector<uint8_t> rgba(row * info.height_px);
      for (size_t y = 0; y < info.height_px; ++y) std::memcpy(&rgba[y * row], info.rgba + y * stride, row);
      if (auto wrong = rain::makePattern(info.width_px, info.height_px, std::move(rgba), pattern);
          !wrong.empty())
        refuse(wrong);
    }
    frame.setRainPattern(std::move(pattern));
  });
}

}  // namespace rg
