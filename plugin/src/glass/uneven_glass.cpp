#include "glass/uneven_glass.h"

#include <algorithm>
#include <cmath>

#include "shared/glass_film.glsl"

namespace rg::glass {
namespace {

// What contact lines feel varies over some millimetres to some centimetres (Le Grand-Piteira, Daerr & Limat
// 2006, Phys. Rev. Lett. 96: streams on glass meander with centimetres to a bend; values by eye).
constexpr double kCoarse_m = 22e-3, kFine_m = 9e-3, kCoarseShare = 0.65;
constexpr double kContrast = 2.0;  // sums of such waves keep close to their middle

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

// Value noise, 0 .. 1: random at the knots of a lattice, smooth between.
class Noise {
 public:
  Noise(glm::dvec2 extent_m, double length_m, uint32_t seed)
      : length_m_(length_m), knots_(glm::ivec2(extent_m / length_m) + 2) {
    for (int y = 0; y < knots_.y; ++y) {
      for (int x = 0; x < knots_.x; ++x)
        values_.push_back(shared::unitFloat(
            shared::pcg(static_cast<uint32_t>(x) + shared::pcg(static_cast<uint32_t>(y) ^ seed))));
    }
  }
  double at(glm::dvec2 place_m) const {
    const glm::dvec2 at = place_m / length_m_;
    const glm::ivec2 low(at);
    const glm::dvec2 f = at - glm::dvec2(low);
    const auto knot = [&](int x, int y) {
      return static_cast<double>(values_[static_cast<size_t>(y * knots_.x + x)]);
    };
    const double along = smooth(f.x);
    return glm::mix(glm::mix(knot(low.x, low.y), knot(low.x + 1, low.y), along),
                    glm::mix(knot(low.x, low.y + 1), knot(low.x + 1, low.y + 1), along), smooth(f.y));
  }

 private:
  double length_m_;
  glm::ivec2 knots_;
  std::vector<float> values_;
};

}  // namespace

UnevenGlass::UnevenGlass(const PaneMap& map, uint32_t seed, double share) {
  const glm::dvec2 extent_m = glm::dvec2(map.grid().size) * map.grid().texel_m;
  const Noise coarse(extent_m, kCoarse_m, shared::pcg(seed)), fine(extent_m, kFine_m, shared::pcg(seed + 1));
  levels_.reserve(static_cast<size_t>(map.texelCount()));
  for (int i = 0; i < map.texelCount(); ++i) {
    const glm::dvec2 place_m = map.middleOf(i);
    const double sum = glm::mix(fine.at(place_m), coarse.at(place_m), kCoarseShare);
    const double contrasted = std::clamp(0.5 + share * kContrast * (sum - 0.5), 0.0, 1.0);
    levels_.push_back(static_cast<uint8_t>(std::lround(contrasted * shared::kMostUneven)));
  }
}

}  // namespace rg::glass
