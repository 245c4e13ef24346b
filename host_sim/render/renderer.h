// The picture without rain: roads and cars under a sky, lit, in HDR.
//
// One picture, in this order (the plugin draws between the passes; see rainglass.h):
//   renderer.beginFrame(sky)                       sky, shadows, lamps: once for all views of a moment
//   renderer.drawWorld(view, target, whole)        sky, roads, and cars that are seen from outside
//   renderer.drawParts(view, target, car, kBody | kWipers)   the cabin around the eye
//   renderer.drawMirrors(view, target)             what its mirrors show
//   renderer.smooth(target, exposure)              edges of all that is solid
//     rain, panes
//   renderer.toneMap(target, framebuffer, exposure)
//
// Frames: world z up, metres, double; everything that reaches the GPU is relative to the eye. Depth:
// reversed, zero to one (1 at the near plane). Light: radiance in units of 1000 cd/m^2 (an overcast zenith is
// about 5), so that half floats hold lamps and tunnels alike.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "render/sky.h"
#include "render/target.h"
#include "scene/scene.h"
#include "window/context.h"

namespace host {

/// An eye and what it projects to. `projection` is clipFromEye with reversed depth in zero to one; see
/// reversedPerspective().
struct View {
  glm::dmat4 eye_from_world{1.0};
  glm::dmat4 projection{1.0};
};

/// clipFromEye: reversed, zero-to-one, infinite far plane. `fov_rad` is horizontal.
glm::dmat4 reversedPerspective(double fov_rad, glm::ivec2 size_px, double near_m = 0.05);

using SceneId = std::uint32_t;
using InstanceId = std::uint32_t;

/// Which frame a scene's file is in, as models/README.md has it.
enum class SceneFrame { Road, Car };

/// Where an instance is and how it is posed.
struct Placement {
  /// World from the host's frame of the scene: the vehicle frame of a car (x forward, z up), the world frame
  /// of a road.
  glm::dmat4 world_from_host{1.0};
  /// Poses of all nodes (Scene::restPoses(), changed), or empty: at rest. Only nodes that can move follow it:
  /// wipers, wheels, steering wheels, needles, digits, animated nodes, and what hangs below them.
  std::vector<Pose> poses;
  /// How bright lamps shine and glowing meshes glow, by LightRole; 1 = as in the file, 0 = off.
  std::array<float, 6> lamp_levels{0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
  /// How bright meshes without a role glow, such as a car's displays; of a road those alone whose glow is a
  /// picture (windows, signs), not lamps' glass; 1 = as in the file.
  float display_level = 1.0F;
};

enum Parts : unsigned {
  kBody = 1,    ///< all but what follows
  kWipers = 2,  ///< wipers' meshes
  kPanes = 4,   ///< panes as plain clear glass that reflects, for cars whose panes the plugin does not draw
};

/// A lamp as it shines now, for the plugin's drops and for the picture. Radiant intensity in 1000 cd.
struct LampNow {
  glm::dvec3 position_m{0.0};
  glm::vec3 direction{0.0F, 0.0F, -1.0F};
  glm::vec3 intensity{0.0F};
  float cos_inner = -1.0F;
  float cos_outer = -1.0F;
  bool low_beam = false;  ///< spreads its light as lowBeam() says instead of the cone, which is a coarse one
};

/// A car's lamp as it is looked into: a small bright disc.
struct Glare {
  glm::dvec3 position_m{0.0};
  glm::vec3 intensity{0.0F};  ///< towards the eye, 1000 cd
  float radius_m = 0.0F;
  bool mesh_glows = false;  ///< a disc is drawn only where its mesh is too small to be drawn well
};

/// Share of the light that a car's mirrors reflect (silver behind glass).
inline constexpr float kCarMirror = 0.85F;

/// What light there is, as rg_lighting wants it.
struct LightSummary {
  glm::vec3 sky_radiance{0.0F};
  glm::vec3 ground_radiance{0.0F};
  glm::vec3 to_sun{0.0F};
  glm::vec3 sun_irradiance{0.0F};
  std::vector<LampNow> lamps;          ///< those that are lit, nearest to the eye first
  std::vector<Glare> glares;           ///< cars' lamps as the eye looks into them; drawScene leaves them out
  std::uint32_t environment_cube = 0;  ///< linear radiance with mips, world axes
};

/// Milliseconds and work of the last call of a pass, timed with glFinish when asked for (setTiming).
struct PassTime {
  std::string pass;
  double ms = 0.0;
  std::uint64_t triangles = 0;
  std::uint64_t draws = 0;
};

class Renderer {
 public:
  /// Needs `context` current, and to be destroyed before it.
  explicit Renderer(const Context& context);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Uploads a scene, its static parts merged. Also finds out how much sky is seen inside its shelter volumes
  /// (rays against its own triangles), so that tunnels are dark and canopies give shade. `scene` is not kept.
  SceneId addScene(const Scene& scene, SceneFrame frame);
  InstanceId addInstance(SceneId scene);
  /// A car among others, seen in every picture as the road is, by the glass too.
  InstanceId addTraffic(SceneId scene);
  void place(InstanceId instance, const Placement& placement);
  /// A flat mirror of a car's: triangles in its host frame, `normal` towards those who look into it.
  void addMirror(InstanceId car, std::span<const glm::vec3> positions_m,
                 std::span<const std::uint32_t> indices, glm::vec3 normal);

  /// A picture of all around at infinity, instead of the computed sky: `rgb` is latitude-longitude, row 0 up,
  /// linear, in this file's unit; the world's +x is in its middle column, +y left of it.
  void setEnvironment(std::span<const float> rgb, int width, int height);

  /// The sky's light alone, for lighting() and adaptingLuminance() between pictures.
  void lightSky(const Sky& sky);
  /// The weather's light for the views to come, around `eye_m`. Renews sky, shadow and lamps where they
  /// changed.
  void beginFrame(const Sky& sky, glm::dvec3 eye_m);

  /// Clears, draws the sky, all roads, and the cars in `whole`.
  void drawWorld(const View& view, const Target& target, std::span<const InstanceId> whole = {});
  /// Draws parts (Parts, or'ed) of an instance into what is there.
  void drawParts(const View& view, const Target& target, InstanceId instance, unsigned parts);
  /// What a car's mirrors that are in the picture show, drawn on them.
  void drawMirrors(const View& view, const Target& target);
  /// Smooths the edges in the target's colour, as they will be seen at `exposure`: before rain and panes,
  /// which are drawn smooth.
  void smooth(const Target& target, double exposure);
  /// World as the glass sees it, for rg_capture_fn: sky, roads and traffic, coarser, cars' lamps dark (the
  /// glass is told of them as `glares`). Clears the framebuffer.
  void drawScene(std::uint32_t framebuffer, glm::ivec2 size_px, const glm::dmat4& eye_from_world,
                 const glm::dmat4& projection);
  /// Writes the target's colour, times `exposure`, through a filmic curve as sRGB into `framebuffer` (0: the
  /// window), its size the target's.
  void toneMap(const Target& target, std::uint32_t framebuffer, double exposure);
  /// As toneMap without the curve: sRGB encoding only.
  void encodeSrgb(const Target& target, std::uint32_t framebuffer, double exposure = 1.0);

  /// Share of the sky's light that reaches a point: 1 in the open, near 0 deep in a tunnel.
  double skyVisibility(glm::dvec3 point_m) const;
  LightSummary lighting() const;
  /// Luminance (1000 cd/m^2) that an eye there adapts to, from skyVisibility and the sky; for exposureFor().
  double adaptingLuminance(glm::dvec3 eye_m) const;

  void setTiming(bool on);
  std::vector<PassTime> times() const;

 private:
  struct Self;
  std::unique_ptr<Self> self_;
};

/// Exposure that makes a picture of this mean luminance (1000 cd/m^2) middling bright. The caller averages
/// log luminance over the last seconds of simulated time, so that the eye adapts alike at every frame rate.
double exposureFor(double luminance);

}  // namespace host
