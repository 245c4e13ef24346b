// A scene with all that a saved state has to hold: rain, hail and flakes in gusts, a wiped pane being washed,
// a window that slides open, fog; saved between ticks of any parity.
#pragma once

#include <memory>

#include "gl_fixture.h"
#include "small_scene.h"

namespace rg::test {

using Bytes = std::vector<unsigned char>;

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
    return setUprightPane(kWindow, "window", {0.3f, 0.3f + width_m}, 1.3f);
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

  // To its last moment, which may be in the middle of a film's step.
  void drive(int frames, bool odd) {
    for (int i = 1; i <= frames; ++i) {
      frame(odd && i == frames);
      expect(api.step_gpu(instance));
    }
  }

  void wash() const {
    rg_wash_info info = jet();
    info.time_ns = time_ns;
    expect(api.wash(instance, &info));
  }

  Bytes save() const {
    size_t size = 0;
    expect(api.save(instance, nullptr, &size));
    Bytes bytes(size);
    expect(api.save(instance, bytes.data(), &size));
    return bytes;
  }
  rg_result restore(const Bytes& bytes) const { return api.restore(instance, bytes.data(), bytes.size()); }

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

inline std::unique_ptr<SavedScene> savedScene(const rg_api& api, bool attached) {
  auto made = std::make_unique<SavedScene>(api);
  if (attached) made->expect(made->attach(GlContext::getProc));
  return made;
}

}  // namespace rg::test
