// All that a picture needs, put together once: context, models, renderer, plugin, simulation. And the order
// of a picture.
#pragma once

#include <memory>
#include <optional>

#include "options.h"
#include "rain_plugin.h"
#include "render/renderer.h"
#include "render/target.h"
#include "report.h"
#include "saved_run.h"
#include "scenario.h"
#include "scene/scene.h"
#include "scene/views.h"
#include "simulation.h"
#include "window/context.h"

namespace host {

// Where scenarios/ and models/ are: the nearest folder above this program (or above the working folder) that
// has both.
std::filesystem::path projectRoot();

// Scenario and models as the options say. Throws InputError or SceneError.
Scenario chosenScenario(const Options& options);

// The files of a scenario, read and checked. Throws SceneError. Needs no context, so that a broken file is
// told of before a window opens.
struct Models {
  std::optional<Scene> car, road;
};
Models loadModels(const Scenario& scenario);

class Stage {
 public:
  Stage(const Options& options, const Scenario& scenario, Models models, Context& context);

  // Takes the world and the plugin to a moment of the scenario's clock.
  void update(int64_t time_ns);
  // Scenario's prewarm, in pieces, with a progress line.
  void prewarm();
  // Draws the moment into `target` and tone-maps it into `framebuffer`. At most `captures` faces of the
  // surroundings are drawn anew for the glass: 1 in a running picture, all 6 for a single one.
  void draw(int64_t time_ns, const Target& target, uint32_t framebuffer, int captures = 1);
  void fillReport(Report& report);

  // Between two updates, at a moment of the scenario's clock; see saved_run.h. restore returns the moment,
  // and throws InputError where the plugin refuses it: then it is as before.
  SavedRun save(int64_t time_ns);
  int64_t restore(const SavedRun& saved);

  Simulation& simulation() { return *simulation_; }
  RainPlugin& plugin() { return *plugin_; }
  Renderer& renderer() { return *renderer_; }

 private:
  void pose(int64_t time_ns);
  void poseTraffic(int64_t time_ns);
  Sky sky(int64_t time_ns) const;
  glm::vec3 toSun() const;
  void addRoad();
  void setParameters();

  const Scenario& scenario_;
  Context& context_;
  std::optional<Scene> car_scene_, road_scene_;
  CarView car_;
  RoadView road_;
  std::unique_ptr<Renderer> renderer_;
  std::optional<InstanceId> car_instance_, road_instance_;
  std::vector<InstanceId> traffic_;
  std::unique_ptr<RainPlugin> plugin_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<Pose> poses_;
};

}  // namespace host
