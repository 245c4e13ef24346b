// After reset() an instance is as a fresh one: the same samples give the same state and the same pictures.
#include <gtest/gtest.h>

#include "screen.h"

namespace rg::test {
namespace {

// What an instance shows of itself at a moment.
struct Seen {
  uint64_t state = 0;
  Picture picture;
};

class Reset : public ScreenTest {
 protected:
  Seen look(const SmallScene& scene) const {
    Seen seen;
    seen.picture = pictureOf(scene);
    scene.expect(scene.api.get_hash(scene.instance, RG_HASH_STATE, &seen.state));
    return seen;
  }

  // The first frames of the scene, each looked at.
  std::vector<Seen> drive(SmallScene& scene, int frames) const {
    std::vector<Seen> all;
    scene.steps = 0;
    for (int i = 0; i < frames; ++i) {
      scene.expect(scene.step());
      scene.expect(scene.api.step_gpu(scene.instance));
      all.push_back(look(scene));
    }
    return all;
  }

  PluginLibrary plugin;
};

// Half a second: longer than the film's reports take, so that drops have come of film and film of drops.
// Before it an odd and an even number of ticks, too few for a report, and a soaked pane.
TEST_F(Reset, givesTheStateAndThePicturesOfAFreshInstance) {
  constexpr int kFrames = 30;
  SmallScene fresh(*plugin.api), used(*plugin.api);
  fresh.expect(fresh.attach(GlContext::getProc));
  used.expect(used.attach(GlContext::getProc));
  // A thin veil, through which drops are seen.
  for (const SmallScene* scene : {&fresh, &used})
    scene->expect(scene->api.set_parameter(scene->instance, "rain.beyond", 0.05));
  const std::vector<Seen> expected = drive(fresh, kFrames);
  // 0.05 where drops refract the sky.
  ASSERT_GT(greatestDifference(expected.front().picture, expected.back().picture), 0.03f)
      << "nothing is seen";
  for (const int frames_before : {1, 2, 40}) {
    drive(used, frames_before);
    used.expect(used.api.reset(used.instance));
    const std::vector<Seen> found = drive(used, kFrames);
    for (size_t i = 0; i < kFrames; ++i) {
      ASSERT_EQ(found[i].state, expected[i].state) << "frame " << i << ", reset after " << frames_before;
      ASSERT_EQ(greatestDifference(found[i].picture, expected[i].picture), 0.0f)
          << "frame " << i << ", reset after " << frames_before;
    }
    used.expect(used.api.reset(used.instance));
  }
  fresh.expect(fresh.api.detach_gl(fresh.instance));
  used.expect(used.api.detach_gl(used.instance));
}

}  // namespace
}  // namespace rg::test
