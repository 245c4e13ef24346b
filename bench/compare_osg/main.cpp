// compare_osg [--speed KMH] [--frames N]: falling rain as Rainglass and as OpenSceneGraph draw it, in one
// context, frame by frame in turn. Prints CSV; bench/README.md tells what is measured and how.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "off_screen.h"
#include "osg_side.h"
#include "rainglass_side.h"
#include "target.h"

namespace compare {
namespace {

constexpr double kAlike = 0.02;      // numbers of streaks are made equal to this
constexpr double kAreaAlike = 0.04;  // and their areas to this
constexpr int kSettled = 10;         // frames until rain seen farther than before has come
constexpr int kCounted = 5;

double seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

// Milliseconds of one frame: until all is drawn, and of the calling thread until all is handed to GL.
struct Cost {
  std::vector<double> frame_ms, cpu_ms;
  void take(const GladGLContext& gl, const std::function<void()>& frame) {
    gl.Finish();
    const double from = seconds(CLOCK_MONOTONIC), cpu = seconds(CLOCK_THREAD_CPUTIME_ID);
    frame();
    gl.Flush();
    cpu_ms.push_back(1e3 * (seconds(CLOCK_THREAD_CPUTIME_ID) - cpu));
    gl.Finish();
    frame_ms.push_back(1e3 * (seconds(CLOCK_MONOTONIC) - from));
  }
};

struct Compared {
  const Target& target;
  OsgSide& osg;
  RainglassSide& rainglass;
  Moment moment;
  int frames;
};

struct Seen {
  double streaks = 0.0, area_px = 0.0;
};

// Means over some frames, of which the first are drawn until the rain has settled.
Seen look(Compared& c, Side& side, int settling) {
  Seen seen;
  Cover cover;
  for (int i = 0; i < settling + kCounted; ++i) {
    ++c.moment.frame;
    side.draw(c.moment);
    if (i < settling) continue;
    seen.streaks += side.streaksSeen() / kCounted;
    cover.add(c.target);
  }
  seen.area_px = cover.px();
  return seen;
}

// Turns a knob until what it makes is `wanted`: secants in logarithms, `slope` at first.
void turn(double knob, double slope, double wanted, double within, const char* what,
          const std::function<double(double)>& make) {
  double last_knob = 0.0, last_got = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double got = make(knob);
    std::fprintf(stderr, "# %s: %.4g makes %.0f of %.0f\n", what, knob, got, wanted);
    if (std::abs(got / wanted - 1.0) < within) return;
    if (last_got > 0.0 && got != last_got)
      slope = std::clamp(std::log(got / last_got) / std::log(knob / last_knob), 0.3, 4.0);
    last_knob = knob;
    last_got = got;
    knob *= std::pow(wanted / got, 1.0 / slope);
  }
  throw std::runtime_error(std::string(what) + " cannot be made equal");
}

void print(const Side& side, const Seen& seen, const Cost& rain, const Cost& empty) {
  const double frame_ms = median(rain.frame_ms) - median(empty.frame_ms),
               cpu_ms = median(rain.cpu_ms) - median(empty.cpu_ms);
  std::printf("%s,%.0f,%.0f,%.3f,%.3f,%.4f\n", side.name(), seen.streaks, seen.area_px, cpu_ms, frame_ms,
              1e3 * frame_ms / seen.streaks);
  std::fflush(stdout);
}

void compare(Compared& c, double streaks) {
  c.rainglass.countStreaks(true);
  turn(1895.0, 2.5, streaks, kAlike, "rainglass' reach, streaks", [&](double px) {
    c.rainglass.setReference(px);
    return look(c, c.rainglass, kSettled).streaks;
  });
  const Seen ours = look(c, c.rainglass, 0);
  turn(150.0, 1.0, ours.streaks, kAlike, "osg's density, streaks", [&](double density) {
    c.osg.setDensity(density);
    return look(c, c.osg, 2).streaks;
  });
  turn(0.01, 1.0, ours.area_px, kAreaAlike, "osg's particle size, area", [&](double size) {
    c.osg.setParticleSize(size);
    return look(c, c.osg, 2).area_px;
  });
  const Seen theirs = look(c, c.osg, 0);
  c.rainglass.countStreaks(false);
  Cost rain[2], empty[2];
  Side* sides[2] = {&c.osg, &c.rainglass};
  for (int i = 0; i < c.frames; ++i) {
    ++c.moment.frame;
    for (size_t k = 0; k < 2; ++k) {
      empty[k].take(c.target.gl, [&] { sides[k]->drawEmpty(c.moment); });
      rain[k].take(c.target.gl, [&] { sides[k]->draw(c.moment); });
    }
  }
  print(c.osg, theirs, rain[0], empty[0]);
  print(c.rainglass, ours, rain[1], empty[1]);
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

int run(int argc, char** argv) {
  double kmh = 0.0;
  int frames = 120;
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    const bool is_number = !value.empty() && *end == '\0' && std::isfinite(number);
    if (option == "--speed" && is_number && std::abs(number) <= 300.0)
      kmh = number;
    else if (option == "--frames" && is_number && number >= 1.0 && number <= 1e5)
      frames = static_cast<int>(number);
    else
      throw std::runtime_error("no option " + option + " " + value +
                               "; there are --speed KMH (to 300) and --frames N (1 .. 100000)");
  }
  const GladGLContext gl = bench::makeContext();
  const Target target(gl);
  OsgSide osg(target.framebuffer);
  RainglassSide rainglass(gl, target.framebuffer, RG_PLUGIN);
  std::printf("# %s, %u threads; %s; %d x %d, %.0f km/h, medians of %d frames\n", processor().c_str(),
              std::thread::hardware_concurrency(), reinterpret_cast<const char*>(gl.GetString(GL_RENDERER)),
              kWidth_px, kHeight_px, kmh, frames);
  std::printf("who,drops,streak_area_px,cpu_ms,frame_ms,frame_us_per_drop\n");
  Compared compared{target, osg, rainglass, {0, kmh / 3.6}, frames};
  for (const double streaks : {20e3, 50e3}) compare(compared, streaks);
  return 0;
}

}  // namespace
}  // namespace compare

int main(int argc, char** argv) {
  try {
    return compare::run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "compare_osg: %s\n", e.what());
    return 1;
  }
}
