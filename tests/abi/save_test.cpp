// A state that was saved: going on from it is as if nothing had happened, in this instance or in another one;
// what is not such a state is refused, and changes nothing.
#include <gtest/gtest.h>

#include <random>

#include "saved/archive.h"
#include "saved_scene.h"
#include "screen.h"

namespace rg::test {
namespace {

using Bytes = std::vector<unsigned char>;

// What an instance tells of itself at a moment.
struct Told {
  uint64_t state = 0, rain = 0;
  std::array<rg_pane_stats, 2> panes{};
  rg_rain_stats weather{};
  Picture picture;
};

class Save : public ScreenTest {
 protected:
  std::unique_ptr<SavedScene> scene(bool attached = true) const {
    auto made = std::make_unique<SavedScene>(*plugin.api);
    if (attached) made->expect(made->attach(GlContext::getProc));
    return made;
  }
  // To its last moment, which may be in the middle of a film's step.
  static void drive(SavedScene& scene, int frames, bool odd) {
    for (int i = 1; i <= frames; ++i) {
      scene.frame(odd && i == frames);
      scene.expect(scene.api.step_gpu(scene.instance));
    }
  }

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
    drive(*whole, kBefore, odd);
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

    drive(*other, 3, false);  // where it has been does not matter
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
  drive(*washed, 36, false);           // the jet is done after 32
  const Bytes saved = washed->save();
  const int64_t steps = washed->steps;
  const auto goOnDown = [&] {
    std::vector<uint64_t> hashes;
    washed->steps = steps;
    for (int i = 0; i < 12; ++i) {
      drive(*washed, 1, false);
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

  drive(*with, 20, false);
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
  drive(*with, 20, false);
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
    drive(*s, 3, false);
    expectClosed(s->stats(kWindow));
    return s->hash();
  };
  const uint64_t expected = goOnWith();
  s->expect(s->restore(saved));
  EXPECT_EQ(goOnWith(), expected);
  s->expect(s->api.detach_gl(s->instance));
}

// ---- what is refused ----

struct Counted {
  static inline size_t made = 0;
  uint8_t value = 0;
  std::array<char, 1000> more{};
  Counted() { ++made; }
  static void visit(auto& a, auto& counted) { a.within(counted.value, 0, 1); }
};

// A list that says it has more than can be read takes no room for what is not there.
TEST(SavedReader, makesRoomAsItReads) {
  Bytes bytes(4 + 5000, 2);  // no value that is taken
  bytes[0] = 5000 % 256, bytes[1] = 5000 / 256, bytes[2] = bytes[3] = 0;
  bytes[4] = bytes[5] = 1;
  saved::Reader a(bytes, false);
  std::vector<Counted> list;
  EXPECT_THROW(a.list(list, 10'000), saved::Refused);
  EXPECT_EQ(Counted::made, 3u);
  EXPECT_LE(list.capacity() * sizeof(Counted), bytes.size());
}

// Where the header ends and what in it is told of the rest; as frame_saved.cpp writes it.
struct Layout {
  explicit Layout(const Bytes& bytes) {
    constexpr size_t kVersion = 8 + 4, kBuild = 8 * 8;
    checksum = kVersion + 4 + bytes[kVersion] + kBuild + 8;
    body = checksum + 8;
  }
  size_t checksum, body;
};

void put(Bytes& bytes, size_t at, uint64_t value) {
  for (size_t i = 0; i < 8; ++i) bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
}

// So that what is wrong is not found by its length or its checksum.
void vouchFor(Bytes& bytes) {
  const Layout at(bytes);
  put(bytes, at.checksum - 8, bytes.size() - at.body);
  put(bytes, at.checksum, saved::fingerprintOf(std::span(bytes).subspan(at.body)));
}

// Where a part of the body begins, by its name, and how long it is.
struct Part {
  Part(const Bytes& bytes, const std::string& name) {
    const auto number = [&](size_t from, size_t size) {
      uint64_t value = 0;
      for (size_t i = 0; i < size; ++i) value |= static_cast<uint64_t>(bytes.at(from + i)) << (8 * i);
      return static_cast<size_t>(value);
    };
    std::string found;
    for (at = Layout(bytes).body; found != name; at += found == name ? 0 : length) {
      const size_t letters = number(at, 4);
      found.assign(reinterpret_cast<const char*>(&bytes.at(at + 4)), letters);
      at += 4 + letters + 8;
      length = number(at - 8, 8);
    }
  }
  size_t at, length = 0;
};

class BadState : public Save {
 protected:
  BadState() : good(scene()) {
    drive(*good, 12, true);
    saved = good->save();
    hash = good->hash();
  }
  ~BadState() override { good->api.detach_gl(good->instance); }

  void expectRefused(const Bytes& bytes, const std::string& what, const std::string& why = "") const {
    EXPECT_EQ(good->restore(bytes), RG_ERROR_BAD_ARGUMENT) << what;
    const std::string told = good->api.last_error(good->instance);
    EXPECT_NE(told.find(why), std::string::npos) << what << ": " << told;
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
    EXPECT_EQ(good->hash(), hash) << what << " changed something";
  }
  // Whatever is in it, the call comes back; what is taken can be lived with.
  bool survives(const Bytes& bytes) const {
    const rg_result result = good->restore(bytes);
    if (result < 0) {
      EXPECT_EQ(result, RG_ERROR_BAD_ARGUMENT) << good->api.last_error(good->instance);
      return false;
    }
    const int64_t steps = good->steps, time_ns = good->time_ns;
    for (int i = 0; i < 2; ++i) {
      if (good->step() < 0) break;  // of another time
      good->expect(good->api.step_gpu(good->instance));
    }
    good->stats(kPane);
    good->steps = steps;
    good->time_ns = time_ns;
    good->expect(good->restore(saved));
    return true;
  }

  std::unique_ptr<SavedScene> good;
  Bytes saved;
  uint64_t hash = 0;
};

TEST_F(BadState, isToldByItsHeader) {
  expectRefused(Bytes(saved.begin(), saved.begin() + 6), "next to nothing", "ends early");
  expectRefused(Bytes(saved.size(), 0), "zeros", "no saved state");
  Bytes bad = saved;
  bad[8] ^= 2;
  expectRefused(bad, "another format", "format");
  bad = saved;
  bad[8 + 4 + 4] ^= 1;
  expectRefused(bad, "another version", "version");
  bad = saved;
  bad[Layout(saved).checksum - 16] ^= 1;
  expectRefused(bad, "another build", "version");
  bad = saved;
  bad.back() ^= 1;
  expectRefused(bad, "a flipped byte", "checksum");
  bad = saved;
  bad.push_back(0);
  expectRefused(bad, "a longer one", "longer");
}

// At every length of the header, and at many of the rest, with a checksum that fits.
TEST_F(BadState, cutShortIsRefused) {
  const size_t body = Layout(saved).body;
  for (size_t length = 0; length < saved.size(); length += length < body + 64 ? 1 : saved.size() / 97) {
    Bytes cut(saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(length));
    ASSERT_EQ(good->restore(cut), RG_ERROR_BAD_ARGUMENT) << length;
    if (length < body) continue;
    vouchFor(cut);
    ASSERT_EQ(good->restore(cut), RG_ERROR_BAD_ARGUMENT) << length;
  }
  EXPECT_EQ(good->hash(), hash);
}

// Bytes anywhere made others, the checksum made to fit: most are refused, of the rest none does harm. Which
// the sanitizers tell.
TEST_F(BadState, withBytesFlippedDoesNoHarm) {
  std::mt19937 random(7);
  const size_t body = Layout(saved).body;
  int refused = 0;
  constexpr int kTimes = 24;
  for (int i = 0; i < kTimes; ++i) {
    Bytes bad = saved;
    for (int k = 0; k < 1 + i % 3; ++k) {
      const size_t at = body + random() % (bad.size() - body);
      const auto kind = random() % 3;
      bad[at] = static_cast<unsigned char>(kind == 0 ? 0xFF : kind == 1 ? 0 : bad[at] ^ (1u << random() % 8));
    }
    vouchFor(bad);
    if (!survives(bad)) {
      ++refused;
      ASSERT_EQ(good->hash(), hash) << "flip " << i << " was refused and changed something";
    }
  }
  EXPECT_GT(refused, kTimes / 10);
  EXPECT_EQ(good->hash(), hash);
}

// Where a number was something else is: no number, none that fits, the largest.
TEST_F(BadState, withAbsurdNumbersDoesNoHarm) {
  std::mt19937 random(8);
  const size_t body = Layout(saved).body;
  constexpr std::array<uint64_t, 4> kAbsurd{0x7FF8000000000000u, 0x7FF0000000000000u, 0xFFFFFFFFFFFFFFFFu,
                                            0x7FFFFFFFFFFFFFFFu};
  for (size_t i = 0; i < 16; ++i) {
    Bytes bad = saved;
    const size_t at = body + random() % (bad.size() - body - 8);
    put(bad, at, kAbsurd[i % kAbsurd.size()]);
    vouchFor(bad);
    if (!survives(bad)) {
      ASSERT_EQ(good->hash(), hash) << "at " << at;
    }
  }
}

TEST_F(BadState, ofMoreJetsThanAPaneTakesIsRefused) {
  const Part part(saved, "washers");
  ASSERT_EQ(saved[part.at], 1u) << "one is at work";
  const Bytes jet(saved.begin() + static_cast<std::ptrdiff_t>(part.at) + 4,
                  saved.begin() + static_cast<std::ptrdiff_t>(part.at + part.length));
  const auto with = [&](unsigned char count) {
    Bytes bytes(saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(part.at + part.length));
    for (int i = 1; i < count; ++i) bytes.insert(bytes.end(), jet.begin(), jet.end());
    put(bytes, part.at - 8, 4 + jet.size() * count);
    bytes[part.at] = count;
    bytes.insert(bytes.end(), saved.begin() + static_cast<std::ptrdiff_t>(part.at + part.length),
                 saved.end());
    vouchFor(bytes);
    return bytes;
  };
  expectRefused(with(9), "nine jets", "more jets");
  expectRefused(with(17), "more than two panes take", "too long");
  EXPECT_TRUE(survives(with(8)));
}

TEST_F(BadState, ofOtherObjectsNamesThem) {
  const auto other = scene();
  const rg_api& api = *plugin.api;
  const auto refused = [&](const std::string& why) {
    const uint64_t before = other->hash();
    EXPECT_EQ(other->restore(saved), RG_ERROR_BAD_ARGUMENT) << why;
    const std::string told = api.last_error(other->instance);
    EXPECT_NE(told.find(why), std::string::npos) << told;
    EXPECT_EQ(other->hash(), before) << why;
  };
  other->expect(other->setWindow(0.35f));
  refused("pane 2 'window': its glass was another");
  other->expect(api.remove_pane(other->instance, kWindow));
  refused("pane 2 'window' is not set here");
  other->expect(other->setWindow());
  EXPECT_EQ(other->restore(saved), RG_OK) << api.last_error(other->instance);
  other->expect(api.remove_wiper(other->instance, kWiper));
  refused("other wipers");
  other->expect(other->setWiper());
  EXPECT_EQ(other->restore(saved), RG_OK);
  expectRefused(
      [&] {
        const SmallScene one_pane(api);
        size_t size = 0;
        one_pane.expect(api.save(one_pane.instance, nullptr, &size));
        Bytes bytes(size);
        one_pane.expect(api.save(one_pane.instance, bytes.data(), &size));
        return bytes;
      }(),
      "a pane less", "pane 2 'window' was not there");
  other->expect(api.detach_gl(other->instance));
  const SmallScene fewer(api, 5000);
  EXPECT_EQ(api.restore(fewer.instance, saved.data(), saved.size()), RG_ERROR_WRONG_ORDER);
  fewer.expect(fewer.attach(GlContext::getProc));
  EXPECT_EQ(api.restore(fewer.instance, saved.data(), saved.size()), RG_ERROR_BAD_ARGUMENT);
  EXPECT_NE(std::string(api.last_error(fewer.instance)).find("max_drops"), std::string::npos);
  fewer.expect(api.detach_gl(fewer.instance));
}

}  // namespace
}  // namespace rg::test
