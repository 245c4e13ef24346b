#pragma once
// What a node means to Rainglass: extras.rainglass, as models/README.md has it. Angles are in radians here.

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

namespace host {

enum class GlassSurface { Uncoated, Dirty, Coated, NewCoating };
inline constexpr std::array<std::pair<const char*, GlassSurface>, 4> kGlassSurfaces = {
    {{"uncoated", GlassSurface::Uncoated},
     {"dirty", GlassSurface::Dirty},
     {"coated", GlassSurface::Coated},
     {"new_coating", GlassSurface::NewCoating}}};
/// What an instrument tells.
enum class Reading { Speed_kmh, Engine_rpm };
enum class LightRole { Head, Tail, Brake, Indicator, Street, Interior };

struct PaneMeaning {
  std::string name;
  GlassSurface glass = GlassSurface::Uncoated;
};

struct ShelterMeaning {
  std::string name;
};

struct WiperMeaning {
  std::string name;
  std::string pane;
  float arm_m = 0.0F;            ///< pivot to the blade's middle
  float blade_m = 0.0F;          ///< blade's length
  float blade_angle_rad = 0.0F;  ///< from the arm's direction to the blade's
  float sweep_rad = 0.0F;        ///< signed, about the node's +Y, rest to far reversal
  float blade_turn = 0.0F;       ///< of the blade on its arm, for each radian of the arm; -1: a pantograph
  float wear = 0.0F;             ///< 0 a new blade .. 1
};

struct EyeMeaning {
  float pitch_rad = 0.0F;      ///< up positive
  float fov_rad = 1.0471976F;  ///< horizontal
};

struct CameraMeaning {
  std::string name;
  float yaw_rad = 0.0F;        ///< to the left positive, from the car's forward direction
  float pitch_rad = 0.0F;      ///< up positive
  float fov_rad = 1.0471976F;  ///< horizontal
  bool inside = false;         ///< within the cabin
};

struct RouteMeaning {
  std::vector<glm::vec3> points_m;  ///< in the node's own axes
  bool closed = false;
};

struct LightMeaning {
  LightRole role = LightRole::Head;
};

struct WheelMeaning {
  float radius_m = 0.3F;
  bool steers = false;
};

struct SteeringWheelMeaning {
  float ratio = 15.0F;  ///< steering wheel angle / road wheel angle
};

struct NeedleMeaning {
  Reading shows = Reading::Speed_kmh;
  float full = 0.0F;       ///< what it shows at the end of its scale
  float sweep_rad = 0.0F;  ///< signed, about the node's +Y, from 0 to there
};

/// A drum of kDigitSides sides, turned about its node's +Y: an empty one, at rest in front, then 0 to 9.
struct DigitMeaning {
  Reading shows = Reading::Speed_kmh;
  int place = 0;  ///< 0 the ones, 1 the tens, ..
};
inline constexpr int kDigitSides = 11;

struct MirrorMeaning {
  std::string name;
  bool wet = false;  ///< rain falls on it
};

/// monostate: an ordinary node.
using Meaning = std::variant<std::monostate, PaneMeaning, ShelterMeaning, WiperMeaning, EyeMeaning,
                             CameraMeaning, RouteMeaning, LightMeaning, WheelMeaning, SteeringWheelMeaning,
                             NeedleMeaning, DigitMeaning, MirrorMeaning>;

}  // namespace host
