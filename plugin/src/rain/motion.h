// Motions as they were and as they are expected to go on: pieces of constant velocity, the last one reaching
// into the future. A piece ends when what really happens departs from it by a centimetre.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "saved/inputs.h"
#include "tick.h"

namespace rg::rain {

inline constexpr double kDeparture_m = 0.01;

// The last N pieces, newest at index 0.
template <class T, uint32_t N>
class Recent {
 public:
  void add(const T& value) {
    newest_ = (newest_ + N - 1) % N;
    values_[newest_] = value;
    if (count_ < N) ++count_;
  }
  void clear() { count_ = 0; }
  uint32_t size() const { return count_; }
  T& operator[](uint32_t age) { return values_[(newest_ + age) % N]; }
  const T& operator[](uint32_t age) const { return values_[(newest_ + age) % N]; }

  template <class Archive>
  static void visit(Archive& a, auto& recent) {
    uint32_t count = recent.count_;
    a.within(count, 0u, N);
    if constexpr (Archive::kReads) {
      recent.clear();
      for (uint32_t i = 0; i < count; ++i) {
        T value;
        a(value);
        recent.add(value);
      }
    } else {
      for (uint32_t age = count; age-- > 0;) a(recent[age]);
    }
  }

 private:
  std::array<T, N> values_{};
  uint32_t newest_ = 0, count_ = 0;
};

// How far the air has carried what floats in it, since the field's start.
class WindPath {
 public:
  struct Piece {
    double from_s = 0.0;
    glm::dvec3 carried_m{0.0};  // at from_s
    glm::dvec3 wind_mps{0.0};
    static void visit(auto& a, auto& piece) { a(piece.from_s, piece.carried_m, piece.wind_mps); }
  };
  // The way so far as few straight stretches, newest first; each from `from_s` to where the one before it
  // began. They leave the way by what a prediction may, 1 cm, and by 4 cm more for each second back. The
  // oldest goes on without end.
  struct Past {
    static constexpr uint32_t kMost = 31;
    std::array<Piece, kMost> stretches;
    uint32_t count = 0;
  };
  void start(double time_s, const glm::dvec3& carried_m, const glm::dvec3& wind_mps);
  // Takes the wind to `time_s`, linear in between. True when a new piece had to begin: ends told from the old
  // one are no longer right.
  bool advance(double time_s, const glm::dvec3& wind_mps);

  const glm::dvec3& carried_m() const { return carried_m_; }
  const glm::dvec3& wind_mps() const { return wind_mps_; }
  void trace(Past& past) const;

  static void visit(auto& a, auto& path) {
    a(path.pieces_);
    a.within(path.past_.count, 0u, Past::kMost - 1);  // trace() puts one before them
    for (uint32_t i = 0; i < path.past_.count; ++i) a(path.past_.stretches[i]);
    a(path.carried_m_, path.wind_mps_, path.time_s_);
  }

 private:
  void straighten();
  bool isStraight(double until_s, const glm::dvec3& until_m, uint32_t first, uint32_t to) const;

  Recent<Piece, 256> pieces_;
  Past past_;  // the way until the newest piece began
  glm::dvec3 carried_m_{0.0}, wind_mps_{0.0};
  double time_s_ = 0.0;
};

// `pose` taken on by `seconds` with its velocities held.
Pose movedOn(const Pose& pose, double seconds);
glm::dvec3 intoBody(const Pose& pose, const glm::dvec3& world_m);
glm::dvec3 outOfBody(const Pose& pose, const glm::dvec3& body_m);

// Where a body was in the last seconds and will be.
class BodyPath {
 public:
  struct Piece {
    double from_s = 0.0;
    Pose pose;  // at from_s
    static void visit(auto& a, auto& piece) { a(piece.from_s, piece.pose); }
  };
  static constexpr double kRenewed_s = 1.5;  // a prediction is taken afresh at least that often
  static constexpr double kAhead_s = 3.0;    // and looked ahead so far
  static constexpr double kBehind_s = 3.0;   // drops that met the body earlier have reached the ground: 2 s
                                             // from a lorry's roof for the slowest
  static constexpr uint32_t kMost = 128;     // pieces

  void start(double time_s, const Pose& pose);
  // As WindPath::advance; `radius_m`: how far from its origin the body reaches. `jumped`: the body was put
  // where it is.
  bool advance(double time_s, const Pose& pose, double radius_m, bool jumped);

  const Pose& pose() const { return pose_; }  // as last told
  uint32_t pieces() const { return pieces_.size(); }
  const Piece& piece(uint32_t age) const { return pieces_[age]; }
  void shift(const glm::dvec3& shift_m);

  static void visit(auto& a, auto& path) { a(path.pieces_, path.pose_); }

 private:
  Recent<Piece, kMost> pieces_;
  Pose pose_;
};

}  // namespace rg::rain
