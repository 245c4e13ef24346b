#include "surroundings/splashes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "rain/class_frames.h"
#include "rain/motion.h"
#include "rain/size_law.h"

namespace rg::surroundings {
namespace {

using glm::dvec2, glm::dvec3, glm::vec4;
using shared::kSplashEpoch_s, shared::kSplashLevels, shared::kSplashSizes, shared::kSplashSorts;

constexpr int64_t kEpoch_ns = 15'625'000;
constexpr double kEpoch_s = static_cast<double>(kSplashEpoch_s);
static_assert(static_cast<double>(kEpoch_ns) == kEpoch_s * 1e9);
// Cells of the finest level, by sort about as far as its drops' splashes are drawn at 50 mm/h; twice that of
// the next level. The same at every rate, as what a cell is made of would jump with it.
constexpr std::array<double, kSplashSorts> kCell_m = {0.8, 1.1, 1.6, 2.2};

// Where the host tells no ground it is looked for as far below the eye as a driver's is above it.
constexpr double kEyeOverGround_m = 1.3;
// About the ground: how deep it may fall and how high surfaces that are looked down on may stand (a car's
// roof), by eye; and where it was only guessed.
constexpr dvec2 kSearch_m{-1.2, 1.8}, kWideSearch_m{-3.0, 1.0};
// A vehicle's own surfaces: a bonnet lies so high over the ground, and within this of the driver's eye.
constexpr double kBonnet_m = 0.9, kVehicle_m = 4.0;
constexpr dvec2 kBonnetSearch_m{-0.4, 0.4};
constexpr double kFarthestCell = 1e9;  // where cells can still be told apart
using Cell = glm::vec<2, int64_t>;     // of a layer
// As far aside lines are looked for that slant into view, which keeps storms cheap.
constexpr double kMostAside_m = 5.0;

vec4 wide(const dvec3& v) { return vec4(glm::vec3(v), 0.0f); }

double diameterBelow(const rain::SizeLaw& law, double flux) {
  double low = static_cast<double>(shared::kSplashFrom_mm), high = rain::kLargest_mm;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (law.flux(static_cast<double>(shared::kSplashFrom_mm), middle) < flux ? low : high) = middle;
  }
  return low;
}

// The diameters below which k / kSplashSizes of the drops lie. Between two of them sizes are taken as evenly
// spread; the last stands where that makes the mean of the largest right.
void findSizes(const rain::SizeLaw& law, double flux, std::array<float, kSplashSizes + 1>& out) {
  for (uint32_t k = 0; k < kSplashSizes; ++k)
    out[k] = static_cast<float>(diameterBelow(law, flux * k / kSplashSizes));
  constexpr int kSteps = 100;
  const auto from_mm = static_cast<double>(out[kSplashSizes - 1]);
  const double step_mm = (rain::kLargest_mm - from_mm) / kSteps;
  double sum = 0.0, number = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double at_mm = from_mm + i * step_mm, share = law.flux(at_mm, at_mm + step_mm);
    sum += share * (at_mm + 0.5 * step_mm);
    number += share;
  }
  out[kSplashSizes] = static_cast<float>(number > 0.0 ? 2.0 * sum / number - from_mm : from_mm);
}

// All drops of a sort and of a level's ranks.
struct Layer {
  double flux_per_m2s = 0.0;
  double cell_m = 0.0;
  double reach_m = 0.0;    // beyond it none of their splashes is drawn,
  double longest_s = 0.0;  // and none lasts longer
};

Layer layerOf(const SplashPicture& picture, uint32_t level, uint32_t sort, double most_m) {
  const glm::vec2 ranks = shared::splashRanks(level), share = shared::splashSort(sort);
  const float largest_m = 1e-3f * picture.sizes_mm[static_cast<size_t>(std::lround(share.y * kSplashSizes))];
  return {
      .flux_per_m2s = picture.flux_per_m2s * static_cast<double>((ranks.y - ranks.x) * (share.y - share.x)),
      .cell_m = kCell_m[sort] * std::exp2(level),
      .reach_m = std::min(most_m, static_cast<double>(shared::splashReach_m(level, largest_m))),
      .longest_s = static_cast<double>(shared::splashLife_s(largest_m))};
}

// As told by the rain alone, and in proportion to it: what a view's own number says would change from one
// picture to the next, and from a view to its neighbour.
double keptOf(const SplashPicture& picture, double most_m) {
  double expected = 0.0;
  for (uint32_t sort = 0; sort < kSplashSorts; ++sort) {
    for (uint32_t level = 0; level < kSplashLevels; ++level) {
      const Layer layer = layerOf(picture, level, sort, most_m);
      const double reach_m = layer.reach_m, cell_m = layer.cell_m;
      // Of all cells that a circle touches, wherever it lies on them (Steiner's formula).
      const double area_m2 = (glm::pi<double>() * reach_m + 4.0 * cell_m) * reach_m + cell_m * cell_m;
      expected += layer.flux_per_m2s * area_m2 * (layer.longest_s + kEpoch_s);
    }
  }
  return std::min(1.0, kMostSplashes / expected);
}

// A lattice as a view meets it.
struct Lattice {
  uint32_t number = 0, name = 0;
  dvec3 origin_m{0.0};  // at the picture's time
  dvec3 velocity_mps{0.0}, drift_mps{0.0};
  double reference_m = 0.0;  // world z
  double ground_m = 0.0;     // above that
  dvec2 search_m{0.0};
  double reach_m = 0.0;
  double own_m = 0.0;  // so near to the eye what stands above the ground is the vehicle's
};

// Cells of all levels and sorts whose lines may meet something in view.
class Cells {
 public:
  Cells(const SplashPicture& picture, const rain::Cone& cone, int64_t time_ns, SplashSetup& out)
      : picture_(picture), cone_(cone), time_ns_(time_ns), out_(out) {}

  void add(const Lattice& lattice) {
    slant_ = slantOf(lattice, static_cast<double>(shared::kSplashFrom_mm));
    least_slant_ = slantOf(lattice, rain::kLargest_mm);
    for (uint32_t sort = 0; sort < kSplashSorts; ++sort) {
      for (uint32_t level = 0; level < kSplashLevels; ++level) addLevel(lattice, level, sort);
    }
  }

 private:
  // As far up or down from the reference lines are followed.
  static double highest_m(const Lattice& lattice) {
    return std::max(-lattice.search_m.x, lattice.search_m.y);
  }

  // Of drops of that size: metres aside for each up.
  static dvec2 slantOf(const Lattice& lattice, double diameter_mm) {
    const double falls_mps = rain::fallSpeed(diameter_mm) - lattice.drift_mps.z;
    const dvec2 slant =
        dvec2(lattice.drift_mps) / -std::max(falls_mps, static_cast<double>(shared::kSplashLeastFall_mps));
    const double aside_m = glm::length(slant) * highest_m(lattice);
    return slant * std::min(1.0, kMostAside_m / std::max(aside_m, 1e-9));
  }

  // Whether any of the lines of a cell may be in view between the heights searched: they lie within what its
  // square sweeps over along the slants of the fastest and of the slowest.
  bool isInView(const Lattice& lattice, const dvec3& corner_m, double cell_m) const {
    const dvec3 half(0.5 * cell_m, 0.5 * cell_m, 0.0);
    // What stands higher near by is the vehicle's, and has its own lattice.
    const double farthest_m =
        glm::length(glm::abs(corner_m + half) + half + dvec3(glm::abs(slant_), 1.0) * highest_m(lattice));
    const bool is_near = lattice.number == 0 && farthest_m < lattice.own_m;
    std::array<dvec3, 4> middles;
    for (size_t i = 0; i < 4; ++i) {
      const double height_m = i < 2     ? lattice.search_m.x
                              : is_near ? lattice.ground_m + static_cast<double>(shared::kSplashOnGround_m)
                                        : lattice.search_m.y;
      middles[i] = corner_m + half + dvec3((i % 2 == 0 ? least_slant_ : slant_) * height_m, height_m);
    }
    return std::ranges::all_of(cone_.inward, [&](const dvec3& n) {
      const double wide_m = glm::dot(glm::abs(n), half);
      return std::ranges::any_of(middles, [&](const dvec3& m) { return glm::dot(n, m) + wide_m > 0.0; });
    });
  }

  // How near to the eye, on the level, lines of a cell come that begins there.
  double nearest_m(const Lattice& lattice, const dvec2& corner_m, double cell_m) const {
    const dvec2 middle = corner_m + 0.5 * cell_m;
    const double along = -glm::dot(middle, slant_) / std::max(glm::dot(slant_, slant_), 1e-12);
    const dvec2 aside = slant_ * std::clamp(along, lattice.search_m.x, lattice.search_m.y);
    const dvec2 low = corner_m + aside;
    return glm::length(glm::clamp(dvec2(0.0), low, low + cell_m));
  }

  void addLevel(const Lattice& lattice, uint32_t level, uint32_t sort) {
    const Layer layer = layerOf(picture_, level, sort, lattice.reach_m);
    const double cell_m = layer.cell_m, reach_m = layer.reach_m;
    const double aside_m = glm::length(slant_) * highest_m(lattice);
    const SplashesInCells numbers(out_.kept * layer.flux_per_m2s * cell_m * cell_m * kEpoch_s);
    longest_s_ = layer.longest_s;
    const dvec2 eye = dvec2(cone_.eye_m - lattice.origin_m) / cell_m,
                reach = dvec2((reach_m + aside_m) / cell_m);
    if (!glm::all(glm::lessThan(glm::abs(eye), dvec2(kFarthestCell)))) return;
    const Cell first(glm::floor(eye - reach)), last(glm::floor(eye + reach));
    for (Cell cell = first; cell.y <= last.y; ++cell.y) {
      for (cell.x = first.x; cell.x <= last.x; ++cell.x) {
        const dvec3 corner_m(dvec2(cell) * cell_m + dvec2(lattice.origin_m - cone_.eye_m),
                             lattice.reference_m - cone_.eye_m.z);
        if (nearest_m(lattice, dvec2(corner_m), cell_m) > reach_m || !isInView(lattice, corner_m, cell_m))
          continue;
        addEpochs(level | lattice.number << 2u | sort << 3u | lattice.name << 5u, numbers, cell,
                  vec4(glm::vec3(corner_m), cell_m));
      }
    }
  }

  void addEpochs(uint32_t level, const SplashesInCells& numbers, const Cell& cell, const vec4& corner) {
    const int64_t epoch = time_ns_ / kEpoch_ns - (time_ns_ % kEpoch_ns < 0 ? 1 : 0);
    shared::SplashJob job;
    job.corner = corner;
    job.x = static_cast<uint32_t>(cell.x);
    job.y = static_cast<uint32_t>(cell.y);
    job.level = level;
    for (int64_t begun = epoch;; --begun) {
      job.epoch = static_cast<uint32_t>(begun);
      job.since_s = static_cast<float>(static_cast<double>(time_ns_ - begun * kEpoch_ns) * 1e-9);
      if (static_cast<double>(job.since_s) - longest_s_ >= kEpoch_s) return;  // all of those are over
      const uint32_t number = numbers.of(job.x, job.y, job.epoch, job.level);
      if (number == 0) continue;
      job.first = out_.count;
      out_.jobs.push_back(job);
      out_.count += number;
    }
  }

  const SplashPicture& picture_;
  const rain::Cone& cone_;
  int64_t time_ns_;
  SplashSetup& out_;
  dvec2 slant_{0.0}, least_slant_{0.0};  // of the slowest drops, and of the fastest
  double longest_s_ = 0.0;               // no splash of the sort lasts longer
};

void tell(const Lattice& lattice, shared::SplashRain& rain) {
  rain.moves[lattice.number] = wide(lattice.velocity_mps);
  rain.drift[lattice.number] = wide(lattice.drift_mps);
  rain.search[lattice.number] = vec4(lattice.search_m, lattice.ground_m, lattice.own_m);
}

// Spares the kernel most of its search for the job that a splash belongs to.
void tellStarts(SplashSetup& out) {
  out.starts.clear();
  size_t job = 0;
  for (uint32_t number = 0; number < out.count; number += shared::kSplashStride) {
    while (job + 1 < out.jobs.size() && out.jobs[job + 1].first <= number) ++job;
    out.starts.push_back(static_cast<uint32_t>(job));
  }
}

}  // namespace

void Splashes::tick(const Tick& tick, const rain::WindProfile& profile) {
  const double rate_mm_h = tick.weather.rain_mm_h, from_mm = static_cast<double>(shared::kSplashFrom_mm);
  SplashPicture& p = picture_;
  p.time_ns = tick.time_ns;
  // As the rain's: wherever a host has its origin, it sees the same splashes about its car.
  if (!std::exchange(started_, true) && !tick.vehicles.empty())
    p.origin_m = dvec3(dvec2(tick.vehicles.front().pose.position_m), 0.0);
  const rain::SizeLaw law = rain::SizeLaw::of(rate_mm_h);
  if (rate_mm_h != sized_for_mm_h_) {
    sized_for_mm_h_ = rate_mm_h;
    p.flux_per_m2s = law.flux(from_mm, rain::kLargest_mm);
    findSizes(law, p.flux_per_m2s, p.sizes_mm);
  }
  const double fall_mps = rain::fallSpeed(static_cast<double>(p.sizes_mm[kSplashSizes / 2]));
  p.drift_mps = profile.dropShare(fall_mps) * rain::usableWind(tick);
  p.vehicles.clear();
  p.eyes_m.clear();
  for (const ViewState& view : tick.views) {
    p.eyes_m.push_back(rain::coneOf(view).eye_m);
    const auto vehicle = std::ranges::find(tick.vehicles, view.vehicle, &VehicleState::id);
    if (view.vehicle != 0 && vehicle != tick.vehicles.end())
      p.vehicles.push_back({vehicle->id, vehicle->pose});
  }
  p.ground_known = std::isfinite(tick.weather.ground_height_m) && tick.weather.ground_height_m > kNoGround_m;
  if (p.ground_known)
    p.ground_m = tick.weather.ground_height_m;
  else if (!p.eyes_m.empty())
    p.ground_m = p.eyes_m.front().z - kEyeOverGround_m;
}

void Splashes::reset() { *this = Splashes(); }

void Splashes::rebase(const dvec3& shift_m) {
  picture_.origin_m -= shift_m;
  picture_.ground_m -= shift_m.z;
  for (auto& vehicle : picture_.vehicles) vehicle.pose.position_m -= shift_m;
  for (dvec3& eye : picture_.eyes_m) eye -= shift_m;
}

SplashesInCells::SplashesInCells(double mean) {
  constexpr double kRarest = 1e-8;  // half of what the hash can tell
  double share = std::exp(-mean);
  sums_.push_back(share);
  // Of so large a mean that the first share is 0 to a double, all cells hold the mean.
  while (sums_.back() < 1.0 - kRarest && (share > 0.0 || static_cast<double>(sums_.size()) < mean)) {
    share *= mean / static_cast<double>(sums_.size());
    sums_.push_back(sums_.back() + share);
  }
}

uint32_t SplashesInCells::of(uint32_t x, uint32_t y, uint32_t epoch, uint32_t level) const {
  const double u = static_cast<double>(shared::openUnitFloat(shared::pcg4d({x, y, epoch, ~level}).x));
  return static_cast<uint32_t>(std::ranges::lower_bound(sums_, u) - sums_.begin());
}

bool setUpSplashes(const SplashPicture& picture, const ViewState& view, int64_t time_ns,
                   const SplashLook& look, SplashSetup& out) {
  const rain::Cone cone = rain::coneOf(view);
  out.count = 0;
  out.jobs.clear();
  if (!(picture.flux_per_m2s > 0.0) || !(look.gain > 0.0) || !(look.reach_m > 0.0) || !cone.valid)
    return false;
  const double after_s = static_cast<double>(time_ns - picture.time_ns) * 1e-9;
  const double known_m = rain::setUpShelter(picture.volumes, cone.eye_m, after_s, out.shelter);
  const rain::Rays rays = rain::raysOf(cone, view);
  out.rain.ray_middle = wide(rays.middle);
  out.rain.ray_right = wide(rays.right);
  out.rain.ray_up = wide(rays.up);
  // Where a volume may stand that found no room, nothing is drawn.
  const double reach_m = std::min({look.reach_m, kMostSplashReach_m, known_m});
  if (!(reach_m > 0.0)) return false;
  for (uint32_t k = 0; k <= kSplashSizes; ++k)
    out.rain.sizes_mm[k / 4][static_cast<int>(k % 4)] = picture.sizes_mm[k];

  std::vector<Lattice> lattices(1);
  Lattice& world = lattices.front();
  world.origin_m = picture.origin_m;
  world.drift_mps = picture.drift_mps;
  world.reference_m = picture.ground_m;
  world.search_m = picture.ground_known ? kSearch_m : kWideSearch_m;
  world.reach_m = reach_m;

  const auto vehicle = std::ranges::find(picture.vehicles, view.vehicle, &SplashPicture::Vehicle::id);
  if (vehicle != picture.vehicles.end()) {
    Lattice on_it;
    on_it.number = 1;
    on_it.name = vehicle->id;
    on_it.origin_m = vehicle->pose.position_m + vehicle->pose.velocity_mps * after_s;
    on_it.velocity_mps = vehicle->pose.velocity_mps;
    on_it.drift_mps = picture.drift_mps - on_it.velocity_mps;
    on_it.reference_m = picture.ground_m + kBonnet_m;
    on_it.ground_m = -kBonnet_m;
    on_it.search_m = kBonnetSearch_m;
    on_it.reach_m = std::min(reach_m, kVehicle_m);
    world.own_m = on_it.own_m = kVehicle_m;
    lattices.push_back(on_it);
  }
  for (const Lattice& lattice : lattices) tell(lattice, out.rain);
  out.kept = keptOf(picture, std::min(look.reach_m, kMostSplashReach_m));
  Cells cells(picture, cone, time_ns, out);
  for (const Lattice& lattice : lattices) cells.add(lattice);
  out.rain.reach = vec4(reach_m, look.gain / out.kept, 0.0, 0.0);
  tellStarts(out);
  return out.count > 0;
}

}  // namespace rg::surroundings
