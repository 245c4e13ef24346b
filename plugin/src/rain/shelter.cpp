#include "rain/shelter.h"

#include <algorithm>
#include <cmath>

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr uint32_t kLeaf = 2;
constexpr dvec3 kRounding_m{1e-6};      // by so much boxes are taken larger than what they hold
constexpr double kLeastChord_s = 1e-3;  // however absurdly a body spins

// Times (enter, leave) within [from, to] at which p + v t is inside; enter > leave: never. (Cyrus & Beck
// 1978.)
struct Span {
  double enter, leave;
};
Span timesInside(std::span<const Plane> planes, const dvec3& p, const dvec3& v, double from, double to) {
  Span span{from, to};
  for (const Plane& plane : planes) {
    const double outside = glm::dot(plane.normal, p) - plane.d;
    const double rate = glm::dot(plane.normal, v);
    if (rate > 0.0)
      span.leave = std::min(span.leave, -outside / rate);
    else if (rate < 0.0)
      span.enter = std::max(span.enter, -outside / rate);
    else if (outside > 0.0)
      return {1.0, 0.0};
    if (span.enter > span.leave) return span;
  }
  return span;
}

// The same of a box that is `half` larger to all sides.
Span timesInBox(const Box& box, const dvec3& half, const dvec3& p, const dvec3& v, double from, double to) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis] - half[axis] - p[axis], high = box.high[axis] + half[axis] - p[axis];
    if (v[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return {1.0, 0.0};
      continue;
    }
    const double a = low / v[axis], b = high / v[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
    if (from > to) return {1.0, 0.0};
  }
  return {from, to};
}

bool meetsBox(const Box& box, const dvec3& half, const dvec3& p, const dvec3& v, double from, double to) {
  const Span span = timesInBox(box, half, p, v, from, to);
  return span.enter <= span.leave;
}

bool meetsSphere(const dvec3& to_centre, const dvec3& v, double from, double to, double radius) {
  const double speed_sq = glm::dot(v, v);
  const double nearest = speed_sq > 0.0 ? std::clamp(glm::dot(to_centre, v) / speed_sq, from, to) : from;
  const dvec3 miss = to_centre - v * nearest;
  return glm::dot(miss, miss) <= radius * radius;
}

// When a point that moves by `v` is within a sphere, of [0, until].
Span timesInSphere(const dvec3& to_centre, const dvec3& v, double until, double radius) {
  const double a = glm::dot(v, v), b = glm::dot(to_centre, v),
               c = glm::dot(to_centre, to_centre) - radius * radius;
  if (a <= 0.0) return c <= 0.0 ? Span{0.0, until} : Span{1.0, 0.0};
  const double under = b * b - a * c;
  if (!(under >= 0.0)) return {1.0, 0.0};  // nor when it is no number
  const double half = std::sqrt(under);
  return {std::max(0.0, (b - half) / a), std::min(until, (b + half) / a)};
}

// A straight path as one piece.
PathPiece wholeOf(const ClassPath& path) {
  const PathPiece& came = path.pieces[path.count - 1];
  return {came.from_s, path.pieces[0].to_s, came.from_m, path.pieces[0].velocity_mps};
}

// A turning body sees a straight path bent: by 2 w x v + w x (w x r) per s2 (Coriolis and the centrifuge).
// Chords of so many seconds stay within half a millimetre of it (the sagitta is a t^2 / 8).
double chord_s(double turn_radps, double speed_mps, double radius_m) {
  constexpr double kSagitta_m = 0.5e-3;
  const double bend_mps2 = turn_radps * (2.0 * speed_mps + turn_radps * radius_m);
  return std::sqrt(8.0 * kSagitta_m / bend_mps2);
}

}  // namespace

std::string Shelter::set(uint32_t id, const VolumeInfo& info) {
  Convex shape;
  if (auto wrong = makeConvex(info, shape); !wrong.empty()) return wrong;
  volumes_[id] = std::make_shared<Volume>(Volume{id, info.vehicle, info.active, std::move(shape)});
  changed_ = true;
  return {};
}

bool Shelter::remove(uint32_t id) {
  const bool was = volumes_.erase(id) > 0;
  changed_ = changed_ || was;
  return was;
}

void Shelter::removeVehicle(uint32_t vehicle) {
  changed_ = std::erase_if(volumes_,
                           [&](const auto& v) { return v.second->vehicle == vehicle && vehicle != 0; }) > 0 ||
             changed_;
  bodies_.erase(vehicle);
}

void Shelter::shift(const dvec3& shift_m) {
  for (auto& [id, volume] : volumes_) {
    if (volume->vehicle != 0) continue;
    for (Plane& plane : volume->shape.planes) plane.d -= glm::dot(plane.normal, shift_m);
    volume->shape.box.low -= shift_m;
    volume->shape.box.high -= shift_m;
    volume->shape.centre -= shift_m;
  }
  for (auto& [id, body] : bodies_) body.path.shift(shift_m);
  for (Node& node : nodes_) {
    node.box.low -= shift_m;
    node.box.high -= shift_m;
  }
}

void Shelter::rebuild() {
  list_.clear();
  nodes_.clear();
  for (auto& [id, body] : bodies_) body.volumes.clear();
  for (const auto& [id, volume] : volumes_) {
    if (volume->active && volume->vehicle == 0) list_.push_back(volume);
  }
  statics_ = static_cast<uint32_t>(list_.size());
  if (statics_ > 0) {
    nodes_.reserve(2 * statics_);
    nodes_.emplace_back();
    split(0, 0, statics_);
  }
  for (const auto& [id, volume] : volumes_) {
    if (!volume->active || volume->vehicle == 0) continue;
    bodies_[volume->vehicle].volumes.push_back(static_cast<uint32_t>(list_.size()));
    list_.push_back(volume);
  }
  for (auto& [id, body] : bodies_) {
    body.radius_m = 0.0;
    if (!body.volumes.empty()) body.box = list_[body.volumes.front()]->shape.box;
    for (const uint32_t i : body.volumes) {
      const Convex& shape = list_[i]->shape;
      body.radius_m = std::max(body.radius_m, glm::length(shape.centre) + shape.radius_m);
      body.box = {glm::min(body.box.low, shape.box.low), glm::max(body.box.high, shape.box.high)};
    }
  }
  met_.reserve(list_.size());
  meetings_.reserve(bodies_.size() * (ClassPath::kMost + BodyPath::kMost));
  stack_.reserve(nodes_.size() + 1);
  size_t planes = 0;
  for (const auto& volume : list_) planes += volume->shape.planes.size();
  gates_.reserve(list_.size());
  gate_planes_.reserve(planes);
}

// Halves by number along the longest side of the middles' box.
void Shelter::split(uint32_t node, uint32_t first, uint32_t count) {
  Box box = list_[first]->shape.box, middles{list_[first]->shape.centre, list_[first]->shape.centre};
  for (uint32_t i = first; i < first + count; ++i) {
    const Convex& shape = list_[i]->shape;
    box = {glm::min(box.low, shape.box.low), glm::max(box.high, shape.box.high)};
    middles = {glm::min(middles.low, shape.centre), glm::max(middles.high, shape.centre)};
  }
  nodes_[node] = {box, first, count};
  if (count <= kLeaf) return;
  const dvec3 size = middles.high - middles.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = list_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const auto& a, const auto& b) {
    return a->shape.centre[axis] != b->shape.centre[axis] ? a->shape.centre[axis] < b->shape.centre[axis]
                                                          : a->id < b->id;
  });
  const uint32_t left = static_cast<uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = left;
  nodes_[node].count = 0;
  split(left, first, count / 2);
  split(left + 1, first + count / 2, count - count / 2);
}

Shelter::Changes Shelter::advance(double time_s, std::span<const VehicleState> vehicles) {
  Changes changes;
  changes.volumes = changed_;
  if (changed_) rebuild();
  changed_ = false;
  for (auto& [id, body] : bodies_) {
    const auto told = std::find_if(vehicles.begin(), vehicles.end(),
                                   [wanted = id](const VehicleState& v) { return v.id == wanted; });
    Pose pose = body.path.pose();
    if (told != vehicles.end())
      pose = told->pose;
    else
      pose.velocity_mps = pose.angular_velocity_radps = dvec3(0.0);  // not listed: it stands still
    if (!body.known) {
      if (told == vehicles.end()) continue;
      body.path.start(time_s, pose);
      body.known = true;
      changes.bodies = true;
    } else if (body.path.advance(time_s, pose, body.radius_m,
                                 told != vehicles.end() && told->discontinuity)) {
      changes.bodies = changes.bodies || !body.volumes.empty();
    }
  }
  return changes;
}

void Shelter::restart() {
  for (auto& [id, body] : bodies_) body.known = false;
}

void Shelter::gatherStatic(const dvec3& middle, const dvec3& half, const PathPiece& piece) {
  const dvec3 from = middle + piece.from_m - piece.velocity_mps * piece.from_s;
  stack_.clear();
  stack_.push_back(0);
  while (!stack_.empty()) {
    const Node& node = nodes_[stack_.back()];
    stack_.pop_back();
    if (!meetsBox(node.box, half, from, piece.velocity_mps, piece.from_s, piece.to_s)) continue;
    if (node.count == 0) {
      stack_.push_back(node.first);
      stack_.push_back(node.first + 1);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (!meetsBox(list_[i]->shape.box, half, from, piece.velocity_mps, piece.from_s, piece.to_s)) continue;
      if (std::find(met_.begin(), met_.end(), i) == met_.end()) met_.push_back(i);
    }
  }
}

void Shelter::gatherBodies(const dvec3& middle, double radius, const ClassPath& path, double now_s,
                           bool past) {
  for (uint32_t k = 0; k < (past ? path.count : 1u); ++k) {
    for (const auto& [id, body] : bodies_) {
      if (body.known && !body.volumes.empty()) gatherBody(body, middle, radius, path.pieces[k], k, now_s);
    }
  }
}

void Shelter::gatherBody(const Body& body, const dvec3& middle, double radius, const PathPiece& piece,
                         uint32_t number, double now_s) {
  double until = now_s + std::min(piece.to_s, BodyPath::kAhead_s);
  const double earliest = now_s + std::max(piece.from_s, -BodyPath::kBehind_s);
  for (uint32_t age = 0; age < body.path.pieces() && until > earliest; ++age) {
    const BodyPath::Piece& motion = body.path.piece(age);
    const double from = std::max(earliest, motion.from_s), to = until;
    until = std::min(until, motion.from_s);
    if (from >= to) continue;
    const dvec3 v = piece.velocity_mps - motion.pose.velocity_mps;
    const dvec3 there = motion.pose.position_m + motion.pose.velocity_mps * (from - motion.from_s);
    const dvec3 here = middle + piece.from_m + piece.velocity_mps * (from - now_s - piece.from_s);
    if (meetsSphere(there - here, v, 0.0, to - from, body.radius_m + radius))
      meetings_.push_back({&body, &motion, number, from, to, glm::conjugate(motion.pose.orientation) * v});
  }
}

// So many of the path's pieces may lie as low as a static volume. Most of a way that a turning wind bent
// into many pieces lies above all roofs.
uint32_t Shelter::lowPieces(const dvec3& middle, const dvec3& half, const ClassPath& path) const {
  if (!path.falls) return path.count;
  const double above_all_m = nodes_[0].box.high.z + half.z;
  for (uint32_t k = 1; k < path.count; ++k) {
    const PathPiece& piece = path.pieces[k];
    const double lowest_m = middle.z + piece.from_m.z + piece.velocity_mps.z * (piece.to_s - piece.from_s);
    if (lowest_m > above_all_m) return k;
  }
  return path.count;
}

// What is the same for all drops of a cell: from which side, and how fast, they pass a volume's planes.
void Shelter::prepareGates(const dvec3& velocity) {
  gates_.clear();
  gate_planes_.clear();
  for (const uint32_t i : met_) {
    Gate gate;
    const auto add = [&](auto&& is_wanted) {
      for (const Plane& plane : list_[i]->shape.planes) {
        const double rate = glm::dot(plane.normal, velocity);
        if (is_wanted(rate)) gate_planes_.push_back({plane.normal, plane.d, rate == 0.0 ? 0.0 : 1.0 / rate});
      }
      return static_cast<uint32_t>(gate_planes_.size());
    };
    gate.along = add([](double rate) { return rate == 0.0; });
    gate.inwards = add([](double rate) { return rate < 0.0; });
    gate.outwards = add([](double rate) { return rate > 0.0; });
    gates_.push_back(gate);
  }
}

bool Shelter::lookAround(const dvec3& middle, const dvec3& half, const ClassPath& path, double now_s,
                         bool past) {
  met_.clear();
  meetings_.clear();
  if (list_.empty()) return false;
  low_pieces_ = nodes_.empty() ? 0 : past ? lowPieces(middle, half, path) : 1;
  if (low_pieces_ > 1 && path.straight) {
    gatherStatic(middle, half, wholeOf(path));
    prepareGates(path.pieces[0].velocity_mps);
  } else {
    for (uint32_t k = 0; k < low_pieces_; ++k) gatherStatic(middle, half, path.pieces[k]);
  }
  gatherBodies(middle, glm::length(half), path, now_s, past);
  return !met_.empty() || !meetings_.empty();
}

// The first time of a meeting at which a drop, at `from_m` when it begins, is inside the body; kNever_s when
// it is not.
double Shelter::entryDuring(const Meeting& meeting, const dvec3& from_m, const dvec3& velocity) {
  const Body& body = *meeting.body;
  const Pose& pose = meeting.motion->pose;
  const double since_s = meeting.from_s - meeting.motion->from_s;
  const dvec3 to_centre = pose.position_m + pose.velocity_mps * since_s - from_m,
              past = velocity - pose.velocity_mps;
  const Span near = timesInSphere(to_centre, past, meeting.to_s - meeting.from_s, body.radius_m);
  if (near.enter > near.leave) return kNever_s;
  // Past a body that does not turn the way is straight; what it does turn moves no place of it farther than
  // this. Most of those that come near a car pass it by.
  const double turn = glm::length(pose.angular_velocity_radps),
               turned_m = turn * (since_s + near.leave) * body.radius_m;
  const Span close =
      timesInBox(body.box, 2.0 * kRounding_m + turned_m, glm::conjugate(pose.orientation) * -to_centre,
                 meeting.past_mps, near.enter, near.leave);
  if (close.enter > close.leave) return kNever_s;
  const auto inBody = [&](double t) {
    return intoBody(movedOn(pose, t - meeting.motion->from_s), from_m + velocity * (t - meeting.from_s));
  };
  const double end = meeting.from_s + near.leave,
               step = std::max(chord_s(turn, glm::length(past), body.radius_m), kLeastChord_s);
  double begin = meeting.from_s + near.enter;
  while (begin + step < meeting.from_s + close.enter) begin += step;
  dvec3 a = inBody(begin);
  while (begin < end && begin <= meeting.from_s + close.leave) {
    const double next = std::min(begin + step, end);
    const dvec3 b = inBody(next), v = (b - a) / (next - begin);
    double first = kNever_s;
    const bool meets = meetsBox(body.box, kRounding_m, a, v, 0.0, next - begin);
    for (const uint32_t i : meets ? std::span<const uint32_t>(body.volumes) : std::span<const uint32_t>()) {
      ++tests_;
      const Span span = timesInside(list_[i]->shape.planes, a, v, 0.0, next - begin);
      if (span.enter <= span.leave) first = std::min(first, begin + span.enter);
    }
    if (first < kNever_s) return first;
    begin = next;
    a = b;
  }
  return kNever_s;
}

// The first time at which the drop is inside the body that a run of meetings is with, all in one piece of the
// path, relative to now; kNever_s when it is not. Goes on to the next run.
double Shelter::entryOfBody(Meetings& at, const dvec3& place, const ClassPath& path, double now_s) {
  double first = kNever_s;
  const Meeting begin = *at;
  const PathPiece& piece = path.pieces[begin.piece];
  for (; at != meetings_.end() && at->body == begin.body && at->piece == begin.piece; ++at) {
    const dvec3 from_m = place + piece.from_m + piece.velocity_mps * (at->from_s - now_s - piece.from_s);
    first = std::min(first, entryDuring(*at, from_m, piece.velocity_mps) - now_s);
  }
  return first;
}

bool Shelter::cameThrough(const dvec3& place, const ClassPath& path, double now_s) {
  Meetings at = meetings_.begin();
  while (at != meetings_.end() && at->piece == 0) ++at;
  for (uint32_t k = 1; k < path.count; ++k) {
    const PathPiece& piece = path.pieces[k];
    const dvec3 from = place + piece.from_m - piece.velocity_mps * piece.from_s;
    for (const uint32_t i : met_) {
      if (k >= low_pieces_) break;
      ++tests_;
      const Span span =
          timesInside(list_[i]->shape.planes, from, piece.velocity_mps, piece.from_s, piece.to_s);
      if (span.enter <= span.leave) return true;
    }
    while (at != meetings_.end() && at->piece == k) {
      if (entryOfBody(at, place, path, now_s) < kNever_s) return true;
    }
  }
  return false;
}

// On a straight path a drop is inside a volume once at most: before now, or to come.
Passage Shelter::passage(const dvec3& place, const ClassPath& path, double now_s) {
  if (!path.straight || !meetings_.empty() || low_pieces_ <= 1)
    return {cameThrough(place, path, now_s), willEnter(place, path, now_s)};
  const PathPiece whole = wholeOf(path);
  Passage passage;
  const GatePlane* plane = gate_planes_.data();
  for (const Gate& gate : gates_) {
    ++tests_;
    double farthest_out = -1.0, enter = whole.from_s, leave = whole.to_s;
    const auto outside = [&] { return glm::dot(plane->normal, place) - plane->d; };
    for (const GatePlane* end = &gate_planes_[0] + gate.along; plane != end; ++plane)
      farthest_out = std::max(farthest_out, outside());
    for (const GatePlane* end = &gate_planes_[0] + gate.inwards; plane != end; ++plane)
      enter = std::max(enter, -outside() * plane->per_rate_s);
    for (const GatePlane* end = &gate_planes_[0] + gate.outwards; plane != end; ++plane)
      leave = std::min(leave, -outside() * plane->per_rate_s);
    if (farthest_out > 0.0 || enter > leave) continue;
    passage.came_through = passage.came_through || enter <= 0.0;
    if (leave >= 0.0) passage.enters_s = std::min(passage.enters_s, std::max(enter, 0.0));
  }
  return passage;
}

double Shelter::willEnter(const dvec3& place, const ClassPath& path, double now_s) {
  const PathPiece& piece = path.pieces[0];
  double first = kNever_s;
  for (const uint32_t i : met_) {
    ++tests_;
    const Span span = timesInside(list_[i]->shape.planes, place, piece.velocity_mps, 0.0, piece.to_s);
    if (span.enter <= span.leave) first = std::min(first, span.enter);
  }
  for (Meetings at = meetings_.begin(); at != meetings_.end() && at->piece == 0;)
    first = std::min(first, entryOfBody(at, place, path, now_s));
  return first;
}

bool Shelter::openToSky(const dvec3& place, const dvec3& velocity, uint32_t without) {
  const double speed = glm::length(velocity);
  if (list_.empty() || speed <= 0.0) return true;
  const double past_s = kPath_m / speed;
  met_.clear();
  if (!nodes_.empty()) gatherStatic(place, dvec3(0.0), {-past_s, 0.0, -velocity * past_s, velocity});
  const auto meets = [&](const Convex& shape, const dvec3& from, const dvec3& v) {
    ++tests_;
    const Span span = timesInside(shape.planes, from, v, 0.0, past_s);
    return span.enter <= span.leave;
  };
  if (std::any_of(met_.begin(), met_.end(),
                  [&](uint32_t i) { return meets(list_[i]->shape, place, -velocity); }))
    return false;
  for (const auto& [id, body] : bodies_) {
    if (id == without || !body.known) continue;
    const dvec3 from = intoBody(body.path.pose(), place);
    const dvec3 v = (intoBody(body.path.pose(), place - velocity) - from);
    if (std::any_of(body.volumes.begin(), body.volumes.end(),
                    [&](uint32_t i) { return meets(list_[i]->shape, from, v); }))
      return false;
  }
  return true;
}

bool Shelter::surfaceAt(const dvec3& place, double ago_s, double within, Surface& out) {
  if (list_.empty()) return false;
  bool found = false;
  const auto consider = [&](const Convex& shape, const Pose& pose) {
    const dvec3 local = intoBody(pose, place);
    double outside = -1e30;
    const Plane* face = &shape.planes.front();
    for (const Plane& plane : shape.planes) {
      const double d = glm::dot(plane.normal, local) - plane.d;
      if (d > outside) outside = d, face = &plane;
    }
    if (std::abs(outside) > within || (found && std::abs(outside) >= std::abs(out.outside_m))) return;
    found = true;
    out = {pose.orientation * face->normal,
           pose.velocity_mps + glm::cross(pose.angular_velocity_radps, place - pose.position_m), outside};
  };
  met_.clear();
  if (!nodes_.empty()) gatherStatic(place, dvec3(within), {});
  for (const uint32_t i : met_) consider(list_[i]->shape, Pose{});
  for (const auto& [id, body] : bodies_) {
    if (!body.known) continue;
    const Pose pose = movedOn(body.path.pose(), -ago_s);
    for (const uint32_t i : body.volumes) consider(list_[i]->shape, pose);
  }
  return found;
}

}  // namespace rg::rain
