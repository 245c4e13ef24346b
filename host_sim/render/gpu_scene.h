// A scene on the GPU: static parts merged into few draws, each with its bounds, material and the body it
// moves with.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/sky_visibility.h"
#include "scene/scene.h"
#include "window/context.h"

namespace host {

enum class SceneFrame;

/// A glowing surface of emissive factor 1, 1000 cd/m^2: a lit window or lamp cover that is seen to glow by
/// day.
constexpr float kGlow = 6.0F;

/// Which of a program's variants a material needs (names in shaders/scene.frag).
enum Feature : unsigned {
  kBaseMap = 1,
  kRoughnessMap = 2,
  kNormalMap = 4,
  kGlowMap = 8,
  kMask = 16,
  kBlend = 32,
  kGlossy = 64,
  kShelter = 128,
  kSun = 256,
  kMirror = 512,
  kCarAbove = 1024,
};

struct GpuMaterial {
  GLuint base_map = 0, roughness_map = 0, normal_map = 0, glow_map = 0;
  glm::vec4 base{1.0F};
  glm::vec4 surface{0.0F};  ///< metallic, roughness, cutoff, normal scale
  glm::vec3 glow{0.0F};
  float film =
      0.0F;  ///< how much of a glossy film of water it holds when level: grass and gravel none, asphalt whole
  unsigned features = 0;
  bool double_sided = false;
};

/// One call's triangles, in their body's axes.
struct GpuDraw {
  std::uint32_t first = 0, count = 0;
  int body = 0;
  int material = 0;
  unsigned part = 1;  ///< Parts
  int role = -1;      ///< LightRole when its glow follows a lamp's level
  glm::vec3 middle{0.0F}, half{0.0F};
};

struct GpuLamp {
  int node = 0;
  int role = -1;
  Light light;
};

/// A lamp's glowing mesh on one side of a car, as far as light goes that it sends afar.
struct GpuGlow {
  int role = -1;
  glm::vec3 position_m{0.0F}, normal{0.0F};  ///< host's frame of the scene
  glm::vec3 radiance_area{0.0F};             ///< intensity along the normal, 1000 cd
  float area_m2 = 0.0F;                      ///< of it that faces one way
};

struct GpuGrid {
  SkyGrid grid;
  GLuint texture = 0;
};

class GpuScene {
 public:
  GpuScene(const GladGLContext& gl, const Scene& scene, SceneFrame frame);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  SceneFrame frame;
  glm::mat4 host_from_file{1.0F};
  Scene tree;               ///< nodes only: to pose it
  std::vector<int> bodies;  ///< node each body moves with, -1: none
  std::vector<GpuMaterial> materials;
  std::vector<GpuDraw> draws;
  std::vector<GpuLamp> lamps;
  std::vector<GpuGlow> glows;    ///< of a car
  bool headlights_glow = false;  ///< they have a mesh beside their lights
  std::vector<GpuGrid> grids;    ///< in the host's frame of the scene
  GLuint vertex_array = 0;
  glm::vec4 footprint{0.0F};  ///< of a car: half length, half width, middle along x, height (m)

 private:
  void uploadMaterials(const Scene& scene);
  void uploadMeshes(const Scene& scene);
  void measureGlows(const Scene& scene);
  void measureShelters(const Scene& scene);
  GLuint upload(const Scene& scene, const TextureUse& use, bool mask);

  const GladGLContext& gl_;
  std::vector<GLuint> textures_;
  GLuint vertices_ = 0, indices_ = 0;
};

}  // namespace host
