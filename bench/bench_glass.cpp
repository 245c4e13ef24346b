// bench_glass [--frames N] [--drops N]...: all that a wet windscreen costs a picture of 1280 x 720, by the
// number of its drops. Prints CSV; bench/README.md tells what is measured and how.
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>

#include "drops_on_glass.h"
#include "glass/look_gl.h"
#include "glass/pane.h"
#include "glass/pane_gl.h"
#include "glass/pane_map.h"
#include "measure.h"
#include "measure_cpu.h"
#include "off_screen.h"

namespace {

using namespace rg;
using bench::median;
using bench::number;
using bench::Stopwatch;

constexpr const char* kUsage =
    "bench_glass [--frames N] [--drops N]...\n"
    "A windscreen with so many drops, one in twenty sliding, and film where they have run, in a picture of\n"
    "1280 x 720 over a background that moves: two ticks of the drops, a step of the film, the drawing.\n"
    "Prints CSV, medians: drops (asked for), live, ticks_ms, step_ms, draw_ms, all_ms (of their sums).\n"
    "  --frames N   how many, 8 to 100000 (60)\n"
    "  --drops N    1000 to 100000; may be given again (2000 20000)\n";

constexpr glm::ivec2 kSize_px{1280, 720};
constexpr int kFramesOfRun = 16;  // then sliding drops have swept up too many others, and all begins anew

struct Options {
  int frames = 60;
  std::vector<int> drops;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    if (name != "--frames" && name != "--drops")
      throw std::invalid_argument("there is no option '" + std::string(name) + "'; see --help");
    if (i + 1 == argc) throw std::invalid_argument(std::string(name) + " wants a value");
    if (name == "--frames")
      options.frames = number(argv[i + 1], 8, 100000, "--frames");
    else
      options.drops.push_back(number(argv[i + 1], 1000, 100000, "--drops"));
  }
  if (options.drops.empty()) options.drops = {2000, 20000};
  return options;
}

// A street's colours without a street: bands that differ from pixel to pixel.
std::vector<glm::vec4> background(glm::ivec2 size_px) {
  std::vector<glm::vec4> pixels;
  for (int y = 0; y < size_px.y; ++y) {
    for (int x = 0; x < size_px.x; ++x) {
      const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
      pixels.emplace_back(0.5f + 0.4f * std::sin(0.05f * fx) * std::cos(0.03f * fy),
                          0.4f + 0.3f * std::sin(0.011f * fx + 0.02f * fy),
                          fy / static_cast<float>(size_px.y), 1.0f);
    }
  }
  return pixels;
}

gl::TextureCube surroundings(const GladGLContext& gl) {
  constexpr int kFace_px = 64;
  gl::TextureCube cube(gl, GL_RGBA16F, kFace_px, gl::fullMipLevels(kFace_px, kFace_px));
  const std::vector<glm::vec4> face = background({kFace_px, kFace_px});
  for (int k = 0; k < 6; ++k) cube.write(0, 0, 0, k, kFace_px, kFace_px, GL_RGBA, GL_FLOAT, face.data());
  cube.generateMipmaps();
  return cube;
}

// A driver's view of the windscreen, 0.7 m before it.
glass::LookView driversView(const glass::PaneMap& map) {
  const glm::dvec3 middle(map.centre_m()), eye = middle - glm::dvec3(0.7, -0.35, 0.0);
  glass::LookView view;
  view.eyeFromWorld = glm::lookAt(eye, eye + glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0));
  view.clipFromEye =
      glm::perspective(glm::radians(45.0), static_cast<double>(kSize_px.x) / kSize_px.y, 0.05, 1000.0);
  view.viewport_px = {0, 0, kSize_px.x, kSize_px.y};
  return view;
}

class Picture {
 public:
  explicit Picture(const GladGLContext& gl)
      : gl_(gl),
        // Twice as wide as the picture: a window moves over it.
        behind_(gl, GL_RGBA16F, 2 * kSize_px.x, kSize_px.y),
        color_(gl, GL_RGBA16F, kSize_px.x, kSize_px.y),
        depth_(gl, GL_DEPTH_COMPONENT32F, kSize_px.x, kSize_px.y),
        target_(gl, {&color_}, &depth_),
        cube_(surroundings(gl)) {
    behind_.write(0, 0, 0, 0, 2 * kSize_px.x, kSize_px.y, GL_RGBA, GL_FLOAT,
                  background({2 * kSize_px.x, kSize_px.y}).data());
    const float farthest = 1.0f;
    gl.DepthMask(GL_TRUE);  // the look leaves it off
    gl.ClearNamedFramebufferfv(target_.name(), GL_DEPTH, 0, &farthest);
    where_.framebuffer = target_.name();
    where_.color_texture = color_.name();
    where_.width_px = kSize_px.x;
    where_.height_px = kSize_px.y;
    light_.environment_cube = cube_.name();
    light_.sky_radiance = glm::vec3(0.8f);
    light_.ground_radiance = glm::vec3(0.2f);
  }
  void showBackground(int frame) {
    gl_.CopyImageSubData(behind_.name(), GL_TEXTURE_2D, 0, 8 * frame % kSize_px.x, 0, 0, color_.name(),
                         GL_TEXTURE_2D, 0, 0, 0, 0, kSize_px.x, kSize_px.y, 1);
  }
  void draw(glass::GlassLook& look, const glass::LookPane& pane, const glass::LookView& view) {
    look.drawPanes({&pane, 1}, view, where_, light_);
  }

 private:
  const GladGLContext& gl_;
  gl::Texture2D behind_, color_, depth_;
  gl::Framebuffer target_;
  gl::TextureCube cube_;
  glass::LookTarget where_;
  glass::LookLight light_;
};

void measure(const GladGLContext& gl, int drops, int frames) {
  const auto sim = std::make_shared<glass::PaneSim>(bench::windscreenInfo(drops), 1, 7);
  glass::PaneGl pane(gl, glass::makeFilmPrograms(gl), sim);
  glass::GlassLook look(gl);
  Picture picture(gl);
  const glass::LookView view = driversView(sim->map());
  const std::vector<glass::PlacedDrop> placed = bench::dropsOnGlass(drops);
  Stopwatch stopwatch(gl);
  glass::PaneTick tick;
  tick.air_mps = {-1.0, 0.0, 0.0};
  std::vector<double> ticks_ms, step_ms, draw_ms, all_ms, live;
  for (int frame = 0; frame < frames + 2; ++frame) {
    if (frame % kFramesOfRun == 0) {
      sim->reset();
      sim->placeDrops(placed);
    }
    picture.showBackground(frame);
    const double ticked = bench::cpuMilliseconds([&] {
      for (int k = 0; k < 2; ++k, ++tick.index) sim->submit(tick);
    });
    const double stepped = stopwatch.time([&] { pane.step(); });
    const glass::LookPane seen = glass::lookPaneOf(pane.drawn());
    const double drawn = stopwatch.time([&] { picture.draw(look, seen, view); });
    if (frame < 2) continue;  // programs are made
    ticks_ms.push_back(ticked);
    step_ms.push_back(stepped);
    draw_ms.push_back(drawn);
    all_ms.push_back(ticked + stepped + drawn);
    live.push_back(seen.drop_count);
  }
  std::printf("%d,%.0f,%.3f,%.3f,%.3f,%.3f\n", drops, median(live), median(ticks_ms), median(step_ms),
              median(draw_ms), median(all_ms));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::program(argc, argv, "bench_glass", kUsage, [&] {
    const Options options = parse(argc, argv);
    const GladGLContext gl = bench::makeContext();
    std::puts("drops,live,ticks_ms,step_ms,draw_ms,all_ms");
    for (const int drops : options.drops) measure(gl, drops, options.frames);
  });
}
