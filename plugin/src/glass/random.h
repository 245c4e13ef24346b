// Random numbers as a stream that a key starts: the same key, the same stream.
#pragma once

#include <cmath>
#include <cstdint>

#include "shared/hash.glsl"

namespace rg::glass {

class Stream {
 public:
  Stream(uint64_t seed, uint32_t a, uint64_t b, uint32_t c = 0) {
    const shared::uvec4 h =
        shared::pcg4d({static_cast<uint32_t>(seed) ^ shared::pcg(c), static_cast<uint32_t>(seed >> 32) ^ a,
                       static_cast<uint32_t>(b), static_cast<uint32_t>(b >> 32) + 0x9e3779b9u * (c + 1u)});
    key_ = h.x;
    weyl_ = h.y | 1u;
  }
  uint32_t next() { return shared::pcg(key_ += weyl_); }
  double unit() { return static_cast<double>(shared::openUnitFloat(next())); }  // in (0, 1)

 private:
  uint32_t key_, weyl_;
};

// A Poisson number: products of uniforms (Knuth), in portions so that exp(-mean) stays in range.
inline uint32_t poisson(Stream& random, double mean) {
  uint32_t count = 0;
  while (mean > 0.0) {
    const double limit = std::exp(-std::fmin(mean, 30.0));
    double product = random.unit();
    while (product > limit) {
      product *= random.unit();
      ++count;
    }
    mean -= 30.0;
  }
  return count;
}

}  // namespace rg::glass
