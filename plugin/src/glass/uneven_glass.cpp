#include "glass/uneven_glass.h"

#include <algorithm>
#include <array>

#include "shared/glass_film.glsl"

namespace rg::glass {
namespace {

// What contact lines feel varies over some millimetres to some centimetres (Le Grand-Piteira, Daerr & Limat
// 2006, Phys. Rev. Lett. 96: streams on glass meander with centimetres to a bend; the shares are by eye).
struct Waves {
  double length_m, share;
};
constexpr std::array<Waves, 2> kWaves{{{22e-3, 0.65}, {9e-3, 0.35}}};
constexpr double kContrast = 2.0;  // sums of such waves keep close to their middle

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

// Value noise, 0 .. 1: random at the knots of a lattice, smooth between.
double noise(glm::dvec2 at, uint32_t seed) {
  const glm::dvec2 low = glm::floor(at), f = at - low;
  const auto knot = [&](int dx, int dy) {
    const auto x = static_cast<uint32_t>(static_cast<int32_t>(low.x) + dx),
               y = static_cast<uint32_t>(static_cast<int32_t>(low.y) + dy);
    return static_cast<double>(shared::unitFloat(shared::pcg(x + shared::pcg(y ^ shared::pcg(seed)))));
  };
  const double below = glm::mix(knot(0, 0), knot(1, 0), smooth(f.x)),
               above = glm::mix(knot(0, 1), knot(1, 1), smooth(f.x));
  return glm::mix(below, above, smooth(f.y));
}

}  // namespace

UnevenGlass::UnevenGlass(const PaneMap& map, uint32_t seed, double share) {
  levels_.reserve(static_cast<size_t>(map.texelCount()));
  for (int i = 0; i < map.texelCount(); ++i) {
    double sum = 0.0;
    for (uint32_t k = 0; k < kWaves.size(); ++k)
      sum += kWaves[k].share * noise(map.middleOf(i) / kWaves[k].length_m, seed + k);
    const double contrasted = std::clamp(0.5 + share * kContrast * (sum - 0.5), 0.0, 1.0);
    levels_.push_back(static_cast<uint8_t>(contrasted * shared::kMostUneven + 0.5));
  }
}

}  // namespace rg::glass
