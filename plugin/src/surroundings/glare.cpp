#include "surroundings/glare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rg::surroundings {
namespace {

constexpr double kAgeFactor = 1.0 + 0.64 * 0.64 * 0.64 * 0.64;  // 40 / 62.5 years
constexpr double kPigment = 0.5;                                // brown eyes
constexpr double kPerDegree = std::numbers::pi / 180.0;

// A level of texels 2^k px wide shows a pixel's light as a bell of standard deviation 0.73 * 2^k px: a box of
// 2^k px (variance 1/12) under a cubic B-spline (1/3) of its own and of each coarser level's texels on the
// way (4/9 in all). Half of such a bell's light lies within 1.18 deviations; a level stands for the octave
// about that.
constexpr double kBellRadius = 0.73 * 1.18;

// Of the equation times t.
double primitive(double t) {
  return -10.0 / t + 5.0 * kAgeFactor * std::log(t) + 0.1 * kPigment * kAgeFactor * t +
         0.00125 * kPigment * t * t;
}

}  // namespace

double scatteredShare(double from_deg, double to_deg) {
  return 2.0 * std::numbers::pi * kPerDegree * kPerDegree * (primitive(to_deg) - primitive(from_deg));
}

std::vector<float> glareShares(double focal_px, int levels) {
  const auto angle_deg = [focal_px](double px) {
    return std::clamp(std::atan(px / focal_px) / kPerDegree, kGlareFrom_deg, kGlareTo_deg);
  };
  std::vector<float> shares;
  double px = kBellRadius * 2.0;
  for (int level = 0; level < levels; ++level, px *= 2.0)
    shares.push_back(static_cast<float>(
        scatteredShare(angle_deg(px / std::numbers::sqrt2), angle_deg(px * std::numbers::sqrt2))));
  return shares;
}

}  // namespace rg::surroundings
