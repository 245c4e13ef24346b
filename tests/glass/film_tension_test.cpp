// Surface tension and weight spread a film as lubrication theory says: by the production kernel on panes that
// lie level, with films laid texel by texel.
#include <gtest/gtest.h>

#include "gl_fixture.h"
#include "lone_film.h"

namespace rg::test {
namespace {

constexpr double kGammaOverMu = 0.072 / 1.0e-3, kStepOfFilm_s = 1.0 / 60.0;

// h^3 k^2 (rho g + gamma k^2) / (3 mu): a small wave of wave number k on a level film decays so fast (Oron,
// Davis & Bankoff 1997).
double decay_per_s(double h_m, double k_per_m, double pressing_mps2) {
  return std::pow(h_m, 3.0) * k_per_m * k_per_m / 3.0 *
         (1.0e6 * pressing_mps2 + kGammaOverMu * k_per_m * k_per_m);
}

class FilmTension : public GlTest {
 protected:
  // Measured decay of a wave, by the law's. It stands still at the pane's edges; `across` of them along y.
  double decayByTheLaw(double h_m, double wave_m, double pressing_mps2, double texel_m,
                       bool both_ways = false) {
    const int along = static_cast<int>(std::lround(wave_m / texel_m)), across = both_ways ? along : 6;
    const double k = 2.0 * kPi / wave_m, total_k = both_ways ? k * std::numbers::sqrt2 : k;
    const auto shape = [&](glm::dvec2 p) {
      return std::cos(k * p.x) * (both_ways ? std::cos(k * p.y) : 1.0);
    };
    constexpr double kSmall = 0.03;  // of the thickness: the cube's second order adds 3 kSmall^2
    LoneFilm film(gl, {along, across}, texel_m);
    film.lay([&](glm::dvec2 p) { return h_m * (1.0 + kSmall * shape(p)); });
    const auto amplitude = [&] {
      const std::vector<double> h = film.thickness_m();
      double sum = 0.0, norm = 0.0;
      for (size_t i = 0; i < h.size(); ++i) {
        const double s = shape(
            texel_m * (glm::dvec2(i % static_cast<size_t>(along), i / static_cast<size_t>(along)) + 0.5));
        sum += h[i] * s;
        norm += s * s;
      }
      return sum / norm;
    };
    film.run(1, pressing_mps2);
    const double before = amplitude();
    const int64_t volume_pl = film.volume_pl();
    const double law = decay_per_s(h_m, total_k, pressing_mps2);
    const int steps = std::max(20, static_cast<int>(0.5 / std::abs(law) / kStepOfFilm_s));
    film.run(steps, pressing_mps2);
    EXPECT_EQ(film.volume_pl(), volume_pl);
    const double ratio = std::log(before / amplitude()) / (law * steps * kStepOfFilm_s);
    std::printf(
        "%.0f um, wave %.0f mm%s, onto the glass %.1f m/s2, texel %.2f mm: %.3f /s, %.3f of the law's\n",
        h_m * 1e6, wave_m * 1e3, both_ways ? " both ways" : "", pressing_mps2, texel_m * 1e3, ratio * law,
        ratio);
    return ratio;
  }
};

// As fast as theory says at the plugin's own texels, for waves of eight and more.
TEST_F(FilmTension, wavesDecayAsLubricationTheorySays) {
  // Differences over texels take (2 - 2 cos k dx) / dx^2 for k^2: 5 % less for eight texels to a wave, and
  // its square for tension.
  constexpr double kLeast = 0.88, kMost = 1.02;
  struct Case {
    double h_m, wave_m, pressing_mps2;
    bool both_ways;
  };
  for (const Case& c : {Case{100e-6, 24e-3, 9.81, false},
                        {100e-6, 24e-3, 0.0, false},
                        {100e-6, 24e-3, 8.0, true},
                        {60e-6, 24e-3, 0.0, true},
                        {150e-6, 36e-3, 4.0, false},
                        {130e-6, 48e-3, 9.81, false}}) {
    const double ratio = decayByTheLaw(c.h_m, c.wave_m, c.pressing_mps2, 3e-3, c.both_ways);
    EXPECT_GT(ratio, kLeast);
    EXPECT_LT(ratio, kMost);
  }
}

// Second-order differences: half the texel, a quarter of the error.
TEST_F(FilmTension, finerGridsComeNearer) {
  const auto error = [&](double texel_m) {
    return std::abs(1.0 - decayByTheLaw(70e-6, 24e-3, 5.0, texel_m));
  };
  const double coarse = error(4e-3), fine = error(2e-3);
  EXPECT_LT(fine, 0.35 * coarse);
}

// Where a step cannot follow, thick film on fine texels, weight still levels long waves; short ones, which
// tension levels in no time, take longer but go.
TEST_F(FilmTension, fineTexelsLevelLongWavesInHalfTheirRate) {
  for (const double h_m : {60e-6, 100e-6}) {
    const double ratio = decayByTheLaw(h_m, 36e-3, 8.5, 0.75e-3);
    EXPECT_GT(ratio, 0.45);
    EXPECT_LT(ratio, 1.02);
  }
}

// A film that hangs draws out into waves longer than 2 pi times the capillary length, 17 mm, and no shorter
// ones (Rayleigh & Taylor).
TEST_F(FilmTension, hangingFilmsDrawOutLongWavesAlone) {
  for (const double texel_m : {0.75e-3, 3e-3}) {
    EXPECT_GT(decayByTheLaw(100e-6, 12e-3, -9.81, texel_m), 0.0);
    EXPECT_GT(decayByTheLaw(100e-6, 36e-3, -9.81, texel_m), 0.0);  // of a rate below 0
  }
}

// Where wind opposes gravity a film's flow and its waves may go opposite ways, between two thirds and all of
// rho g h sin a: ripples do not grow there either.
TEST_F(FilmTension, ripplesDoNotGrowAgainstTheWind) {
  const glm::ivec2 texels(16, 80);
  for (const double h_m : {50e-6, 120e-6}) {
    for (const double ratio : {0.3, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2}) {
      LoneFilm film(gl, texels, 3e-3);
      film.lay([&](glm::dvec2 p) { return h_m * (1.0 + 0.05 * std::cos(kPi * (p.x + p.y) / 3e-3)); });
      const auto ripple_m = [&] {
        const std::vector<double> h = film.thickness_m();
        double most = 0.0;
        for (size_t y = 30; y < 50; ++y) {
          for (size_t x = 1; x + 1 < 16; ++x) {
            const size_t i = 16 * y + x;
            most = std::max(most, std::abs(h[i] - 0.5 * (h[i - 16] + h[i + 16])));
          }
        }
        return most;
      };
      film.run(1, 4.0);
      const double before = ripple_m();
      film.run(90, 4.0, {0.0, -8.0, 0.0, ratio * 1000.0 * 8.0 * h_m});
      EXPECT_LT(ripple_m(), 0.7 * before) << h_m << " m, " << ratio;
    }
  }
}

// Nothing grows from texel to texel, however thick the film.
TEST_F(FilmTension, roughFilmsOfAnyThicknessGrowSmooth) {
  for (const double texel_m : {0.75e-3, 3e-3}) {
    for (const double h_m : {8e-6, 60e-6, 150e-6, 280e-6}) {
      for (const double down_mps2 : {0.0, 4.9, 9.0}) {
        const glm::ivec2 texels(16, 80);
        LoneFilm film(gl, texels, texel_m);
        film.lay([&](glm::dvec2 p) {
          const auto x = static_cast<int>(p.x / texel_m), y = static_cast<int>(p.y / texel_m);
          const double noise =
              static_cast<double>(shared::unitFloat(shared::pcg(static_cast<uint32_t>(x + 1000 * y)))) - 0.5;
          return h_m * (1.0 + ((x + y) % 2 == 0 ? 0.05 : -0.05) + 0.02 * noise);
        });
        // How far texels stand from the mean of their neighbours, where no edge has come.
        const auto roughness_m = [&](int from, int until) {
          const std::vector<double> h = film.thickness_m();
          double most = 0.0;
          for (int y = from; y < until; ++y) {
            for (int x = 1; x + 1 < texels.x; ++x) {
              const auto i = static_cast<size_t>(y * texels.x + x), row = static_cast<size_t>(texels.x);
              most = std::max(most, std::abs(h[i] - 0.25 * (h[i - 1] + h[i + 1] + h[i - row] + h[i + row])));
            }
          }
          return most;
        };
        film.run(1, 8.0, down_mps2);
        const double before = roughness_m(12, 44);
        film.run(30, 8.0, down_mps2);
        const double after = roughness_m(12, 44);
        std::printf("texel %.2f mm, %.0f um, down %.1f m/s2: rough %.3f um, then %.3f\n", texel_m * 1e3,
                    h_m * 1e6, down_mps2, before * 1e6, after * 1e6);
        EXPECT_LT(after, before) << texel_m << " " << h_m << " " << down_mps2;
      }
    }
  }
}

}  // namespace
}  // namespace rg::test
