// How the standing frames of the classes move: they fall, and go with the wind as far as their drops do.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "rain/motion.h"
#include "rain/shelter.h"
#include "rain/wind_profile.h"
#include "tick.h"

namespace rg::rain {

// The tick's wind as far as it can be used: a number, within what the ABI takes.
glm::dvec3 usableWind(const Tick& tick);

class ClassFrames {
 public:
  // Anew: at time 0, with the corner of each cell (0, 0, 0) in one place.
  void start(const glm::dvec3& origin_m, const glm::dvec3& wind_mps);
  // To another time, earlier or later, as if today's wind had blown all the while. Then resume().
  void jump(double time_s);
  void resume(const glm::dvec3& wind_mps);
  // As WindPath::advance.
  bool advance(double time_s, const glm::dvec3& wind_mps);

  // Frames stay where they are and go on by it. The winds that were count as if it had been in force then,
  // for the seconds until drops that knew the old one are down. True when it is another one than before.
  bool setProfile(const WindProfile& profile);
  void shift(const glm::dvec3& shift_m);

  // World position of the corner of cell (0, 0, 0).
  const glm::dvec3& origin(uint32_t kind) const { return origins_m_[kind]; }
  const glm::dvec3& velocity(uint32_t kind) const { return velocities_mps_[kind]; }
  // The way of a class's drops: to come at today's wind, and back along the winds that were. Valid until the
  // frames go on.
  const ClassPath& path(uint32_t kind);

  template <class Archive>
  static void visit(Archive& a, auto& frames) {
    a(frames.wind_, frames.profile_, frames.time_s_, frames.origin_m_, frames.moved_m_);
    if constexpr (Archive::kReads) frames.moveClasses();
  }

 private:
  void findPath(uint32_t kind, ClassPath& path) const;
  void moveClasses();

  WindPath wind_;  // of the stated wind; a class has its share
  WindProfile profile_;
  double time_s_ = 0.0;
  glm::dvec3 origin_m_{0.0};                                         // of all, without wind and fall
  std::array<glm::dvec3, kClasses> moved_m_{};                       // by changes of the profile
  std::array<glm::dvec3, kClasses> origins_m_{}, velocities_mps_{};  // as things stand
  WindPath::Past past_;                                              // count 0: not asked for in this tick
  std::array<ClassPath, kClasses> paths_;                            // count 0: as well
};

}  // namespace rg::rain
