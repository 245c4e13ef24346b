// The streaks' segments as the GPU draws them: where streak.vert itself draws them, in the plugin's own draw
// call on its own buffers, read back by transform feedback.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "picture.h"
#include "rain/picture.h"

namespace oracle {

// World coordinates.
struct Segment {
  bool drawn = false;
  glm::dvec3 from_m{0.0}, to_m{0.0};
};

class DrawnStreaks {
 public:
  // `capacity_drops` as of the field. Without `read_back` nothing is, and the plugin's program stays as it
  // is.
  explicit DrawnStreaks(uint32_t capacity_drops, bool read_back = true);
  ~DrawnStreaks();

  // Takes over what is new, then draws; by slot, all others hold no drop.
  std::vector<Segment> draw(rg::rain::Upload& upload, const rg::ViewState& view, int64_t time_ns);
  // What was drawn last.
  rg::test::Picture picture() const;
  // What the driver complained about since the last call; empty when all is clean.
  std::string complaints();

 private:
  struct Gpu;
  std::unique_ptr<Gpu> gpu_;
  bool read_back_;
};

}  // namespace oracle
