// The standing field by brute force: every cell of every class near the eye.
#pragma once

#include <cmath>
#include <vector>

#include "measure.h"
#include "rain/standing.h"

namespace rg::rain::test {

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
        const CandidateRow row(seed, eye.x + x, eye.y + y);
        for (int z = -far; z <= far; ++z) {
          const CellKey key{eye.x + x, eye.y + y, eye.z + z, kind};
          Candidates candidates(row, key.z, kind);
          while (const Candidate* c = candidates.next(least)) {
            if (c->id % one_of != 0) continue;
            LiveDrop d;
            d.key = {kind, key.x, key.y, key.z, c->id};
            d.kind = kind;
            d.diameter_m = 1e-3 * drawnDiameter_mm(lattice.drops.hydrometeor, air.quantile(kind, c->size));
            const dvec3 fraction = (dvec3(c->fraction_x, c->fraction_y, c->fraction_z) + 0.5) / 65536.0;
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
