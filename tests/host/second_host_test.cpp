// Another host (tests/abi/second_host.c), 1000 km from its world's origin, draws the rain that host_sim
// draws. Both show the same scene: an even sky at dusk, a street lamp ahead, and on the left a wall.
#include <gtest/gtest.h>

#include "gltf_files.h"
#include "image/decode.h"
#include "support/run_host.h"

namespace {

using files::Bytes;
using files::Gltf;
using files::Json;
using files::TempFolder;

constexpr int kWidth = 320, kHeight = 180;  // second_host.c's

// Upright 21 m along the world's +x, 6 m ahead of the eye when it is looked at; left of the way, as far as is
// seen. It mirrors the sky, which is the same all around, so it is as bright as that and seen only by the
// rain it hides. (A road's file has y up and -z to the left.)
void addWall(Gltf& g) {
  const int positions = g.addFloats("VEC3", 3, {21, -10, 0, 21, -10, -30, 21, 20, -30, 21, 20, 0});
  const int normals = g.addFloats("VEC3", 3, {-1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0});
  const int indices = g.addIndices<std::uint16_t>(5123, {0, 2, 1, 0, 3, 2});
  g.add("materials", {{"pbrMetallicRoughness", {{"metallicFactor", 1.0}, {"roughnessFactor", 0.0}}}});
  const Json attributes = {{"POSITION", positions}, {"NORMAL", normals}};
  g.add("meshes", {{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}});
  g.add("nodes", {{"mesh", 0}});
}

// Behind the wall as the eye sees it, so that it does not light it.
void addLamp(Gltf& g) {
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 20000.0}}};
  g.add("nodes", {{"translation", {40, 3, 6}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
}

Bytes road() {
  Gltf g;
  addWall(g);
  addLamp(g);
  g.add("scenes", {{"nodes", {0, 1}}});
  g.json["scene"] = 0;
  return g.glb();
}

// 128.5 / 256 * 2^-6 thousand cd/m^2 all around (Ward 1991: a mantissa stands for the middle of its step).
Bytes evenSky() {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
  Bytes file(header.begin(), header.end());
  for (int i = 0; i < 4 * 8; ++i) file.insert(file.end(), {128, 128, 128, 128 - 6});
  return file;
}

// Red, green and blue, row 0 on top.
using Rgb = std::vector<unsigned char>;

class SecondHost : public ::testing::Test {
 protected:
  SecondHost() {
    folder.write("road.glb", road());
    folder.write("sky.hdr", evenSky());
    // The fog takes away the last per cent by which the wall is darker than the sky.
    folder.write("dusk.toml", "seconds = 1\nwhite_cd_m2 = 31.25\n[models]\ncar = \"\"\nroad = \"" +
                                  (folder / "road.glb").string() +
                                  "\"\n[drive]\nspeed_kmh = 54\n[weather]\nvisibility_m = 10\n");
  }

  Rgb hostSim(int rain_mm_h, const std::string& options = "") const {
    const testing_host::Outcome run = testing_host::runHost(
        "--headless --size 320x180 --shots 1 --scenario " + (folder / "dusk.toml").string() +
        " --environment " + (folder / "sky.hdr").string() + " --out " + (folder / "out").string() +
        " --set weather.rain_mm_h=" + std::to_string(rain_mm_h) + " " + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const std::string file = testing_host::slurp(folder / "out/shot_1.00.png");
    const host::Pixels picture = host::decodePixels(Bytes(file.begin(), file.end()));
    Rgb rgb;
    for (size_t i = 0; i < picture.rgba.size(); ++i) {
      if (i % 4 < 3) rgb.push_back(picture.rgba[i]);
    }
    return rgb;
  }

  Rgb secondHost(int rain_mm_h) const {
    const std::string file = (folder / "second.ppm").string(), bin = RG_BIN_DIR;
    const std::string command =
        bin + "/second_host " + bin + "/librainglass.so " + std::to_string(rain_mm_h) + " " + file;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    const std::string ppm = testing_host::slurp(file), header = "P6\n320 180\n255\n";
    EXPECT_EQ(ppm.substr(0, header.size()), header);
    return {ppm.begin() + static_cast<std::ptrdiff_t>(header.size()), ppm.end()};
  }

  TempFolder folder;
};

int greatestDifference(const Rgb& a, const Rgb& b) {
  EXPECT_EQ(a.size(), size_t{3 * kWidth * kHeight});
  EXPECT_EQ(b.size(), a.size());
  int most = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

// Pixels of columns [from, to) that rain changed by more than three grey levels.
int wetPixels(const Rgb& rain, const Rgb& dry, int from, int to) {
  int count = 0;
  for (size_t i = 0; i < std::min(rain.size(), dry.size()); i += 3) {
    const int x = static_cast<int>(i / 3) % kWidth;
    count += x >= from && x < to && std::abs(rain[i] - dry[i]) > 3 ? 1 : 0;
  }
  return count;
}

TEST_F(SecondHost, drawsTheSameRainAsHostSim) {
  constexpr int kRain_mm_h = 100, kMiddle = kWidth / 2, kHalf_px = kWidth * kHeight / 2;
  const Rgb rain = hostSim(kRain_mm_h), dry = hostSim(0), other = hostSim(kRain_mm_h, "--seed 2");
  const Rgb second = secondHost(kRain_mm_h);
  EXPECT_LE(greatestDifference(rain, second), 1);
  EXPECT_LE(greatestDifference(dry, secondHost(0)), 1);
  // What is compared is rain, seen well (at thirty times what may differ), and in both mostly hidden by the
  // wall, before which some falls too.
  EXPECT_GT(greatestDifference(rain, dry), 30);
  EXPECT_GT(greatestDifference(other, second), 30) << "other drops look the same";
  for (const Rgb* picture : {&rain, &second}) {
    EXPECT_GT(wetPixels(*picture, dry, kMiddle, kWidth), kHalf_px / 2);
    EXPECT_LT(wetPixels(*picture, dry, 0, kMiddle), 2 * kHalf_px / 5);
  }
}

}  // namespace
