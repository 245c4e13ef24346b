// Nodes and their animations.
#include <algorithm>

#include "scene/gltf/check.h"
#include "scene/gltf/parts.h"

namespace host::gltf {

namespace {

constexpr std::size_t kMostKeys = 16U << 20;  // of all channels together, which may share accessors

glm::mat4 matrixOf(const std::vector<double>& from) {
  glm::mat4 matrix(1.0F);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = static_cast<float>(from[static_cast<std::size_t>(i)]);
  return matrix;
}

Node readNode(const tinygltf::Node& from, const Json& json) {
  Node node;
  node.name = from.name;
  node.children = from.children;
  node.mesh = from.mesh;
  node.pose.translation_m = vec3Of(from.translation, glm::vec3(0.0F));
  node.pose.scale = vec3Of(from.scale, glm::vec3(1.0F));
  if (from.rotation.size() == 4) {
    const auto& q = from.rotation;  // glTF: x, y, z, w; glm: w first
    node.pose.rotation = glm::normalize(glm::quat(static_cast<float>(q[3]), static_cast<float>(q[0]),
                                                  static_cast<float>(q[1]), static_cast<float>(q[2])));
  }
  node.has_matrix = from.matrix.size() == 16;
  node.local = node.has_matrix ? matrixOf(from.matrix) : node.pose.matrix();
  if (json.contains("extensions") && json["extensions"].contains("KHR_lights_punctual")) {
    node.light = json["extensions"]["KHR_lights_punctual"]["light"].get<int>();
  }
  return node;
}

std::vector<float> readTimes(const Source& source, int accessor, const std::string& where) {
  std::vector<float> times_s = source.floats(accessor, 1, where + ": input");
  if (times_s.front() < 0.0F) fail(where, "first key is before time 0");
  if (std::adjacent_find(times_s.begin(), times_s.end(), std::greater_equal<>()) != times_s.end()) {
    fail(where, "times of keys do not increase");
  }
  return times_s;
}

std::vector<glm::vec4> readValues(const Source& source, int accessor, bool is_rotation,
                                  const std::string& where) {
  if (is_rotation) return source.vectors<4>(accessor, where + ": output");
  std::vector<glm::vec4> values;
  for (const glm::vec3& value : source.vectors<3>(accessor, where + ": output"))
    values.emplace_back(value, 0.0F);
  return values;
}

Interpolation interpolationOf(const std::string& name) {
  if (name == "STEP") return Interpolation::Step;
  return name == "CUBICSPLINE" ? Interpolation::CubicSpline : Interpolation::Linear;
}

AnimatedProperty propertyOf(const std::string& path, const std::string& where) {
  if (path == "translation") return AnimatedProperty::Translation;
  if (path == "rotation") return AnimatedProperty::Rotation;
  if (path == "scale") return AnimatedProperty::Scale;
  fail(where, "target.path \"" + path + "\" is unknown");
}

void checkRotations(const AnimationChannel& channel, const std::string& where) {
  const std::size_t per_key = channel.interpolation == Interpolation::CubicSpline ? 3 : 1;
  for (std::size_t i = per_key / 2; i < channel.values.size(); i += per_key) {
    const float length = glm::length(channel.values[i]);
    if (!(length > 0.9F && length < 1.1F))
      fail(where, "key " + std::to_string(i / per_key) + " is not a unit quaternion");
  }
}

AnimationChannel readChannel(const Source& source, const tinygltf::Animation& animation,
                             const tinygltf::AnimationChannel& from, const std::string& where) {
  const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(from.sampler)];
  AnimationChannel channel;
  channel.node = from.target_node;
  channel.property = propertyOf(from.target_path, where);
  channel.interpolation = interpolationOf(sampler.interpolation);
  if (source.model.nodes[static_cast<std::size_t>(channel.node)].matrix.size() == 16) {
    fail(where, "moves node " + std::to_string(channel.node) + ", which has a matrix");
  }
  channel.times_s = readTimes(source, sampler.input, where);
  channel.values = readValues(source, sampler.output, channel.property == AnimatedProperty::Rotation, where);
  const std::size_t expected =
      channel.times_s.size() * (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
  if (channel.values.size() != expected) {
    fail(where, "has " + std::to_string(channel.values.size()) + " values, its keys need " +
                    std::to_string(expected));
  }
  if (channel.property == AnimatedProperty::Rotation) checkRotations(channel, where);
  return channel;
}

}  // namespace

std::vector<Node> readNodes(const Source& source) {
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < source.model.nodes.size(); ++i) {
    nodes.push_back(readNode(source.model.nodes[i], source.document.json["nodes"][i]));
  }
  return nodes;
}

std::vector<Animation> readAnimations(const Source& source, std::vector<std::string>& warnings) {
  std::vector<Animation> animations;
  std::size_t keys = 0;
  for (std::size_t a = 0; a < source.model.animations.size(); ++a) {
    const tinygltf::Animation& from = source.model.animations[a];
    Animation animation{from.name, 0.0F, {}};
    for (std::size_t c = 0; c < from.channels.size(); ++c) {
      const std::string where =
          elementOf(source.document, "animations", "animation", a) + ": channels[" + std::to_string(c) + "]";
      if (from.channels[c].target_node < 0 || from.channels[c].target_path == "weights") {
        warnings.push_back(where + ": moves no node, left out");
        continue;
      }
      keys += source.count(from.samplers[static_cast<std::size_t>(from.channels[c].sampler)].output);
      if (keys > kMostKeys) fail(where, "takes the file above 16 million keys");
      animation.channels.push_back(readChannel(source, from, from.channels[c], where));
      animation.duration_s = std::max(animation.duration_s, animation.channels.back().times_s.back());
    }
    animations.push_back(std::move(animation));
  }
  return animations;
}

}  // namespace host::gltf
