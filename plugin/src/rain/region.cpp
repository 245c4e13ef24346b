#include "rain/region.h"

#include <algorithm>
#include <cmath>

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kMostCells = 22.0;  // RowSet holds 48 rows: 22 to either side, and the roundings
constexpr double kFarthestCell = 1.0e9;

// The direction, world axes, that is seen at a point of the picture (-1..1).
dvec3 seenAt(const glm::dmat4& eyeFromClip, const glm::dmat3& worldFromEye, double x, double y) {
  // Two depths on the ray: their difference is the direction, whatever the depth convention.
  const glm::dvec4 a = eyeFromClip * glm::dvec4(x, y, 0.25, 1.0),
                   b = eyeFromClip * glm::dvec4(x, y, 0.75, 1.0);
  dvec3 ray = dvec3(a) / a.w - dvec3(b) / b.w;
  if (ray.z > 0.0) ray = -ray;
  return worldFromEye * glm::normalize(ray);
}

struct Side {
  float offset, by_y, by_z;  // x = offset + by_y * y + by_z * z, relative to the eye, in cells
};

struct Sides {
  std::array<Side, 4> low, high;
  int lows = 0, highs = 0;
};

Sides sidesOf(const Cone& cone, const Margin& margin, double cell_m) {
  Sides sides;
  const Region region(cone, margin);
  for (size_t i = 0; i < 4; ++i) {
    const dvec3& n = region.inward[i];
    const double wider = region.wider_m[i] / cell_m + 0.5 * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    // A plane along x bounds no row in x. Tilting it by 1e-4 moves it by less than 0.003 cells anywhere in
    // reach.
    const double nx = std::abs(n.x) < 1e-4 ? 1e-4 : n.x;
    const Side side{static_cast<float>(-wider / nx), static_cast<float>(-n.y / nx),
                    static_cast<float>(-n.z / nx)};
    if (nx > 0.0)
      sides.low[static_cast<size_t>(sides.lows++)] = side;
    else
      sides.high[static_cast<size_t>(sides.highs++)] = side;
  }
  return sides;
}

// Bounds of the region along an axis, from the eye, in cells: of the pyramid with the sphere's radius as its
// depth, within the sphere.
void extent(const Cone& cone, const Margin& margin, double cell_m, double radius, int axis, double& low,
            double& high) {
  const dvec3 middle = glm::normalize(cone.corners[0] + cone.corners[1] + cone.corners[2] + cone.corners[3]);
  double nearest = 0.0, farthest = 0.0;
  for (const dvec3& corner : cone.corners) {
    const double along = glm::dot(corner, middle);
    const double tip = along > 0.2 ? corner[axis] / along : (corner[axis] > 0.0 ? 5.0 : -5.0);
    nearest = std::min(nearest, tip);
    farthest = std::max(farthest, tip);
  }
  // The sides' margin moves the pyramid's edges apart by more than itself where they meet sharply: twice
  // covers 60 deg between them.
  const double wider =
      2.0 * (glm::length(margin.ahead_m) + glm::length(margin.streak_m) + margin.sides_m) / cell_m + 1.5;
  const double middle_cells = margin.middle_m[axis] / cell_m,
               deep = radius + glm::length(margin.middle_m) / cell_m;
  low = std::max(middle_cells - radius, deep * nearest - wider);
  high = std::min(middle_cells + radius, deep * farthest + wider);
}

// So many rows along z are found together, as the machine can.
constexpr int32_t kAtOnce = RowSet::kAtOnce;

// A sphere, from the eye, in cells.
struct Ball {
  float x, y, z, radius_sq;
};

// Whole cells [first, last) whose middle lies between low and high, both within +-22 of the eye; nothing of
// the kind is an empty span.
void findSpans(const Sides& sides, const Ball& ball, float y, float first_z, float eye_x, int32_t base_x,
               RowSpan* spans) {
  std::array<float, kAtOnce> z, low, high;
  for (size_t i = 0; i < kAtOnce; ++i) z[i] = first_z + static_cast<float>(i);
  for (size_t i = 0; i < kAtOnce; ++i) {
    const float beside_y = y - ball.y, beside_z = z[i] - ball.z;
    const float rest = ball.radius_sq - beside_y * beside_y - beside_z * beside_z;
    const float half = rest > 0.0f ? std::sqrt(std::max(rest, 0.0f)) : -1.0f;
    high[i] = ball.x + half;
    low[i] = ball.x - half;
  }
  for (int s = 0; s < sides.lows; ++s) {
    const Side& side = sides.low[static_cast<size_t>(s)];
    for (size_t i = 0; i < kAtOnce; ++i)
      low[i] = std::max(low[i], side.offset + side.by_y * y + side.by_z * z[i]);
  }
  for (int s = 0; s < sides.highs; ++s) {
    const Side& side = sides.high[static_cast<size_t>(s)];
    for (size_t i = 0; i < kAtOnce; ++i)
      high[i] = std::min(high[i], side.offset + side.by_y * y + side.by_z * z[i]);
  }
  // Ceiling and floor by truncation, above zero.
  constexpr float kAbove = 64.0f, kBeyond = 32.0f;
  std::array<int32_t, kAtOnce> first, last;
  for (size_t i = 0; i < kAtOnce; ++i) {
    const float from = low[i] + eye_x - 0.5f, to = high[i] + eye_x - 0.5f;
    const float above = kAbove - std::min(from, kBeyond), below = kAbove + std::max(to, -kBeyond);
    const int32_t begin = 64 - static_cast<int32_t>(above), end = static_cast<int32_t>(below) - 63;
    const int32_t any = begin < end ? -1 : 0;
    first[i] = (base_x + begin) & any;
    last[i] = (base_x + end) & any;
  }
  for (size_t i = 0; i < kAtOnce; ++i) spans[i] = {first[i], last[i]};
}

}  // namespace

Cone coneOf(const ViewState& view) {
  Cone cone;
  const glm::dmat4 eyeFromClip = glm::inverse(view.clipFromEye);
  const glm::dmat3 worldFromEye = glm::transpose(glm::dmat3(view.eyeFromWorld));
  cone.eye_m = -(worldFromEye * dvec3(view.eyeFromWorld[3]));
  cone.corners = {seenAt(eyeFromClip, worldFromEye, -1, -1), seenAt(eyeFromClip, worldFromEye, 1, -1),
                  seenAt(eyeFromClip, worldFromEye, 1, 1), seenAt(eyeFromClip, worldFromEye, -1, 1)};
  const dvec3 middle = glm::normalize(cone.corners[0] + cone.corners[1] + cone.corners[2] + cone.corners[3]);
  for (size_t i = 0; i < 4; ++i) {
    dvec3 normal = glm::normalize(glm::cross(cone.corners[i], cone.corners[(i + 1) % 4]));
    if (glm::dot(normal, middle) < 0.0) normal = -normal;
    cone.inward[i] = normal;
  }
  cone.valid = true;
  const auto usable = [](const dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  for (size_t i = 0; i < 4; ++i) cone.valid = cone.valid && usable(cone.inward[i]) && usable(cone.corners[i]);
  cone.valid = cone.valid && usable(cone.eye_m);
  if (cone.valid) return cone;
  // Such a one is passed on and saved as well: with numbers in it.
  if (!usable(cone.eye_m)) cone.eye_m = dvec3(0.0);
  cone.inward.fill(dvec3(0.0)), cone.corners.fill(dvec3(0.0));
  return cone;
}

Rays raysOf(const Cone& cone, const ViewState& view) {
  const dvec3 forward = glm::transpose(glm::dmat3(view.eyeFromWorld)) * dvec3(0, 0, -1);
  const auto atDepth1 = [&](size_t i) { return cone.corners[i] / glm::dot(cone.corners[i], forward); };
  const dvec3 right = 0.5 * (atDepth1(1) - atDepth1(0)), up = 0.5 * (atDepth1(3) - atDepth1(0));
  return {atDepth1(0) + right + up, right, up};
}

Region::Region(const Cone& cone, const Margin& margin)
    : inward(cone.inward), reach_m(margin.reach_m), middle_m(margin.middle_m) {
  for (size_t i = 0; i < 4; ++i)
    wider_m[i] = std::max(0.0, glm::dot(margin.ahead_m, inward[i])) +
                 std::abs(glm::dot(margin.streak_m, inward[i])) + margin.sides_m;
}

// Within the other's reach a plane that is turned lies elsewhere by that times the difference of the normals.
bool Region::holds(const Region& other, const dvec3& moved) const {
  bool inside = other.reach_m + glm::distance(moved + other.middle_m, middle_m) <= reach_m;
  const double farthest_m = other.reach_m + glm::length(other.middle_m);
  for (size_t i = 0; i < 4; ++i) {
    const double turned_m = farthest_m * glm::distance(inward[i], other.inward[i]);
    inside = inside && other.wider_m[i] + turned_m - glm::dot(moved, inward[i]) <= wider_m[i];
  }
  return inside;
}

double exposureOf(const ViewState& view) {
  return view.exposure_s > 0.0 ? std::min(view.exposure_s, 0.25) : 0.0;
}

dvec3 eyeVelocityOf(const ViewState& view) {
  const dvec3 v = view.eye_velocity_mps;
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) ? v : dvec3(0.0);
}

void findRows(const Cone& cone, const Margin& margin, const dvec3& eye_cells, double cell_m, RowSet& out) {
  out.clear();
  if (!cone.valid || !(glm::length(eye_cells) < kFarthestCell)) return;
  const dvec3 base = glm::floor(eye_cells);
  const dvec3 eye = eye_cells - base;  // 0..1: what follows stays near zero, where floats are fine
  constexpr double kHalfDiagonal = 0.8661;
  const double radius = std::min(margin.reach_m / cell_m + kHalfDiagonal, kMostCells);

  double y_low, y_high, z_low, z_high;
  extent(cone, margin, cell_m, radius, 1, y_low, y_high);
  extent(cone, margin, cell_m, radius, 2, z_low, z_high);
  const int32_t y_first = static_cast<int32_t>(std::floor(eye.y + y_low)),
                y_last = static_cast<int32_t>(std::ceil(eye.y + y_high));
  const int32_t z_first = static_cast<int32_t>(std::floor(eye.z + z_low)),
                z_last = static_cast<int32_t>(std::ceil(eye.z + z_high));
  const int32_t base_x = static_cast<int32_t>(base.x);
  out.y0 = static_cast<int32_t>(base.y) + y_first;
  out.z0 = static_cast<int32_t>(base.z) + z_first;
  out.ny = std::clamp(y_last - y_first, 0, RowSet::kRows);
  out.nz = std::clamp(z_last - z_first, 0, RowSet::kRows);

  const Sides sides = sidesOf(cone, margin, cell_m);
  const glm::vec3 middle(margin.middle_m / cell_m);
  const Ball ball{middle.x, middle.y, middle.z, static_cast<float>(radius * radius)};
  const float eye_x = static_cast<float>(eye.x);
  for (int32_t iy = 0; iy < out.ny; ++iy) {
    const float y = static_cast<float>(y_first + iy + 0.5 - eye.y);
    RowSpan* row = out.line(out.y0 + iy);
    for (int32_t iz = 0; iz < out.nz; iz += kAtOnce) {
      const float z = static_cast<float>(z_first + iz + 0.5 - eye.z);
      findSpans(sides, ball, y, z, eye_x, base_x, row + iz);
    }
  }
}

}  // namespace rg::rain
