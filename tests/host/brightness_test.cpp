// How bright a picture is hangs on what its driver's eye has met, not on what was drawn on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "image/decode.h"
#include "support/run_host.h"

namespace {

using Bytes = std::vector<unsigned char>;

host::Pixels pictureAt600ms(const std::filesystem::path& folder, const std::string& shots) {
  const testing_host::Outcome run = testing_host::runHost(
      "--headless --size 64x36 --scenario drive --seconds 0.6 --set prewarm_s=0 --set "
      "weather.rain_mm_h=[[0,0],[0.5,100]] "
      "--shots " +
      shots + " --out " + folder.string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string file = testing_host::slurp(folder / "shot_0.60.png");
  return host::decodePixels(Bytes(file.begin(), file.end()));
}

// The sky darkens within half a second, to which the eye adapts more slowly.
TEST(Brightness, isTheSameWhicheverPicturesWereDrawnBefore) {
  const auto folder = testing_host::freshFolder("brightness");
  const host::Pixels alone = pictureAt600ms(folder, "0.6"), last = pictureAt600ms(folder, "0.2,0.4,0.6");
  ASSERT_EQ(alone.rgba.size(), size_t{4 * 64 * 36});
  ASSERT_EQ(last.rgba.size(), alone.rgba.size());
  int most = 0;
  for (size_t i = 0; i < alone.rgba.size(); ++i)
    most = std::max(most, std::abs(alone.rgba[i] - last.rgba[i]));
  EXPECT_LE(most, 1);  // its rounding
  std::filesystem::remove_all(folder);
}

}  // namespace
