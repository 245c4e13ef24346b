// The field against the laws of a Poisson rain: chance in the view volume's cells, flux through its faces,
// nothing that pops up inside it.
#include <gtest/gtest.h>

#include <unordered_map>

#include "measure.h"
#include "rain/field.h"

namespace rg::rain::test {
namespace {

constexpr size_t kGroups = 8;
size_t groupOf(uint32_t kind) { return kind / 4; }

struct Motion {
  const char* name;
  double rate_mm_h, speed_mps;
  double turn_radps;           // steadily, or when swinging the fastest
  bool swings = false;         // to and fro, three times in four seconds
  double crosswind_mps = 0.0;  // in Appearance
  double gust_mps = 0.0;       // swings of it, once in 3 s
  double headingAt(double t) const {
    constexpr double kOften = 2.0 * 3.14159265358979 * 0.75;
    return swings ? turn_radps / kOften * std::sin(kOften * t) : turn_radps * t;
  }
};
std::ostream& operator<<(std::ostream& out, const Motion& m) { return out << m.name; }
std::string nameOf(const ::testing::TestParamInfo<Motion>& info) { return info.param.name; }

// ---- density ----

class Density : public ::testing::TestWithParam<Motion> {};

// Within 5 % of the law. So many independent pictures are added up (the view cuts to another place, then
// moves for a tenth of a second) that chance is below 1.5 % for the rarest group, and the limit stands at 3
// standard errors of it.
TEST_P(Density, ofEachSizeIsTheLaws) {
  const Motion motion = GetParam();
  constexpr double kStandardError = 0.015;
  constexpr int kTicksAPicture = 12;
  Field field({.capacity = 200000, .seed = 3});
  Scene scene = sceneWithView(motion.rate_mm_h);
  const SizeLaw law = SizeLaw::of(motion.rate_mm_h);
  const double solid_angle = solidAngle(coneOf(scene.views[0]));
  std::array<double, kGroups> seen{}, in_a_picture{};
  for (size_t kind = 0; kind < kSpeedClasses; ++kind)
    in_a_picture[groupOf(static_cast<uint32_t>(kind))] += expectedInView(law, kind, solid_angle);
  const double rarest = *std::min_element(in_a_picture.begin(), in_a_picture.end());
  const int pictures = static_cast<int>(std::ceil(1.0 / (kStandardError * kStandardError * rarest)));
  std::vector<Streak> streaks;
  for (int n = 0; n < pictures; ++n) {
    for (int i = 0; i < kTicksAPicture; ++i, ++scene.index) {
      scene.views[0].discontinuity = i == 0;
      place(scene, motion.speed_mps, motion.headingAt(static_cast<double>(scene.index) * kTickSeconds),
            50.0 * n);
      field.tick(scene.tick());
    }
    --scene.index;
    field.streaks(scene.views[0], tickTimeNs(scene.index), streaks);
    ++scene.index;
    const Cone cone = coneOf(scene.views[0]);
    for (const Streak& s : streaks) seen[groupOf(s.kind)] += inCone(cone, s.drop_m) ? 1.0 : 0.0;
  }
  for (size_t i = 0; i < kGroups; ++i) {
    const double expected = in_a_picture[i] * pictures;
    EXPECT_LT(1.0 / std::sqrt(expected), 1.001 * kStandardError);
    EXPECT_NEAR(seen[i] / expected, 1.0, std::min(0.05, 0.005 + 3.0 / std::sqrt(expected)))
        << "classes " << 4 * i << "..";
  }
}
INSTANTIATE_TEST_SUITE_P(Motions, Density,
                         ::testing::Values(Motion{"standingAt50", 50, 0, 0},
                                           Motion{"drivingAt50", 50, 100 * kKmh, 0},
                                           Motion{"turningAt50", 50, 0, 1.0472},
                                           Motion{"at250kmhIn25", 25, 250 * kKmh, 0},
                                           Motion{"swingingAt50", 50, 20, 1.0472, true}),
                         nameOf);

// Light rain's large drops are few: that takes many pictures.
INSTANTIATE_TEST_SUITE_P(LongMotions, Density,
                         ::testing::Values(Motion{"standingAt5", 5, 0, 0},
                                           Motion{"drivingAt5", 5, 100 * kKmh, 0},
                                           Motion{"turningAt5", 5, 0, 1.0472}),
                         nameOf);

// ---- chance ----

// One of 4 x 4 x 4 cells of equal content of the view volume to `reach_m`. Across the picture the solid angle
// is uniform in atan(u V / sqrt(1 + u^2 + V^2)) and, for a given u, in v / sqrt(1 + u^2 + v^2) (u, v: slopes,
// U, V: of the edges); in depth, r^3.
int cellOf(const ViewState& view, const dvec3& p, double reach_m) {
  const double most_u = 1.0 / view.clipFromEye[0][0], most_v = 1.0 / view.clipFromEye[1][1];
  const dvec3 q = dvec3(view.eyeFromWorld * glm::dvec4(p, 1.0));
  const double u = q.x / -q.z, v = q.y / -q.z, r = glm::length(q) / reach_m;
  if (q.z >= 0.0 || r >= 1.0 || std::abs(u) >= most_u || std::abs(v) >= most_v) return -1;
  const auto across = [&](double s) {
    return std::atan(s * most_v / std::sqrt(1.0 + s * s + most_v * most_v));
  };
  const double a = across(u) / across(most_u),
               b = v / std::sqrt(1.0 + u * u + v * v) / (most_v / std::sqrt(1.0 + u * u + most_v * most_v));
  const auto quarter = [](double share) { return std::min(3, static_cast<int>(4.0 * share)); };
  return quarter(0.5 * (a + 1.0)) * 16 + quarter(0.5 * (b + 1.0)) * 4 + quarter(r * r * r);
}

class Chance : public ::testing::TestWithParam<Motion> {};

// Counts are Poisson's with the law's mean in every cell of every picture: sum (n - m)^2 / m has mean K and
// variance K (2 + 1 / m), too few unlike ones being as wrong as too many; and no cell is preferred over all
// pictures: chi-square with 63 degrees of freedom. Each picture is of other drops than the last: the view
// cuts to another place, or has gone on for 8 m (the rarest are seen to 7.4).
TEST_P(Chance, cellsOfTheViewVolumeHoldPoissonCounts) {
  const Motion motion = GetParam();
  const bool cuts = motion.speed_mps < 20.0;
  const int ticks_a_picture = cuts ? 12 : static_cast<int>(std::ceil(8.3 / motion.speed_mps / kTickSeconds));
  constexpr int kPictures = 100, kCells = 64;
  constexpr double kErrors = 4.0;  // 16 statistics: one in a thousand seeds fails
  Field field({.capacity = 200000, .seed = 5});
  Scene scene = sceneWithView(motion.rate_mm_h);
  const SizeLaw law = SizeLaw::of(motion.rate_mm_h);
  const double solid_angle = solidAngle(coneOf(scene.views[0]));
  std::array<std::array<double, kCells>, kGroups> total{};
  std::array<double, kGroups> spread{}, mean{};
  std::array<double, kGroups> reach_m{};
  for (size_t g = 0; g < kGroups; ++g) {
    const double from_mm = speedClasses()[4 * g].from_mm, to_mm = speedClasses()[4 * g + 3].to_mm;
    reach_m[g] = kReachPerDiameter * 1e-3 * from_mm;  // where all of the group are seen
    mean[g] = law.numberDensity(from_mm, to_mm) * solid_angle * std::pow(reach_m[g], 3) / 3.0 / kCells;
  }
  Upload upload;
  std::vector<LiveDrop> drops;
  for (int n = 0; n < kPictures; ++n) {
    for (int i = 0; i < ticks_a_picture; ++i, ++scene.index) {
      scene.views[0].discontinuity = cuts && i == 0;
      place(scene, motion.speed_mps, motion.headingAt(static_cast<double>(scene.index) * kTickSeconds),
            cuts ? 50.0 * n : 0.0);
      field.tick(scene.tick());
    }
    liveDrops(field, upload, drops);
    std::array<std::array<double, kCells>, kGroups> count{};
    for (const LiveDrop& d : drops) {
      const size_t g = groupOf(d.kind);
      if (const int cell = cellOf(scene.views[0], d.place_m, reach_m[g]); cell >= 0)
        ++count[g][static_cast<size_t>(cell)];
    }
    for (size_t g = 0; g < kGroups; ++g) {
      for (size_t c = 0; c < kCells; ++c) {
        total[g][c] += count[g][c];
        spread[g] += (count[g][c] - mean[g]) * (count[g][c] - mean[g]) / mean[g];
      }
    }
  }
  for (size_t g = 0; g < kGroups; ++g) {
    const double k = kPictures * kCells;
    EXPECT_NEAR(spread[g], k, kErrors * std::sqrt(k * (2.0 + 1.0 / mean[g])))
        << "group " << g << ", mean " << mean[g];
    double all = 0.0, chi_square = 0.0;
    for (const double n : total[g]) all += n;
    for (const double n : total[g]) chi_square += (n - all / kCells) * (n - all / kCells) / (all / kCells);
    ASSERT_GT(all / kCells, 20.0);
    EXPECT_NEAR(chi_square, kCells - 1.0, kErrors * std::sqrt(2.0 * (kCells - 1.0))) << "group " << g;
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, Chance,
                         ::testing::Values(Motion{"standing", 50, 0, 0},
                                           Motion{"at250kmh", 25, 250 * kKmh, 0},
                                           Motion{"turning", 50, 0, 1.0472},
                                           Motion{"swinging", 50, 10, 1.0472, true}),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(LongMotions, Chance, ::testing::Values(Motion{"driving", 50, 100 * kKmh, 0}),
                         nameOf);

// ---- flux ----

constexpr size_t kFaces = 5;  // the four sides, and the sphere of the drop's reach

// Births per second through each face by n (v_drop - v_face) . n_in, over all sizes.
std::array<double, kFaces> fluxByTheLaw(const Cone& cone, const ViewState& view, const SizeLaw& law,
                                        const dvec3& wind, const dvec3& face_mps) {
  std::array<double, kFaces> flux{};
  const double most_u = 1.0 / view.clipFromEye[0][0], most_v = 1.0 / view.clipFromEye[1][1];
  const glm::dmat3 worldFromEye = glm::transpose(glm::dmat3(view.eyeFromWorld));
  for (size_t kind = 0; kind < kSpeedClasses; ++kind) {
    const dvec3 past = wind - dvec3(0, 0, speedClasses()[kind].speed_mps) - face_mps;
    double n_area = 0.0;  // sum of n R^2
    overSizes(law, kind, [&](double mm, double per_m3) {
      n_area += per_m3 * std::pow(kReachPerDiameter * 1e-3 * mm, 2);
    });
    for (size_t i = 0; i < 4; ++i) {  // a sector of a disk
      const double angle = std::acos(glm::dot(cone.corners[i], cone.corners[(i + 1) % 4]));
      flux[i] += 0.5 * angle * n_area * std::max(0.0, glm::dot(past, cone.inward[i]));
    }
    constexpr int kSteps = 64;
    for (int a = 0; a < kSteps; ++a) {
      for (int b = 0; b < kSteps; ++b) {
        const double u = most_u * ((a + 0.5) / kSteps * 2.0 - 1.0),
                     v = most_v * ((b + 0.5) / kSteps * 2.0 - 1.0);
        const double patch = 4.0 * most_u * most_v / (kSteps * kSteps) * std::pow(1.0 + u * u + v * v, -1.5);
        flux[4] +=
            n_area * patch * std::max(0.0, -glm::dot(past, worldFromEye * glm::normalize(dvec3(u, v, -1.0))));
      }
    }
  }
  return flux;
}

// The face by which a point that moves from p by `way`, both from the eye, comes into the volume; -1 when it
// does not.
int entryFace(const Cone& cone, const dvec3& p, const dvec3& way, double reach_m) {
  double enter = 0.0, leave = 1.0;
  int face = -1;
  const auto meet = [&](double from, double to, int which) {
    if (from > enter) enter = from, face = which;
    leave = std::min(leave, to);
  };
  for (size_t i = 0; i < 4; ++i) {
    const double inside = glm::dot(cone.inward[i], p), rate = glm::dot(cone.inward[i], way);
    if (rate > 0.0)
      meet(-inside / rate, 2.0, static_cast<int>(i));
    else if (rate < 0.0)
      meet(0.0, inside / -rate, -1);
    else if (inside < 0.0)
      return -1;
  }
  const double b = glm::dot(p, way), a = glm::dot(way, way),
               under = b * b - a * (glm::dot(p, p) - reach_m * reach_m);
  if (under < 0.0) return -1;
  meet((-b - std::sqrt(under)) / a, (-b + std::sqrt(under)) / a, 4);
  return enter < leave ? face : -1;
}

class Flux : public ::testing::TestWithParam<Motion> {};

// 3 %, and 3 standard errors of the count, each below 2 % (of the fullest faces below 0.5 %).
TEST_P(Flux, throughEachFaceIsTheLaws) {
  const Motion motion = GetParam();
  constexpr double kStandardError = 0.01;
  Field field({.capacity = 200000, .seed = 7});
  Scene scene = sceneWithView(motion.rate_mm_h);
  scene.weather.wind_mps = {-1.0, 4.0, 0.0};
  const dvec3 face_mps(motion.speed_mps, 0, 0);
  const SizeLaw law = SizeLaw::of(motion.rate_mm_h);
  const auto flux =
      fluxByTheLaw(coneOf(scene.views[0]), scene.views[0], law, scene.weather.wind_mps, face_mps);
  double least = 1e30;  // of the faces that have any
  for (const double f : flux) least = f > 0.0 ? std::min(least, f) : least;
  const int ticks = static_cast<int>(
      std::clamp(1.0 / (kStandardError * kStandardError * least) / kTickSeconds, 600.0, 4800.0));
  std::array<double, kFaces> births{};
  Upload upload;
  std::vector<LiveDrop> drops;
  for (int i = 0; i < ticks; ++i, ++scene.index) {
    place(scene, motion.speed_mps, 0.0);
    field.tick(scene.tick());
    liveDrops(field, upload, drops);
    const Cone cone = coneOf(scene.views[0]);
    for (const LiveDrop& d : drops) {
      const int face =
          entryFace(cone, d.place_m - cone.eye_m, (d.velocity_mps - face_mps) * kTickSeconds, d.reach_m());
      if (face >= 0) ++births[static_cast<size_t>(face)];
    }
  }
  for (size_t f = 0; f < kFaces; ++f) {
    const double expected = flux[f] * ticks * kTickSeconds;
    if (expected == 0.0) {
      EXPECT_EQ(births[f], 0.0) << "face " << f;
      continue;
    }
    EXPECT_LT(1.0 / std::sqrt(expected), 0.02) << "face " << f << ": the run is too short to tell";
    RecordProperty("face_" + std::to_string(f),
                   std::to_string(births[f] / expected) + " of " + std::to_string(expected));
    EXPECT_NEAR(births[f] / expected, 1.0, 0.03 + 3.0 / std::sqrt(expected))
        << "face " << f << ", expected " << expected;
  }
}
INSTANTIATE_TEST_SUITE_P(Motions, Flux,
                         ::testing::Values(Motion{"standing", 50, 0, 0},
                                           Motion{"driving", 50, 100 * kKmh, 0}),
                         nameOf);

// ---- nothing pops up ----

class Appearance : public ::testing::TestWithParam<Motion> {};

// Whether any of a streak, drawn for a whole exposure, may show: all of it beyond one face of the volume is
// out of sight.
bool mayShow(const Cone& cone, const LiveDrop& d, double ago_s, const dvec3& eye_mps, double exposure_s) {
  const dvec3 place = d.place_m - d.velocity_mps * ago_s - cone.eye_m,
              half = (d.velocity_mps - eye_mps) * (0.5 * exposure_s);
  if (glm::length(place) >= d.reach_m()) return false;
  for (const dvec3& n : cone.inward) {
    if (glm::dot(n, place) + std::abs(glm::dot(n, half)) < 0.0) return false;
  }
  return true;
}

// A drop that a tick brings must not have been due in any picture since the last tick.
TEST_P(Appearance, isOnlyEverFromOutsideTheView) {
  const Motion motion = GetParam();
  Field field({.capacity = 200000, .seed = 9});
  Scene scene = sceneWithView(motion.rate_mm_h);
  const auto at = [&](double ticks, ViewState& view) {
    const double t = ticks * kTickSeconds;
    look(view, {motion.speed_mps * t, 0, 1.5}, motion.headingAt(t));
    view.eye_velocity_mps = {motion.speed_mps, 0, 0};
  };
  std::vector<RainDrop> before, now;
  Upload upload;
  uint64_t appeared = 0, popped = 0;
  for (; scene.index < 400; ++scene.index) {
    at(static_cast<double>(scene.index), scene.views[0]);
    const double gust =
        std::sin(2.0 * 3.14159265358979 * static_cast<double>(scene.index) * kTickSeconds / 3.0);
    scene.weather.wind_mps = {0, motion.crosswind_mps + motion.gust_mps * gust, 0};
    field.tick(scene.tick());
    field.publishAll(upload);
    now.assign(200000, RainDrop{});
    for (size_t i = 0; i < upload.slots.size(); ++i) now[upload.slots[i]] = upload.records[i];
    if (scene.index < 5) before = now;
    std::array<Cone, 5> cones;  // of pictures between the ticks
    for (size_t k = 0; k < cones.size(); ++k) {
      ViewState view = scene.views[0];
      at(static_cast<double>(scene.index) - 0.25 * static_cast<double>(k), view);
      cones[k] = coneOf(view);
    }
    for (const uint32_t slot : upload.slots) {
      const RainDrop &a = before[slot], &b = now[slot];
      if (a.diameter_m > 0.0f && a.id == b.id && a.cell_x == b.cell_x && a.cell_y == b.cell_y &&
          a.cell_z == b.cell_z)
        continue;
      ++appeared;
      const LiveDrop d = liveDropOf(b, upload.picture);
      bool shows = false;
      for (size_t k = 0; k < cones.size(); ++k) {
        shows = shows || mayShow(cones[k], d, 0.25 * kTickSeconds * static_cast<double>(k),
                                 {motion.speed_mps, 0, 0}, scene.views[0].exposure_s);
      }
      popped += shows ? 1 : 0;
    }
    before.swap(now);
  }
  EXPECT_GT(appeared, 10000u);
  EXPECT_EQ(popped, 0u) << "of " << appeared;
}
INSTANTIATE_TEST_SUITE_P(Motions, Appearance,
                         ::testing::Values(Motion{"standing", 50, 0, 0}, Motion{"driving", 50, 100 * kKmh, 0},
                                           Motion{"turning", 50, 0, 1.0472},
                                           Motion{"swinging", 50, 0, 1.0472, true},
                                           Motion{"drivingAndSwinging", 50, 100 * kKmh, 1.0472, true},
                                           Motion{"at250kmh", 50, 250 * kKmh, 0},
                                           Motion{"inCrosswind", 50, 0, 0, false, 20},
                                           Motion{"inGusts", 50, 10, 0, false, 10, 8}),
                         nameOf);

// ---- thinning ----

// A full buffer keeps the same share of every size: no size, hence no distance, is favoured.
TEST(Thinning, isTheSameForAllSizes) {
  Field field({.capacity = 2000, .seed = 11});
  Scene scene = sceneWithView(50);
  const SizeLaw law = SizeLaw::of(50);
  const double solid_angle = solidAngle(coneOf(scene.views[0]));
  std::array<double, kGroups> seen{}, expected{};
  Upload upload;
  std::vector<LiveDrop> drops;
  for (int i = 0; i < 7200; ++i, ++scene.index) {
    place(scene, 100 * kKmh, 0.0);
    field.tick(scene.tick());
    if (i % 30 != 29) continue;
    const double kept = field.stats().thinning;
    ASSERT_LT(kept, 0.6);
    liveDrops(field, upload, drops);
    const Cone cone = coneOf(scene.views[0]);
    for (const LiveDrop& d : drops)
      seen[groupOf(d.kind)] += inVolume(cone, d.place_m, d.reach_m()) ? 1.0 : 0.0;
    for (uint32_t kind = 0; kind < kSpeedClasses; ++kind)
      expected[groupOf(kind)] += kept * expectedInView(law, kind, solid_angle);
  }
  for (size_t g = 0; g < kGroups; ++g) {
    ASSERT_GT(expected[g], 2000.0);
    EXPECT_NEAR(seen[g] / expected[g], 1.0, 0.02 + 3.5 / std::sqrt(expected[g])) << "group " << g;
  }
}

}  // namespace
}  // namespace rg::rain::test
