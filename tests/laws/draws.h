// A test's free parameters, drawn at random from the ranges it states. The environment's RG_LAWS_SEED chooses
// others; it is told with every failure, as is what was drawn.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <sstream>
#include <string>

namespace rg::test {

class Draws {
 public:
  // Each test draws for itself: what it gets does not depend on which others run.
  Draws() : random_(seed() ^ std::hash<std::string>{}(testName())) {}

  static uint64_t seed() {
    const char* chosen = std::getenv("RG_LAWS_SEED");
    return chosen != nullptr ? std::strtoull(chosen, nullptr, 0) : 1;
  }
  static std::string told() { return "RG_LAWS_SEED=" + std::to_string(seed()); }

  double between(double least, double most) {
    constexpr double kUnit =
        1.0 / 9007199254740992.0;  // 2^-53; the standard's distributions differ from library to library
    return least + (most - least) * static_cast<double>(random_() >> 11u) * kUnit;
  }
  uint64_t number() { return random_(); }

 private:
  static std::string testName() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    return std::string(info->test_suite_name()) + "." + info->name();
  }
  std::mt19937_64 random_;
};

// A fixture that draws: every failure tells the seed.
template <class Base>
class Drawing : public Base {
 protected:
  void SetUp() override {
    Base::SetUp();
    ::testing::Test::RecordProperty("RG_LAWS_SEED", std::to_string(Draws::seed()));
  }
  Draws draws;
  ::testing::ScopedTrace seed_told{__FILE__, __LINE__, Draws::told()};
};

}  // namespace rg::test
