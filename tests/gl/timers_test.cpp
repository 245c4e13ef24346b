#include "gl/timers.h"

#include <gtest/gtest.h>

#include <thread>

#include "gl_fixture.h"

namespace rg::gl {
namespace {

using std::chrono::milliseconds;

TEST(TimerWindow, givesPercentilesByNearestRank) {
  Window window;
  EXPECT_EQ(window.percentile(0.5), 0.0);
  for (int i = 100; i >= 1; --i) window.add(i);
  EXPECT_EQ(window.percentile(0.50), 50.0);
  EXPECT_EQ(window.percentile(0.95), 95.0);
  EXPECT_EQ(window.percentile(0.99), 99.0);
  EXPECT_EQ(window.percentile(1.00), 100.0);
  EXPECT_EQ(window.percentile(0.00), 1.0);
}

TEST(TimerWindow, ofOneValueIsThatValueEverywhere) {
  Window window;
  window.add(7.0);
  EXPECT_EQ(window.percentile(0.5), 7.0);
  EXPECT_EQ(window.percentile(0.99), 7.0);
}

TEST(TimerWindow, forgetsWhatIsOlderThanItsCapacity) {
  Window window;
  for (size_t i = 0; i < Window::kCapacity; ++i) window.add(1000.0);
  for (size_t i = 0; i < Window::kCapacity; ++i) window.add(1.0);
  EXPECT_EQ(window.percentile(1.0), 1.0);
  EXPECT_EQ(window.size(), Window::kCapacity);
  EXPECT_EQ(window.total(), 2 * Window::kCapacity);
}

TEST(CpuStages, measureWithoutAnyContextAndNest) {
  Timers timers;
  const auto outer = timers.add("outer", false), inner = timers.add("inner", false);
  {
    const ScopedStage a(timers, outer);
    const ScopedStage b(timers, inner);
    std::this_thread::sleep_for(milliseconds(5));
  }
  const StageTimes times = timers.times(outer);
  EXPECT_EQ(times.name, "outer");
  EXPECT_FALSE(times.gpu);
  EXPECT_EQ(times.samples, 1u);
  EXPECT_GE(times.cpu_ms.p50, timers.times(inner).cpu_ms.p50);
  EXPECT_GE(timers.times(inner).cpu_ms.p50, 5.0);
  timers.clear();
  EXPECT_EQ(timers.times(outer).samples, 0u);
}

TEST(CpuStages, mayRunOnAnotherThreadThanQuestions) {
  Timers timers;
  const auto stage = timers.add("update", false), other = timers.add("draw", false);
  std::thread thread([&] {
    for (int i = 0; i < 2000; ++i) const ScopedStage scope(timers, stage);
  });
  for (int i = 0; i < 200; ++i) {
    const ScopedStage scope(timers, other);
    timers.times(stage);
  }
  thread.join();
  EXPECT_EQ(timers.times(stage).samples, 2000u);
  EXPECT_EQ(timers.times(other).samples, 200u);
}

class GpuStages : public test::GlTest {
 protected:
  std::unique_ptr<Context> loaded = loadContext(test::GlContext::getProc, nullptr);
  void clearLargeTexture() {
    const Texture2D texture(gl, GL_RGBA32F, 1024, 1024);
    const Framebuffer framebuffer(gl, {&texture});
    const float color[4] = {1.0f, 0.5f, 0.25f, 1.0f};
    for (int i = 0; i < 8; ++i) gl.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, color);
  }
};

TEST_F(GpuStages, finishOnSoftwareRenderersAndStampElsewhere) {
  Timers timers;
  timers.attach(*loaded, false);
  EXPECT_EQ(timers.kind(), loaded->software ? TimerKind::kFinish : TimerKind::kGpu);
  loaded->software = false;
  timers.attach(*loaded, false);
  EXPECT_EQ(timers.kind(), TimerKind::kGpu);
  timers.attach(*loaded, true);
  EXPECT_EQ(timers.kind(), TimerKind::kFinish);
}

TEST_F(GpuStages, byFinishHoldTheWholeWork) {
  Timers timers;
  const auto stage = timers.add("clear", true);
  timers.attach(*loaded, true);
  {
    const ScopedStage scope(timers, stage);
    clearLargeTexture();
  }
  const StageTimes times = timers.times(stage);
  EXPECT_GT(times.gpu_ms.p50, 0.0);
  EXPECT_GE(times.gpu_ms.p50, times.cpu_ms.p50);
}

TEST_F(GpuStages, byTimestampArriveLaterAndNeverWait) {
  loaded->software = false;
  Timers timers;
  const auto stage = timers.add("clear", true);
  timers.attach(*loaded, false);
  // Far more runs than the ring has room for, none collected: the surplus is left out.
  for (int i = 0; i < 200; ++i) const ScopedStage scope(timers, stage);
  EXPECT_EQ(timers.times(stage).samples, 200u);
  EXPECT_EQ(timers.times(stage).gpu_ms.p50, 0.0);
  gl.Finish();
  timers.collect();
  {
    const ScopedStage scope(timers, stage);
    clearLargeTexture();
  }
  gl.Finish();
  timers.collect();
  EXPECT_GT(timers.times(stage).gpu_ms.p99, 0.0);
  timers.detach();
  { const ScopedStage scope(timers, stage); }
  EXPECT_EQ(timers.times(stage).samples, 202u);
}

TEST_F(GpuStages, surviveALostContext) {
  loaded->software = false;
  Timers timers;
  const auto stage = timers.add("clear", true);
  timers.attach(*loaded, false);
  { const ScopedStage scope(timers, stage); }
  timers.forget();
  { const ScopedStage scope(timers, stage); }
  timers.attach(*loaded, false);
  { const ScopedStage scope(timers, stage); }
  timers.detach();
  EXPECT_EQ(timers.times(stage).samples, 3u);
}

}  // namespace
}  // namespace rg::gl
