// Which moments of a headless run are updated and which are drawn. Neither changes the state.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "options.h"

namespace host {

struct Event {
  int64_t time_ns = 0;
  bool update = false;
  bool draw = false;
  std::string shot;  // file name, or empty
  bool save = false;
};

// Ascending. Pictures at k / fps where a video or a budget wants them, or where no shots are asked for; the
// shots; an update before each of them, or at the asked rate; and a last update at the end. From `begin_ns`
// on: throws InputError where a shot or the saving lies before it, or the end does.
std::vector<Event> schedule(const Options& options, double seconds, int64_t begin_ns = 0);

}  // namespace host
