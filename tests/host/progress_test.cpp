// What a headless run tells of the time it still takes.
#include "progress.h"

#include <gtest/gtest.h>

#include <cmath>

namespace host {
namespace {

TEST(Progress, leavesOutWhatCameBeforeTheFirstPicture) {
  Progress progress(60.0);
  EXPECT_FALSE(progress.left_s(0.0, 16.0)) << "after 16 s of rain before it";
  EXPECT_DOUBLE_EQ(progress.left_s(0.5, 19.0).value(), 59.5 * 3.0 / 0.5);
  EXPECT_DOUBLE_EQ(progress.left_s(30.0, 76.0).value(), 60.0);
}

TEST(Progress, countsFromWhereARestoredRunBegins) {
  Progress progress(60.0);
  EXPECT_FALSE(progress.left_s(40.0, 1.0));
  EXPECT_DOUBLE_EQ(progress.left_s(50.0, 21.0).value(), 20.0);
}

TEST(Progress, isNeverLessThanNothing) {
  Progress progress(60.0);
  progress.left_s(0.0, 1.0);
  EXPECT_EQ(std::signbit(progress.left_s(60.000000000000007, 9.0).value()), false);
}

}  // namespace
}  // namespace host
