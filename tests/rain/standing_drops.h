// The standing field by brute force: every cell of every class near the eye.
#pragma once

#include <cmath>
#include <vector>

#include "measure.h"
#include "rain/standing.h"

namespace rg::rain::test {

// A cell's candidates one by one, as Candidates tells what they are.
class OneByOne {
 public:
  OneByOne(uint64_t seed, const CellKey& key)
      : state_(splitMix(splitMix(splitMix(seed + kSplitMixStep) ^ wide(key.x, key.y)) +
                        wide(key.z, static_cast<int32_t>(key.kind)))) {}
  // False when the next one's chance, and so every later one's, is not above `least`.
  bool next(double least) {
    const uint64_t a = draw();
    chance *= open(a >> 32);
    if (chance <= least) return false;
    const uint64_t b = draw();
    size = open(a & 0xffffffffu);
    fraction = dvec3(b & 0xffffu, b >> 16 & 0xffffu, b >> 32 & 0xffffu);
    id = static_cast<uint32_t>(a ^ b >> 32);
    return true;
  }
  double chance = 1.0, size = 0.0;
  dvec3 fraction{0.0};
  uint32_t id = 0;

 private:
  static uint64_t wide(int32_t high, int32_t low) {
    return uint64_t{static_cast<uint32_t>(high)} << 32 | static_cast<uint32_t>(low);
  }
  static double open(uint64_t bits) { return (static_cast<double>(bits) + 0.5) * 0x1p-32; }
  uint64_t draw() { return splitMix(state_ += kSplitMixStep); }
  uint64_t state_;
};

// All drops that the standing field holds within the view's volume, sheltered or not; of many one of so many.
inline std::vector<LiveDrop> standingDrops(uint64_t seed, const Picture& picture, const Cone& cone,
                                           const InTheAir& air, uint32_t one_of = 1) {
  std::vector<LiveDrop> found;
  for (uint32_t kind = 0; kind < kBouncedClass; ++kind) {
    const ClassLattice& lattice = classLattices()[kind];
    const double least = std::exp(-air.density_m3[kind] * lattice.cell_m3);
    const glm::ivec3 eye(glm::floor((cone.eye_m - picture.classes[kind].origin_m) / lattice.cell_m));
    const int far = static_cast<int>(kReachPerDiameter * 1e-3 * lattice.reach_mm / lattice.cell_m) + 2;
    for (int x = -far; x <= far; ++x) {
      for (int y = -far; y <= far; ++y) {
        for (int z = -far; z <= far; ++z) {
          const CellKey key{eye.x + x, eye.y + y, eye.z + z, kind};
          OneByOne candidate(seed, key);
          while (candidate.next(least)) {
            if (candidate.id % one_of != 0) continue;
            LiveDrop d;
            d.key = {kind, key.x, key.y, key.z, candidate.id};
            d.kind = kind;
            d.diameter_m =
                1e-3 * drawnDiameter_mm(lattice.drops.hydrometeor, air.quantile(kind, candidate.size));
            const dvec3 fraction = (candidate.fraction + 0.5) / 65536.0;
            d.place_m =
                picture.classes[kind].origin_m + (dvec3(key.x, key.y, key.z) + fraction) * lattice.cell_m;
            d.velocity_mps = picture.classes[kind].velocity_mps;
            if (inVolume(cone, d.place_m, d.reach_m())) found.push_back(d);
          }
        }
      }
    }
  }
  return found;
}

}  // namespace rg::rain::test
