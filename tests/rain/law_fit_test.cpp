// The drops that the field really makes against the size law, by tests of fit: not their mean, but their
// whole distribution, within each class and over all of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "measure.h"

namespace rg::rain::test {
namespace {

// The field's random numbers are fixed, so that a fit passes or fails for good. Limits are those that chance
// passes once in ten thousand fields.
constexpr double kKolmogorov = 2.22;  // of sqrt(n) D: 2 exp(-2 x^2) = 1e-4 (Kolmogorov 1933)
constexpr double kSigmas = 3.72;      // of a normal number, one-sided

// The chi-square that chance exceeds once in ten thousand times (Wilson & Hilferty 1931).
double mostChiSquare(double freedom) {
  const double part = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - part + kSigmas * std::sqrt(part), 3.0);
}

// sqrt(n) times the largest distance between the diameters' share below and the law's.
double kolmogorov(std::vector<double>& diameters_mm, const SizeLaw& law, double from_mm, double to_mm) {
  std::ranges::sort(diameters_mm);
  const double n = static_cast<double>(diameters_mm.size()), all = law.numberDensity(from_mm, to_mm);
  double farthest = 0.0;
  for (size_t i = 0; i < diameters_mm.size(); ++i) {
    const double share = law.numberDensity(from_mm, diameters_mm[i]) / all;
    farthest =
        std::max({farthest, share - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - share});
  }
  return std::sqrt(n) * farthest;
}

class LawFit : public ::testing::TestWithParam<double> {
 protected:
  // Independent pictures of the field, each cut to from far off.
  template <class F>
  void look(int pictures, F&& each) {
    Field field({.capacity = 400000, .seed = 17});
    Scene scene = sceneWithView(GetParam());
    Upload upload;
    std::vector<LiveDrop> drops;
    for (int n = 0; n < pictures; ++n, ++scene.index) {
      scene.views[0].discontinuity = true;
      place(scene, 0.0, 0.0, 60.0 * n);
      field.tick(scene.tick());
      liveDrops(field, upload, drops);
      each(drops, coneOf(scene.views[0]));
    }
  }
};

// Inside a class every live drop is a fair sample, in sight or not.
TEST_P(LawFit, withinEachClass) {
  constexpr int kPictures = 200;
  const SizeLaw law = SizeLaw::of(GetParam());
  std::array<std::vector<double>, kSpeedClasses> diameters_mm;
  look(kPictures, [&](const std::vector<LiveDrop>& drops, const Cone&) {
    for (const LiveDrop& d : drops) diameters_mm[d.kind].push_back(1e3 * d.diameter_m);
  });
  for (size_t kind = 0; kind < kSpeedClasses; ++kind) {
    const SpeedClass& c = speedClasses()[kind];
    ASSERT_GT(diameters_mm[kind].size(), 200U) << "class " << kind;
    EXPECT_LT(kolmogorov(diameters_mm[kind], law, c.from_mm, c.to_mm), kKolmogorov)
        << "class " << kind << ", " << diameters_mm[kind].size() << " drops";
  }
}

// In the space where every size is seen (to 1 m) the drops of all classes together are a sample of the law.
TEST_P(LawFit, ofAllSizesTogether) {
  constexpr int kPictures = 300;
  constexpr size_t kBins = 40;
  const SizeLaw law = SizeLaw::of(GetParam());
  const double reach_m = kReachPerDiameter * 1e-3 * kSmallest_mm;
  std::vector<double> diameters_mm;
  double volume_m3 = 0.0;
  look(kPictures, [&](const std::vector<LiveDrop>& drops, const Cone& cone) {
    volume_m3 += solidAngle(cone) * reach_m * reach_m * reach_m / 3.0;
    for (const LiveDrop& d : drops) {
      if (inVolume(cone, d.place_m, reach_m)) diameters_mm.push_back(1e3 * d.diameter_m);
    }
  });
  EXPECT_LT(kolmogorov(diameters_mm, law, kSmallest_mm, kLargest_mm), kKolmogorov);
  // Bins of equal content by the law, against the number that the law puts there: shape and number at once.
  const double expected = law.numberDensity(kSmallest_mm, kLargest_mm) * volume_m3 / kBins;
  ASSERT_GT(expected, 100.0);
  double chi_square = 0.0;
  for (size_t bin = 0; bin < kBins; ++bin) {
    const double from_mm = law.quantile(kSmallest_mm, kLargest_mm, static_cast<double>(bin) / kBins),
                 to_mm = law.quantile(kSmallest_mm, kLargest_mm, static_cast<double>(bin + 1) / kBins);
    const auto counted =
        std::ranges::upper_bound(diameters_mm, to_mm) - std::ranges::upper_bound(diameters_mm, from_mm);
    chi_square += std::pow(static_cast<double>(counted) - expected, 2.0) / expected;
  }
  EXPECT_LT(chi_square, mostChiSquare(kBins));
}

// Each class's number in its view volume, where the rare large drops are seen farthest.
TEST_P(LawFit, ofTheClassesNumbers) {
  constexpr int kPictures = 300;
  const SizeLaw law = SizeLaw::of(GetParam());
  std::array<double, kSpeedClasses> seen{}, expected{};
  look(kPictures, [&](const std::vector<LiveDrop>& drops, const Cone& cone) {
    for (const LiveDrop& d : drops) seen[d.kind] += inVolume(cone, d.place_m, d.reach_m()) ? 1.0 : 0.0;
    for (size_t kind = 0; kind < kSpeedClasses; ++kind)
      expected[kind] += expectedInView(law, kind, solidAngle(cone));
  });
  double chi_square = 0.0;
  for (size_t kind = 0; kind < kSpeedClasses; ++kind) {
    ASSERT_GT(expected[kind], 20.0) << "class " << kind;
    chi_square += std::pow(seen[kind] - expected[kind], 2.0) / expected[kind];
  }
  EXPECT_LT(chi_square, mostChiSquare(kSpeedClasses));
}
INSTANTIATE_TEST_SUITE_P(Rates, LawFit, ::testing::Values(5.0, 50.0), [](const auto& rate) {
  return "at" + std::to_string(static_cast<int>(rate.param)) + "mmh";
});

}  // namespace
}  // namespace rg::rain::test
