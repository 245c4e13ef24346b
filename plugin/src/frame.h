// An instance of the plugin: the host's objects, and the order of a frame as named, timed stages. Functions
// throw ApiError.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "error.h"
#include "gl/loader.h"
#include "gl/timers.h"
#include "glass/airflow.h"
#include "glass/film_state.h"
#include "glass/fog.h"
#include "glass/look_gl.h"
#include "glass/pane.h"
#include "glass/pane_gl.h"
#include "glass/pillar.h"
#include "glass/washer.h"
#include "last_error.h"
#include "rain/beyond.h"
#include "rain/beyond_pattern.h"
#include "rain/field.h"
#include "rain/rain_gl.h"
#include "settings.h"
#include "surroundings/splashes.h"
#include "surroundings/wetness.h"
#include "surroundings/wetness_gl.h"
#include "timeline.h"
#include "workers.h"

namespace rg {

// A pane with both its halves.
struct PaneObject {
  uint32_t vehicle = 0;
  bool active = true;
  std::shared_ptr<glass::PaneSim> sim;
  std::shared_ptr<glass::Fog> fog;
  double demister = 0.0;
  double mirror = 0.0;
  double opening_m = 0.0;  // until the timeline says otherwise
  std::array<float, glass::kRegions> wet_share{};
  glass::Airflow airflow;
  int64_t tick = 0;  // the pane's own count: it has no gaps where time was left out
  uint64_t left_out_ticks = 0;
};

// A jet at work.
struct WashObject {
  uint32_t pane = 0;
  glass::JetInfo info;
  std::shared_ptr<const glass::Jet> jet;  // of that
  int64_t begin_ns = 0, end_ns = 0;
  int64_t volume_pl = 0, given_pl = 0;
};

// A washer's order, read from the ABI and checked.
struct WashOrder {
  uint32_t pane = 0;
  glass::JetInfo jet;
  int64_t time_ns = 0;
  double duration_s = 1.0;
  double volume_m3 = 0.0;
};

struct WiperObject {
  uint32_t pane = 0;
  glass::WiperInfo info;
};

// A picture asked for, read from the ABI and checked.
struct DrawRequest {
  int64_t time_ns = 0;
  ViewState view;
  glm::ivec4 viewport_px{0};
  glass::LookTarget target;
  uint32_t depth_texture = 0;
  rain::RainLighting lighting;
  std::vector<rain::DropLamp> lamps;
  size_t lamps_on_glass = 0;  // the first of `lamps`, which drops on panes show too
};

class Frame {
 public:
  explicit Frame(const rg_create_info& info);
  ~Frame();
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  LastError last_error;

  // Objects.
  void setVolume(uint32_t id, const rain::VolumeInfo& info);
  void removeVolume(uint32_t id);
  void removeVehicle(uint32_t id);
  void setPane(uint32_t id, uint32_t vehicle, bool active, const glass::PaneInfo& info);
  void removePane(uint32_t id);
  void setWiper(uint32_t id, uint32_t pane, const glass::WiperInfo& info);
  void removeWiper(uint32_t id);
  void placeDrops(uint32_t pane, std::span<const glass::PlacedDrop> drops);
  void wash(const WashOrder& order);
  void setAirflow(uint32_t pane, glass::Airflow airflow);
  void setRainPattern(rain::RainPattern pattern);  // an empty one: the project's own

  // Time. update returns a remark or RG_OK.
  rg_result update(int64_t time_ns, const std::vector<Sample>& samples);
  const Sample* lastSample() const { return timeline_.empty() ? nullptr : &timeline_.last(); }
  void reset();
  void seek(int64_t time_ns);
  void prewarm(double seconds);
  void rebase(const glm::dvec3& shift_m);
  // GL thread where attached. Restoring what is refused changes nothing.
  std::vector<unsigned char> save();
  void restore(std::span<const unsigned char> bytes);

  // GL thread.
  void attach(const rg_gl_info& info);
  void detach();
  void contextLost();
  void stepGpu();
  uint32_t prepareCaptures(const ViewState& view, int max_faces, const glass::DrawScene& draw);
  uint32_t drawWorld(const DrawRequest& request);
  uint32_t drawGlass(const DrawRequest& request);
  uint32_t drawFinish(const DrawRequest& request);

  // Questions.
  rain::FieldStats rainStats();
  double rainRate();
  double waterOnGround_mm();
  double splashesKept() const { return splashes_kept_; }  // of those of the latest picture
  // False when more volumes are near the views than streaks can be clipped at; see setUpStreaks.
  bool nearVolumesFit() const;
  glass::PaneStats paneStats(uint32_t pane);
  uint64_t hash(bool with_glass);
  const gl::Timers& timers() const { return timers_; }
  Settings settings() const;
  void set(double Settings::*value, double to);

 private:
  struct Gl;

  void runTick(int64_t index, bool rain_only);
  void tellSettings();
  void tickGlass(const Tick& tick);
  void tickWashes(uint32_t pane, const Tick& tick, glass::PaneTick& out);
  void tickFog(PaneObject& pane, const glass::PaneTick& tick) const;
  void updateShelter(PaneObject& pane, const VehicleState& vehicle, const Tick& tick, double opening_m);
  void joinPane(uint32_t id);
  void partPane(uint32_t id);
  void tellPillars();
  PaneObject& pane(uint32_t id);
  double openingOf_m(uint32_t id, const PaneObject& pane, int64_t time_ns) const;
  void removeWipersOf(uint32_t pane);
  Gl& attached();
  void syncPanes(Gl& gl);
  void leaveGl();
  void finishGlass();  // runs what waits for the film, and waits for it; GL thread, locked
  void publish();
  void publishBeyond();
  void publishSplashes();
  void publishWetness();
  void requireMoment(int64_t time_ns) const;

  // Of the panes that have one, by their ids; finished.
  using FilmStates = std::map<uint32_t, glass::FilmState>;
  FilmStates filmStates();
  void setFilms(const FilmStates& films);
  void writeParts(saved::Writer& body, const FilmStates& films) const;
  FilmStates readParts(saved::Reader& body);
  int64_t readClock(saved::Reader& a);
  void readPillars(saved::Reader& a, int64_t glass_moment);
  void readWashes(saved::Reader& a);
  void checkPanes(saved::Reader& a) const;

  mutable std::mutex sim_;  // of all below; held by update throughout, by the GL thread for moments
  Timeline timeline_;
  rain::Field field_;
  rain::Upload upload_;
  rain::Beyond beyond_;
  rain::BeyondPicture beyond_picture_;
  surroundings::Splashes splashes_;
  surroundings::SplashPicture splash_picture_;
  std::atomic<double> splashes_kept_ = 1.0;
  surroundings::Wetness wetness_;
  surroundings::WetnessPicture wetness_picture_;
  rain::RainPattern pattern_;  // empty: the project's own
  uint32_t pattern_version_ = 1;
  std::map<uint32_t, PaneObject> panes_;
  std::map<uint32_t, WiperObject> wipers_;
  std::map<std::pair<uint32_t, uint32_t>, std::shared_ptr<glass::Pillar>> pillars_;  // from pane, to pane
  std::vector<WashObject> washes_;        // in the order they were asked for
  std::map<uint32_t, uint32_t> volumes_;  // id -> vehicle
  Settings settings_;
  rain::WindProfile wind_profile_;  // as the settings say
  uint64_t seed_;
  uint32_t capacity_;
  bool started_ = false;
  int64_t next_tick_ = 0;
  int64_t glass_moment_ = 0;  // of PaneTick
  int64_t prewarm_ticks_ = 0;
  // What falls on the glass, as of `glass_rates_`, and of which class of the rain's each is.
  std::array<glass::SizeClass, glass::kMaxSizeClasses> classes_{};
  std::array<uint32_t, glass::kMaxSizeClasses> class_of_{};
  uint32_t class_count_ = 0;
  rain::Rates glass_rates_;
  double glass_fall_mps_ = 0.0;  // typical of them; 0: not asked yet

  Workers workers_;  // run panes' ticks

  gl::Timers timers_;
  struct Stages {
    gl::Timers::Stage rain_tick, glass_tick, rain_upload, glass_step, captures, wetness, splashes,
        rain_beyond, rain_draw, glass_draw, finish;
  } stage_;
  std::unique_ptr<Gl> gl_;
};

}  // namespace rg
