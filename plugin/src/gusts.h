// Gusts: how the wind swings about its mean, as a function of seed and tick alone.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace rg {

// The wind swings along its mean and across it, which turns it. Each swing is a sum of three octaves of
// smooth noise whose variances fall with the length of an octave as those of eddies do, by the power of 2/3
// (Kolmogorov 1941). What lasts less is left out: it fills no more than a part of the space round a view, and
// heavy drops do not follow it. What is in counts for all the air round the views at once, and for drops of
// every size without delay (they take v_t / g, 0.2 .. 0.95 s). Left out too: swings up and down, and that a
// car in motion meets eddies more often than a mast.
struct Gusts {
  uint64_t seed = 1;
  double share = 0.0;    // standard deviation along the mean, by its speed (turbulence intensity); 0: none
  double time_s = 10.0;  // how long a gust lasts: the integral time scale

  // The wind at a tick with this mean; its vertical part stays. Within +-kStrongestWind_mps along an axis.
  glm::dvec3 at(int64_t tick, const glm::dvec3& mean_mps) const;
};

}  // namespace rg
