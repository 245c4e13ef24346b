// Windows that slide, through the ABI.
#include "bad_arguments.h"
#include "picture.h"
#include "plugin_library.h"

namespace rg::test {
namespace {

class SlidingArguments : public BadArguments {
 protected:
  rg_result tell(const rg_opening_knot* knots, uint32_t count) const {
    rg_sample sample;
    api.default_sample(&sample);
    sample.time_ns = scene.time_ns + 5'000'000;
    sample.opening_knots = knots;
    sample.opening_knot_count = count;
    return api.update(scene.instance, sample.time_ns, &sample, 1, sizeof sample);
  }
};

TEST_F(SlidingArguments, refusesNonsense) {
  const rg_opening_knot good{scene.time_ns, kPane, 0, 0.1};
  const auto refused = [&](const char* what, const std::string& field, rg_opening_knot first,
                           rg_opening_knot second) {
    const std::array<rg_opening_knot, 2> knots{first, second};
    expectRefused(
        what, [&] { return tell(knots.data(), 2); }, RG_ERROR_BAD_ARGUMENT, field);
  };
  const auto with = [&](const std::function<void(rg_opening_knot&)>& spoil) {
    rg_opening_knot knot = good;
    spoil(knot);
    return knot;
  };
  refused("no number", "opening_m", good, with([](rg_opening_knot& k) { k.opening_m = kNaN; }));
  refused("above its frame", "opening_m", good, with([](rg_opening_knot& k) { k.opening_m = -0.01; }));
  refused("down a mine", "opening_m", good, with([](rg_opening_knot& k) { k.opening_m = 11.0; }));
  refused("no pane", "pane", good, with([](rg_opening_knot& k) { k.pane = 0; }));
  refused("to come", "after its sample", good, with([](rg_opening_knot& k) { k.time_ns += 6'000'000; }));
  refused("not ascending", "ascend", good, with([](rg_opening_knot& k) { k.time_ns -= 1; }));
  expectRefused(
      "a count without knots", [&] { return tell(nullptr, 1); }, RG_ERROR_BAD_ARGUMENT, "opening_knots");
}

// A window of 0.4 m in driving rain, opened by 0.3 m and shut again between 0.2 and 0.8 s, time cut into
// pieces of so many ticks.
struct Driven {
  uint64_t state;
  rg_pane_stats stats;
};
Driven driveWithWindow(const rg_api& api, int ticks_an_update, bool opens) {
  SmallScene scene(api);
  scene.expect(api.remove_wiper(scene.instance, kWiper));
  rg_weather weather;
  api.default_weather(&weather);
  weather.rain_mm_h = 50.0;
  weather.wind_mps[0] = -10.0;
  const rg_vehicle car = [&] {
    rg_vehicle v;
    api.default_vehicle(&v);
    v.id = kCar;
    return v;
  }();
  constexpr int kTicks = 120;
  std::vector<rg_opening_knot> knots(kTicks + 1);
  for (int tick = 0; tick <= kTicks;) {
    std::vector<rg_sample> samples;
    for (int k = 0; k < ticks_an_update && tick <= kTicks; ++k, ++tick) {
      rg_sample sample;
      api.default_sample(&sample);
      sample.time_ns = tick * INT64_C(1'000'000'000) / 120;
      sample.weather = &weather;
      sample.vehicles = &car;
      sample.vehicle_count = 1;
      knots[static_cast<size_t>(tick)] = {sample.time_ns, kPane, 0,
                                          tick < 24 || tick > 96 ? 0.0 : 0.3 - std::abs(tick - 60) / 120.0};
      sample.opening_knots = opens ? &knots[static_cast<size_t>(tick)] : nullptr;
      sample.opening_knot_count = opens ? 1 : 0;
      samples.push_back(sample);
    }
    scene.expect(api.update(scene.instance, samples.back().time_ns, samples.data(),
                            static_cast<uint32_t>(samples.size()), sizeof(rg_sample)));
  }
  Driven out{};
  out.stats.struct_size = sizeof out.stats;
  scene.expect(api.get_pane_stats(scene.instance, kPane, &out.stats));
  scene.expect(api.get_hash(scene.instance, RG_HASH_STATE, &out.state));
  return out;
}

TEST(SlidingWindow, isTheSameHoweverTimeIsCut) {
  PluginLibrary library;
  const Driven by_ticks = driveWithWindow(*library.api, 1, true);
  EXPECT_EQ(driveWithWindow(*library.api, 7, true).state, by_ticks.state);
  EXPECT_EQ(driveWithWindow(*library.api, 121, true).state, by_ticks.state);
  const Driven shut = driveWithWindow(*library.api, 1, false);
  EXPECT_NE(shut.state, by_ticks.state);
  // For 0.6 of the second it was open by 0.15 of 0.4 m in the mean; of some 600 drops the large ones count.
  EXPECT_NEAR(by_ticks.stats.caught_ml / shut.stats.caught_ml, 1.0 - 0.6 * 0.15 / 0.4, 0.1);
  EXPECT_LT(by_ticks.stats.ledger_error, 1e-12) << "rounding of millilitres";
}

// Of a soaked pane nothing is drawn below its upper edge, wherever that is; where it stood before there is
// the world as it was.
class SlidingPicture : public GlTest {
 protected:
  static constexpr int kSize_px = SmallScene::kSize_px;
  PluginLibrary plugin;
};

TEST_F(SlidingPicture, showsTheGlassThatIsThere) {
  GLuint color = 0, framebuffer = 0;
  gl.CreateRenderbuffers(1, &color);
  gl.NamedRenderbufferStorage(color, GL_RGBA16F, kSize_px, kSize_px);
  gl.CreateFramebuffers(1, &framebuffer);
  gl.NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  SmallScene scene(*plugin.api);
  scene.rain_mm_h = 100.0;
  scene.expect(scene.api.remove_wiper(scene.instance, kWiper));
  scene.expect(scene.attach(GlContext::getProc));
  for (int i = 0; i < 60; ++i) {
    scene.expect(scene.step());
    scene.expect(scene.api.step_gpu(scene.instance));
  }
  // From 1 m before the pane, backwards, where dry glass shows too: what it mirrors.
  const auto lookFromOutside = [&] {
    const double car_m = scene.view.eye_from_world[14];
    const std::array<double, 16> eye{0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1.2, -(car_m + 2.0), 1};
    std::memcpy(scene.view.eye_from_world, eye.data(), sizeof scene.view.eye_from_world);
    scene.view.vehicle = 0;
  };
  // Rows of the picture, from below, that differ from the bare background.
  const auto changedRows = [&] {
    const std::array<float, 4> ground{0.05f, 0.05f, 0.05f, 1.0f}, sky{1.0f, 1.0f, 1.0f, 1.0f};
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, ground.data());
    gl.Enable(GL_SCISSOR_TEST);
    for (int x = 0; x < kSize_px; x += 4) {  // stripes: water anywhere bends some edge
      gl.Scissor(x, 0, 2, kSize_px);
      gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, sky.data());
    }
    gl.Disable(GL_SCISSOR_TEST);
    const Picture bare = readFramebuffer(gl, framebuffer, kSize_px, kSize_px);
    scene.expect(scene.draw(scene.api.draw_glass, scene.target(framebuffer)));
    const Picture seen = readFramebuffer(gl, framebuffer, kSize_px, kSize_px);
    std::pair<int, int> rows{kSize_px, -1};
    for (int y = 0; y < kSize_px; ++y) {
      for (int x = 0; x < kSize_px; ++x) {
        if (seen.at(x, y) == bare.at(x, y)) continue;
        rows = {std::min(rows.first, y), std::max(rows.second, y)};
      }
    }
    return rows;
  };
  const auto open = [&](double opening_m) {
    const rg_opening_knot knot{scene.time_ns + 1'000'000, kPane, 0, opening_m};
    rg_sample sample;
    scene.api.default_sample(&sample);
    sample.time_ns = scene.time_ns + 5'000'000;
    sample.opening_knots = &knot;
    sample.opening_knot_count = 1;
    scene.expect(scene.api.update(scene.instance, sample.time_ns, &sample, 1, sizeof sample));
    scene.expect(scene.step());
    scene.expect(scene.api.step_gpu(scene.instance));
  };
  // The eye is 1.2 m up and 1 m off the pane, its view 90 degrees wide.
  const auto rowOf = [](double height_m) { return (0.5 + 0.5 * (height_m - 1.2)) * kSize_px; };
  constexpr double kDrop_px = 2.0;  // a drop on the edge is drawn across it, a dry edge not at all
  const auto expectRows = [&](double low_m, double high_m) {
    const auto rows = changedRows();
    EXPECT_NEAR(rows.first, rowOf(low_m), kDrop_px);
    EXPECT_NEAR(rows.second + 1, rowOf(high_m), kDrop_px);
  };
  expectRows(1.0, 1.4);
  lookFromOutside();
  expectRows(1.0, 1.4);
  open(0.2);
  expectRows(1.0, 1.2);
  lookFromOutside();
  expectRows(1.0, 1.2);
  open(0.5);
  EXPECT_EQ(changedRows().second, -1) << "all of it is behind the sill";
  lookFromOutside();
  EXPECT_EQ(changedRows().second, -1) << "all of it is behind the sill";
  scene.expect(scene.api.detach_gl(scene.instance));
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteRenderbuffers(1, &color);
}

// Hosts of the headers before know no sill and no knots.
TEST(OlderHosts, haveWindowsThatStayAsTheyAre) {
  PluginLibrary library;
  const SmallScene scene(*library.api);
  std::array<rg_sample, 2> samples;
  const size_t older = offsetof(rg_sample, opening_knots);
  std::vector<unsigned char> packed(2 * older);
  for (size_t i = 0; i < 2; ++i) {
    scene.api.default_sample(&samples[i]);
    samples[i].struct_size = static_cast<uint32_t>(older);
    samples[i].time_ns = static_cast<int64_t>(i + 1) * 10'000'000;
    std::memcpy(&packed[i * older], &samples[i], older);
  }
  const void* at = packed.data();
  EXPECT_EQ(scene.api.update(scene.instance, 20'000'000, static_cast<const rg_sample*>(at), 2, older), RG_OK);
}

}  // namespace
}  // namespace rg::test
