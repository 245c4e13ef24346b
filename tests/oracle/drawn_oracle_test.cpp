// What the GPU really draws of the rain: nothing lies where it is dry, and it is what the CPU works out, to
// within rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "drawn.h"
#include "drive.h"
#include "rain/region.h"

namespace oracle {
namespace {

using rg::rain::Picture, rg::rain::RainDrop, rg::rain::Streak, rg::rain::StreakSetup, rg::rain::Upload;

// Up to 20 m from the eye floats are 2 um apart, and the planes' distances up to 128 m 8 um; no two machines
// round a sum of products alike, but none places a drop or a plane further off than this.
constexpr double kRounding_m = 10e-6;
// A drop fades out at the end of its reach, with no slope, so that rounding tells where: in the last 2e-4 of
// it the drop shows less than 1e-6 of itself.
constexpr double kFaded = 2e-4;

// What the vertex shader leaves of a segment: the part before the eye.
Segment beforeEye(Segment s, const rg::ViewState& view, double nearest_m) {
  const glm::dvec3 eye = rg::rain::coneOf(view).eye_m;
  const glm::dvec3 forward = glm::transpose(glm::dmat3(view.eyeFromWorld)) * glm::dvec3(0, 0, -1);
  const double from = glm::dot(s.from_m - eye, forward) - nearest_m,
               to = glm::dot(s.to_m - eye, forward) - nearest_m;
  if (!s.drawn || (from <= 0.0 && to <= 0.0)) return {};
  if (from > 0.0 && to > 0.0) return s;
  (from < to ? s.from_m : s.to_m) = s.from_m + (s.to_m - s.from_m) * (from / (from - to));
  return s;
}

// Whether any of a segment before the eye can be in the picture: the box about it is.
bool meetsPicture(const Segment& s, const rg::ViewState& view) {
  glm::dvec2 low(1e30), high(-1e30);
  for (const glm::dvec3& p : {s.from_m, s.to_m}) {
    const glm::dvec4 clip = view.clipFromEye * view.eyeFromWorld * glm::dvec4(p, 1.0);
    const glm::dvec2 ndc(clip.x / clip.w, clip.y / clip.w);
    low = glm::min(low, ndc);
    high = glm::max(high, ndc);
  }
  return low.x < 1.0 && low.y < 1.0 && high.x > -1.0 && high.y > -1.0;
}

bool isNear(const glm::dvec3& p, const Segment& s) {
  const glm::dvec3 way = s.to_m - s.from_m;
  const double along = glm::dot(p - s.from_m, way) / std::max(glm::dot(way, way), 1e-30);
  return glm::distance(p, s.from_m + way * std::clamp(along, 0.0, 1.0)) < kRounding_m;
}

// Whether all of `inner` lies on `outer`, as far as rounding can tell: what is shorter may be there or not.
bool holds(const Segment& outer, const Segment& inner) {
  if (!inner.drawn || glm::distance(inner.from_m, inner.to_m) < kRounding_m) return true;
  return outer.drawn && isNear(inner.from_m, outer) && isNear(inner.to_m, outer);
}

bool alike(const Segment& a, const Segment& b) {
  if (!a.drawn || !b.drawn) return a.drawn == b.drawn;
  return glm::distance(a.from_m, b.from_m) < kRounding_m && glm::distance(a.to_m, b.to_m) < kRounding_m;
}

std::string told(const Segment& s) {
  if (!s.drawn) return "nothing";
  const auto point = [](const glm::dvec3& p) {
    return std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z);
  };
  return point(s.from_m) + " to " + point(s.to_m);
}

// The CPU's instance of the kernel, on the same records and uniform blocks as the GPU's.
class CpuKernel {
 public:
  explicit CpuKernel(uint32_t capacity_drops) : records_(capacity_drops) {}

  void take(const Upload& upload) {
    for (size_t i = 0; i < upload.slots.size(); ++i) records_[upload.slots[i]] = upload.records[i];
    picture_ = upload.picture;
  }

  void look(const rg::ViewState& view, int64_t time_ns) {
    view_ = view;
    setUp(time_ns, 1.0, *least_);
    setUp(time_ns, -1.0, *most_);
  }

  // Whether rounding alone may make this of a drop's streak. Where one grazes a volume, or its drop lies in
  // the surface, the least decides on all of it, so that ends cannot be compared: no more may be drawn than
  // with all volumes smaller by what rounding is, and no less than with all so much larger.
  bool mayBe(uint32_t slot, const Segment& segment) const {
    return holds(segmentOf(slot, *most_, -1.0), segment) && holds(segment, segmentOf(slot, *least_, 1.0));
  }

 private:
  void setUp(int64_t time_ns, double sign, StreakSetup& out) const {
    rg::rain::setUpStreaks(picture_, view_, time_ns, out);
    for (glm::vec4& plane : out.shelter.planes) plane.w += static_cast<float>(sign * kRounding_m);
    for (auto& c : out.classes) c.velocity_reach.w *= static_cast<float>(1.0 - sign * kFaded);
  }

  Segment segmentOf(uint32_t slot, const StreakSetup& setup, double sign) const {
    const RainDrop& drop = records_[slot];
    if (drop.diameter_m <= 0.0f) return {};
    const auto streak =
        rg::shared::rainStreak(drop, setup.classes[rg::shared::rainClassOf(drop)], setup.view, setup.shelter);
    const glm::dvec3 place = glm::dvec3(streak.drop_m) + rg::rain::coneOf(view_).eye_m,
                     velocity(streak.velocity_mps);
    const Segment whole{streak.from_s < streak.to_s, place + velocity * static_cast<double>(streak.from_s),
                        place + velocity * static_cast<double>(streak.to_s)};
    return beforeEye(whole, view_, static_cast<double>(rg::shared::kRainNearest_m) + sign * kRounding_m);
  }

  std::vector<RainDrop> records_;
  Picture picture_;
  rg::ViewState view_;
  std::unique_ptr<StreakSetup> least_ = std::make_unique<StreakSetup>(),
                               most_ = std::make_unique<StreakSetup>();
};

struct Tally {
  uint64_t frames = 0, drawn = 0, inside = 0;
  uint64_t rounded = 0;  // the CPU's is another, for rounding's sake
  uint64_t others = 0;   // the CPU's is another altogether
  std::string first_other;
  double deepest_m = -1e30;
};

class Both {
 public:
  Both(const Variant& variant, double frame_s)
      : drive(variant, frame_s), gpu_(drive.capacity_drops()), kernel_(drive.capacity_drops()) {}

  Tally run() {
    while (drive.next()) frame();
    EXPECT_EQ(gpu_.complaints(), "");
    return tally_;
  }

  Drive drive;

 private:
  void frame() {
    ++tally_.frames;
    const rg::ViewState view = drive.view();
    drive.field().publish(upload_);
    kernel_.take(upload_);
    kernel_.look(view, drive.pluginTime_ns());
    std::vector<Segment> drawn = gpu_.draw(upload_, view, drive.pluginTime_ns());
    for (const Segment& s : drawn) {
      if (s.drawn) judge(s);
    }
    drive.field().streaks(view, drive.pluginTime_ns(), streaks_);
    std::vector<Segment> expected(drawn.size());
    for (const Streak& s : streaks_)
      expected.at(s.slot) = beforeEye({true, s.from_m, s.to_m}, view, rg::shared::kRainNearest_m);
    for (uint32_t slot = 0; slot < drawn.size(); ++slot) {
      // What is not in the picture need not be drawn.
      if (!drawn[slot].drawn && expected[slot].drawn && !meetsPicture(expected[slot], view)) continue;
      compare(slot, drawn[slot], expected[slot]);
    }
  }

  void judge(const Segment& s) {
    const double depth_m = drive.depth(s.from_m, s.to_m);
    tally_.deepest_m = std::max(tally_.deepest_m, depth_m);
    tally_.inside += depth_m > kTolerance_m ? 1u : 0u;
    ++tally_.drawn;
  }

  void compare(uint32_t slot, const Segment& gpu, const Segment& cpu) {
    if (alike(gpu, cpu)) return;
    if (kernel_.mayBe(slot, gpu) && kernel_.mayBe(slot, cpu)) {
      ++tally_.rounded;
    } else if (tally_.others++ == 0) {
      tally_.first_other = "at " + std::to_string(drive.time_s()) + " s, slot " + std::to_string(slot) +
                           ", on the GPU " + told(gpu) + ", on the CPU " + told(cpu);
    }
  }

  DrawnStreaks gpu_;
  CpuKernel kernel_;
  Upload upload_;
  std::vector<Streak> streaks_;
  Tally tally_;
};

void drawAndJudge(const Variant& variant, double frame_s) {
  Both both(variant, frame_s);
  const Tally t = both.run();
  std::printf("%s: %llu frames, %llu streaks drawn, %llu of them otherwise rounded, deepest %.3f mm\n",
              nameOf(variant).c_str(), static_cast<unsigned long long>(t.frames),
              static_cast<unsigned long long>(t.drawn), static_cast<unsigned long long>(t.rounded),
              t.deepest_m * 1e3);
  EXPECT_EQ(t.inside, 0u);
  EXPECT_EQ(t.others, 0u) << t.first_other;
  EXPECT_TRUE(both.drive.was_under_cover);
  EXPECT_GT(t.drawn, 300 * t.frames);
  // Where streaks fade, 6 kFaded of a cone, and where one meets a face at a small angle: a few in a thousand.
  EXPECT_LT(static_cast<double>(t.rounded), 0.005 * static_cast<double>(t.drawn));
  if (!variant.brake_for.empty()) {
    EXPECT_GT(both.drive.hardest_braking_mps2, 9.81);
  }
}

class Drawn : public ::testing::TestWithParam<Variant> {};
TEST_P(Drawn, streaksAreTheCpusAndNoneLiesInsideAnyVolume) { drawAndJudge(GetParam(), kRareFrame_s); }
INSTANTIATE_TEST_SUITE_P(
    Brief, Drawn,
    ::testing::Values(briefly(Variant{.scenario = "tunnel", .changes = {"weather.wind_y_mps=40"}}),
                      briefly(Variant{.scenario = "canopy"}), briefly(kKinds[4]),
                      briefly(Variant{.scenario = "canopy", .changes = {"seconds=8"}, .falls = "snow"}),
                      briefly(Variant{.scenario = "canopy", .changes = {"seconds=8"}, .falls = "hail"})),
    [](const auto& v) { return nameOf(v.param); });

class DrawnAtEveryFrame : public ::testing::TestWithParam<Variant> {};
TEST_P(DrawnAtEveryFrame, streaksAreTheCpusAndNoneLiesInsideAnyVolume) {
  drawAndJudge(GetParam(), 1.0 / 60.0);
}
INSTANTIATE_TEST_SUITE_P(LongKinds, DrawnAtEveryFrame, ::testing::ValuesIn(kKinds),
                         [](const auto& v) { return nameOf(v.param); });
INSTANTIATE_TEST_SUITE_P(LongOthers, DrawnAtEveryFrame, ::testing::ValuesIn(kOthers),
                         [](const auto& v) { return nameOf(v.param); });

TEST(DrawnOracle, seesTheRainThatIsDrawnInsideWithoutShelter) {
  Variant variant = briefly(Variant{.scenario = "canopy", .sheltered = false});
  variant.changes.emplace_back("seconds=4");
  Both both(variant, kRareFrame_s);
  const Tally t = both.run();
  EXPECT_GT(t.inside, 100 * t.frames);
}

// What is read back is what is drawn: the program that gives out its segments' ends draws the same picture.
TEST(DrawnOracle, changesNothingByReadingBack) {
  Drive drive({.scenario = "canopy"});
  ASSERT_TRUE(drive.next());
  rg::test::Picture pictures[2];
  for (const size_t read_back : {0u, 1u}) {
    DrawnStreaks gpu(drive.capacity_drops(), read_back == 1);
    Upload upload;
    drive.field().publishAll(upload);
    gpu.draw(upload, drive.view(), drive.pluginTime_ns());
    pictures[read_back] = gpu.picture();
  }
  EXPECT_TRUE(std::ranges::any_of(pictures[0].pixels, [](const glm::vec4& p) { return p.x > 0.0f; }));
  EXPECT_EQ(rg::test::greatestDifference(pictures[0], pictures[1]), 0.0f);
}

}  // namespace
}  // namespace oracle
