// Light that goes astray in the driver's eye: what makes a lamp at night veil the road beside it.
#pragma once

#include <vector>

namespace rg::surroundings {

inline constexpr double kGlareFrom_deg = 0.1, kGlareTo_deg = 60.0;

// Share of a lamp's light that an eye spreads between two angles from it, kGlareFrom_deg <= from <= to <=
// kGlareTo_deg: the integral over that ring of the CIE's general equation of disability glare (CIE 135/1; Vos
// & van den Berg 1999), L / E = 10 / t^3 + (5 / t^2 + 0.1 p / t) (1 + (age / 62.5)^4) + 0.0025 p with t in
// degrees, for an eye of 40 years and brown (p = 0.5). The ring's area is taken as flat, 2 pi t dt.
double scatteredShare(double from_deg, double to_deg);

// How much of a picture's light goes to each of its ever coarser levels, of texels 2, 4, 8 .. px wide, drawn
// smoothly one over the other; `focal_px`: pixels to a radian in the picture's middle. Rings beyond the last
// level are not spread: their light stays where it is.
std::vector<float> glareShares(double focal_px, int levels);

}  // namespace rg::surroundings
