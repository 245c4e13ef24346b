#include "scene/gltf/meaning.h"

#include <array>
#include <utility>

namespace host::gltf {

namespace {

constexpr std::size_t kMostRouteNumbers = 3'000'000;
constexpr double kRadPerDeg = 0.017453292519943295;

float metres(const Fields& f, const char* key, double lowest, double highest) {
  return static_cast<float>(f.number(key, lowest, highest));
}

float radians(const Fields& f, const char* key, double lowest_deg, double highest_deg,
              std::optional<double> otherwise_deg) {
  return static_cast<float>(f.number(key, lowest_deg, highest_deg, otherwise_deg) * kRadPerDeg);
}

std::string readName(const Fields& f, const char* key = "name") {
  std::string name = f.text(key, kLongestName_bytes);
  if (name.empty()) f.failAt(key, "is empty");
  return name;
}

template <typename T, std::size_t N>
T oneOf(const Fields& f, const char* key, const std::array<std::pair<const char*, T>, N>& choices,
        const std::string& value) {
  std::string known;
  for (const auto& [name, choice] : choices) {
    if (value == name) return choice;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  f.failAt(key, "is \"" + value.substr(0, kLongestName_bytes) + "\", must be one of " + known);
}

Meaning readPane(const Fields& f) {
  f.allowOnly({"type", "name", "glass"});
  const std::string name = readName(f);
  return PaneMeaning{name, oneOf(f, "glass", kGlassSurfaces, f.text("glass", 1000, "uncoated"))};
}

Meaning readShelter(const Fields& f) {
  f.allowOnly({"type", "name"});
  return ShelterMeaning{readName(f)};
}

constexpr double kUsualWear = 0.3;  // of blades that have been on the road for some months

Meaning readWiper(const Fields& f) {
  f.allowOnly(
      {"type", "name", "pane", "arm_m", "blade_m", "blade_angle_deg", "sweep_deg", "blade_turn", "wear"});
  WiperMeaning wiper;
  wiper.name = readName(f);
  wiper.pane = readName(f, "pane");
  wiper.arm_m = metres(f, "arm_m", 0.05, 2.0);
  wiper.blade_m = metres(f, "blade_m", 0.05, 2.0);
  wiper.blade_angle_rad = radians(f, "blade_angle_deg", -180.0, 180.0, 0.0);
  wiper.sweep_rad = radians(f, "sweep_deg", -180.0, 180.0, {});
  if (std::abs(f.number("sweep_deg", -180.0, 180.0)) < 5.0) f.failAt("sweep_deg", "must be 5..180 in size");
  wiper.blade_turn = static_cast<float>(f.number("blade_turn", -2.0, 2.0, 0.0));
  wiper.wear = static_cast<float>(f.number("wear", 0.0, 1.0, kUsualWear));
  return wiper;
}

Meaning readEye(const Fields& f) {
  f.allowOnly({"type", "pitch_deg", "fov_deg"});
  return EyeMeaning{radians(f, "pitch_deg", -90.0, 90.0, 0.0), radians(f, "fov_deg", 20.0, 120.0, 60.0)};
}

Meaning readCamera(const Fields& f) {
  f.allowOnly({"type", "name", "yaw_deg", "pitch_deg", "fov_deg", "inside"});
  return CameraMeaning{readName(f), radians(f, "yaw_deg", -180.0, 180.0, 0.0),
                       radians(f, "pitch_deg", -90.0, 90.0, 0.0), radians(f, "fov_deg", 20.0, 120.0, 60.0),
                       f.flag("inside", false)};
}

Meaning readRoute(const Fields& f) {
  f.allowOnly({"type", "points_m", "closed"});
  if (!f.has("points_m")) f.failAt("points_m", "is missing");
  const std::vector<float> numbers = f.numbers("points_m", 6, kMostRouteNumbers);
  if (numbers.size() % 3 != 0) {
    f.failAt("points_m", "has " + std::to_string(numbers.size()) + " numbers, must have a multiple of 3");
  }
  RouteMeaning route;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    route.points_m.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  for (std::size_t i = 1; i < route.points_m.size(); ++i) {
    const float step_m = glm::distance(route.points_m[i - 1], route.points_m[i]);
    if (!(step_m > 1e-3F)) f.failAt("points_m", "has the same point twice in a row, at " + std::to_string(i));
    if (!(step_m < 1e5F))
      f.failAt("points_m", "has a gap of more than 100 km, before point " + std::to_string(i));
  }
  route.closed = f.flag("closed", false);
  return route;
}

Meaning readLight(const Fields& f) {
  static constexpr std::array<std::pair<const char*, LightRole>, 6> kRoles = {
      {{"head", LightRole::Head},
       {"tail", LightRole::Tail},
       {"brake", LightRole::Brake},
       {"indicator", LightRole::Indicator},
       {"street", LightRole::Street},
       {"interior", LightRole::Interior}}};
  f.allowOnly({"type", "role"});
  return LightMeaning{oneOf(f, "role", kRoles, f.text("role", 1000))};
}

Meaning readWheel(const Fields& f) {
  f.allowOnly({"type", "radius_m", "steers"});
  return WheelMeaning{metres(f, "radius_m", 0.1, 2.0), f.flag("steers", false)};
}

Meaning readSteeringWheel(const Fields& f) {
  f.allowOnly({"type", "ratio"});
  return SteeringWheelMeaning{static_cast<float>(f.number("ratio", 1.0, 100.0, 15.0))};
}

Reading readReading(const Fields& f) {
  static constexpr std::array<std::pair<const char*, Reading>, 2> kReadings = {
      {{"speed_kmh", Reading::Speed_kmh}, {"engine_rpm", Reading::Engine_rpm}}};
  return oneOf(f, "shows", kReadings, f.text("shows", 1000));
}

Meaning readNeedle(const Fields& f) {
  f.allowOnly({"type", "shows", "full", "sweep_deg"});
  return NeedleMeaning{readReading(f), static_cast<float>(f.number("full", 1.0, 1e5)),
                       radians(f, "sweep_deg", -360.0, 360.0, {})};
}

Meaning readDigit(const Fields& f) {
  f.allowOnly({"type", "shows", "place"});
  return DigitMeaning{readReading(f), static_cast<int>(f.integer("place", 0, 5))};
}

Meaning readMirror(const Fields& f) {
  f.allowOnly({"type", "name", "wet"});
  return MirrorMeaning{f.text("name", kLongestName_bytes, ""), f.flag("wet", false)};
}

using Read = Meaning (*)(const Fields&);
constexpr std::array<std::pair<const char*, Read>, 12> kTypes = {{{"pane", readPane},
                                                                  {"shelter", readShelter},
                                                                  {"wiper", readWiper},
                                                                  {"eye", readEye},
                                                                  {"camera", readCamera},
                                                                  {"route", readRoute},
                                                                  {"light", readLight},
                                                                  {"wheel", readWheel},
                                                                  {"steering_wheel", readSteeringWheel},
                                                                  {"needle", readNeedle},
                                                                  {"digit", readDigit},
                                                                  {"mirror", readMirror}}};

}  // namespace

Meaning readMeaning(const Json& node, const std::string& where) {
  const auto extras = node.find("extras");
  if (extras == node.end() || !extras->is_object() || !extras->contains("rainglass")) return {};
  const Fields fields((*extras)["rainglass"], where, "extras.rainglass.");
  return oneOf(fields, "type", kTypes, fields.text("type", 1000))(fields);
}

}  // namespace host::gltf
