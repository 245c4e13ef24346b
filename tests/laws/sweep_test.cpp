// What wipers wipe, through the ABI: on a level pane with an even film, one stroke takes up the film of the
// area that its blades' geometry covers, at any speed of the wiper and any rate of updates.
#include "draws.h"
#include "gl_fixture.h"
#include "rig.h"

namespace rg::test {
namespace {

class SweepLaws : public Drawing<GlTest> {};

constexpr double kWidth_m = 1.3, kHeight_m = 0.7;

// Pivot right of and above the pane's middle as seen from outside, angles from the direction to the left seen
// from inside.
struct Arm {
  double right_m, up_m, arm_m, blade_m, blade_rad, turn, from_rad, to_rad;
  // Whether a place (right, up from the pane's middle, from outside) is passed: by trying all angles.
  bool passes(double right, double up) const {
    constexpr int kSteps = 160;
    double before = 0.0;
    for (int n = 0; n <= kSteps; ++n) {
      const double angle = std::lerp(from_rad, to_rad, static_cast<double>(n) / kSteps),
                   along = blade_rad + (1.0 + turn) * angle;
      const double x = right - right_m - arm_m * std::cos(angle), y = up - up_m - arm_m * std::sin(angle);
      const double across = y * std::cos(along) - x * std::sin(along);
      if (n > 0 && (across < 0.0) != (before < 0.0) &&
          std::abs(x * std::cos(along) + y * std::sin(along)) < 0.5 * blade_m)
        return true;
      before = across;
    }
    return false;
  }
};

struct Linkage {
  const char* name;
  std::vector<Arm> arms;
};

double coveredArea_m2(const Linkage& linkage) {
  constexpr double kGrain_m = 5e-3;  // of a stick's area some 1e-3: edges are met by chance
  int covered = 0;
  for (double x = 0.5 * (kGrain_m - kWidth_m); x < 0.5 * kWidth_m; x += kGrain_m) {
    for (double y = 0.5 * (kGrain_m - kHeight_m); y < 0.5 * kHeight_m; y += kGrain_m) {
      for (const Arm& arm : linkage.arms) {
        if (!arm.passes(x, y)) continue;
        ++covered;
        break;
      }
    }
  }
  return covered * kGrain_m * kGrain_m;
}

void set(Rig& rig, uint32_t wiper_id, uint32_t pane, const Arm& arm, double residual_m) {
  const Plate plate;
  rg_wiper_info wiper;
  rig.api.default_wiper_info(&wiper);
  wiper.pane = pane;
  const glm::dvec3 pivot = kMiddle_m + arm.right_m * glm::dvec3(0.0, 1.0, 0.0) + arm.up_m * plate.up();
  for (int i = 0; i < 3; ++i) {
    wiper.pivot_m[i] = pivot[i];
    wiper.axis[i] = plate.outward()[i];
    wiper.rest_direction[i] = i == 1 ? 1.0 : 0.0;
  }
  wiper.arm_m = arm.arm_m;
  wiper.blade_m = arm.blade_m;
  wiper.blade_angle_rad = arm.blade_rad;
  wiper.blade_turn = arm.turn;
  wiper.residual_film_m = residual_m;
  rig.expect(rig.api.set_wiper(rig.instance, wiper_id, &wiper));
}

constexpr double kFilm_m = 25e-6, kResidual_m = 1e-7;

// Long blades that leave a film of kFilm_m go over whole panes, and off them with the rest.
void spread(Rig& rig, uint32_t panes) {
  constexpr double kStroke_s = 0.7;
  constexpr uint32_t kFirst = 100;
  const Arm arm{0.0, -0.6, 0.8, 1.5, rad(90), -1.0, rad(25), rad(155)};
  const double begins_s = rig.time_s();
  for (uint32_t pane = 1; pane <= panes; ++pane) {
    set(rig, kFirst + pane, pane, arm, kFilm_m);
    rig.wipers[kFirst + pane] = [arm, begins_s](double time_s) {
      return std::lerp(arm.from_rad, arm.to_rad, std::clamp((time_s - begins_s) / kStroke_s, 0.0, 1.0));
    };
  }
  rig.run(kStroke_s + 0.1);
  for (uint32_t pane = 1; pane <= panes; ++pane) {
    rig.expect(rig.api.remove_wiper(rig.instance, kFirst + pane));
    rig.wipers.erase(kFirst + pane);
    const rg_pane_stats s = rig.stats(pane);
    // Where much was before it some of the jets' splashes are left as they are.
    EXPECT_NEAR(s.film_ml * 1e-6 / s.area_m2 / kFilm_m, 1.0, 0.01) << "it is not spread evenly";
  }
}

TEST_F(SweepLaws, aStrokeTakesUpTheFilmOfTheAreaItCovers) {
  constexpr double kTolerance = 0.004;  // texels and the grain of coveredArea_m2 meet the edges by chance
  const auto around = [&](double angle_deg) { return rad(angle_deg + draws.between(-4, 4)); };
  const std::vector<Linkage> linkages{
      {"single", {{0.0, -0.32, 0.36, 0.5, 0.0, 0.0, around(25), around(150)}}},
      {"tandem",
       {{0.3, -0.32, 0.36, 0.45, 0.0, 0.0, around(60), around(140)},
        {-0.2, -0.32, 0.34, 0.45, 0.0, 0.0, around(60), around(140)}}},
      {"opposed",
       {{0.55, -0.32, 0.36, 0.5, 0.0, 0.0, around(168), around(95)},
        {-0.55, -0.32, 0.36, 0.5, 0.0, 0.0, around(12), around(85)}}},
      {"pantograph", {{0.0, -0.4, 0.45, 0.4, rad(80), -1.0, around(45), around(135)}}}};
  Rig rig(draws.number());
  rig.attach();
  std::vector<std::pair<uint32_t, double>> films;
  for (uint32_t id = 1; id <= linkages.size(); ++id) {
    Plate plate;
    plate.width_m = kWidth_m;
    plate.height_m = kHeight_m;
    plate.max_drops = 0;
    rig.set(id, plate);
    films.emplace_back(id, 1.4 * kFilm_m);
  }
  rig.lay(films, 0.6, 0.0);
  spread(rig, static_cast<uint32_t>(linkages.size()));
  constexpr int64_t kStill = 2;
  const int64_t stroke_ticks = 2 * std::llround(1800.0 / draws.between(20, 80));
  const double begins_s = rig.time_s() + kStill / 120.0, stroke_s = static_cast<double>(stroke_ticks) / 120.0;
  const auto ticks = static_cast<int64_t>(draws.between(1, 13));  // of an update: 120 to 10 a second
  SCOPED_TRACE("a stroke of " + std::to_string(stroke_s) + " s in updates of " + std::to_string(ticks) +
               " ticks");
  uint32_t wiper_id = 1;
  for (uint32_t id = 1; const Linkage& linkage : linkages) {
    for (const Arm& arm : linkage.arms) {
      set(rig, wiper_id, id, arm, kResidual_m);
      rig.wipers[wiper_id++] = [arm, begins_s, stroke_s](double time_s) {
        return std::lerp(arm.from_rad, arm.to_rad, std::clamp((time_s - begins_s) / stroke_s, 0.0, 1.0));
      };
    }
    ++id;
  }
  rig.update(kStill);  // blades are where they begin
  // To the last tick in which blades move: where they stop they lay down what they carry.
  for (int64_t done = 0; done < stroke_ticks; done += ticks) rig.update(std::min(ticks, stroke_ticks - done));
  for (size_t i = 0; i < linkages.size(); ++i) {
    const Linkage& linkage = linkages[i];
    const rg_pane_stats s = rig.stats(static_cast<uint32_t>(i + 1));
    const double taken_m2 = s.ridge_ml * 1e-6 / (kFilm_m - kResidual_m), covered_m2 = coveredArea_m2(linkage);
    std::printf("%s: took up %.4f m2, covers %.4f m2\n", linkage.name, taken_m2, covered_m2);
    EXPECT_NEAR(taken_m2 / covered_m2, 1.0, kTolerance) << linkage.name;
    expectNothingLost(s);
  }
}

}  // namespace
}  // namespace rg::test
