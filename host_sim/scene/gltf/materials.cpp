// Materials and lights.
#include "scene/gltf/parts.h"

namespace host::gltf {

namespace {

const Json* extensionOf(const Json& element, const char* name) {
  const auto extensions = element.find("extensions");
  if (extensions == element.end()) return nullptr;
  const auto extension = extensions->find(name);
  return extension == extensions->end() ? nullptr : &*extension;
}

Sampler samplerOf(const tinygltf::Model& model, int index) {
  Sampler sampler;
  if (index < 0) return sampler;
  const tinygltf::Sampler& from = model.samplers[static_cast<std::size_t>(index)];
  if (from.minFilter >= 0) sampler.min_filter = static_cast<std::uint32_t>(from.minFilter);
  if (from.magFilter >= 0) sampler.mag_filter = static_cast<std::uint32_t>(from.magFilter);
  sampler.wrap_s = static_cast<std::uint32_t>(from.wrapS);
  sampler.wrap_t = static_cast<std::uint32_t>(from.wrapT);
  return sampler;
}

glm::vec2 pairOf(const Json& from, const char* key, glm::vec2 otherwise) {
  if (!from.contains(key)) return otherwise;
  return {from[key][0].get<float>(), from[key][1].get<float>()};
}

/// The texture under `key` of a checked JSON object.
TextureUse textureOf(const Source& source, const Json& owner, const char* key) {
  TextureUse use;
  const auto found = owner.find(key);
  if (found == owner.end()) return use;
  const tinygltf::Texture& texture = source.model.textures[(*found)["index"].get<std::size_t>()];
  use.image = texture.source;
  use.sampler = samplerOf(source.model, texture.sampler);
  use.uv_set = found->value("texCoord", 0);
  if (const Json* transform = extensionOf(*found, "KHR_texture_transform")) {
    use.offset = pairOf(*transform, "offset", use.offset);
    use.scale = pairOf(*transform, "scale", use.scale);
    use.rotation_rad = transform->value("rotation", 0.0F);
    use.uv_set = transform->value("texCoord", use.uv_set);
  }
  return use;
}

void readBase(const Source& source, const tinygltf::PbrMetallicRoughness& from, const Json& json,
              Material& material) {
  if (from.baseColorFactor.size() == 4) {
    const auto& f = from.baseColorFactor;
    material.base_colour = glm::vec4(glm::dvec4(f[0], f[1], f[2], f[3]));
  }
  material.metallic = static_cast<float>(from.metallicFactor);
  material.roughness = static_cast<float>(from.roughnessFactor);
  const auto pbr = json.find("pbrMetallicRoughness");
  if (pbr == json.end()) return;
  material.base_colour_map = textureOf(source, *pbr, "baseColorTexture");
  material.metallic_roughness_map = textureOf(source, *pbr, "metallicRoughnessTexture");
}

AlphaMode alphaModeOf(const std::string& name) {
  if (name == "MASK") return AlphaMode::Mask;
  return name == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
}

Material readMaterial(const Source& source, const tinygltf::Material& from, const Json& json) {
  Material material;
  material.name = from.name;
  readBase(source, from.pbrMetallicRoughness, json, material);
  material.emissive = vec3Of(from.emissiveFactor, glm::vec3(0.0F));
  if (const Json* glow = extensionOf(json, "KHR_materials_emissive_strength")) {
    material.emissive *= glow->value("emissiveStrength", 1.0F);
  }
  material.normal_map = textureOf(source, json, "normalTexture");
  material.normal_scale = static_cast<float>(from.normalTexture.scale);
  material.occlusion_map = textureOf(source, json, "occlusionTexture");
  material.occlusion_strength = static_cast<float>(from.occlusionTexture.strength);
  material.emissive_map = textureOf(source, json, "emissiveTexture");
  material.alpha_mode = alphaModeOf(from.alphaMode);
  material.alpha_cutoff = static_cast<float>(from.alphaCutoff);
  material.double_sided = from.doubleSided;
  material.unlit = extensionOf(json, "KHR_materials_unlit") != nullptr;
  return material;
}

LightKind lightKindOf(const std::string& name) {
  if (name == "directional") return LightKind::Directional;
  return name == "spot" ? LightKind::Spot : LightKind::Point;
}

}  // namespace

std::vector<Material> readMaterials(const Source& source) {
  std::vector<Material> materials;
  for (std::size_t i = 0; i < source.model.materials.size(); ++i) {
    materials.push_back(
        readMaterial(source, source.model.materials[i], source.document.json["materials"][i]));
  }
  materials.emplace_back();
  return materials;
}

std::vector<Light> readLights(const Source& source) {
  std::vector<Light> lights;
  for (const tinygltf::Light& from : source.model.lights) {
    Light light;
    light.name = from.name;
    light.kind = lightKindOf(from.type);
    light.colour = vec3Of(from.color, glm::vec3(1.0F));
    light.intensity = static_cast<float>(from.intensity);
    light.range_m = static_cast<float>(from.range);
    light.inner_cone_rad = static_cast<float>(from.spot.innerConeAngle);
    light.outer_cone_rad = static_cast<float>(from.spot.outerConeAngle);
    lights.push_back(std::move(light));
  }
  return lights;
}

}  // namespace host::gltf
