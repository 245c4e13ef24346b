// What is no state that was saved is refused and changes nothing, whatever its bytes are.
#include <gtest/gtest.h>

#include <random>

#include "gl_fixture.h"
#include "saved/archive.h"
#include "saved_scene.h"

namespace rg::test {
namespace {

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

class BadState : public GlTest {
 protected:
  BadState() : good(scene()) {
    good->drive(12, true);
    saved = good->save();
    hash = good->hash();
  }
  ~BadState() override { good->api.detach_gl(good->instance); }
  std::unique_ptr<SavedScene> scene() const { return savedScene(*plugin.api, true); }

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

  PluginLibrary plugin;
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
