// A second host, with reversed depth and an origin 1000 km away, sees the same rain and the same drops.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "plugin_library.h"

namespace rg::test {
namespace {

constexpr int kWidth = 320, kHeight = 180;  // second_host.c's

struct Bytes {
  std::vector<unsigned char> rgb;
  int at(int x, int y) const { return rgb[static_cast<size_t>(3 * (y * kWidth + x))]; }
};

Bytes draw(const std::string& arguments) {
  const auto path =
      std::filesystem::temp_directory_path() / ("rainglass_second_host_" + std::to_string(getpid()) + ".ppm");
  const std::string command = std::string(RG_BIN_DIR) + "/second_host " + PluginLibrary::path() + " " +
                              path.string() + " " + arguments;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream file(path, std::ios::binary);
  std::string magic, width, height, most;
  file >> magic >> width >> height >> most;
  file.get();
  Bytes picture{std::vector<unsigned char>(3 * kWidth * kHeight)};
  file.read(reinterpret_cast<char*>(picture.rgb.data()), static_cast<std::streamsize>(picture.rgb.size()));
  EXPECT_TRUE(file.good());
  std::filesystem::remove(path);
  return picture;
}

int greatest(const Bytes& a, const Bytes& b) {
  int most = 0;
  for (size_t i = 0; i < a.rgb.size(); ++i) most = std::max(most, std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
  return most;
}

// Pixels of columns [from, to) that rain changed.
int wetPixels(const Bytes& rain, const Bytes& dry, int from, int to) {
  int count = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = from; x < to; ++x) count += rain.at(x, y) != dry.at(x, y) ? 1 : 0;
  }
  return count;
}

TEST(SecondHost, drawsTheSamePictureFarAwayWithReversedDepth) {
  const Bytes near = draw("near"), far = draw("far"), dry = draw("near 0");
  EXPECT_LE(greatest(near, far), 1);  // grey levels
  const int before_wall = wetPixels(near, dry, 0, kWidth / 2),
            open = wetPixels(near, dry, kWidth / 2, kWidth);
  EXPECT_GT(open, 500) << "too little rain to compare";
  EXPECT_LT(before_wall, open) << "the wall hides none of the rain behind it";
}

}  // namespace
}  // namespace rg::test
