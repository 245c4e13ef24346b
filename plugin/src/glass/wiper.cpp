#include "glass/wiper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "glass/water.h"
#include "glass/wear.h"
#include "saved/archive.h"

namespace rg::glass {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double wrapped(double angle_rad) { return angle_rad - kTurn * std::round(angle_rad / kTurn); }

glm::dvec2 direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

double bladeDirection_rad(const WiperInfo& info, double angle_rad) {
  return info.blade_angle_rad + (1.0 + info.blade_turn) * angle_rad;
}

// Where f changes its sign between a and b: halving until doubles end.
template <typename F>
double root(const F& f, double a, double b) {
  const bool rises = f(a) < 0.0;
  for (int k = 0; k < 60 && a < b; ++k) {
    const double middle = 0.5 * (a + b);
    if (middle == a || middle == b) break;
    ((f(middle) < 0.0) == rises ? a : b) = middle;
  }
  return b;
}

}  // namespace

Wiper::Wiper(const WiperInfo& info, const PaneMap& map, int slot, uint32_t seed)
    : info_(info),
      slot_(slot),
      side_(glm::cross(info.axis, info.rest_direction)),
      texel_m_(map.grid().texel_m),
      ends_(shared::kBladeSegments) {
  struct Entry {
    int pass, piece;
    double angle;
    shared::SweptTexel swept;
  };
  std::vector<Entry> entries;
  const Wear wear(info.residual_film_m, info.blade_m, info.wear, seed);
  int most = 1;
  crossed_from_.reserve(static_cast<size_t>(map.texelCount()) + 1);
  for (int i = 0; i < map.texelCount(); ++i) {
    crossed_from_.push_back(static_cast<uint32_t>(crossed_rad_.size()));
    if (!map.inside(i)) continue;
    const Crossings c = crossingsAt(glm::dvec3(map.texel(i).position_m));
    crossed_rad_.insert(crossed_rad_.end(), c.angle_rad, c.angle_rad + c.count);
    const auto area_m2 = static_cast<double>(map.texel(i).area_m2);
    for (int k = 0; k < c.count; ++k) {
      const shared::SweptTexel swept{i, static_cast<int>(picolitres(wear.residual_m(c.along_m[k]) * area_m2)),
                                     static_cast<int>(picolitres(wear.smear_m() * area_m2)), 0};
      entries.push_back({k, c.segment[k], c.angle_rad[k], swept});
      ends_[static_cast<size_t>(c.segment[k])].reach(c.angle_rad[k], i);
    }
    most = std::max(most, c.count);
  }
  crossed_from_.push_back(static_cast<uint32_t>(crossed_rad_.size()));
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.pass, a.piece, a.angle, a.swept.texel) <
           std::tie(b.pass, b.piece, b.angle, b.swept.texel);
  });
  starts_.resize(static_cast<size_t>(most * shared::kBladeSegments));
  auto swept = std::make_shared<std::vector<shared::SweptTexel>>();
  size_t piece = 0;
  for (const Entry& entry : entries) {
    const auto of = static_cast<size_t>(entry.pass * shared::kBladeSegments + entry.piece);
    while (piece <= of) starts_[piece++] = angles_.size();
    swept->push_back(entry.swept);
    angles_.push_back(entry.angle);
  }
  while (piece < starts_.size()) starts_[piece++] = angles_.size();
  starts_.push_back(angles_.size());
  swept_ = std::move(swept);
  findTiles(map);
}

void Wiper::findTiles(const PaneMap& map) {
  const glm::ivec2 count = map.tileCount();
  const double tile_m = texel_m_ * shared::kTileSize;
  tiles_.resize(static_cast<size_t>(count.x * count.y));
  for (size_t i = 0; i < tiles_.size(); ++i) {
    const int n = static_cast<int>(i);
    tiles_[i].low_m = tile_m * glm::dvec2(n % count.x, n / count.x);
    tiles_[i].high_m = tiles_[i].low_m + tile_m;
  }
  const auto eachTexel = [&](const auto& visit) {
    for (int i = 0; i < map.texelCount(); ++i) {
      if (map.inside(i)) visit(tiles_[map.tileOf(i)], map.texel(i), map.middleOf(i));
    }
  };
  // Means first.
  std::vector<double> texels(tiles_.size(), 0.0);
  eachTexel([&](TileInPlane& tile, const PaneTexel& texel, const glm::dvec2& middle_m) {
    tile.middle_m += middle_m;
    tile.place_m += inPlane(glm::dvec3(texel.position_m));
    tile.along_x += turnedInPlane(glm::dvec3(texel.along_x));
    tile.along_y += turnedInPlane(glm::dvec3(texel.along_y));
    ++texels[static_cast<size_t>(&tile - tiles_.data())];
  });
  for (size_t i = 0; i < tiles_.size(); ++i) {
    for (glm::dvec2* sum : {&tiles_[i].middle_m, &tiles_[i].place_m, &tiles_[i].along_x, &tiles_[i].along_y})
      *sum /= std::max(texels[i], 1.0);
  }
  // Of each texel's corners: between them all is straight.
  eachTexel([&](TileInPlane& tile, const PaneTexel& texel, const glm::dvec2& middle_m) {
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
      const glm::dvec2 d = 0.5 * texel_m_ * corner, from_middle = middle_m + d - tile.middle_m;
      const glm::dvec2 place_m = inPlane(glm::dvec3(texel.position_m) + d.x * glm::dvec3(texel.along_x) +
                                         d.y * glm::dvec3(texel.along_y));
      const glm::dvec2 told_m = tile.place_m + from_middle.x * tile.along_x + from_middle.y * tile.along_y;
      tile.off_m = std::max(tile.off_m, glm::distance(place_m, told_m));
      tile.radius_m = std::max(tile.radius_m, glm::distance(place_m, tile.place_m));
    }
  });
}

glm::dvec2 Wiper::inPlane(const glm::dvec3& vehicle_m) const {
  return turnedInPlane(vehicle_m - info_.pivot_m);
}

glm::dvec2 Wiper::turnedInPlane(const glm::dvec3& d) const {
  return {glm::dot(d, info_.rest_direction), glm::dot(d, side_)};
}

BladePose bladePose(const WiperInfo& info, double angle_rad) {
  const glm::dvec3 side = glm::cross(info.axis, info.rest_direction);
  const auto inVehicle = [&](const glm::dvec2& v) { return v.x * info.rest_direction + v.y * side; };
  const glm::dvec2 along = direction(bladeDirection_rad(info, angle_rad));
  const double with_arm = glm::dot(along, direction(angle_rad)) < 0.0 ? -1.0 : 1.0;
  return {info.pivot_m + inVehicle(info.arm_m * direction(angle_rad)), inVehicle(along),
          inVehicle(with_arm * glm::dvec2(-along.y, along.x))};
}

// The blade's line at angle t goes through a e(t) along e(b + (1 + k) t); a place p lies on it where
// F(t) = e(b + (1 + k) t) x (p - a e(t)) = r sin(phi - b - (1 + k) t) + a sin(b + k t) = 0. Solved in closed
// form for k = 0 and k = -1, else by halving between samples: F has few waves in a turn.
std::vector<double> Wiper::anglesOf(const glm::dvec2& place_m) const {
  const double a = info_.arm_m, b = info_.blade_angle_rad, k = info_.blade_turn;
  const double r = glm::length(place_m), phi = std::atan2(place_m.y, place_m.x);
  std::vector<double> out;
  if (k == 0.0) {
    const double under = r * r - std::pow(a * std::sin(b), 2.0);
    if (under < 0.0) return out;
    for (const double sign : {1.0, -1.0}) {
      const double along = -a * std::cos(b) + sign * std::sqrt(under);
      if (sign < 0.0 && under == 0.0) continue;
      out.push_back(wrapped(phi - std::atan2(along * std::sin(b), a + along * std::cos(b))));
    }
  } else if (k == -1.0) {
    const double share = r * std::sin(phi - b) / a;
    if (std::abs(share) > 1.0) return out;
    const double t = std::asin(share);
    out = {wrapped(b + t), wrapped(b + std::numbers::pi - t)};
  } else {
    const auto f = [&](double t) { return r * std::sin(phi - b - (1.0 + k) * t) + a * std::sin(b + k * t); };
    constexpr int kSamples = 64;
    double before = f(-std::numbers::pi);
    for (int n = 0; n < kSamples; ++n) {
      const double from = -std::numbers::pi + kTurn * n / kSamples, to = from + kTurn / kSamples;
      const double now = f(to);
      if ((before < 0.0) != (now < 0.0)) out.push_back(root(f, from, to));
      before = now;
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

uint64_t Wiper::fingerprint() const {
  saved::Writer a;
  a(info_.pivot_m, info_.axis, info_.rest_direction, info_.arm_m, info_.blade_m, info_.blade_angle_rad,
    info_.residual_film_m, info_.blade_turn, info_.wear, info_.lift_m, slot_);
  return saved::fingerprintOf(a.bytes);
}

Crossings Wiper::crossingsAt(const glm::dvec3& vehicle_m, double beyond_end_m) const {
  const glm::dvec2 place = inPlane(vehicle_m);
  Crossings out;
  const double reach = info_.arm_m + 0.5 * info_.blade_m + beyond_end_m;
  if (glm::dot(place, place) > reach * reach) return out;
  for (const double angle : anglesOf(place)) {
    const double along =
        glm::dot(place - info_.arm_m * direction(angle), direction(bladeDirection_rad(info_, angle)));
    if (std::abs(along) > 0.5 * info_.blade_m + beyond_end_m || out.count == Crossings::kMost) continue;
    out.angle_rad[out.count] = angle;
    out.along_m[out.count] = along;
    const auto piece = static_cast<int>(std::floor((along / info_.blade_m + 0.5) * shared::kBladeSegments));
    out.segment[out.count] = std::clamp(piece, 0, shared::kBladeSegments - 1);
    ++out.count;
  }
  return out;
}

std::vector<shared::SweptRange> Wiper::ranges(const Sweep& sweep) const {
  const bool forward = sweep.now_rad > sweep.before_rad;
  std::vector<shared::SweptRange> out;
  for (size_t piece = 0; piece + 1 < starts_.size(); ++piece) {
    const auto begin = angles_.begin() + static_cast<std::ptrdiff_t>(starts_[piece]);
    const auto end = angles_.begin() + static_cast<std::ptrdiff_t>(starts_[piece + 1]);
    const auto first = forward ? std::upper_bound(begin, end, sweep.before_rad)
                               : std::lower_bound(begin, end, sweep.now_rad);
    const auto last = forward ? std::upper_bound(first, end, sweep.now_rad)
                              : std::lower_bound(first, end, sweep.before_rad);
    out.push_back({static_cast<int>(first - angles_.begin()), static_cast<int>(last - first)});
  }
  return out;
}

// No point of the blade goes farther in a sweep than its end's turns allow.
SweptStrip Wiper::stripOf(const Sweep& sweep) const {
  constexpr double kRounding_m = 1e-6;  // of places as floats, too
  const double angle = 0.5 * (sweep.before_rad + sweep.now_rad);
  const double half_rad = 0.5 * std::abs(sweep.now_rad - sweep.before_rad),
               turned_rad = half_rad * std::abs(1.0 + info_.blade_turn);
  return {.middle_m = info_.arm_m * direction(angle),
          .along = direction(bladeDirection_rad(info_, angle)),
          .half_m = 0.5 * info_.blade_m,
          .near_m = half_rad * info_.arm_m + turned_rad * 0.5 * info_.blade_m + kRounding_m,
          .turned_rad = turned_rad};
}

std::optional<double> Wiper::ahead_rad(int texel, const Sweep& sweep, double met_rad) const {
  const auto i = static_cast<size_t>(texel);
  const double *first = crossed_rad_.data() + crossed_from_[i],
               *last = crossed_rad_.data() + crossed_from_[i + 1];
  if (first == last) return std::nullopt;
  const double nearest = *std::min_element(
      first, last, [met_rad](double a, double b) { return std::abs(a - met_rad) < std::abs(b - met_rad); });
  return sweep.now_rad > sweep.before_rad ? nearest - sweep.before_rad : sweep.before_rad - nearest;
}

std::vector<std::vector<int>> Wiper::aheadOf(double extreme_rad, double direction) const {
  constexpr size_t kEnough = 8;                          // texels for a piece's water
  const double near_rad = 2.5 * texel_m_ / info_.arm_m;  // a ridge is some millimetres wide
  std::vector<std::vector<int>> out(shared::kBladeSegments);
  const std::vector<shared::SweptRange> ranges =
      this->ranges({extreme_rad, extreme_rad + direction * 4.0 * near_rad});
  for (size_t n = 0; n < ranges.size(); ++n) {
    std::vector<int>& list = out[n % shared::kBladeSegments];
    for (int k = 0; k < ranges[n].count; ++k) {
      const int back = direction > 0.0 ? k : ranges[n].count - 1 - k;
      const auto i = static_cast<size_t>(ranges[n].first + back);
      const bool near = std::abs(angles_[i] - extreme_rad) <= near_rad;
      if (list.size() < kEnough && (near || list.empty())) list.push_back((*swept_)[i].texel);
    }
  }
  // A piece may be narrower than a texel: one that meets none leaves its water with its neighbour's.
  for (size_t piece = 0; piece + 1 < out.size(); ++piece) {
    if (out[piece + 1].empty() && !offGlass(static_cast<int>(piece + 1), extreme_rad))
      out[piece + 1] = out[piece];
  }
  for (size_t piece = out.size() - 1; piece > 0; --piece) {
    if (out[piece - 1].empty() && !offGlass(static_cast<int>(piece - 1), extreme_rad))
      out[piece - 1] = out[piece];
  }
  return out;
}

bool Wiper::offGlass(int segment, double angle_rad) const {
  const Ends& ends = ends_[static_cast<size_t>(segment)];
  const double margin = 1.5 * texel_m_ / info_.arm_m;
  return angle_rad < ends.low_rad - margin || angle_rad > ends.high_rad + margin;
}

double Wiper::toEdge_rad(int segment, double angle_rad, double direction) const {
  const Ends& ends = ends_[static_cast<size_t>(segment)];
  return direction > 0.0 ? ends.high_rad - angle_rad : angle_rad - ends.low_rad;
}

int Wiper::edgeTexel(int segment, double direction) const {
  const Ends& ends = ends_[static_cast<size_t>(segment)];
  return direction > 0.0 ? ends.high_texel : ends.low_texel;
}

void Wiper::Ends::reach(double angle_rad, int texel) {
  if (angle_rad < low_rad) low_rad = angle_rad, low_texel = texel;
  if (angle_rad > high_rad) high_rad = angle_rad, high_texel = texel;
}

// The derivative of a e(t) + s e(b + (1 + k) t).
double Wiper::turnsAt_m(int segment, double angle_rad) const {
  const double along_m = ((segment + 0.5) / shared::kBladeSegments - 0.5) * info_.blade_m;
  return glm::length(info_.arm_m * direction(angle_rad) +
                     (1.0 + info_.blade_turn) * along_m * direction(bladeDirection_rad(info_, angle_rad)));
}

}  // namespace rg::glass
