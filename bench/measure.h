// What the programs that print CSV share: their options' numbers, medians, and time on any GL.
#pragma once

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gl/objects.h"

namespace bench {

// Throws std::invalid_argument naming `what`.
inline int number(std::string_view text, int least, int most, const char* what) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
    throw std::invalid_argument(std::string(what) + " must be a whole number from " + std::to_string(least) +
                                " to " + std::to_string(most) + ", not '" + std::string(text) + "'");
  }
  return value;
}

inline double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

// Milliseconds from one mark of the GL's to the next: on software GL, which has no clock of its own, each
// waits until all is done.
class Stopwatch {
 public:
  explicit Stopwatch(const GladGLContext& gl)
      : gl_(gl), software_(std::strstr(name(gl), "llvmpipe") || std::strstr(name(gl), "softpipe")) {
    for (rg::gl::TimestampQuery& query : queries_) query = rg::gl::TimestampQuery(gl);
  }
  bool software() const { return software_; }
  template <class Work>
  double time(const Work& work) {
    const double from_ms = mark(0);
    work();
    const double to_ms = mark(1);
    return software_ ? to_ms - from_ms
                     : 1e-6 * (static_cast<double>(queries_[1].ns()) - static_cast<double>(queries_[0].ns()));
  }

 private:
  static const char* name(const GladGLContext& gl) {
    return reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  }
  double mark(size_t which) {
    if (!software_) {
      queries_[which].stamp();
      return 0.0;
    }
    gl_.Finish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  const GladGLContext& gl_;
  bool software_;
  std::array<rg::gl::TimestampQuery, 2> queries_;
};

// What a program does with its arguments: --help, `run`, or one line that says what is wrong.
template <class Run>
int program(int argc, char** argv, const char* name, const char* usage, const Run& run) {
  if (argc > 1 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0)) {
    std::fputs(usage, stdout);
    return 0;
  }
  try {
    run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  }
  return 0;
}

}  // namespace bench
