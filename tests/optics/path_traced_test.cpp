// Drops of known shape against path-traced pictures of them: tests/picture/README.md.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <sstream>
#include <stdexcept>

#include "environment.h"
#include "flat_pane.h"
#include "gl_fixture.h"

namespace rg::test {
namespace {

const std::string kPictures = std::string(RG_SOURCE_DIR) + "/tests/picture/";
constexpr glm::ivec2 kSize_px{1280, 720};

double numberAfter(const std::string& text, const char* key, size_t& at) {
  at = text.find(key, at);
  if (at == std::string::npos) return 0.0;
  at = text.find(':', at) + 1;
  return std::strtod(text.c_str() + at, nullptr);
}

std::vector<shared::GlassDropRecord> readDrops(const std::string& path, const FlatPane& pane) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  std::vector<shared::GlassDropRecord> drops;
  size_t at = all.find("\"drops\"");
  while (true) {
    const double u = numberAfter(all, "\"u_m\"", at);
    if (at == std::string::npos) return drops;
    const double v = numberAfter(all, "\"v_m\"", at);
    const double radius = numberAfter(all, "\"base_radius_m\"", at);
    const double angle_deg = numberAfter(all, "\"contact_angle_deg\"", at);
    drops.push_back(pane.cap(u, v, radius, glm::radians(angle_deg)));
  }
}

// A picture decoded to linear by ImageMagick's convert, rows from the bottom.
std::vector<glm::vec4> readPng(const std::string& path) {
  const auto closePipe = [](std::FILE* f) { pclose(f); };
  const std::unique_ptr<std::FILE, decltype(closePipe)> pipe(
      popen(("convert " + path + " -flip -depth 8 rgb:-").c_str(), "r"), closePipe);
  std::vector<unsigned char> bytes(static_cast<size_t>(kSize_px.x * kSize_px.y * 3));
  if (std::fread(bytes.data(), 1, bytes.size(), pipe.get()) != bytes.size())
    throw std::runtime_error("cannot read " + path);
  const auto decode = [](unsigned char b) {
    const float x = static_cast<float>(b) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
  };
  std::vector<glm::vec4> pixels;
  for (size_t k = 0; k < bytes.size(); k += 3)
    pixels.emplace_back(decode(bytes[k]), decode(bytes[k + 1]), decode(bytes[k + 2]), 1.0f);
  return pixels;
}

class PathTraced : public GlTest {
 protected:
  // Draws the listed drops and holds them against the reference by compare.py, whose limits are the project's
  // own.
  void compare(const std::string& name) {
    glass::GlassLook look(gl);
    FlatPane pane(gl, glm::radians(30.0), 0.8, 64);
    pane.putDrops(readDrops(kPictures + name + ".json", pane));
    ASSERT_GT(pane.pane.drop_count, 1000);
    const Panorama street = readRadiance(kPictures + "street_env.hdr");
    const gl::TextureCube cube = makeCube(gl, 512, [&](const glm::vec3& d) { return street.towards(d); });
    Scene scene;
    scene.size_px = kSize_px;
    scene.view = forwardView(kSize_px, glm::radians(40.0));
    scene.picture = readPng(kPictures + "background.png");
    scene.light.environment_cube = cube.name();
    const Picture ours = draw(gl, look, scene, {&pane.pane, 1});
    const std::string out = std::string(RG_BIN_DIR) + "/" + name + "_drawn.ppm";
    writeSrgb(out, ours);
    const std::string command = "/usr/bin/python3 " + kPictures + "compare.py " + kPictures + name + ".png " +
                                out + " " + kPictures + "background.png";
    EXPECT_EQ(std::system(command.c_str()), 0) << "beyond the limits of " << command;
  }
};

TEST_F(PathTraced, uncoatedDropsLookPathTraced) { compare("pane_uncoated"); }
TEST_F(PathTraced, coatedDropsLookPathTraced) { compare("pane_coated"); }

}  // namespace
}  // namespace rg::test
