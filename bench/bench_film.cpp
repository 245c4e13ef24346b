// bench_film [--frames N] [--grid WxH]...: a step of the wet film as it runs in a frame, against a compute
// copy of the film's whole state by the same groups in the same format, frame by frame in turn. Prints CSV;
// bench/README.md tells what is measured and how.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gl/program.h"
#include "glass/bead_shape.h"
#include "glass/film_gl.h"
#include "glass/pane.h"
#include "measure.h"
#include "off_screen.h"
#include "shared/hash.glsl"

namespace {

using namespace rg;
using bench::median;
using bench::number;
using bench::Stopwatch;

constexpr const char* kUsage =
    "bench_film [--frames N] [--grid WxH]...\n"
    "A step of a film that is wet and awake all over, as it runs in a frame, against a compute copy of the\n"
    "film's whole state by the same groups in the same format, frame by frame in turn.\n"
    "Prints CSV, medians: grid, film_step_ms, copy_ms, ratio (of the medians).\n"
    "  --frames N   how many of each, 8 to 100000 (120)\n"
    "  --grid WxH   texels, 16 to 4096 along a side; may be given again (512x256 2048x1024)\n";

constexpr double kTexel_m = 3e-3;
constexpr double kFilm_m = 50e-6;     // downpours keep it so thick: it flows everywhere
constexpr int kStepsFromWet = 60;     // then it is made wet again
constexpr int kTexelsForAnAdd = 512;  // some 100 mm/h, and what drops leave behind
constexpr int kTexelsForATake = 2048;
constexpr int kCopiesBefore = 64;  // a GPU's millisecond or so

struct Options {
  int frames = 120;
  std::vector<glm::ivec2> grids;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    if (name != "--frames" && name != "--grid")
      throw std::invalid_argument("there is no option '" + std::string(name) + "'; see --help");
    if (i + 1 == argc) throw std::invalid_argument(std::string(name) + " wants a value");
    const std::string_view value = argv[i + 1];
    if (name == "--frames") {
      options.frames = number(value, 8, 100000, "--frames");
      continue;
    }
    const size_t cross = std::min(value.find('x'), value.size() - 1);
    options.grids.push_back({number(value.substr(0, cross), 16, 4096, "--grid's width"),
                             number(value.substr(cross + 1), 16, 4096, "--grid's height")});
  }
  if (options.grids.empty()) options.grids = {{512, 256}, {2048, 1024}};
  return options;
}

// A flat pane of a grid, its rim of a texel off the glass.
std::unique_ptr<glass::PaneMap> paneOf(glm::ivec2 grid) {
  const glm::vec2 size_m = (glm::vec2(grid) - 2.5f) * static_cast<float>(kTexel_m);
  const std::vector<glm::vec3> positions{
      {0.0f, 0.0f, 0.0f}, {0.0f, -size_m.x, 0.0f}, {0.0f, -size_m.x, size_m.y}, {0.0f, 0.0f, size_m.y}};
  const std::vector<glm::vec2> uvs{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<uint32_t> indices{0, 2, 1, 0, 3, 2};
  glass::PaneInfo info;
  info.name = "bench";
  info.positions_m = positions;
  info.uvs = uvs;
  info.indices = indices;
  info.texel_m = kTexel_m;
  auto map = std::make_unique<glass::PaneMap>(info);
  if (map->grid().size != grid) throw std::runtime_error("the pane's grid came out otherwise");
  return map;
}

// Orders as ticks give them in a downpour.
class Downpour {
 public:
  explicit Downpour(const glass::PaneMap& map) : map_(map) {
    for (int i = 0; i < map.texelCount(); ++i) {
      if (map.inside(i)) glass_.push_back(i);
    }
  }
  std::vector<glass::FilmOrder> next() {
    glass::FilmOrder order;
    order.step = step_++;
    order.info.columns = map_.grid().size.x;
    order.info.rows = map_.grid().size.y;
    order.info.step = static_cast<uint32_t>(2 * order.step);
    order.info.up_y = 1.0f;
    order.info.pin_m = 3e-6f;
    order.info.front_m = 40e-6f;
    order.info.rupture_m = 8e-6f;
    order.info.rupture_chance = 0.001f;
    order.info.evaporation_mps = 1e-9f;
    order.info.drops_allowed = 1;
    glass::setBeadShape(order.info, glass::surfaceOf(glass::Glass::uncoated));
    shared::setLevelling(order.info, 8.5f, static_cast<float>(1.0 / (kTexel_m * kTexel_m)));
    // A raked windscreen at some 50 km/h.
    order.drive.assign(static_cast<size_t>(map_.nodeCount().x * map_.nodeCount().y),
                       {0.3f, -4.9f, 0.1f, 0.2f});
    if (order.step % kStepsFromWet == 0)
      wet(order);
    else
      rain(order);
    return std::exchange(orders_, {});
  }
  bool wetsNext() const { return step_ % kStepsFromWet == 0; }

 private:
  static int texelVolume_pl(double thickness_m) {
    return static_cast<int>(thickness_m * kTexel_m * kTexel_m * 1e15);
  }
  void wet(glass::FilmOrder& order) {
    glass::FilmOrder dry;
    dry.clear = true;
    orders_.push_back(std::move(dry));
    for (const int texel : glass_) order.adds.push_back({texel, texelVolume_pl(kFilm_m)});
    orders_.push_back(std::move(order));
  }
  void rain(glass::FilmOrder& order) {
    for (size_t i = 0; i < glass_.size() / kTexelsForAnAdd; ++i)
      order.adds.push_back({texelOf(order, i, kTexelsForAnAdd), texelVolume_pl(1e-4)});
    for (size_t i = 0; i < glass_.size() / kTexelsForATake; ++i)
      order.takes.push_back({texelOf(order, i, kTexelsForATake), 32768});
    orders_.push_back(std::move(order));
  }
  // Anywhere on the i-th stretch of so many, so that none comes twice.
  int texelOf(const glass::FilmOrder& order, size_t i, int stretch) const {
    const uint32_t h = shared::pcg(static_cast<uint32_t>(i) + shared::pcg(static_cast<uint32_t>(order.step)));
    return glass_[i * static_cast<size_t>(stretch) + h % static_cast<uint32_t>(stretch)];
  }
  const glass::PaneMap& map_;
  std::vector<int> glass_;
  std::vector<glass::FilmOrder> orders_;
  int64_t step_ = 0;
};

// The film's whole state, film and beads of each texel, from one buffer to another: as film_flow.comp reads
// and writes it, by groups that walk over tiles as its do.
class Copy {
 public:
  Copy(const GladGLContext& gl, const glass::PaneMap& map, bool software)
      : gl_(gl),
        tiles_(map.tileCount()),
        tiles_in_group_(software ? 8 : 1),  // as film_lists.glsl and film_tile.comp have it
        program_(gl, {"copy.comp"},
                 software ? std::vector<std::string>{"RG_SOFTWARE_GL"} : std::vector<std::string>{}, source),
        from_(gl, bytes(map)),
        to_(gl, bytes(map)),
        from_strips_(gl),
        from_beads_(gl, bytes(map)),
        to_beads_(gl, bytes(map)),
        from_beads_strips_(gl) {
    for (gl::Buffer* buffer : {&from_, &to_, &from_beads_, &to_beads_}) buffer->zero();
    from_beads_strips_.show(GL_RGBA32I, shared::kStripSize * sizeof(int32_t), from_beads_, 0,
                            from_beads_.bytes());
    from_strips_.show(GL_RGBA32I, shared::kStripSize * sizeof(int32_t), from_, 0, from_.bytes());
  }
  void run() {
    gl_.BindImageTexture(0, from_strips_.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32I);
    gl_.BindImageTexture(1, from_beads_strips_.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32I);
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, from_.name());
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, from_beads_.name());
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, to_.name());
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, to_beads_.name());
    program_.use();
    program_.set(4, tiles_);
    gl_.DispatchCompute((tiles_.x * tiles_.y + tiles_in_group_ - 1) / tiles_in_group_, 1, 1);
    gl_.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  }

 private:
  static size_t bytes(const glass::PaneMap& map) {
    return map.tileArea_m2().size() * shared::kTileSize * shared::kTileSize * sizeof(int32_t);
  }
  static std::string_view source(std::string_view path) {
    return path == "copy.comp" ? kText : gl::shaderSource(path);
  }
  // Before any branch: a file is put in where it is first named, whatever becomes of that branch.
  static constexpr std::string_view kText = R"(
#include "shared/glass_types.glsl"
#ifdef RG_SOFTWARE_GL
#include "glass/film_lists.glsl"
layout(local_size_x = kGroup) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer from;
layout(rgba32i, binding = 1) readonly uniform iimageBuffer from_beads;
layout(std430, binding = 3) writeonly buffer To { ivec4 to[]; };
layout(std430, binding = 6) writeonly buffer ToBeads { ivec4 to_beads[]; };
layout(location = 4) uniform uvec2 tiles;
void main() {
  int t = int(gl_GlobalInvocationID.x), tiles_across = int(tiles.x), across = tiles_across * kStrips;
  if (t >= tiles_across * int(tiles.y)) return;
  int first = t / tiles_across * kTileSize * across + t % tiles_across * kStrips, row = 0;
  do {
    for (int strip = first; strip < first + kStrips; ++strip) {
      to[strip] = imageLoad(from, strip);
      to_beads[strip] = imageLoad(from_beads, strip);
    }
    first += across;
  } while (++row < kTileSize);
}
#else
layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(std430, binding = 0) readonly buffer From { int from[]; };
layout(std430, binding = 1) readonly buffer FromBeads { int from_beads[]; };
layout(std430, binding = 3) writeonly buffer To { int to[]; };
layout(std430, binding = 6) writeonly buffer ToBeads { int to_beads[]; };
layout(location = 4) uniform uvec2 tiles;
void main() {
  int t = int(gl_WorkGroupID.x), tiles_across = int(tiles.x);
  ivec2 at = ivec2(t % tiles_across, t / tiles_across) * kTileSize + ivec2(gl_LocalInvocationID.xy);
  int place = at.y * tiles_across * kTileSize + at.x;
  to[place] = from[place];
  to_beads[place] = from_beads[place];
}
#endif
)";
  const GladGLContext& gl_;
  glm::uvec2 tiles_;
  GLuint tiles_in_group_;
  gl::Program program_;
  gl::Buffer from_, to_;
  gl::BufferTexture from_strips_;
  gl::Buffer from_beads_, to_beads_;
  gl::BufferTexture from_beads_strips_;
};

void compare(const GladGLContext& gl, glm::ivec2 grid, int frames) {
  const std::unique_ptr<glass::PaneMap> map = paneOf(grid);
  glass::FilmGl film(gl, glass::makeFilmPrograms(gl), *map, glass::UnevenGlass(*map, 1));
  Downpour downpour(*map);
  Stopwatch stopwatch(gl);
  Copy copy(gl, *map, stopwatch.software());
  std::vector<double> step_ms, copy_ms;
  while (static_cast<int>(step_ms.size()) < frames) {
    const bool wets = downpour.wetsNext();
    std::vector<glass::FilmOrder> orders = downpour.next();
    // A GPU is given something to do until all of the step is in its queue, so that its stamps tell of no
    // wait for the CPU, nor for the report.
    for (int i = 0; i < (stopwatch.software() ? 0 : kCopiesBefore); ++i) copy.run();
    const double step = stopwatch.time([&] {
      film.run(std::move(orders));
      if (stopwatch.software()) film.collect(true);
    });
    film.collect(true);
    const double copied = stopwatch.time([&] { copy.run(); });
    if (wets) continue;
    step_ms.push_back(step);
    copy_ms.push_back(copied);
  }
  std::printf("%dx%d,%.3f,%.3f,%.2f\n", grid.x, grid.y, median(step_ms), median(copy_ms),
              median(step_ms) / median(copy_ms));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::program(argc, argv, "bench_film", kUsage, [&] {
    const Options options = parse(argc, argv);
    const GladGLContext gl = bench::makeContext();
    std::puts("grid,film_step_ms,copy_ms,ratio");
    for (const glm::ivec2 grid : options.grids) compare(gl, grid, options.frames);
  });
}
