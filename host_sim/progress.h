// How long a run will still take, by how long its pictures took so far.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

namespace host {

class Progress {
 public:
  explicit Progress(double end_s) : end_s_(end_s) {}
  // To be asked after each picture, times ascending, `wall_s` on any clock. Nothing after the first: what
  // came before it, rain beforehand, a state restored and the driver's compiling, says nothing of the others.
  std::optional<double> left_s(double time_s, double wall_s) {
    if (!std::exchange(begun_, true)) {
      begin_s_ = time_s;
      begin_wall_s_ = wall_s;
      return std::nullopt;
    }
    return (wall_s - begin_wall_s_) / (time_s - begin_s_) * std::max(0.0, end_s_ - time_s);
  }

 private:
  double end_s_;
  bool begun_ = false;
  double begin_s_ = 0.0, begin_wall_s_ = 0.0;  // of the first picture
};

}  // namespace host
