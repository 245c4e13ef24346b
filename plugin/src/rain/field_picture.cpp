// What the field hands out: records for the GPU, the picture they are drawn by, and streaks for tests.
#include <algorithm>
#include <memory>

#include "rain/field_state.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kGoneOn_m = 5.0;  // what an eye may go on from a tick to its pictures

}  // namespace

void Field::State::describe(Picture& picture) const {
  picture.tick = tick;
  picture.time_ns = tickTimeNs(tick);
  picture.epoch_ticks = static_cast<uint32_t>(tick - epoch);
  picture.slot_end = drops.end();
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    picture.classes[kind] = {frames.origin(kind), frames.velocity(kind), classLattices()[kind].cell_m,
                             reachPerDiameter() * classLattices()[kind].drops.seen};
  }
  picture.volumes.clear();
  std::vector<dvec3> eyes;
  double streak_m = 0.0, reach_mm = kLargest_mm;
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    if (isAbout(kind)) reach_mm = std::max(reach_mm, classLattices()[kind].reach_mm);
  }
  for (const auto& view : border.views()) {
    if (!view->moved) continue;
    eyes.push_back(view->eye_m);
    streak_m = std::max(streak_m, view->streak_m);
  }
  shelter.near(eyes, reachPerDiameter() * 1e-3 * reach_mm + streak_m + kGoneOn_m, picture.volumes);
}

void Field::publish(Upload& upload) {
  State& s = *state_;
  const uint32_t changed = s.drops.changed();
  size_t at = upload.slots.size();
  upload.slots.resize(at + changed);
  upload.records.resize(at + changed);
  s.drops.takeChanged([&](uint32_t slot, const RainDrop& record) {
    upload.slots[at] = slot;
    upload.records[at++] = record;
  });
  s.uploaded += changed * sizeof(RainDrop);
  s.describe(upload.picture);
}

void Field::publishAll(Upload& upload) {
  State& s = *state_;
  upload.whole = true;
  upload.slots.clear();
  upload.records.clear();
  for (uint32_t slot = 0; slot < s.drops.end(); ++slot) {
    if (!s.drops.alive(slot)) continue;
    upload.slots.push_back(slot);
    upload.records.push_back(s.drops[slot]);
  }
  s.uploaded += upload.records.size() * sizeof(RainDrop);
  s.drops.takeChanged([](uint32_t, const RainDrop&) {});
  s.describe(upload.picture);
}

void Field::streaks(const ViewState& view, int64_t time_ns, std::vector<Streak>& out) const {
  const State& s = *state_;
  out.clear();
  Picture picture;
  s.describe(picture);
  const auto setup = std::make_unique<StreakSetup>();
  setUpStreaks(picture, view, time_ns, *setup);
  const dvec3 eye = coneOf(view).eye_m;
  for (uint32_t slot = 0; slot < s.drops.end(); ++slot) {
    if (!s.drops.alive(slot)) continue;
    const RainDrop& drop = s.drops[slot];
    const uint32_t kind = shared::rainClassOf(drop);
    const shared::RainStreak streak =
        shared::rainStreak(drop, setup->classes[kind], setup->view, setup->shelter);
    if (streak.from_s >= streak.to_s) continue;
    const dvec3 place = dvec3(streak.drop_m) + eye, velocity(streak.velocity_mps);
    out.push_back({slot, kind, static_cast<double>(drop.diameter_m), place,
                   place + velocity * static_cast<double>(streak.from_s),
                   place + velocity * static_cast<double>(streak.to_s), static_cast<double>(streak.fade)});
  }
}

}  // namespace rg::rain
