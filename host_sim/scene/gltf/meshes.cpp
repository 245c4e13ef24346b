// Meshes: any glTF primitive as indexed triangles with normals, and tangents where a normal map wants them.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/gltf/check.h"
#include "scene/gltf/parts.h"

namespace host::gltf {

namespace {

// Primitives may share accessors, so a small file can ask for a lot.
constexpr std::size_t kMostVertices = 32U << 20;
constexpr std::size_t kMostIndices = 128U << 20;

struct Budget {
  std::size_t vertices = 0;
  std::size_t indices = 0;
};

/// One primitive being read.
struct Reading {
  const Source& source;
  const tinygltf::Primitive& from;
  const std::string& where;

  int attribute(const char* name) const {
    const auto found = from.attributes.find(name);
    return found == from.attributes.end() ? -1 : found->second;
  }

  template <int N>
  std::vector<glm::vec<N, float>> vectors(const char* name, std::size_t vertices) const {
    const int accessor = attribute(name);
    if (accessor < 0) return {};
    if (source.count(accessor) != vertices) {
      fail(where, std::string(name) + " has " + std::to_string(source.count(accessor)) +
                      " elements, POSITION has " + std::to_string(vertices));
    }
    return source.vectors<N>(accessor, where + ": " + name);
  }
};

std::vector<glm::vec4> readColours(const Reading& reading, std::size_t vertices) {
  const int accessor = reading.attribute("COLOR_0");
  if (accessor < 0) return {};
  if (reading.source.components(accessor) == 4) return reading.vectors<4>("COLOR_0", vertices);
  const std::vector<glm::vec3> rgb = reading.vectors<3>("COLOR_0", vertices);
  std::vector<glm::vec4> colours;
  colours.reserve(rgb.size());
  for (const glm::vec3& colour : rgb) colours.emplace_back(colour, 1.0F);
  return colours;
}

/// Strips and fans as triangles (glTF 2.0, 3.7.2.1).
std::vector<std::uint32_t> triangles(const std::vector<std::uint32_t>& in, int mode) {
  const std::size_t whole = in.size() - in.size() % 3;
  if (mode == TINYGLTF_MODE_TRIANGLES) return {in.begin(), in.begin() + static_cast<std::ptrdiff_t>(whole)};
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i + 2 < in.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      out.insert(out.end(), {in[i + 1], in[i + 2], in[0]});
    } else {
      out.insert(out.end(), {in[i], in[i + 1 + i % 2], in[i + 2 - i % 2]});
    }
  }
  return out;
}

std::vector<std::uint32_t> readIndices(const Reading& reading, std::size_t vertices) {
  std::vector<std::uint32_t> indices(vertices);
  if (reading.from.indices < 0) {
    std::iota(indices.begin(), indices.end(), 0U);
  } else {
    indices = reading.source.integers(reading.from.indices, reading.where + ": indices");
    const auto beyond =
        std::find_if(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= vertices; });
    if (beyond != indices.end()) {
      fail(reading.where, "index " + std::to_string(beyond - indices.begin()) + " is " +
                              std::to_string(*beyond) + ", but there are only " + std::to_string(vertices) +
                              " vertices");
    }
  }
  return triangles(indices, reading.from.mode);
}

glm::vec3 normalOr(const glm::vec3& vector, const glm::vec3& otherwise) {
  const float length = glm::length(vector);
  return length > 1e-12F && std::isfinite(length) ? vector / length : otherwise;
}

template <typename T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
  if (values.empty()) return;
  std::vector<T> unshared;
  unshared.reserve(indices.size());
  for (const std::uint32_t i : indices) unshared.push_back(values[i]);
  values = std::move(unshared);
}

/// Flat normals, as glTF 2.0, 3.7.2.1 asks for where none are given: each triangle gets vertices of its own.
void makeFlatNormals(Primitive& p) {
  unshare(p.positions_m, p.indices);
  unshare(p.uv0, p.indices);
  unshare(p.uv1, p.indices);
  unshare(p.colours, p.indices);
  p.tangents.clear();  // without normals they are to be ignored
  std::iota(p.indices.begin(), p.indices.end(), 0U);
  p.normals.resize(p.positions_m.size());
  for (std::size_t i = 0; i < p.positions_m.size(); i += 3) {
    const glm::vec3 edge = p.positions_m[i + 1] - p.positions_m[i];
    const glm::vec3 normal =
        normalOr(glm::cross(edge, p.positions_m[i + 2] - p.positions_m[i]), {0.0F, 1.0F, 0.0F});
    for (std::size_t k = 0; k < 3; ++k) p.normals[i + k] = normal;
  }
}

/// Tangents along increasing u, averaged over a vertex's triangles (Lengyel 2001, "Computing tangent space
/// basis vectors").
void makeTangents(Primitive& p, const std::vector<glm::vec2>& uv) {
  std::vector<glm::vec3> along_u(p.positions_m.size(), glm::vec3(0.0F));
  std::vector<glm::vec3> along_v = along_u;
  for (std::size_t i = 0; i < p.indices.size(); i += 3) {
    const std::array<std::uint32_t, 3> t = {p.indices[i], p.indices[i + 1], p.indices[i + 2]};
    const glm::vec3 e1 = p.positions_m[t[1]] - p.positions_m[t[0]];
    const glm::vec3 e2 = p.positions_m[t[2]] - p.positions_m[t[0]];
    const glm::vec2 d1 = uv[t[1]] - uv[t[0]];
    const glm::vec2 d2 = uv[t[2]] - uv[t[0]];
    const float area = d1.x * d2.y - d2.x * d1.y;
    if (!(std::abs(area) > 1e-20F)) continue;
    for (const std::uint32_t v : t) {
      along_u[v] += (e1 * d2.y - e2 * d1.y) / area;
      along_v[v] += (e2 * d1.x - e1 * d2.x) / area;
    }
  }
  p.tangents.resize(p.positions_m.size());
  for (std::size_t v = 0; v < p.positions_m.size(); ++v) {
    const glm::vec3& n = p.normals[v];
    const glm::vec3 any = std::abs(n.x) < 0.9F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec3 fallback = glm::normalize(any - n * glm::dot(n, any));
    const glm::vec3 tangent = normalOr(along_u[v] - n * glm::dot(n, along_u[v]), fallback);
    const bool mirrored =
        glm::dot(glm::cross(n, tangent), along_v[v]) > 0.0F;  // v grows downwards in the image
    p.tangents[v] = glm::vec4(tangent, mirrored ? -1.0F : 1.0F);
  }
}

void setBounds(Primitive& p) {
  p.min_m = p.max_m = p.positions_m.front();
  for (const glm::vec3& position : p.positions_m) {
    p.min_m = glm::min(p.min_m, position);
    p.max_m = glm::max(p.max_m, position);
  }
}

void spend(Budget& budget, std::size_t vertices, std::size_t indices, const std::string& where) {
  budget.vertices += vertices;
  budget.indices += indices;
  if (budget.vertices > kMostVertices) fail(where, "takes the file above 32 million vertices");
  if (budget.indices > kMostIndices) fail(where, "takes the file above 128 million indices");
}

Primitive readPrimitive(const Reading& reading, const std::vector<Material>& materials, Budget& budget) {
  const tinygltf::Primitive& from = reading.from;
  const std::size_t vertices = reading.source.count(reading.attribute("POSITION"));
  const std::size_t indices = from.indices < 0 ? vertices : reading.source.count(from.indices);
  spend(budget, vertices, from.mode == TINYGLTF_MODE_TRIANGLES ? indices : 3 * indices, reading.where);
  Primitive p;
  p.positions_m = reading.vectors<3>("POSITION", vertices);
  p.normals = reading.vectors<3>("NORMAL", vertices);
  p.tangents = reading.vectors<4>("TANGENT", vertices);
  p.uv0 = reading.vectors<2>("TEXCOORD_0", vertices);
  p.uv1 = reading.vectors<2>("TEXCOORD_1", vertices);
  p.colours = readColours(reading, vertices);
  p.indices = readIndices(reading, vertices);
  p.material = from.material < 0 ? static_cast<int>(materials.size()) - 1 : from.material;
  if (p.indices.empty()) fail(reading.where, "has no triangle");
  if (p.normals.empty()) {
    spend(budget, p.indices.size(), 0, reading.where);
    makeFlatNormals(p);
  }
  for (glm::vec3& normal : p.normals) normal = normalOr(normal, {0.0F, 1.0F, 0.0F});
  const TextureUse& normal_map = materials[static_cast<std::size_t>(p.material)].normal_map;
  const std::vector<glm::vec2>& uv = normal_map.uv_set == 1 ? p.uv1 : p.uv0;
  if (normal_map && p.tangents.empty() && !uv.empty()) makeTangents(p, uv);
  setBounds(p);
  return p;
}

}  // namespace

std::vector<Mesh> readMeshes(const Source& source, const std::vector<Material>& materials,
                             std::vector<std::string>& warnings) {
  std::vector<Mesh> meshes;
  Budget budget;
  for (std::size_t m = 0; m < source.model.meshes.size(); ++m) {
    const tinygltf::Mesh& from = source.model.meshes[m];
    Mesh mesh{from.name, {}};
    for (std::size_t i = 0; i < from.primitives.size(); ++i) {
      const std::string where =
          elementOf(source.document, "meshes", "mesh", m) + ": primitives[" + std::to_string(i) + "]";
      if (from.primitives[i].mode < TINYGLTF_MODE_TRIANGLES && from.primitives[i].mode >= 0) {
        warnings.push_back(where + ": points and lines are not shown");
        continue;
      }
      mesh.primitives.push_back(readPrimitive({source, from.primitives[i], where}, materials, budget));
    }
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace host::gltf
