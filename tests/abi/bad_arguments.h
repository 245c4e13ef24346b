// For tests that hand the plugin nonsense: a small scene that runs, and the state's hash before and after.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include "gl_fixture.h"
#include "small_scene.h"

namespace rg::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                        kInfinity = std::numeric_limits<double>::infinity();

class BadArguments : public GlTest {
 protected:
  BadArguments() : scene(*library.api), api(*library.api) {
    scene.expect(scene.attach(GlContext::getProc));
    for (int i = 0; i < 4; ++i) {
      scene.expect(scene.step());
      scene.expect(api.step_gpu(scene.instance));
    }
  }
  ~BadArguments() override { api.detach_gl(scene.instance); }

  uint64_t stateHash() const {
    uint64_t hash = 0;
    scene.expect(api.get_hash(scene.instance, RG_HASH_STATE, &hash));
    return hash;
  }

  // The call is refused with a message, and changes nothing. With `code` and `field` it is refused for that
  // reason.
  void expectRefused(const std::string& what, const std::function<rg_result()>& call, rg_result code = 0,
                     const std::string& field = "") const {
    const uint64_t before = stateHash();
    const rg_result result = call();
    EXPECT_LT(result, 0) << what;
    EXPECT_EQ(result, code != 0 ? code : result) << what;
    const std::string why = api.last_error(scene.instance);
    EXPECT_NE(why, "") << what;
    EXPECT_NE(why.find(field), std::string::npos) << what << ": \"" << why << "\" does not name " << field;
    EXPECT_EQ(stateHash(), before) << what << " changed something";
  }

  // `call` with each double of the struct at `first`..`end` (bytes) being no number, and with each wrong
  // struct_size.
  template <class T>
  void expectStructChecked(const char* what, const T& good, std::initializer_list<size_t> doubles,
                           const std::function<rg_result(const T&)>& call) const {
    for (const uint32_t size : {0u, 1u, static_cast<uint32_t>(sizeof(T)) - 1, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
      T bad = good;
      bad.struct_size = size;
      expectRefused(std::string(what) + " of size " + std::to_string(size), [&] { return call(bad); });
    }
    for (const size_t offset : doubles) {
      for (const double value : {kNaN, kInfinity, -kInfinity}) {
        T bad = good;
        std::memcpy(reinterpret_cast<unsigned char*>(&bad) + offset, &value, sizeof value);
        expectRefused(std::string(what) + " with no number at byte " + std::to_string(offset),
                      [&] { return call(bad); });
      }
    }
  }

  rg_result updateWith(const std::function<void(rg_sample&)>& spoil) {
    rg_sample sample;
    api.default_sample(&sample);
    sample.time_ns = scene.time_ns + 1'000'000;
    spoil(sample);
    return api.update(scene.instance, scene.time_ns + 1'000'000, &sample, 1, sizeof sample);
  }

  PluginLibrary library;
  SmallScene scene;
  const rg_api& api;
};

}  // namespace rg::test
