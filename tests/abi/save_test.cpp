// A state that was saved: going on from it is as if nothing had happened, in this instance or in another one.
#include <gtest/gtest.h>

#include "saved_scene.h"
#include "screen.h"

namespace rg::test {
namespace {

// What an instance tells of itself at a moment.
struct Told {
  uint64_t state = 0, rain = 0;
  std::array<rg_pane_stats, 2> panes{};
  rg_rain_stats weather{};
  Picture picture;
};

class Save : public ScreenTest {
 protected:
  std::unique_ptr<SavedScene> scene(bool attached = true) const { return savedScene(*plugin.api, attached); }
  Told tell(const SavedScene& scene, bool seen) const {
    Told told;
    if (seen) told.picture = pictureOf(scene);
    told.state = scene.hash();
    told.rain = scene.hash(RG_HASH_RAIN);
    told.panes = {scene.stats(kPane), scene.stats(kWindow)};
    told.weather.struct_size = sizeof told.weather;
    scene.expect(scene.api.get_rain_stats(scene.instance, &told.weather));
    return told;
  }
  std::vector<Told> goOn(SavedScene& scene, int frames) const {
    std::vector<Told> all;
    for (int i = 0; i < frames; ++i) {
      scene.frame();
      scene.expect(scene.api.step_gpu(scene.instance));
      all.push_back(tell(scene, i % 4 == 1));  // pictures take most of the time
    }
    return all;
  }

  static void expectClosed(const rg_pane_stats& s) {
    EXPECT_NEAR(s.caught_ml, s.on_glass_ml + s.drained_ml + s.wiped_ml + s.blown_ml + s.evaporated_ml, 1e-9);
  }
  static void expectSame(const std::vector<Told>& found, const std::vector<Told>& expected,
                         const std::string& how) {
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) {
      const Told &f = found[i], &e = expected[i];
      ASSERT_EQ(f.rain, e.rain) << how << ", frame " << i;
      ASSERT_EQ(f.state, e.state) << how << ", frame " << i;
      ASSERT_EQ(std::memcmp(&f.panes, &e.panes, sizeof f.panes), 0) << how << ", frame " << i;
      for (const rg_pane_stats& pane : f.panes) expectClosed(pane);
      ASSERT_EQ(f.weather.born, e.weather.born) << how << ", frame " << i;
      ASSERT_EQ(f.weather.bounced, e.weather.bounced) << how << ", frame " << i;
      ASSERT_EQ(f.weather.ground_water_mm, e.weather.ground_water_mm) << how << ", frame " << i;
      ASSERT_TRUE(f.picture.pixels == e.picture.pixels) << how << ", frame " << i;
    }
  }

  // The scene's own clock is the host's.
  static void setClock(SavedScene& to, const SavedScene& from) {
    to.steps = from.steps;
    to.time_ns = from.time_ns;
    to.view = from.view;
  }

  PluginLibrary plugin;
};

// Long enough for what is under way between CPU and GPU to have come of the state: reports take 8 steps of
// the film. Before it the washer is at work and the window slides; a tick more, and a film's step is half
// gathered. Where there is none the weather ends then: what stirs, on the glass and in the air, is what was
// there.
TEST_F(Save, goesOnAsIfNothingHadHappened) {
  constexpr int kBefore = 24, kAfter = 14;
  for (const bool odd : {false, true}) {
    const auto whole = scene(), other = scene();
    whole->drive(kBefore, odd);
    const Bytes saved = whole->save();
    const uint64_t then = whole->hash();
    const int64_t steps = whole->steps;
    if (!odd) whole->rain_mm_h = whole->snow_mm_h = whole->hail_mm_h = 0.0;
    const std::vector<Told> expected = goOn(*whole, kAfter);
    ASSERT_GT(expected.back().weather.bounced, 0u) << "no stone bounced";
    ASSERT_GT(expected.back().panes[0].run_on_ml + expected.back().panes[1].run_on_ml, 0.0)
        << "nothing came round the pillar";
    ASSERT_GT(expected.back().panes[0].ridge_ml, 0.0) << "nothing is wiped";
    ASSERT_GT(expected.back().panes[1].drained_ml, 0.0) << "the window slid without stripping water";
    ASSERT_NE(expected.back().state, then);

    other->drive(3, false);  // where it has been does not matter
    other->expect(other->restore(saved));
    EXPECT_EQ(other->hash(), then);
    setClock(*other, *whole);
    other->steps = steps;
    if (!odd) other->rain_mm_h = other->snow_mm_h = other->hail_mm_h = 0.0;
    expectSame(goOn(*other, kAfter), expected, odd ? "other, odd" : "other");

    whole->expect(whole->restore(saved));
    EXPECT_EQ(whole->hash(), then);
    whole->steps = steps;
    expectSame(goOn(*whole, kAfter), expected, odd ? "rewound, odd" : "rewound");
    for (const auto* s : {whole.get(), other.get()}) s->expect(s->api.detach_gl(s->instance));
  }
}

// A washed pane of film alone, when no more comes onto it and no blade stirs it: what runs down still is told
// by nothing but the film's own state.
TEST_F(Save, waterRunsOnDown) {
  const auto washed = scene();
  washed->rain_mm_h = washed->snow_mm_h = washed->hail_mm_h = 0.0;
  washed->expect(washed->api.remove_pane(washed->instance, kWindow));
  washed->expect(washed->api.remove_wiper(washed->instance, kWiper));
  washed->expect(washed->setPane(0));  // no drops
  washed->drive(36, false);            // the jet is done after 32
  const Bytes saved = washed->save();
  const int64_t steps = washed->steps;
  const auto goOnDown = [&] {
    std::vector<uint64_t> hashes;
    washed->steps = steps;
    for (int i = 0; i < 12; ++i) {
      washed->drive(1, false);
      hashes.push_back(washed->hash());
    }
    return hashes;
  };
  const double drained_ml = washed->stats(kPane).drained_ml;
  const std::vector<uint64_t> expected = goOnDown();
  ASSERT_GT(washed->stats(kPane).drained_ml, drained_ml) << "nothing ran";
  washed->expect(washed->restore(saved));
  EXPECT_EQ(goOnDown(), expected);
  washed->expect(washed->api.detach_gl(washed->instance));
}

// Without GL there is no film. A state of such an instance goes on without one, or with one that begins dry;
// one with water on a film wants a GPU to hold it.
TEST_F(Save, knowsWhetherThereIsAFilm) {
  const auto without = scene(false), also = scene(false), with = scene();
  for (int i = 0; i < 20; ++i) without->frame();
  const Bytes dry = without->save();
  also->expect(also->restore(dry));
  also->steps = without->steps;
  for (const auto* s : {without.get(), also.get()}) EXPECT_EQ(s->hash(), without->hash());
  for (int i = 0; i < 10; ++i) without->frame(), also->frame();
  EXPECT_EQ(also->hash(), without->hash());

  with->drive(20, false);
  ASSERT_GT(with->stats(kPane).film_ml, 0.0);
  const Bytes wet = with->save();
  const uint64_t before = also->hash();
  EXPECT_EQ(also->restore(wet), RG_ERROR_WRONG_ORDER);
  EXPECT_NE(std::string(also->api.last_error(also->instance)).find("attach_gl"), std::string::npos);
  EXPECT_EQ(also->hash(), before);

  with->expect(with->restore(dry));
  EXPECT_EQ(with->stats(kPane).film_ml, 0.0);
  EXPECT_EQ(with->hash(RG_HASH_RAIN), [&] {
    also->expect(also->restore(dry));
    return also->hash(RG_HASH_RAIN);
  }());
  with->drive(20, false);
  EXPECT_GT(with->stats(kPane).film_ml, 0.0);
  for (const uint32_t pane : {kPane, kWindow}) expectClosed(with->stats(pane));
  with->expect(with->api.detach_gl(with->instance));
}

// Parameters and a state before the first update are saved as well.
TEST_F(Save, restoresParametersAndAnUnstartedInstance) {
  const auto fresh = scene(false), used = scene(false);
  fresh->expect(fresh->api.set_parameter(fresh->instance, "rain.gain", 2.0));
  const Bytes saved = fresh->save();
  for (int i = 0; i < 10; ++i) used->frame();
  used->expect(used->restore(saved));
  EXPECT_EQ(used->api.update(used->instance, 0, nullptr, 0, 0), RG_ERROR_WRONG_ORDER) << "it had begun";
  rg_parameter gain{};
  gain.struct_size = sizeof gain;
  for (uint32_t i = 0; std::string(gain.name) != "rain.gain"; ++i)
    used->expect(used->api.get_parameter(used->instance, i, &gain));
  EXPECT_EQ(gain.value, 2.0);
  used->steps = 0;
  for (int i = 0; i < 10; ++i) fresh->frame(), used->frame();
  EXPECT_EQ(used->hash(), fresh->hash());
}

TEST_F(Save, tellsTheSizeWhereTheBufferIsTooSmall) {
  const auto s = scene(false);
  s->frame();
  size_t size = 0;
  EXPECT_EQ(s->api.save(s->instance, nullptr, nullptr), RG_ERROR_BAD_ARGUMENT);
  ASSERT_EQ(s->api.save(s->instance, nullptr, &size), RG_OK);
  Bytes buffer(size, 0xAB);
  size_t room = size - 1;
  EXPECT_EQ(s->api.save(s->instance, buffer.data(), &room), RG_ERROR_BAD_ARGUMENT);
  EXPECT_EQ(room, size);
  EXPECT_NE(std::string(s->api.last_error(s->instance)).find(std::to_string(size)), std::string::npos);
  EXPECT_EQ(buffer, Bytes(size, 0xAB)) << "something was written";
  EXPECT_EQ(s->api.save(s->instance, buffer.data(), &room), RG_OK);
  EXPECT_EQ(s->api.restore(s->instance, nullptr, size), RG_ERROR_BAD_ARGUMENT);
}

// At the edge of what a host may tell: drops as large as may be placed, which merge, and a view so narrow
// that its sides are no planes.
TEST_F(Save, takesBackWhateverItWrote) {
  const auto s = scene(false);
  s->frame();
  std::array<rg_glass_drop, 3> drops{};
  for (size_t i = 0; i < drops.size(); ++i) {
    drops[i].u_m = 0.01 * static_cast<double>(i);
    drops[i].base_radius_m = 0.02;
    drops[i].contact_angle_deg = 169.9;
  }
  s->expect(s->api.place_drops(s->instance, kPane, drops.data(), 3));
  const Bytes placed = s->save();
  s->expect(s->restore(placed));
  s->frame();
  s->expect(s->restore(s->save()));

  rg_view nowhere = s->view;
  nowhere.projection[0] = nowhere.projection[5] = 1e200;
  rg_sample sample;
  s->api.default_sample(&sample);
  sample.time_ns = s->time_ns + 20'000'000;
  sample.views = &nowhere;
  sample.view_count = 1;
  s->expect(s->api.update(s->instance, sample.time_ns, &sample, 1, sizeof sample));
  const uint64_t rain = s->hash(RG_HASH_RAIN);
  s->expect(s->restore(s->save()));
  EXPECT_EQ(s->hash(RG_HASH_RAIN), rain);
}

// A film that is made as the window closes: in its first step glass is hidden and shown again.
TEST_F(Save, restoresAFilmThatWasMadeAMomentAgo) {
  const auto s = scene(false);
  for (int i = 0; i < 16; ++i) s->frame();  // it stands open by 0.2 m
  s->expect(s->attach(GlContext::getProc));
  const rg_opening_knot shut{s->time_ns + 8'000'000, kWindow, 0, 0.0};
  rg_sample sample;
  s->api.default_sample(&sample);
  sample.time_ns = s->time_ns + 10'000'000;
  sample.opening_knots = &shut;
  sample.opening_knot_count = 1;
  s->expect(s->api.update(s->instance, sample.time_ns, &sample, 1, sizeof sample));
  s->expect(s->api.step_gpu(s->instance));
  const Bytes saved = s->save();
  const int64_t steps = s->steps, time_ns = s->time_ns;
  const auto goOnWith = [&] {
    s->steps = steps;
    s->time_ns = time_ns;
    s->drive(3, false);
    expectClosed(s->stats(kWindow));
    return s->hash();
  };
  const uint64_t expected = goOnWith();
  s->expect(s->restore(saved));
  EXPECT_EQ(goOnWith(), expected);
  s->expect(s->api.detach_gl(s->instance));
}

}  // namespace
}  // namespace rg::test
