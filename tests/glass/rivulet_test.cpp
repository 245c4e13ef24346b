// Streams: where the glass is dry to both sides water runs down narrow and wanders as the glass is uneven;
// later water takes the wet way; on wet glass it runs straight.
#include <gtest/gtest.h>

#include "gl_fixture.h"
#include "lone_film.h"

namespace rg::test {
namespace {

class Rivulets : public GlTest {
 protected:
  static constexpr glm::ivec2 kTexels{64, 100};
  static constexpr double kTexel_m = 3e-3, kPressing_mps2 = 8.5, kDown_mps2 = 4.9;
  static constexpr glm::ivec2 kSource{32, 97};

  static void feed(LoneFilm& film, double flow_m3_s, double seconds) {
    for (int step = 0; step < static_cast<int>(seconds * 60.0); ++step) {
      film.add(kSource, flow_m3_s / 60.0);
      film.run(1, kPressing_mps2, kDown_mps2);
    }
  }
  // Middle and width (four standard deviations) of what runs through each row, by thickness cubed; rows in
  // which nothing is are left out.
  struct Way {
    std::vector<double> middle_m, width_m;
    double meandering_m() const {
      const auto [low, high] = std::minmax_element(middle_m.begin(), middle_m.end());
      return *high - *low;
    }
    double meanWidth_m() const {
      return std::accumulate(width_m.begin(), width_m.end(), 0.0) / static_cast<double>(width_m.size());
    }
  };
  static Way wayOf(const LoneFilm& film, double above_m = 0.0) {
    const std::vector<double> h = film.thickness_m();
    Way way;
    for (int y = kSource.y - 1; y >= 0; --y) {
      double sum = 0.0, first = 0.0, second = 0.0;
      for (int x = 0; x < kTexels.x; ++x) {
        const double q = std::pow(std::max(h[static_cast<size_t>(y * kTexels.x + x)] - above_m, 0.0) * 1e6,
                                  3.0),
                     at_m = (x + 0.5) * kTexel_m;
        sum += q;
        first += q * at_m;
        second += q * at_m * at_m;
      }
      if (sum < 1e3) continue;
      way.middle_m.push_back(first / sum);
      way.width_m.push_back(4.0 * std::sqrt(std::max(second / sum - first * first / (sum * sum), 0.0)));
    }
    return way;
  }
};

// A place's glass is the same however fine the grid, like what is a millimetre away, unlike what is far, and
// each pane's is its own.
TEST(UnevenGlass, isSmoothOverMillimetresAndTheSameOnAllGrids) {
  const Mesh mesh = windscreen(0.3, 0.3, rad(30));
  glass::PaneInfo info = paneInfo(mesh);
  const glass::PaneMap usual(info);
  info.texel_m = 1.5e-3;
  const glass::PaneMap fine(info);
  const glass::UnevenGlass glass(usual, 7), finer(fine, 7), other(usual, 8);
  double near = 0.0, far = 0.0, grids = 0.0, panes = 0.0;
  int count = 0;
  for (int i = 0; i < usual.texelCount(); ++i) {
    const glm::dvec2 place = usual.glassFromGrid(usual.middleOf(i));
    const auto levelAt = [&](double aside_m) {
      const int texel = usual.texelAt(usual.gridFromGlass(place + glm::dvec2(aside_m, 0.0)));
      return texel < 0 ? -1 : glass.level(texel);
    };
    const int there = fine.texelAt(fine.gridFromGlass(place));
    if (levelAt(0.0) < 0 || levelAt(3e-3) < 0 || levelAt(60e-3) < 0 || there < 0) continue;
    ++count;
    near += std::pow(levelAt(3e-3) - levelAt(0.0), 2.0);
    far += std::pow(levelAt(60e-3) - levelAt(0.0), 2.0);
    grids += std::pow(finer.level(there) - levelAt(0.0), 2.0);
    panes += std::pow(other.level(i) - levelAt(0.0), 2.0);
  }
  ASSERT_GT(count, 1000);
  EXPECT_LT(near, 0.2 * far);
  EXPECT_LT(grids, near);  // middles of fine texels lie within a millimetre
  EXPECT_GT(panes, 0.7 * far);
  EXPECT_GT(far / count, std::pow(0.2 * shared::kMostUneven, 2.0)) << "it is all alike";
}

// As much as a parked screen's streams carry in heavy rain.
TEST_F(Rivulets, wanderOnDryGlassAndRunStraightOnWet) {
  constexpr double kFlow_m3_s = 40e-9;
  double sum_m = 0.0;
  for (const uint32_t seed : {1u, 2u, 3u}) {
    LoneFilm film(gl, kTexels, kTexel_m, seed);
    film.breaks = true;
    feed(film, kFlow_m3_s, 11.0);
    const Way way = wayOf(film);
    std::printf("glass %u: %zu rows, wanders %.1f mm, %.1f mm wide\n", seed, way.middle_m.size(),
                way.meandering_m() * 1e3, way.meanWidth_m() * 1e3);
    EXPECT_EQ(way.middle_m.size(), static_cast<size_t>(kSource.y)) << "it does not come down";
    EXPECT_GT(way.meandering_m(), kTexel_m);
    sum_m += way.meandering_m();
    EXPECT_LT(way.meanWidth_m(), 4.0 * kTexel_m);
  }
  EXPECT_GT(sum_m / 3.0, 1.5 * kTexel_m);
  // Once it is wet all over, how the glass is unevenly wetted does nothing: the stream on the film goes
  // straight down.
  constexpr double kWet_m = 30e-6;
  LoneFilm wet(gl, kTexels, kTexel_m);
  wet.lay([](glm::dvec2) { return kWet_m; });
  feed(wet, kFlow_m3_s, 1.5);
  const Way way = wayOf(wet, 1.1 * kWet_m);
  EXPECT_GT(way.middle_m.size(), 15u);
  EXPECT_LT(way.meandering_m(), 1e-6);
}

// So little that on dry glass it stays where it comes follows the way of water that went before.
TEST_F(Rivulets, laterWaterTakesTheWetWay) {
  constexpr double kParcel_m3 = 0.15e-9;  // 17 um in its texel: no front of that passes
  constexpr int kRowsBelow = 2;
  const auto below_m3 = [&](bool wet, double parcel_m3) {
    LoneFilm film(gl, kTexels, kTexel_m);
    if (wet) feed(film, 40e-9, 4.0);
    film.run(60, kPressing_mps2, kDown_mps2);
    film.add(kSource, parcel_m3);
    film.run(240, kPressing_mps2, kDown_mps2);
    const std::vector<double> h = film.thickness_m();
    return std::accumulate(h.begin(), h.begin() + (kSource.y - kRowsBelow) * kTexels.x, 0.0) * kTexel_m *
           kTexel_m;
  };
  EXPECT_EQ(below_m3(false, kParcel_m3), 0.0);
  EXPECT_GT(below_m3(true, kParcel_m3) - below_m3(true, 0.0), 0.3 * kParcel_m3);
}

}  // namespace
}  // namespace rg::test
