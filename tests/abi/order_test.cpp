// Calls in the wrong order are refused; those that take something away leave nothing behind that hurts.
#include <malloc.h>

#include <thread>

#include "bad_arguments.h"

namespace rg::test {
namespace {

class Order : public BadArguments {
 protected:
  Order() {
    gl.CreateRenderbuffers(1, &color);
    gl.NamedRenderbufferStorage(color, GL_RGBA16F, SmallScene::kSize_px, SmallScene::kSize_px);
    gl.CreateFramebuffers(1, &framebuffer);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  }
  ~Order() override {
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteRenderbuffers(1, &color);
  }

  void frame(SmallScene& of) const {
    of.expect(of.step());
    of.expect(api.step_gpu(of.instance));
    drawGlass(of);
  }
  void drawGlass(const SmallScene& of) const { of.expect(of.draw(api.draw_glass, of.target(framebuffer))); }

  GLuint color = 0, framebuffer = 0;
};

TEST_F(Order, nothingIsDrawnWithoutAContext) {
  const SmallScene fresh(api);
  rg_instance* const i = fresh.instance;
  const auto refused = [&](rg_result result, const char* what) {
    EXPECT_EQ(result, RG_ERROR_WRONG_ORDER) << what;
    EXPECT_NE(std::string(api.last_error(i)).find("attach_gl"), std::string::npos)
        << what << ": " << api.last_error(i);
  };
  const rg_target target = fresh.target(framebuffer);
  rg_draw draw;
  api.default_draw(&draw);
  draw.view = &scene.view;
  draw.target = &target;
  refused(api.draw_world(i, &draw), "draw_world");
  refused(api.draw_glass(i, &draw), "draw_glass");
  refused(api.draw_finish(i, &draw), "draw_finish");
  refused(api.step_gpu(i), "step_gpu");
  refused(api.detach_gl(i), "detach_gl");
  refused(api.context_lost(i), "context_lost");
  rg_capture_info capture;
  api.default_capture_info(&capture);
  capture.view = &scene.view;
  refused(api.prepare_captures(i, &capture), "prepare_captures");
}

TEST_F(Order, ofLifeAndTimeIsKept) {
  rg_instance* const i = scene.instance;
  expectRefused(
      "attach twice", [&] { return scene.attach(GlContext::getProc); }, RG_ERROR_WRONG_ORDER,
      "attached already");
  expectRefused(
      "prewarm after update", [&] { return api.prewarm(i, 1.0); }, RG_ERROR_WRONG_ORDER, "prewarm");
  expectRefused(
      "prewarm by no number", [&] { return api.prewarm(i, kNaN); }, RG_ERROR_BAD_ARGUMENT, "prewarm");
  expectRefused(
      "time backwards", [&] { return api.update(i, scene.time_ns - 100'000'000, nullptr, 0, 0); },
      RG_ERROR_WRONG_ORDER, "backwards");
  for (const int64_t never : {INT64_MIN, INT64_MAX}) {
    expectRefused(
        "update to no time", [&] { return api.update(i, never, nullptr, 0, 0); }, RG_ERROR_BAD_ARGUMENT,
        "time_ns");
    expectRefused(
        "seek to no time", [&] { return api.seek(i, never); }, RG_ERROR_BAD_ARGUMENT, "time_ns");
    expectRefused(
        "a sample of no time", [&] { return updateWith([&](rg_sample& s) { s.time_ns = never; }); },
        RG_ERROR_BAD_ARGUMENT, "time_ns");
    const rg_wiper_knot knot{never, kWiper, 0, 0.1};
    expectRefused(
        "a knot of no time",
        [&] { return updateWith([&](rg_sample& s) { s.wiper_knots = &knot, s.wiper_knot_count = 1; }); },
        RG_ERROR_BAD_ARGUMENT, "rg_wiper_knot.time_ns");
  }
  const std::array<rg_wiper_knot, 2> knots{rg_wiper_knot{scene.time_ns + 500, kWiper, 0, 0.1},
                                           rg_wiper_knot{scene.time_ns + 400, kWiper, 0, 0.2}};
  expectRefused(
      "knots that fall",
      [&] { return updateWith([&](rg_sample& s) { s.wiper_knots = knots.data(), s.wiper_knot_count = 2; }); },
      RG_ERROR_BAD_ARGUMENT, "does not ascend");
  const std::array<double, 3> shift{kNaN, 0.0, 0.0};
  expectRefused(
      "a shift by no number", [&] { return api.rebase_origin(i, shift.data()); }, RG_ERROR_BAD_ARGUMENT,
      "rebase_origin");
  expectRefused(
      "save without a size", [&] { return api.save(i, nullptr, nullptr); }, RG_ERROR_BAD_ARGUMENT, "save");
  expectRefused(
      "restore of nothing", [&] { return api.restore(i, nullptr, 0); }, RG_ERROR_BAD_ARGUMENT, "restore");
  const SmallScene fresh(api);
  EXPECT_EQ(api.seek(fresh.instance, 0), RG_ERROR_WRONG_ORDER);
  EXPECT_EQ(api.update(fresh.instance, 0, nullptr, 0, 0), RG_ERROR_WRONG_ORDER);
  EXPECT_NE(std::string(api.last_error(fresh.instance)).find("sample"), std::string::npos);
}

TEST_F(Order, arraysWithoutPointersOrWithHugeCountsAreRefused) {
  rg_view view = scene.view;
  rg_vehicle car;
  api.default_vehicle(&car);
  car.id = kCar;
  const auto refused = [&](const std::string& field, rg_result code,
                           const std::function<void(rg_sample&)>& spoil) {
    expectRefused(
        field, [&] { return updateWith(spoil); }, code, field);
  };
  refused("rg_sample.vehicles", RG_ERROR_BAD_ARGUMENT, [](rg_sample& s) { s.vehicle_count = 1; });
  refused("rg_sample.views", RG_ERROR_BAD_ARGUMENT, [](rg_sample& s) { s.view_count = 1; });
  refused("rg_sample.wiper_knots", RG_ERROR_BAD_ARGUMENT, [](rg_sample& s) { s.wiper_knot_count = 1; });
  refused("rg_sample.vehicles", RG_ERROR_BAD_ARGUMENT,
          [&](rg_sample& s) { s.vehicles = &car, s.vehicle_count = 0xFFFFFFFF; });
  refused("rg_sample.views", RG_ERROR_BAD_ARGUMENT,
          [&](rg_sample& s) { s.views = &view, s.view_count = 0xFFFFFFFF; });
  refused("rg_sample.views", RG_ERROR_BAD_STRUCT,
          [&](rg_sample& s) { s.views = &view, s.view_count = 1, s.view_stride = 8; });
  refused("rg_sample.vehicles", RG_ERROR_BAD_STRUCT,
          [&](rg_sample& s) { s.vehicles = &car, s.vehicle_count = 1, s.vehicle_stride = sizeof car + 4; });
  const std::array<rg_view, 2> twice{view, view};
  refused("rg_sample.views", RG_ERROR_BAD_ARGUMENT,
          [&](rg_sample& s) { s.views = twice.data(), s.view_count = 2; });
  rg_sample sample;
  api.default_sample(&sample);
  expectRefused(
      "samples",
      [&] { return api.update(scene.instance, scene.time_ns, &sample, 0xFFFFFFFF, sizeof sample); },
      RG_ERROR_BAD_ARGUMENT, "samples");
}

TEST_F(Order, resetLeavesTheGlassDry) {
  for (int i = 0; i < 10; ++i) frame(scene);
  ASSERT_EQ(api.reset(scene.instance), RG_OK);
  drawGlass(scene);  // before the film heard of it
  rg_pane_stats stats{};
  stats.struct_size = sizeof stats;
  scene.expect(api.get_pane_stats(scene.instance, kPane, &stats));
  EXPECT_EQ(stats.caught_ml, 0.0);
  EXPECT_EQ(stats.on_glass_ml, 0.0);
}

// What the film is asked for waits for the first step_gpu, so that the state does not depend on when it came.
TEST_F(Order, theFirstStepMayComeLate) {
  SmallScene late(api), early(api);
  uint64_t expected = 0, found = 1;
  for (SmallScene* s : {&late, &early}) {
    ASSERT_EQ(s->attach(GlContext::getProc), RG_OK);
    for (int i = 0; i < 60; ++i) {
      s->expect(s->step());
      if (s == &early) s->expect(api.step_gpu(s->instance));
    }
    s->expect(api.get_hash(s->instance, RG_HASH_STATE, s == &early ? &expected : &found));
    s->expect(api.detach_gl(s->instance));
  }
  EXPECT_EQ(found, expected);
}

// Replaced with its film's work under way, a pane starts dry, is drawn once it is there, and keeps its
// wipers.
TEST_F(Order, aReplacedPaneStartsDryAndKeepsItsWipers) {
  for (int i = 0; i < 10; ++i) frame(scene);
  scene.expect(scene.step());
  scene.expect(scene.setPane());
  drawGlass(scene);
  rg_pane_stats stats{};
  stats.struct_size = sizeof stats;
  scene.expect(api.get_pane_stats(scene.instance, kPane, &stats));
  EXPECT_EQ(stats.caught_ml, 0.0);
  for (int i = 0; i < 60; ++i) frame(scene);
  scene.expect(api.get_pane_stats(scene.instance, kPane, &stats));
  EXPECT_GT(stats.caught_ml, 0.0);
  EXPECT_GT(stats.wiped_ml + stats.ridge_ml, 0.0) << "its wiper is gone";
  EXPECT_LT(stats.ledger_error, 1e-12);  // a few roundings of doubles
  EXPECT_EQ(api.remove_wiper(scene.instance, kWiper), RG_OK);
}

TEST_F(Order, removingThingsWhileAttachedLeavesNothingToTripOver) {
  for (int i = 0; i < 5; ++i) frame(scene);
  EXPECT_EQ(api.remove_pane(scene.instance, kPane), RG_OK);
  drawGlass(scene);
  EXPECT_EQ(api.remove_wiper(scene.instance, kWiper), RG_ERROR_NOT_FOUND) << "it went with its pane";
  frame(scene);
  scene.expect(scene.setPane());
  scene.expect(scene.setWiper());
  frame(scene);
  EXPECT_EQ(api.remove_vehicle(scene.instance, kCar), RG_OK);
  drawGlass(scene);
  EXPECT_EQ(api.remove_pane(scene.instance, kPane), RG_ERROR_NOT_FOUND) << "it went with its car";
  EXPECT_EQ(api.remove_volume(scene.instance, kRoof), RG_OK) << "the roof is the world's";
  frame(scene);
}

TEST_F(Order, aLostContextLosesTheFilmAndNoWaterOfTheLedger) {
  for (int i = 0; i < 30; ++i) frame(scene);
  scene.expect(scene.step());
  EXPECT_EQ(api.context_lost(scene.instance), RG_OK);
  rg_pane_stats stats{};
  stats.struct_size = sizeof stats;
  scene.expect(api.get_pane_stats(scene.instance, kPane, &stats));
  EXPECT_GT(stats.caught_ml, 0.0);
  EXPECT_EQ(stats.film_ml, 0.0);
  EXPECT_LT(stats.ledger_error, 1e-12);  // a few roundings of doubles
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  for (int i = 0; i < 10; ++i) frame(scene);
  scene.expect(api.get_pane_stats(scene.instance, kPane, &stats));
  EXPECT_LT(stats.ledger_error, 1e-12);  // a few roundings of doubles
}

// What the GL thread does not fetch must not pile up, with a context or without.
TEST_F(Order, updatesThatNobodyDrawsTakeNoMoreMemory) {
  for (const bool attached : {true, false}) {
    SmallScene undrawn(api, 1000);
    if (attached) undrawn.expect(undrawn.attach(GlContext::getProc));
    const auto run = [&](int steps) {
      for (int i = 0; i < steps; ++i) undrawn.expect(undrawn.step());
      return mallinfo2().uordblks;
    };
    const size_t before = run(400), after = run(1200);
    // 1000 drops are 32 kB; 1200 updates that pile up are some MB.
    EXPECT_LT(after, before + 500'000) << (attached ? "attached" : "without a context");
    if (attached) undrawn.expect(api.detach_gl(undrawn.instance));
  }
}

// With the GPU's own timestamps too (which software GL would not use): their queries outlive no context.
TEST_F(Order, destroyingWhileAttachedForgetsTheTimersQueries) {
  SmallScene doomed(api);
  const auto hardware = [](void*, const char* name) -> void* {
    static constexpr auto kText = [](GLenum what) -> const GLubyte* {
      if (what == GL_RENDERER) return reinterpret_cast<const GLubyte*>("Some GPU");
      return reinterpret_cast<const GLubyte* (*)(GLenum)>(GlContext::getProc(nullptr, "glGetString"))(what);
    };
    if (std::strcmp(name, "glGetString") != 0) return GlContext::getProc(nullptr, name);
    return reinterpret_cast<void*>(static_cast<const GLubyte* (*)(GLenum)>(kText));
  };
  ASSERT_EQ(doomed.attach(hardware), RG_OK);
  int32_t kind = RG_TIMER_FINISH;
  doomed.expect(api.get_timer_kind(doomed.instance, &kind));
  if (kind != RG_TIMER_GPU) GTEST_SKIP() << "this driver has no timestamps";
  frame(doomed);
  std::thread([&] {
    api.destroy(std::exchange(doomed.instance, nullptr));
  }).join();  // no context is current there
}

TEST_F(Order, eachThreadHasItsOwnLastError) {
  EXPECT_EQ(api.remove_pane(scene.instance, 77), RG_ERROR_NOT_FOUND);
  std::string first, second;
  std::thread([&] {
    first = api.last_error(scene.instance);
    api.remove_wiper(scene.instance, 88);
    second = api.last_error(scene.instance);
  }).join();
  EXPECT_NE(first.find("pane 77"), std::string::npos)
      << "a thread without an error of its own sees the instance's last one";
  EXPECT_NE(second.find("wiper 88"), std::string::npos);
  EXPECT_NE(std::string(api.last_error(scene.instance)).find("pane 77"), std::string::npos);
}

}  // namespace
}  // namespace rg::test
