#pragma once
// What a glTF 2.0 file holds, checked, in plain arrays without GL. Everything here is in the file's own axes
// (y up, metres); views.h turns it into the vehicle's and the world's frames.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/meaning.h"

namespace host {

/// The file cannot be used. what() is one line that names file and element.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// 8 bits per channel, row 0 on top (glTF: uv (0,0) is the first row's corner).
struct Image {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< width x height x 4
};

/// The values are the GL enumerants (glTF uses them as they are).
struct Sampler {
  std::uint32_t min_filter = 9987;  ///< GL_LINEAR_MIPMAP_LINEAR
  std::uint32_t mag_filter = 9729;  ///< GL_LINEAR
  std::uint32_t wrap_s = 10497;     ///< GL_REPEAT
  std::uint32_t wrap_t = 10497;
};

/// A material's use of a texture. `image` < 0: none. KHR_texture_transform: uv' = offset + R(rotation) (scale
/// * uv).
struct TextureUse {
  int image = -1;  ///< index into Scene::images
  Sampler sampler;
  int uv_set = 0;  ///< 0 or 1
  glm::vec2 offset{0.0F};
  glm::vec2 scale{1.0F};
  float rotation_rad = 0.0F;  ///< counter-clockwise, as KHR_texture_transform has it
  explicit operator bool() const { return image >= 0; }
};

enum class AlphaMode { Opaque, Mask, Blend };

/// glTF metallic-roughness. Colour factors are linear; base colour and emissive images are sRGB, the others
/// linear.
struct Material {
  std::string name;
  glm::vec4 base_colour{1.0F};
  float metallic = 1.0F;
  float roughness = 1.0F;
  glm::vec3 emissive{0.0F};  ///< factor x KHR_materials_emissive_strength
  float normal_scale = 1.0F;
  float occlusion_strength = 1.0F;
  TextureUse base_colour_map;
  TextureUse metallic_roughness_map;  ///< g roughness, b metallic
  TextureUse normal_map;
  TextureUse occlusion_map;  ///< r
  TextureUse emissive_map;
  AlphaMode alpha_mode = AlphaMode::Opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
  bool unlit = false;  ///< KHR_materials_unlit
};

/// Triangles. Optional arrays are empty or as long as `positions_m`; every index is in range; normals are
/// always there, tangents where the material has a normal map and the primitive has that map's uv.
struct Primitive {
  std::vector<glm::vec3> positions_m;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;  ///< w: sign of the bitangent, cross(normal, tangent) * w
  std::vector<glm::vec2> uv0;
  std::vector<glm::vec2> uv1;
  std::vector<glm::vec4> colours;      ///< linear, factor on the base colour
  std::vector<std::uint32_t> indices;  ///< a multiple of 3
  int material = 0;  ///< always valid: the glTF default material is appended where a primitive has none
  glm::vec3 min_m{0.0F};
  glm::vec3 max_m{0.0F};
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

enum class LightKind { Directional, Point, Spot };

/// KHR_lights_punctual: shines along its node's local -Z.
struct Light {
  std::string name;
  LightKind kind = LightKind::Point;
  glm::vec3 colour{1.0F};  ///< linear
  float intensity = 1.0F;  ///< candela; lux when directional
  float range_m = 0.0F;    ///< 0: unlimited
  float inner_cone_rad = 0.0F;
  float outer_cone_rad = 0.785398F;
};

/// Translation, rotation, scale; where the file gives a matrix it is kept as such and cannot be animated
/// (glTF 2.0, 3.5.2).
struct Pose {
  glm::vec3 translation_m{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::vec3 scale{1.0F};
  glm::mat4 matrix() const;
};

struct Node {
  std::string name;
  int parent = -1;
  std::vector<int> children;
  int mesh = -1;
  int light = -1;
  Pose pose;
  bool has_matrix = false;
  glm::mat4 local{1.0F};            ///< parentFromNode at rest
  glm::mat4 scene_from_node{1.0F};  ///< at rest, in the file's axes
  Meaning meaning;                  ///< extras.rainglass
  bool in_scene = false;            ///< reached from the scene's roots; others are to be ignored
};

enum class AnimatedProperty { Translation, Rotation, Scale };
enum class Interpolation { Step, Linear, CubicSpline };

/// One node property over time. Values are xyz, or xyzw of a quaternion. CubicSpline has three values per
/// key: in-tangent, value, out-tangent.
struct AnimationChannel {
  int node = 0;
  AnimatedProperty property = AnimatedProperty::Translation;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times_s;  ///< strictly increasing
  std::vector<glm::vec4> values;
  /// The value at `time_s`, held before the first and after the last key (glTF 2.0, appendix C). Rotations
  /// are of unit length.
  glm::vec4 at(float time_s) const;
};

struct Animation {
  std::string name;
  float duration_s = 0.0F;
  std::vector<AnimationChannel> channels;
};

struct Scene {
  std::string file;  ///< file name for messages
  std::vector<Image> images;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Light> lights;
  std::vector<Node> nodes;
  std::vector<int> roots;
  std::vector<int> order;  ///< the scene's nodes, parents before children
  std::vector<Animation> animations;
  std::vector<std::string> warnings;  ///< one line each: what was left out

  /// Index of the first node of that name in the scene, or -1.
  int findNode(const std::string& name) const;
  /// All nodes' poses at rest, to be changed by animate() or by hand and handed to sceneFromNode().
  std::vector<Pose> restPoses() const;
  /// parentFromNode products along the tree: sceneFromNode of each node (identity for nodes outside the
  /// scene). Nodes with a matrix keep it.
  std::vector<glm::mat4> sceneFromNode(const std::vector<Pose>& poses) const;
};

/// Writes an animation's values at `time_s` into `poses` (as long as scene.nodes).
void animate(const Animation& animation, float time_s, std::vector<Pose>& poses);

/// Loads a .gltf or .glb (told apart by its first bytes). Files it names must lie in the model's own folder
/// or below. Images are decoded. Throws SceneError, and nothing else, for whatever is wrong.
Scene loadScene(const std::filesystem::path& file);

}  // namespace host
