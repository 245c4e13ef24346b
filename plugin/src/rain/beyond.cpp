#include "rain/beyond.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rain/class_frames.h"
#include "rain/size_law.h"

namespace rg::rain {
namespace {

using glm::dvec3, glm::vec4;

// The distance of the rain a layer stands for (unsourced), and the pattern round the axis, so often that it
// is 2.4 m wide there: what is a streak near by is ever finer with distance, and an even haze where a pixel
// holds many.
constexpr std::array<double, 3> kDistance_m{9.0, 25.0, 62.0};
constexpr std::array<double, 3> kRepeats{24.0, 67.0, 165.0};
constexpr double kPlainStreak_m = 0.11;  // the pattern's streaks as they are: 6.5 m/s for 1/60 s
constexpr double kLongest = 4.0;         // and drawn out so many times at most

dvec3 passing(const dvec3& drop_mps, const ViewState& view) { return drop_mps - eyeVelocityOf(view); }

// How much longer than wide the pattern is drawn.
double stretchOf(const dvec3& passing_mps, const ViewState& view) {
  return std::clamp(glm::length(passing_mps) * exposureOf(view) / kPlainStreak_m, 1.0, kLongest);
}

vec4 wide(const dvec3& v) { return vec4(glm::vec3(v), 0.0f); }

void setUpRays(const Cone& cone, const ViewState& view, shared::RainBeyond& out) {
  const Rays rays = raysOf(cone, view);
  out.ray_middle = wide(rays.middle);
  out.ray_right = wide(rays.right);
  out.ray_up = wide(rays.up);
}

void setUpAxis(const dvec3& passing_mps, shared::RainBeyond& out) {
  const double speed = glm::length(passing_mps);
  const dvec3 axis = speed > 1e-3 ? -passing_mps / speed : dvec3(0, 0, 1);
  // The map's seam runs along world y where it can: no view looks along both.
  const dvec3 beside = std::abs(axis.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 side = glm::normalize(glm::cross(beside, axis));
  out.axis = wide(axis);
  out.axis_side = wide(side);
  out.axis_up = wide(glm::cross(axis, side));
}

}  // namespace

void Beyond::tick(const Tick& tick, const WindProfile& profile) {
  time_ns_ = tick.time_ns;
  rate_mm_h_ = tick.weather.rain_mm_h;
  const double fall_mps = SizeLaw::of(std::max(rate_mm_h_, 0.1)).meanSpeedSeen_mps();
  const dvec3 wind_mps = profile.dropShare(fall_mps) * usableWind(tick);
  drop_velocity_mps_ = wind_mps - dvec3(0, 0, fall_mps);
  before_.swap(views_);
  views_.clear();
  cones_.clear();
  for (const ViewState& view : tick.views) {
    const auto known = std::ranges::find(before_, view.id, &BeyondPicture::View::id);
    const dvec3 passing_mps = passing(drop_velocity_mps_, view);
    const double streamed_m = glm::length(passing_mps) / stretchOf(passing_mps, view) * kTickSeconds;
    views_.push_back({view.id, (known != before_.end() ? known->streamed_m : 0.0) + streamed_m});
    cones_.push_back(coneOf(view));
  }
}

void Beyond::reset() { *this = Beyond(); }

void Beyond::rebase(const dvec3& shift_m) {
  for (Cone& cone : cones_) cone.eye_m -= shift_m;
}

void Beyond::describe(double reach_per_diameter, BeyondPicture& picture) const {
  picture.time_ns = time_ns_;
  picture.rate_mm_h = rate_mm_h_;
  picture.drop_velocity_mps = drop_velocity_mps_;
  picture.reach_per_diameter = reach_per_diameter;
  picture.views = views_;
}

ParticlesShare particlesShare(double rate_mm_h, double reach_per_diameter) {
  const SizeLaw law = SizeLaw::of(rate_mm_h);
  const double cover_per_m = law.cover_per_m();
  if (!(cover_per_m > 0.0)) return {};
  return {cover_per_m, 1.2 * reach_per_diameter * 1e-6 * law.water_g_m3() / cover_per_m};
}

bool setUpBeyond(const BeyondPicture& picture, const ViewState& view, int64_t time_ns, const BeyondLook& look,
                 double gain, double pattern_mean, double pattern_greatest, shared::RainBeyond& out) {
  const Cone cone = coneOf(view);
  const double extinction_per_m = rain::extinction_per_m(picture.rate_mm_h);
  if (!(extinction_per_m > 0.0) || !(look.share > 0.0) || !cone.valid) return false;
  setUpRays(cone, view, out);
  const dvec3 passing_mps = passing(picture.drop_velocity_mps, view);
  setUpAxis(passing_mps, out);
  const ParticlesShare particles = particlesShare(picture.rate_mm_h, picture.reach_per_diameter);
  out.extinction = vec4(extinction_per_m, std::min(gain * particles.at_eye_per_m, extinction_per_m),
                        particles.mean_m, look.share);
  out.bias = vec4(look.bias);

  const double stretch = stretchOf(passing_mps, view);
  const auto known = std::ranges::find(picture.views, view.id, &BeyondPicture::View::id);
  const double after_s = static_cast<double>(time_ns - picture.time_ns) * 1e-9;
  const double streamed_m =
      (known != picture.views.end() ? known->streamed_m : 0.0) + glm::length(passing_mps) / stretch * after_s;
  constexpr std::array<double, 4> kEnds_m{0.0, shared::kRainNearEnd_m, shared::kRainMiddleEnd_m,
                                          shared::kRainFarEnd_m};
  for (size_t i = 0; i < kRepeats.size(); ++i) {
    const auto layer = static_cast<glm::length_t>(i);
    const double opaque =
        1.0 - std::exp(-extinction_per_m * look.bias[layer] * (kEnds_m[i + 1] - kEnds_m[i]));
    const double most =
        (1.0 / std::max(opaque, 1e-9) - 1.0) / std::max(pattern_greatest / pattern_mean - 1.0, 1e-9);
    out.contrast[layer] = static_cast<float>(std::min(look.contrast[layer], most));
    out.repeats[layer] = static_cast<float>(kRepeats[i]);
    const double turns = streamed_m / kDistance_m[i] * kRepeats[i] / (2.0 * glm::pi<double>());
    out.scroll[layer] = static_cast<float>(std::floor(turns) - turns);
  }
  out.contrast.w = static_cast<float>(pattern_mean);
  out.repeats.w = static_cast<float>(stretch);
  return true;
}

}  // namespace rg::rain
