// The host's side of the plugin: loads the library, tells it the world, has it draw. Sees only the public
// header.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "drive/driver.h"
#include "rainglass/rainglass.h"
#include "render/renderer.h"
#include "render/target.h"
#include "scene/views.h"
#include "window/context.h"

namespace host {

// The plugin refused a call; what() has the call and the plugin's own words.
class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr uint32_t kCarId = 1;
inline constexpr uint32_t kFirstTrafficId = 2;
inline constexpr uint32_t kViewId = 1;

// A moment of the host's world, to be told. Pointers are not kept.
struct Moment {
  int64_t time_ns = 0;
  CarState car;
  std::vector<CarState> traffic;
  rg_weather weather;
  rg_view view;
  std::vector<rg_wiper_knot> knots;
  std::vector<rg_opening_knot> openings;
};

class RainPlugin {
 public:
  // `library`: the plugin's file; empty: librainglass.so beside this program.
  RainPlugin(const std::filesystem::path& library, uint64_t seed);
  // One that is linked in.
  RainPlugin(const rg_api& api, uint64_t seed);
  ~RainPlugin();
  RainPlugin(const RainPlugin&) = delete;
  RainPlugin& operator=(const RainPlugin&) = delete;

  void attach(Context& context);
  // The car's cabin, panes, wet mirrors (panes after the others) and wipers. Ids are index + 1.
  void addCar(const CarView& car);
  // The cabins of so many other cars like it; moments tell where they are.
  void addTraffic(const CarView& car, size_t count);
  // Shelter of the road.
  void addRoad(const RoadView& road);
  // The plugin's whole state, and going on from one. restore throws PluginError where it is refused.
  std::vector<unsigned char> save();
  void restore(const std::vector<unsigned char>& state);
  void setParameter(const std::string& name, double value);
  void prewarm(double seconds);

  // Samples wait until the next update takes them along.
  void tell(Moment moment) { waiting_.push_back(std::move(moment)); }
  void update(int64_t time_ns);
  void stepGpu();
  void capture(Renderer& renderer, const rg_view& view, int max_faces);

  void drawWorld(int64_t time_ns, const rg_view& view, const Target& target, const LightSummary& light);
  void drawGlass(int64_t time_ns, const rg_view& view, const Target& target, const LightSummary& light);
  void drawFinish(int64_t time_ns, const rg_view& view, const Target& target, const LightSummary& light);

  rg_rain_stats rainStats();
  std::vector<std::pair<std::string, rg_pane_stats>> paneStats();
  rg_pane_stats paneStats(int pane_index);
  // The jets of all wipers' panes, from that time on.
  void wash(const CarView& car, int64_t time_ns);
  std::vector<rg_stage_stats> stages();
  std::vector<rg_parameter> parameters();
  bool gpuTimer();
  uint64_t hash(rg_hash_kind kind);
  void placeDrops(uint32_t pane, std::span<const rg_glass_drop> drops);
  const rg_api& api() const { return *api_; }
  rg_instance* instance() { return instance_; }

 private:
  void create(uint64_t seed);
  void check(rg_result result, const char* call);
  void addVolume(uint32_t id, uint32_t vehicle, const ShelterView& shelter);
  void addPane(const std::string& name, const rg_pane_info& info);
  using DrawCall = rg_result (*)(rg_instance*, rg_draw*);
  // `lamps`: those that light the drops, or that are looked at through them (`on_glass`).
  void draw(DrawCall call, const char* name, int64_t time_ns, const rg_view& view, const Target& target,
            const LightSummary& light, std::span<const rg_lamp> lamps, bool on_glass = false);

  void* library_ = nullptr;
  const rg_api* api_ = nullptr;
  rg_instance* instance_ = nullptr;
  bool attached_ = false;
  uint32_t volumes_ = 0;
  std::vector<std::string> panes_;
  std::vector<Moment> waiting_;
};

rg_view pluginView(const rg_api& api, const View& view, glm::ivec2 size_px, glm::dvec3 eye_velocity_mps,
                   uint32_t vehicle);
rg_vehicle pluginVehicle(const rg_api& api, const CarState& car, uint32_t id = kCarId);

}  // namespace host
