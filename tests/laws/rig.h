// Panes on carriers that can be tilted and driven, through the C ABI: what the laws of the water on the glass
// are tried on.
#pragma once

#include <array>
#include <cstring>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "abi/plugin_library.h"
#include "gl_context.h"
#include "windscreen.h"

namespace rg::test {

// Of physics.md.
inline constexpr double kGravity = 9.81, kRho = 1000.0, kMu = 1.0e-3, kGamma = 0.072, kRhoAir = 1.2;

// A pane raked by `slope_rad` from the horizontal when its carrier stands level. All else is the plugin's
// default.
struct Plate {
  double width_m = 0.3, height_m = 0.2, slope_rad = rad(30), bulge_m = 0.0;
  double texel_m = 3e-3;
  int32_t glass = RG_GLASS_UNCOATED;
  double advancing_deg = 0.0, receding_deg = 0.0;
  uint32_t max_drops = 20000;
  bool film = true;
  bool mirrored = false;  // left for right; its uvs go along, so that its grid is the same

  double area_m2() const { return width_m * height_m; }                               // where it is flat
  glm::dvec3 up() const { return {-std::cos(slope_rad), 0.0, std::sin(slope_rad)}; }  // on a level carrier
  glm::dvec3 outward() const { return {std::sin(slope_rad), 0.0, std::cos(slope_rad)}; }
};

inline const glm::dvec3 kMiddle_m{1.5, 0.0, 1.2};  // of windscreen()

// One pane on each carrier; both have the same id.
class Rig {
 public:
  explicit Rig(uint64_t seed) : api(*library_.api) {
    rg_create_info info;
    api.default_create_info(&info);
    info.seed = seed;
    if (api.create(&info, &instance) != RG_OK) throw std::runtime_error(api.last_error(nullptr));
    api.default_weather(&weather);
    weather.humidity = 1.0;  // nothing dries unless a test wants it
  }
  ~Rig() {
    if (attached_) api.detach_gl(instance);
    api.destroy(instance);
  }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  void attach() {
    rg_gl_info info;
    api.default_gl_info(&info);
    info.get_proc = GlContext::getProc;
    expect(api.attach_gl(instance, &info));
    attached_ = true;
  }

  void set(uint32_t id, const Plate& plate) {
    Mesh mesh = windscreen(plate.width_m, plate.height_m, plate.slope_rad, plate.bulge_m,
                           plate.bulge_m > 0.0 ? 12 : 1);
    if (plate.mirrored) {
      for (glm::vec3& p : mesh.positions) p.y = -p.y;
      for (size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
    rg_pane_info pane;
    api.default_pane_info(&pane);
    pane.vehicle = id;
    pane.positions_m = &mesh.positions[0].x;
    pane.uvs = &mesh.uvs[0].x;
    pane.indices = mesh.indices.data();
    pane.vertex_count = static_cast<uint32_t>(mesh.positions.size());
    pane.index_count = static_cast<uint32_t>(mesh.indices.size());
    pane.glass = plate.glass;
    pane.advancing_deg = plate.advancing_deg;
    pane.receding_deg = plate.receding_deg;
    pane.texel_m = plate.texel_m;
    pane.max_drops = plate.max_drops;
    pane.film_enabled = plate.film ? 1 : 0;
    expect(api.set_pane(instance, id, &pane));
    carriers_[id].plate = plate;
  }

  void remove(uint32_t id) {
    expect(api.remove_vehicle(instance, id));
    carriers_.erase(id);
  }

  void place(uint32_t id, const std::vector<rg_glass_drop>& drops) const {
    expect(api.place_drops(instance, id, drops.data(), static_cast<uint32_t>(drops.size())));
  }

  // Pitches a carrier at once, its panes' upper edges up by `pitch_rad`, and sets it off; nothing on it feels
  // a jerk.
  void put(uint32_t id, double pitch_rad, const glm::dvec3& velocity_mps = glm::dvec3(0.0)) {
    Carrier& carrier = carriers_.at(id);
    carrier.pitch_rad = pitch_rad;
    carrier.velocity_mps = velocity_mps;
    carrier.jumps = true;
  }
  // With a jerk: water feels it.
  void accelerate(uint32_t id, const glm::dvec3& acceleration_mps2) {
    carriers_.at(id).acceleration_mps2 = acceleration_mps2;
  }
  void level(uint32_t id) { put(id, -carriers_.at(id).plate.slope_rad); }

  // Water from far above the pane, along its normal, evenly over all of it: `volume_m3` within `seconds`,
  // from now on.
  void sprinkle(uint32_t id, double volume_m3, double seconds, int jets = 8) const {
    constexpr double kAway_m = 20.0;
    const Plate& plate = carriers_.at(id).plate;
    rg_wash_info wash;
    api.default_wash_info(&wash);
    wash.pane = id;
    wash.time_ns = time_ns();
    wash.duration_s = seconds;
    wash.fan_rad = 2.2 * std::atan(0.5 * std::hypot(plate.width_m, plate.height_m) / kAway_m);
    const double cone_sr = 2.0 * kPi * (1.0 - std::cos(0.5 * wash.fan_rad));
    wash.volume_m3 = volume_m3 / jets * cone_sr * kAway_m * kAway_m / plate.area_m2();  // much of it misses
    const glm::dvec3 nozzle = kMiddle_m + kAway_m * plate.outward(), direction = -plate.outward();
    for (int i = 0; i < 3; ++i) {
      wash.nozzle_m[i] = nozzle[i];
      wash.direction[i] = direction[i];
    }
    for (int k = 0; k < jets; ++k) expect(api.wash(instance, &wash));
  }

  // Lays films of these mean thicknesses on level panes and waits until they are even.
  void lay(const std::vector<std::pair<uint32_t, double>>& thickness_m, double sprinkled_s,
           double levelled_s) {
    run(0.0);
    for (const auto& [id, h] : thickness_m) {
      level(id);
      sprinkle(id, h * carriers_.at(id).plate.area_m2(), sprinkled_s);
    }
    run(sprinkled_s + levelled_s);
  }

  // Goes on by this time, in updates of `ticks` ticks of 1/120 s, each with its sample. The clock starts with
  // an even number of ticks, so that the film, which goes two ticks at a time, is never behind after an even
  // number.
  void run(double seconds, int64_t ticks = 2) {
    if (tick_ < 0) {
      update(1);
      update(1);
    }
    const int64_t until = tick_ + std::llround(seconds * 120.0);
    while (tick_ < until) update(std::min(ticks, until - tick_));
  }

  void update(int64_t ticks, bool step = true) {
    const rg_sample sample = nextSample(ticks);
    result = api.update(instance, sample.time_ns, &sample, 1, sizeof sample);
    expect(result);
    if (attached_ && step) expect(api.step_gpu(instance));
  }

  // One update with `count` samples, `ticks` apart.
  void updates(int64_t ticks, size_t count) {
    std::vector<rg_sample> samples(count);
    std::vector<std::vector<rg_vehicle>> vehicles(count);
    std::vector<std::vector<rg_wiper_knot>> knots(count);
    for (size_t i = 0; i < count; ++i) {
      samples[i] = nextSample(ticks);
      vehicles[i] = vehicles_;
      knots[i] = knots_;
      samples[i].vehicles = vehicles[i].data();
      samples[i].wiper_knots = knots[i].data();
    }
    result = api.update(instance, time_ns(), samples.data(), static_cast<uint32_t>(count), sizeof(rg_sample));
    expect(result);
    if (attached_) expect(api.step_gpu(instance));
  }

  rg_pane_stats stats(uint32_t id) const {
    rg_pane_stats out{};
    out.struct_size = sizeof out;
    expect(api.get_pane_stats(instance, id, &out));
    return out;
  }
  uint64_t hash() const {
    uint64_t out = 0;
    expect(api.get_hash(instance, RG_HASH_STATE, &out));
    return out;
  }
  void reset() {
    expect(api.reset(instance));
    tick_ = -1;
    for (auto& [id, carrier] : carriers_) carrier.place_m = glm::dvec3(0.0);
  }

  void expect(rg_result got) const {
    if (got < 0) throw std::runtime_error(api.last_error(instance));
  }
  double time_s() const { return static_cast<double>(tick_ - kBegunTick) / 120.0; }
  int64_t time_ns() const {
    return tick_ < 0 ? 0 : tick_ / 120 * 1'000'000'000 + tick_ % 120 * 1'000'000'000 / 120;
  }

 private:
  PluginLibrary library_;

 public:
  const rg_api& api;
  rg_instance* instance = nullptr;
  rg_weather weather{};
  rg_result result = RG_OK;                                         // of the last update
  std::map<uint32_t, std::function<double(double time_s)>> wipers;  // angle by wiper

 private:
  struct Carrier {
    Plate plate;
    double pitch_rad = 0.0;
    glm::dvec3 place_m{0.0}, velocity_mps{0.0}, acceleration_mps2{0.0};
    bool jumps = false;
  };

  rg_sample nextSample(int64_t ticks) {
    tick_ += ticks;
    const double passed_s = static_cast<double>(ticks) / 120.0;
    vehicles_.clear();
    for (auto& [id, carrier] : carriers_) {
      carrier.velocity_mps += carrier.acceleration_mps2 * passed_s;
      carrier.place_m += carrier.velocity_mps * passed_s;
      rg_vehicle vehicle;
      api.default_vehicle(&vehicle);
      vehicle.id = id;
      vehicle.discontinuity = std::exchange(carrier.jumps, false) ? 1 : 0;
      for (int i = 0; i < 3; ++i) {
        vehicle.pose.position_m[i] = carrier.place_m[i];
        vehicle.pose.velocity_mps[i] = carrier.velocity_mps[i];
      }
      vehicle.pose.orientation[1] = std::sin(0.5 * carrier.pitch_rad);
      vehicle.pose.orientation[3] = std::cos(0.5 * carrier.pitch_rad);
      vehicles_.push_back(vehicle);
    }
    knots_.clear();
    for (const auto& [wiper, angle] : wipers) knots_.push_back({time_ns(), wiper, 0, angle(time_s())});
    rg_sample sample;
    api.default_sample(&sample);
    sample.time_ns = time_ns();
    sample.weather = &weather;
    sample.vehicles = vehicles_.data();
    sample.vehicle_count = static_cast<uint32_t>(vehicles_.size());
    sample.vehicle_stride = sizeof(rg_vehicle);
    sample.wiper_knots = knots_.data();
    sample.wiper_knot_count = static_cast<uint32_t>(knots_.size());
    return sample;
  }

  std::map<uint32_t, Carrier> carriers_;
  std::vector<rg_vehicle> vehicles_;
  std::vector<rg_wiper_knot> knots_;
  bool attached_ = false;
  static constexpr int64_t kBegunTick = 1;
  int64_t tick_ = -1;
};

// Water that is off the glass, mL.
inline double gone_ml(const rg_pane_stats& s) {
  return s.drained_ml + s.wiped_ml + s.blown_ml + s.evaporated_ml;
}

// The ledger closes; its terms are doubles, so sums round in their last bits.
inline void expectNothingLost(const rg_pane_stats& s) {
  EXPECT_LT(s.ledger_error, 1e-12);
  EXPECT_NEAR(s.caught_ml, s.on_glass_ml + gone_ml(s), 1e-12 * (1.0 + s.caught_ml));
}

}  // namespace rg::test
