// Drops through the ABI: what sticks, what slides and how fast, what the wind does, how long they take to dry
// (physics.md 3). Drops lie in a row of columns; which of them have gone over an edge, and when, is read from
// the ledger.
#include <algorithm>

#include "draws.h"
#include "rig.h"

namespace rg::test {
namespace {

class DropLaws : public Drawing<::testing::Test> {};

constexpr double kShape = 24.0 / (kPi * kPi * kPi);  // ElSherbini & Jacobi

struct Preset {
  const char* name;
  int32_t glass;
  double advancing_rad, receding_rad;
  double mean_rad() const { return 0.5 * (advancing_rad + receding_rad); }
  double cosines() const { return std::cos(receding_rad) - std::cos(advancing_rad); }
};
const std::array<Preset, 4> kPresets{{{"uncoated", RG_GLASS_UNCOATED, rad(40), rad(10)},
                                      {"dirty", RG_GLASS_DIRTY, rad(60), rad(20)},
                                      {"coated", RG_GLASS_COATED, rad(110), rad(90)},
                                      {"new coating", RG_GLASS_NEW_COATING, rad(105), rad(98)}}};

// V = R^3 of a spherical cap.
double capVolume(double theta_rad) {
  const double c = std::cos(theta_rad), s = std::sin(theta_rad);
  return kPi * (2.0 + c) * (1.0 - c) * (1.0 - c) / (3.0 * s * s * s);
}

// rho V g sin a = k gamma 2 R (cos receding - cos advancing).
double criticalRadius_m(const Preset& glass, double slope_rad) {
  return std::sqrt(2.0 * kShape * kGamma * glass.cosines() /
                   (kRho * kGravity * std::sin(slope_rad) * capVolume(glass.mean_rad())));
}

rg_glass_drop dropAt(double u_m, double v_m, double radius_m, double contact_rad) {
  return {u_m, v_m, radius_m, contact_rad * 180.0 / kPi};
}

// Watches drops of about one volume leave a pane.
class Leaving {
 public:
  explicit Leaving(double volume_m3) : each_ml_(volume_m3 * 1e6) {}
  // How many since the last look. On their way they leave pearls behind, which may leave too: a fiftieth
  // each.
  int look(double gone_ml) {
    const double share = (gone_ml - std::exchange(gone_ml_, gone_ml)) / each_ml_;
    return share > 0.2 ? std::max(1, static_cast<int>(std::lround(share))) : 0;
  }

 private:
  double each_ml_, gone_ml_ = 0.0;
};

// Of drops from 8 % below to 8 % above the critical diameter those above slide off the pane, and no other.
TEST_F(DropLaws, thoseBeyondTheCriticalVolumeSlide) {
  constexpr double kAboveEdge_m = 2e-3, kBetween_m = 25e-3;
  constexpr std::array<double, 10> kPercent{-8, -6.5, -5, -3.5, -2, 2, 3.5, 5, 6.5, 8};
  struct Case {
    const Preset* glass;
    double slope_rad, radius_m;
  };
  std::vector<Case> cases;
  Rig rig(draws.number());
  for (const Preset& glass : kPresets) {
    for (const auto& [least, most] : {std::pair{20, 35}, {35, 55}, {55, 70}}) {
      const double slope_rad = rad(draws.between(least, most));
      Plate plate;
      plate.slope_rad = slope_rad;
      plate.width_m = kBetween_m * (kPercent.size() + 1);
      plate.height_m = 0.06;
      plate.glass = glass.glass;
      cases.push_back({&glass, slope_rad, criticalRadius_m(glass, slope_rad)});
      const auto id = static_cast<uint32_t>(cases.size());
      rig.set(id, plate);
      std::vector<rg_glass_drop> drops;
      for (size_t i = 0; i < kPercent.size(); ++i)
        drops.push_back(dropAt(kBetween_m * (static_cast<double>(i) - 4.5),
                               kAboveEdge_m - 0.5 * plate.height_m,
                               cases.back().radius_m * (1.0 + 0.01 * kPercent[i]), glass.mean_rad()));
      rig.place(id, drops);
    }
  }
  std::vector<Leaving> leaving;
  std::vector<int> gone(cases.size(), 0);
  for (const Case& c : cases)
    leaving.emplace_back(capVolume(c.glass->mean_rad()) * std::pow(c.radius_m, 3.0));
  while (rig.time_s() < 6.0) {  // 1 % above, a dirty pane's drop goes a millimetre a second
    rig.run(1.0 / 120.0, 1);
    for (size_t i = 0; i < cases.size(); ++i)
      gone[i] += leaving[i].look(rig.stats(static_cast<uint32_t>(i + 1)).drained_ml);
  }
  for (size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(std::string(cases[i].glass->name) + " at " + std::to_string(cases[i].slope_rad * 180 / kPi) +
                 " degrees, critical diameter " + std::to_string(2e3 * cases[i].radius_m) + " mm");
    EXPECT_EQ(gone[i], 5);
    const rg_pane_stats s = rig.stats(static_cast<uint32_t>(i + 1));
    EXPECT_GE(s.drops, 5u);
    expectNothingLost(s);
  }
}

// The speed that like drops come to which slide down glass raked like this, from when those that lie farther
// up come to the lower edge. They set out from rest: with m dU/dt = F - F0 - f U they have gone U (t - T (1 -
// exp(-t / T))), T = m / f, by the time t.
double slidingSpeed_mps(Rig& rig, const Preset& glass, double slope_rad, double radius_m,
                        double relaxation_s) {
  constexpr int kDrops = 5;
  constexpr double kWay_m = 6e-3;
  Plate plate;
  plate.slope_rad = slope_rad;
  plate.width_m = 0.3;
  plate.height_m = 0.12;
  plate.glass = glass.glass;
  rig.set(1, plate);
  std::vector<rg_glass_drop> drops;
  for (int i = 0; i < kDrops; ++i)
    drops.push_back(dropAt(0.05 * (i - 2), kWay_m * (i + 2) - 0.06, radius_m, glass.mean_rad()));
  rig.place(1, drops);
  Leaving leaving(capVolume(glass.mean_rad()) * std::pow(radius_m, 3.0));
  double sum_mps = 0.0;
  int gone = 0;
  for (int k = 0; k < 3600 && gone < kDrops; ++k) {
    rig.run(1.0 / 120.0, 1);
    const double t = rig.time_s();
    for (int n = leaving.look(rig.stats(1).drained_ml); n > 0; --n, ++gone)
      sum_mps += kWay_m * (gone + 2) / (t - relaxation_s * (1.0 - std::exp(-t / relaxation_s)));
  }
  EXPECT_EQ(gone, kDrops);
  return sum_mps / kDrops;
}

// Le Grand, Daerr & Limat 2005: above a threshold the speed is linear in Bo sin a; here the threshold is the
// critical drop's. Li et al. 2023: F = F0 + b w eta U, b from 20 to 200.
TEST_F(DropLaws, slidingSpeedIsLinearInBoAboveTheCriticalOne) {
  constexpr std::array<double, 4> kFriction{100.0, 120.0, 60.0, 40.0};  // the plugin's b
  for (size_t g = 0; g < kPresets.size(); ++g) {
    const Preset& glass = kPresets[g];
    const double critical_slope = rad(draws.between(12, 18));
    const double radius_m = criticalRadius_m(glass, critical_slope);
    const double mass_kg = kRho * capVolume(glass.mean_rad()) * std::pow(radius_m, 3.0);
    const double drag_kg_s = kFriction[g] * 2.0 * radius_m * kMu,
                 threshold_n = mass_kg * kGravity * std::sin(critical_slope);
    SCOPED_TRACE(std::string(glass.name) + ", radius " + std::to_string(1e3 * radius_m) + " mm");
    Rig rig(draws.number());
    std::vector<double> excess, speed_mps;
    for (double beyond = 0.2; beyond < 0.75; beyond += 0.1) {
      const double slope_rad = std::asin(std::sin(critical_slope) * (1.0 + beyond));
      rig.reset();
      excess.push_back(beyond);
      speed_mps.push_back(slidingSpeed_mps(rig, glass, slope_rad, radius_m, mass_kg / drag_kg_s));
    }
    double mean_x = 0.0, mean_y = 0.0, xy = 0.0, xx = 0.0;
    const auto n = static_cast<double>(excess.size());
    for (size_t i = 0; i < excess.size(); ++i) mean_x += excess[i] / n, mean_y += speed_mps[i] / n;
    for (size_t i = 0; i < excess.size(); ++i)
      xy += (excess[i] - mean_x) * (speed_mps[i] - mean_y), xx += std::pow(excess[i] - mean_x, 2.0);
    const double slope = xy / xx, threshold = mean_x - mean_y / slope;
    std::printf("%s: threshold at %.3f of the critical Bo, %.3f of the law's speed; speeds by the line:",
                glass.name, 1.0 + threshold, slope * drag_kg_s / threshold_n);
    for (size_t i = 0; i < excess.size(); ++i)
      std::printf(" %.3f (%.3f)", speed_mps[i], speed_mps[i] / (slope * (excess[i] - threshold)));
    std::printf("\n");
    for (size_t i = 0; i < excess.size(); ++i)
      EXPECT_NEAR(speed_mps[i], slope * (excess[i] - threshold), 0.05 * speed_mps.back());
    EXPECT_NEAR(threshold, 0.0, 0.06);
    // Some of its weight it leaves behind as film and pearls.
    EXPECT_NEAR(slope * drag_kg_s / threshold_n, 1.0, 0.08);
  }
}

// How far a wind moves a drop up in half a second: of like drops in a ladder below the upper edge, how many
// it blows off, less how many of such a ladder above the lower edge of a like pane run off.
int movedUp(uint64_t seed, const Preset& glass, double slope_rad, double radius_m, double wind_mps) {
  constexpr int kRungs = 12;
  constexpr double kRung_m = 5e-3, kBetween_m = 0.04;
  Rig rig(seed);
  Plate plate;
  plate.slope_rad = slope_rad;
  plate.width_m = 2.0 * kBetween_m * kRungs;  // they lie in its middle: none is blown to a side
  plate.height_m = 0.3;
  plate.glass = glass.glass;
  for (const uint32_t id : {1u, 2u}) {
    rig.set(id, plate);
    std::vector<rg_glass_drop> drops;
    for (int i = 0; i < kRungs; ++i) {
      const double from_edge_m = 0.15 - kRung_m * (i + 0.6);
      drops.push_back(
          dropAt(kBetween_m * (i - 5.5), id == 1 ? from_edge_m : -from_edge_m, radius_m, glass.mean_rad()));
    }
    rig.place(id, drops);
  }
  rig.weather.wind_mps[0] = -wind_mps;
  Leaving up(capVolume(glass.mean_rad()) * std::pow(radius_m, 3.0)), down(up);
  int moved = 0;
  while (rig.time_s() < 0.5) {
    rig.run(1.0 / 120.0, 1);
    moved += up.look(rig.stats(1).blown_ml) - down.look(rig.stats(2).drained_ml);
  }
  for (const uint32_t id : {1u, 2u}) expectNothingLost(rig.stats(id));
  return moved;
}

// Hooshanginejad & Lee 2022, as an order: a stronger wind never moves a drop less far up the glass. Each drop
// is once held, once driven by winds from none to a storm.
TEST_F(DropLaws, aStrongerWindNeverMovesADropLessFar) {
  int climbed = 0, held = 0, ran_down = 0;
  for (const Preset& glass : kPresets) {
    for (int k = 0; k < 2; ++k) {
      const double slope_rad = rad(draws.between(20, 60)),
                   radius_m = criticalRadius_m(glass, slope_rad) *
                              (k == 0 ? draws.between(0.5, 0.9) : draws.between(1.1, 1.4));
      const double step_mps = draws.between(3.0, 5.0);
      SCOPED_TRACE(std::string(glass.name) + ", radius " + std::to_string(1e3 * radius_m) + " mm, slope " +
                   std::to_string(slope_rad) + " rad, winds by " + std::to_string(step_mps) + " m/s");
      const uint64_t seed = draws.number();
      int before = -1000;
      std::string seen;
      for (int wind = 0; wind <= 8; ++wind) {
        const int moved = movedUp(seed, glass, slope_rad, radius_m, wind * step_mps);
        seen += " " + std::to_string(moved);
        EXPECT_GE(moved, before) << "at " << wind * step_mps << " m/s";
        before = moved;
        (moved > 0 ? climbed : moved < 0 ? ran_down : held) += 1;
      }
      std::printf("%s, %.1f mm:%s\n", glass.name, 2e3 * radius_m, seen.c_str());
    }
  }
  // All three are there to be ordered.
  EXPECT_GT(climbed, 8);
  EXPECT_GT(held, 8);
  EXPECT_GT(ran_down, 3);
}

// Saturated vapour by Buck 1981, kg/m^3; the plugin's is Magnus', within half a per cent of it.
double saturated_kg_m3(double temperature_c) {
  const double pressure_pa =
      611.21 * std::exp((18.678 - temperature_c / 234.5) * temperature_c / (257.14 + temperature_c));
  return pressure_pa / (461.5 * (temperature_c + 273.15));
}

// Hu & Larson 2002 with a pinned base, followed by the volume: -dm/dt = pi R D (1 - H) c_v (0.27 theta^2
// + 1.30). Moving air: Froessling 1938, times 1 + 0.276 Re^1/2 Sc^1/3.
double dryingTime_s(double radius_m, double contact_rad, double humidity, double temperature_c,
                    double wind_mps) {
  constexpr double kDiffusivity_m2_s = 2.5e-5, kAir_m2_s = 1.5e-5;
  const double moving = 1.0 + 0.276 * std::sqrt(2.0 * radius_m * wind_mps / kAir_m2_s) *
                                  std::cbrt(kAir_m2_s / kDiffusivity_m2_s);
  constexpr int kSteps = 20000;
  double time_s = 0.0;
  const double volume_m3 = capVolume(contact_rad) * std::pow(radius_m, 3.0);
  double h = radius_m * std::tan(0.5 * contact_rad);
  for (int i = 0; i < kSteps; ++i) {
    const double v = volume_m3 * (1.0 - (i + 0.5) / kSteps);
    for (int k = 0; k < 4; ++k)
      h -= (kPi / 6.0 * h * (3.0 * radius_m * radius_m + h * h) - v) /
           (kPi / 2.0 * (radius_m * radius_m + h * h));
    const double theta = 2.0 * std::atan(h / radius_m);
    time_s += kRho * volume_m3 / kSteps /
              (kPi * radius_m * kDiffusivity_m2_s * (1.0 - humidity) * saturated_kg_m3(temperature_c) *
               (0.27 * theta * theta + 1.30) * moving);
  }
  return time_s;
}

TEST_F(DropLaws, dryInTheTimesOfHuAndLarson) {
  // Of the vapour's formula half a per cent, of what is no drop any more (50 pL) a per cent for the smallest.
  constexpr double kTolerance = 0.02;
  constexpr double kLook_s = 16.0 / 120.0;  // what a drop loses is taken off every 16th tick
  EXPECT_NEAR(dryingTime_s(0.5e-3, rad(40), 0.9, 20.0, 0.0) / (13.6 * 60.0), 1.0, 0.05)
      << "physics.md's own number";
  for (int k = 0; k < 8; ++k) {
    const double radius_m = draws.between(0.2e-3, 0.45e-3), contact_rad = rad(draws.between(25, 40));
    const double humidity = draws.between(0.2, 0.8), temperature_c = draws.between(2, 30),
                 wind_mps = k % 2 == 0 ? 0.0 : draws.between(2, 20);
    std::ostringstream drawn;
    drawn << "radius " << 1e3 * radius_m << " mm, " << contact_rad * 180 / kPi << " degrees, humidity "
          << humidity << ", " << temperature_c << " C, wind " << wind_mps << " m/s";
    SCOPED_TRACE(drawn.str());
    Rig rig(draws.number());
    Plate plate;
    plate.width_m = plate.height_m = 0.06;
    plate.advancing_deg = 41.0;
    plate.receding_deg = 0.5;  // the base stays pinned
    plate.max_drops = 10;
    rig.set(1, plate);
    rig.level(1);
    rig.place(1, {dropAt(0.0, 0.0, radius_m, contact_rad)});
    rig.weather.humidity = humidity;
    rig.weather.temperature_c = temperature_c;
    rig.weather.wind_mps[0] = -wind_mps;
    const double law_s = dryingTime_s(radius_m, contact_rad, humidity, temperature_c, wind_mps);
    while (rig.time_s() < 2.0 * law_s && rig.stats(1).drops > 0)
      rig.run(std::max(law_s / 500.0, 1.0 / 120.0), 24);
    std::printf("%s: %.1f s, law %.1f s\n", drawn.str().c_str(), rig.time_s(), law_s);
    EXPECT_NEAR(rig.time_s(), law_s, kTolerance * law_s + kLook_s);
    const rg_pane_stats s = rig.stats(1);
    EXPECT_EQ(s.evaporated_ml, s.caught_ml);
  }
}

}  // namespace
}  // namespace rg::test
