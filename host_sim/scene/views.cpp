#include "scene/views.h"

#include <algorithm>

namespace host {

namespace {

/// Calls visit(index, node, meaning) for each node of the scene with meaning T.
template <typename T, typename Visit>
void eachMeaning(const Scene& scene, Visit&& visit) {
  for (const int index : scene.order) {
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    if (const T* meaning = std::get_if<T>(&node.meaning)) visit(index, node, *meaning);
  }
}

glm::vec3 origin(const glm::mat4& matrix) { return glm::vec3(matrix[3]); }
glm::vec3 unitAxis(const glm::mat4& matrix, int axis) { return glm::normalize(glm::vec3(matrix[axis])); }

const Mesh& meshOf(const Scene& scene, const Node& node) {
  return scene.meshes[static_cast<std::size_t>(node.mesh)];
}

void appendPrimitive(PaneView& pane, const Primitive& primitive, const glm::mat4& matrix) {
  const auto base = static_cast<std::uint32_t>(pane.positions_m.size());
  const glm::mat3 normal_matrix = glm::transpose(glm::inverse(glm::mat3(matrix)));
  for (const glm::vec3& p : primitive.positions_m) pane.positions_m.emplace_back(matrix * glm::vec4(p, 1.0F));
  for (const glm::vec3& n : primitive.normals) pane.normals.push_back(glm::normalize(normal_matrix * n));
  pane.uv.insert(pane.uv.end(), primitive.uv0.begin(), primitive.uv0.end());
  const bool mirrored = glm::determinant(glm::mat3(matrix)) < 0.0F;  // turns triangles inside out
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    std::array<std::uint32_t, 3> t = {primitive.indices[i], primitive.indices[i + 1],
                                      primitive.indices[i + 2]};
    if (mirrored) std::swap(t[1], t[2]);
    for (const std::uint32_t vertex : t) pane.indices.push_back(base + vertex);
  }
}

std::vector<PaneView> panesOf(const Scene& scene, const glm::mat4& frame) {
  std::vector<PaneView> panes;
  eachMeaning<PaneMeaning>(scene, [&](int index, const Node& node, const PaneMeaning& meaning) {
    PaneView pane{meaning.name, meaning.glass, index, {}, {}, {}, {}};
    for (const Primitive& p : meshOf(scene, node).primitives)
      appendPrimitive(pane, p, frame * node.scene_from_node);
    panes.push_back(std::move(pane));
  });
  return panes;
}

std::vector<ShelterView> sheltersOf(const Scene& scene, const glm::mat4& frame) {
  std::vector<ShelterView> shelters;
  eachMeaning<ShelterMeaning>(scene, [&](int index, const Node& node, const ShelterMeaning& meaning) {
    ShelterView shelter{meaning.name, index, {}};
    const glm::mat4 matrix = frame * node.scene_from_node;
    for (const Primitive& primitive : meshOf(scene, node).primitives) {
      for (const glm::vec3& p : primitive.positions_m)
        shelter.points_m.emplace_back(matrix * glm::vec4(p, 1.0F));
    }
    // A box has each corner thrice, once per face.
    const auto before = [](const glm::vec3& a, const glm::vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::sort(shelter.points_m.begin(), shelter.points_m.end(), before);
    shelter.points_m.erase(std::unique(shelter.points_m.begin(), shelter.points_m.end()),
                           shelter.points_m.end());
    shelters.push_back(std::move(shelter));
  });
  return shelters;
}

std::vector<WiperView> wipersOf(const Scene& scene, const glm::mat4& frame,
                                const std::vector<PaneView>& panes) {
  std::vector<WiperView> wipers;
  eachMeaning<WiperMeaning>(scene, [&](int index, const Node& node, const WiperMeaning& meaning) {
    const glm::mat4 matrix = frame * node.scene_from_node;
    WiperView wiper;
    wiper.name = meaning.name;
    wiper.pane = meaning.pane;
    const auto pane =
        std::find_if(panes.begin(), panes.end(), [&](const PaneView& p) { return p.name == meaning.pane; });
    wiper.pane_index = static_cast<int>(pane - panes.begin());
    wiper.node = index;
    wiper.pivot_m = origin(matrix);
    wiper.axis = unitAxis(matrix, 1);
    const glm::vec3 x = unitAxis(matrix, 0);
    wiper.rest_direction = glm::normalize(x - wiper.axis * glm::dot(wiper.axis, x));
    wiper.arm_m = meaning.arm_m;
    wiper.blade_m = meaning.blade_m;
    wiper.blade_angle_rad = meaning.blade_angle_rad;
    wiper.sweep_rad = meaning.sweep_rad;
    wiper.blade_turn = meaning.blade_turn;
    wiper.wear = meaning.wear;
    wipers.push_back(std::move(wiper));
  });
  return wipers;
}

glm::vec3 meshCentre(const Mesh& mesh) {
  glm::vec3 low = mesh.primitives.front().min_m;
  glm::vec3 high = mesh.primitives.front().max_m;
  for (const Primitive& primitive : mesh.primitives) {
    low = glm::min(low, primitive.min_m);
    high = glm::max(high, primitive.max_m);
  }
  return 0.5F * (low + high);
}

std::vector<LampView> lampsOf(const Scene& scene, const glm::mat4& frame) {
  std::vector<LampView> lamps;
  eachMeaning<LightMeaning>(scene, [&](int index, const Node& node, const LightMeaning& meaning) {
    const glm::mat4 matrix = frame * node.scene_from_node;
    LampView lamp{meaning.role, index, node.light, origin(matrix), -unitAxis(matrix, 2)};
    if (node.light < 0)
      lamp.position_m = glm::vec3(matrix * glm::vec4(meshCentre(meshOf(scene, node)), 1.0F));
    lamps.push_back(lamp);
  });
  return lamps;
}

glm::vec3 meanNormal(const Mesh& mesh, const glm::mat4& matrix) {
  glm::vec3 sum(0.0F);
  for (const Primitive& primitive : mesh.primitives) {
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) {
        return glm::vec3(matrix * glm::vec4(primitive.positions_m[primitive.indices[i + k]], 1.0F));
      };
      sum += glm::cross(at(1) - at(0), at(2) - at(0));
    }
  }
  if (glm::determinant(glm::mat3(matrix)) < 0.0F) sum = -sum;
  return glm::length(sum) > 0.0F ? glm::normalize(sum) : glm::vec3(-1.0F, 0.0F, 0.0F);
}

void readParts(const Scene& scene, const glm::mat4& frame, CarView& car) {
  eachMeaning<EyeMeaning>(scene, [&](int, const Node& node, const EyeMeaning& eye) {
    car.eye = {origin(frame * node.scene_from_node), eye.pitch_rad, eye.fov_rad, true};
  });
  eachMeaning<CameraMeaning>(scene, [&](int, const Node& node, const CameraMeaning& camera) {
    car.cameras.push_back({camera.name, origin(frame * node.scene_from_node), camera.yaw_rad,
                           camera.pitch_rad, camera.fov_rad, camera.inside});
  });
  eachMeaning<WheelMeaning>(scene, [&](int index, const Node& node, const WheelMeaning& wheel) {
    const glm::mat4 matrix = frame * node.scene_from_node;
    car.wheels.push_back({index, origin(matrix), unitAxis(matrix, 0), wheel.radius_m, wheel.steers});
  });
  eachMeaning<SteeringWheelMeaning>(
      scene, [&](int index, const Node& node, const SteeringWheelMeaning& wheel) {
        const glm::mat4 matrix = frame * node.scene_from_node;
        car.steering_wheel = SteeringWheelView{index, origin(matrix), unitAxis(matrix, 1), wheel.ratio};
      });
  eachMeaning<NeedleMeaning>(scene, [&](int index, const Node&, const NeedleMeaning& needle) {
    car.needles.push_back({index, needle});
  });
  eachMeaning<DigitMeaning>(scene, [&](int index, const Node&, const DigitMeaning& digit) {
    car.digits.push_back({index, digit});
  });
  eachMeaning<MirrorMeaning>(scene, [&](int index, const Node& node, const MirrorMeaning& mirror) {
    const glm::mat4 matrix = frame * node.scene_from_node;
    const Mesh& mesh = meshOf(scene, node);
    const glm::vec3 centre_m(matrix * glm::vec4(meshCentre(mesh), 1.0F));
    PaneView face;
    face.name = mirror.name;
    face.node = index;
    for (const Primitive& p : mesh.primitives) appendPrimitive(face, p, matrix);
    car.mirrors.push_back(
        {mirror.name, index, centre_m, meanNormal(mesh, matrix), std::move(face), mirror.wet});
  });
}

}  // namespace

glm::mat4 vehicleFromGltf() {
  return {
      {0.0F, 1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F, 1.0F}};
}

glm::mat4 worldFromGltf() {
  return {{1.0F, 0.0F, 0.0F, 0.0F},
          {0.0F, 0.0F, 1.0F, 0.0F},
          {0.0F, -1.0F, 0.0F, 0.0F},
          {0.0F, 0.0F, 0.0F, 1.0F}};
}

CarView carView(const Scene& scene) {
  const glm::mat4 frame = vehicleFromGltf();
  CarView car;
  car.panes = panesOf(scene, frame);
  car.shelters = sheltersOf(scene, frame);
  car.wipers = wipersOf(scene, frame, car.panes);
  car.lamps = lampsOf(scene, frame);
  readParts(scene, frame, car);
  return car;
}

RoadView roadView(const Scene& scene) {
  const glm::mat4 frame = worldFromGltf();
  RoadView road{sheltersOf(scene, frame), {}, lampsOf(scene, frame)};
  eachMeaning<RouteMeaning>(scene, [&](int, const Node& node, const RouteMeaning& meaning) {
    RouteView route{{}, meaning.closed};
    for (const glm::vec3& p : meaning.points_m) {
      route.points_m.emplace_back(frame * node.scene_from_node * glm::vec4(p, 1.0F));
    }
    road.route = std::move(route);
  });
  return road;
}

void turnNode(const Scene& scene, int node, glm::vec3 local_axis, float angle_rad, std::vector<Pose>& poses) {
  const auto i = static_cast<std::size_t>(node);
  poses[i].rotation = scene.nodes[i].pose.rotation * glm::angleAxis(angle_rad, local_axis);
}

}  // namespace host
