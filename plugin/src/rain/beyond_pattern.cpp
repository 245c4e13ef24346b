#include "rain/beyond_pattern.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace rg::rain {
namespace {

constexpr int kSize_px = 256;
// All by eye (unsourced), but for streaks' length: so dense that they just stand out from an even half. Each
// lies where chance has put it, without broader bands: those come again with every turn of the pattern, and
// make combed hair of rain.
constexpr int kStreaks = 2000;
constexpr double kEven = 0.4;      // of the mean, everywhere
constexpr double kGreatest = 3.0;  // times the mean
constexpr double kRelief = 2.0;    // slope of normals at a streak's flank

double unit(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

size_t index(int x, int y) {
  const auto wrapped = [](int i) { return static_cast<size_t>((i % kSize_px + kSize_px) % kSize_px); };
  return wrapped(y) * kSize_px + wrapped(x);
}

// A rounded streak with soft ends, across the pattern's edges where it lies there.
void addStreak(double x, double y, double length_px, double width_px, double strength,
               std::vector<double>& rain) {
  const int reach_x = static_cast<int>(2.5 * width_px) + 1, reach_y = static_cast<int>(0.5 * length_px) + 1;
  for (int j = -reach_y; j <= reach_y; ++j) {
    for (int i = -reach_x; i <= reach_x; ++i) {
      const double u = (std::floor(x) + i - x) / width_px, v = (std::floor(y) + j - y) / (0.5 * length_px);
      const double along = std::max(0.0, 1.0 - v * v);
      rain[index(static_cast<int>(x) + i, static_cast<int>(y) + j)] += strength * std::exp(-u * u) * along;
    }
  }
}

uint8_t byteOf(double share) {
  return static_cast<uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

std::string makePattern(uint32_t width_px, uint32_t height_px, std::vector<uint8_t> rgba, RainPattern& out) {
  for (const uint32_t side : {width_px, height_px}) {
    if (side < RainPattern::kSmallest_px || side > RainPattern::kLargest_px)
      return "rain pattern: " + std::to_string(width_px) + " x " + std::to_string(height_px) +
             " pixels, must be 8 .. 4096 a side";
  }
  uint64_t sum = 0;
  uint8_t greatest = 0;
  for (size_t i = 3; i < rgba.size(); i += 4) {
    sum += rgba[i];
    greatest = std::max(greatest, rgba[i]);
  }
  if (sum == 0) return "rain pattern: its alpha is 0 everywhere, so there is no rain in it";
  out.width_px = width_px;
  out.height_px = height_px;
  out.mean = static_cast<double>(sum) / (255.0 * static_cast<double>(width_px) * height_px);
  out.greatest = greatest / 255.0;
  out.rgba = std::move(rgba);
  return {};
}

RainPattern generatePattern() {
  std::mt19937 random(1);  // its numbers are the same everywhere (C++20, [rand.eng.mers])
  std::vector<double> rain(size_t{kSize_px} * kSize_px, 0.0);
  for (int i = 0; i < kStreaks; ++i) {
    // Few are near and long, many far and short: 11 on the mean, as drops fall in an exposure
    // (kPlainStreak_m).
    const double size = std::pow(unit(random), 2.0);
    const double x = unit(random) * kSize_px, y = unit(random) * kSize_px;
    addStreak(x, y, 6.0 + 15.0 * size, 0.6 + 0.5 * size, 0.3 + 0.7 * unit(random), rain);
  }
  const double mean = meanOf(rain);
  for (int y = 0; y < kSize_px; ++y) {
    for (int x = 0; x < kSize_px; ++x) {
      double& r = rain[index(x, y)];
      r = std::min(kEven + (1.0 - kEven) * r / mean, kGreatest);
    }
  }
  std::vector<uint8_t> rgba;
  rgba.reserve(4 * rain.size());
  for (int y = 0; y < kSize_px; ++y) {
    for (int x = 0; x < kSize_px; ++x) {
      const double nx = -kRelief * 0.5 * (rain[index(x + 1, y)] - rain[index(x - 1, y)]),
                   ny = -kRelief * 0.5 * (rain[index(x, y + 1)] - rain[index(x, y - 1)]);
      const double length = std::sqrt(nx * nx + ny * ny + 1.0);
      for (const double n : {nx, ny, 1.0}) rgba.push_back(byteOf((n / length * 127.0 + 128.0) / 255.0));
      rgba.push_back(byteOf(rain[index(x, y)] / kGreatest));
    }
  }
  RainPattern pattern;
  const std::string wrong = makePattern(kSize_px, kSize_px, std::move(rgba), pattern);
  (void)wrong;  // it has rain in it
  return pattern;
}

}  // namespace rg::rain
