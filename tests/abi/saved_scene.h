// A scene with all that a saved state has to hold: rain, hail and flakes in gusts, a wiped pane being washed,
// a window that slides open, fog; saved between ticks of any parity.
#pragma once

#include "small_scene.h"

namespace rg::test {

inline constexpr uint32_t kWindow = 2;

class SavedScene : public SmallScene {
 public:
  explicit SavedScene(const rg_api& table) : SmallScene(table) {
    rain_mm_h = 60.0;
    snow_mm_h = 5.0;
    hail_mm_h = 40.0;
    temperature_c = 1.0;
    crosswind_mps = 4.0;
    expect(setWindow());
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"wind.gust_share", 0.3}, {"fog.cabin_humidity", 0.9}, {"rain.beyond", 0.05}})
      expect(api.set_parameter(instance, name, value));
  }

  // Beside a pillar of 10 cm.
  rg_result setWindow(float width_m = 0.4f) const {
    const float left = 0.3f + width_m;
    const std::array<float, 12> positions{1, left, 1, 1, 0.3f, 1, 1, 0.3f, 1.3f, 1, left, 1.3f};
    const std::array<float, 8> uvs{0, 0, 1, 0, 1, 1, 0, 1};
    const std::array<uint32_t, 6> indices{0, 2, 1, 0, 3, 2};
    rg_pane_info pane;
    api.default_pane_info(&pane);
    pane.name = "window";
    pane.vehicle = kCar;
    pane.positions_m = positions.data();
    pane.uvs = uvs.data();
    pane.indices = indices.data();
    pane.vertex_count = 4;
    pane.index_count = 6;
    pane.texel_m = 10e-3;
    return api.set_pane(instance, kWindow, &pane);
  }

  // A frame, after it the window is told where it stands. A tick more where `odd`: one of the film's step has
  // run then and the other has not.
  void frame(bool odd = false) {
    expect(step());
    const double opening_m = 0.1 + 0.1 * std::sin(0.1 * static_cast<double>(steps));
    const rg_opening_knot knot{time_ns + 1'000'000, kWindow, 0, opening_m};
    rg_sample sample;
    api.default_sample(&sample);
    sample.time_ns = time_ns + 1'000'000;
    sample.opening_knots = &knot;
    sample.opening_knot_count = 1;
    expect(api.update(instance, time_ns + (odd ? 10'000'000 : 1'000'000), &sample, 1, sizeof sample));
    if (steps == 2) wash();
  }

  void wash() const {
    rg_wash_info info;
    api.default_wash_info(&info);
    info.pane = kPane;
    info.time_ns = time_ns;
    info.duration_s = 0.5;
    info.volume_m3 = 5e-6;
    const std::array<double, 3> nozzle{1.3, 0.0, 1.0}, toward{-0.3, 0.0, 0.2};
    const double length = std::hypot(toward[0], toward[2]);
    for (size_t i = 0; i < 3; ++i) {
      info.nozzle_m[i] = nozzle[i];
      info.direction[i] = toward[i] / length;
    }
    expect(api.wash(instance, &info));
  }

  std::vector<unsigned char> save() const {
    size_t size = 0;
    expect(api.save(instance, nullptr, &size));
    std::vector<unsigned char> bytes(size);
    expect(api.save(instance, bytes.data(), &size));
    return bytes;
  }
  rg_result restore(const std::vector<unsigned char>& bytes) const {
    return api.restore(instance, bytes.data(), bytes.size());
  }

  uint64_t hash(rg_hash_kind kind = RG_HASH_STATE) const {
    uint64_t value = 0;
    expect(api.get_hash(instance, kind, &value));
    return value;
  }

  rg_pane_stats stats(uint32_t pane) const {
    rg_pane_stats s{};
    s.struct_size = sizeof s;
    expect(api.get_pane_stats(instance, pane, &s));
    return s;
  }
};

}  // namespace rg::test
