// Which panes a view sees, in what order, and behind which of them the picture must be fetched anew.
#pragma once

#include <span>
#include <vector>

#include "glass/look_gl.h"

namespace rg::glass {

// A pane's bounding sphere as the eye sees it.
struct SeenPane {
  const LookPane* pane = nullptr;
  glm::dvec3 direction{0.0};  // unit, eye frame
  double distance_m = 0.0;
  double radius_m = 0.0;
};

// Panes whose sphere meets the view's frustum, far ones first.
std::vector<SeenPane> seenPanes(std::span<const LookPane> panes, const LookView& view);

// True where `far` lies wholly beyond `near` and they overlap in the picture: what `near` shows bent must
// hold what `far` drew. Panes around an eye inside a car lie beside each other, so that one picture does for
// all of them.
bool liesBehind(const SeenPane& far, const SeenPane& near);

}  // namespace rg::glass
