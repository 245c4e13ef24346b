#pragma once
// A scene as its users see it: a car in its vehicle frame (x forward, y left, z up; metres), a road in the
// world's (z up).

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace host {

/// vehicle (x forward, y left, z up) from a car file's axes: (X, Y, Z) -> (Z, X, Y).
glm::mat4 vehicleFromGltf();
/// world (z up) from a road file's axes: (X, Y, Z) -> (X, -Z, Y).
glm::mat4 worldFromGltf();

/// A pane's triangles, all primitives in one. Counter-clockwise triangles face outward (the wet side).
struct PaneView {
  std::string name;
  GlassSurface glass = GlassSurface::Uncoated;
  int node = -1;
  std::vector<glm::vec3> positions_m;
  std::vector<glm::vec3> normals;  ///< unit, outward
  std::vector<glm::vec2> uv;
  std::vector<std::uint32_t> indices;
};

/// The convex hull of these points is dry air. At least four, not in one plane.
struct ShelterView {
  std::string name;
  int node = -1;
  std::vector<glm::vec3> points_m;
};

/// The blade's middle at angle a: pivot + arm_m * (rest direction turned by a about the axis).
struct WiperView {
  std::string name;
  std::string pane;
  int pane_index = -1;  ///< into CarView::panes
  int node = -1;        ///< turned about its local +Y when the wiper moves
  glm::vec3 pivot_m{0.0F};
  glm::vec3 axis{0.0F, 0.0F, 1.0F};            ///< unit, out of the glass
  glm::vec3 rest_direction{1.0F, 0.0F, 0.0F};  ///< unit, at a right angle to the axis
  float arm_m = 0.0F;
  float blade_m = 0.0F;
  float blade_angle_rad = 0.0F;  ///< about the axis, from the arm's direction to the blade's
  float sweep_rad = 0.0F;        ///< signed, about the axis
  float blade_turn = 0.0F;       ///< of the blade on its arm, for each radian of the arm
  float wear = 0.0F;             ///< 0 a new blade .. 1
};

struct EyeView {
  glm::vec3 position_m{0.0F, 0.0F, 1.2F};
  float pitch_rad = 0.0F;
  float fov_rad = 1.0471976F;
  bool given = false;  ///< false: the file has no eye, the default stands
};

struct CameraView {
  std::string name;
  glm::vec3 position_m{0.0F};
  float yaw_rad = 0.0F;  ///< to the left, from the car's forward direction
  float pitch_rad = 0.0F;
  float fov_rad = 1.0471976F;
  bool inside = false;  ///< within the cabin
};

/// A node with a light role: a punctual light (light >= 0) or a glowing mesh (light < 0, at the middle of its
/// mesh).
struct LampView {
  LightRole role = LightRole::Street;
  int node = -1;
  int light = -1;  ///< index into Scene::lights
  glm::vec3 position_m{0.0F};
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< where a punctual light shines to, unit
};

struct WheelView {
  int node = -1;
  glm::vec3 hub_m{0.0F};
  glm::vec3 axle{0.0F, 1.0F, 0.0F};  ///< unit, to the left
  float radius_m = 0.3F;
  bool steers = false;
};

struct SteeringWheelView {
  int node = -1;  ///< turned about its local +Y
  glm::vec3 hub_m{0.0F};
  glm::vec3 axis{-1.0F, 0.0F, 0.0F};  ///< unit, towards the driver
  float ratio = 15.0F;
};

struct NeedleView {
  int node = -1;  ///< turned about its local +Y
  NeedleMeaning scale;
};

struct DigitView {
  int node = -1;  ///< turned about its local +Y
  DigitMeaning drum;
};

struct MirrorView {
  std::string name;
  int node = -1;
  glm::vec3 centre_m{0.0F};
  glm::vec3 normal{-1.0F, 0.0F, 0.0F};  ///< unit, the mean of its faces
  PaneView face;
  bool wet = false;  ///< rain falls on it
};

struct CarView {
  std::vector<PaneView> panes;
  std::vector<ShelterView> shelters;
  std::vector<WiperView> wipers;
  EyeView eye;
  std::vector<CameraView> cameras;
  std::vector<LampView> lamps;
  std::vector<WheelView> wheels;
  std::optional<SteeringWheelView> steering_wheel;
  std::vector<NeedleView> needles;
  std::vector<DigitView> digits;
  std::vector<MirrorView> mirrors;
};

struct RouteView {
  std::vector<glm::vec3> points_m;  ///< two or more
  bool closed = false;
};

struct RoadView {
  std::vector<ShelterView> shelters;
  std::optional<RouteView> route;
  std::vector<LampView> lamps;
};

/// All in the vehicle frame, the car at rest. A loaded scene has been checked, so this cannot fail.
CarView carView(const Scene& scene);
/// All in the world frame.
RoadView roadView(const Scene& scene);

/// Turns a node by an angle about an axis of its own, from where it rests, by setting its rotation in
/// `poses`: a wheel's about +X, all others' about +Y. (Does nothing visible to a node with a matrix.)
void turnNode(const Scene& scene, int node, glm::vec3 local_axis, float angle_rad, std::vector<Pose>& poses);

}  // namespace host
