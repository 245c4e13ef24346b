// The film's link as a saved state: what ticks have gathered for the step that is not closed yet, and reports
// that wait for their tick.
#include <algorithm>

#include "glass/film_link.h"
#include "glass/saved_limits.h"
#include "shared/glass_beads.glsl"

namespace rg::glass {
namespace {

constexpr int32_t kMostAtOnce_pl = 200'000'000;  // to a texel or a ridge, as film_link.cpp has it
constexpr int kWholeTexel = 65536;               // as FilmTake has it
constexpr size_t kMostInList = size_t{1} << 26;
constexpr uint32_t kMostReports = 64;

// Of a report's tiles what its tick still asks for.
constexpr auto kAskedLater = {&shared::FilmTile::film_low_pl, &shared::FilmTile::film_high,
                              &shared::FilmTile::beads_pl};
constexpr auto kRunOff = {&shared::FilmTile::drained_pl, &shared::FilmTile::blown_pl};  // likewise

void visitOrder(auto& a, auto& order) {
  a.list(order.takes, kMostInList, [&a](auto& take) {
    a(take.texel);
    a.within(take.share_65536, 0, kWholeTexel);
  });
  a.list(order.slid, kMostInList, [&a](auto& slid) { a(slid.texel, slid.shown); });
  a.list(order.bead_adds, kMostInList, [&a](auto& add) {
    a(add.texel);
    a.within(add.volume_pl, 1, kMostAtOnce_pl);
    a.within(add.number, 0, shared::kMostBeads);
  });
  a.list(order.ridge_adds, kMostInList, [&a](auto& add) {
    a.within(add.segment, 0, kRidgePieces - 1);
    a.within(add.volume_pl, 0, kMostAtOnce_pl);
  });
  a.list(order.sweeps, kMostInList,
         [&a](auto& sweep) { a(sweep.first_range, sweep.first_piece, sweep.backwards); });
  a.list(order.sweep_ranges, kMostInList, [&a](auto& range) { a(range.first, range.count); });
  a.list(order.leaves, kMostInList, [&a](auto& leave) {
    a.within(leave.segment, 0, kRidgePieces - 1);
    a(leave.first, leave.count, leave.over_edge_pl);
  });
  a.list(order.leave_texels, kMostInList);
  a.list(order.leave_edges, kMostInList);
}

void checkPlaces(const saved::Reader& a, const PaneMap& map, const auto& items) {
  for (const auto& item : items) {
    a.require(item.texel >= 0 && item.texel < map.texelCount() && map.inside(item.texel),
              "a texel is off the pane");
  }
}

// No texel twice, each on the glass.
void checkTexels(const saved::Reader& a, const PaneMap& map, const auto& items) {
  checkPlaces(a, map, items);
  std::vector<bool> seen(static_cast<size_t>(map.texelCount()), false);
  for (const auto& item : items) {
    a.require(!seen[static_cast<size_t>(item.texel)], "a texel is told twice");
    seen[static_cast<size_t>(item.texel)] = true;
  }
}

bool lies(int first, int count, size_t size) {
  return first >= 0 && count >= 0 && static_cast<size_t>(first) + static_cast<size_t>(count) <= size;
}

}  // namespace

bool FilmLink::settled(const SweptBy& swept_by) const {
  return outbox_.empty() && ordered_.empty() &&
         std::ranges::all_of(order_.sweeps, [&](const SweepOrder& sweep) {
           return swept_by(sweep.first_piece) == sweep.swept;
         });
}

void FilmLink::write(saved::Writer& a) const {
  a(attached_, next_step_);
  if (!attached_) return;
  a(first_step_);
  visitOrder(a, order_);
  a.list(takers_, takers_.size());
  a.list(touched_, touched_.size(), [&](int texel) { a(texel, sums_[static_cast<size_t>(texel)]); });
  writeReports(a);
  a.list(tile_thickness_m_, tile_thickness_m_.size());
  for (const bool watered : tile_watered_) a(watered);
  a(film_pl_, beads_pl_, ridge_pl_);
}

void FilmLink::read(saved::Reader& a, const SweptBy& swept_by) {
  a(attached_);
  a.within(next_step_, 0, kMostSavedTicks);
  last_reported_ = next_step_ - 1;
  first_step_ = next_step_;
  if (!attached_) return;
  a.within(first_step_, 0, kMostSavedTicks);
  visitOrder(a, order_);
  for (SweepOrder& sweep : order_.sweeps) sweep.swept = swept_by(sweep.first_piece);
  a.list(takers_, kMostInList);
  checkOrder(a);
  struct Sum {
    int texel = 0, volume_pl = 0;
  };
  std::vector<Sum> sums;
  a.list(sums, kMostInList, [&a](Sum& sum) {
    a(sum.texel);
    a.within(sum.volume_pl, 1, kMostAtOnce_pl);
  });
  checkTexels(a, *map_, sums);
  for (const Sum& sum : sums) {
    touched_.push_back(sum.texel);
    sums_[static_cast<size_t>(sum.texel)] = sum.volume_pl;
  }
  findGathered();
  readReports(a);
  std::vector<float> thickness_m;
  a.list(thickness_m, tile_thickness_m_.size(), [&a](float& m) { a.within(m, 0.0, 1e6); });
  a.require(thickness_m.size() == tile_thickness_m_.size(), "it has another number of tiles");
  tile_thickness_m_ = std::move(thickness_m);
  thickest_m_ = 0.0f;
  for (const float m : tile_thickness_m_) thickest_m_ = std::max(thickest_m_, m);
  findMostAbout();
  for (size_t i = 0; i < tile_watered_.size(); ++i) {
    bool watered = false;
    a(watered);
    tile_watered_[i] = watered;
  }
  a.within(film_pl_, 0, kMostSaved_pl), a.within(beads_pl_, 0, kMostSaved_pl),
      a.within(ridge_pl_, 0, kMostSaved_pl);
}

// Steps are behind where a pane was reset in the middle of some. As nothing is under way all that were closed
// have been reported: what is asked for and was not would be waited for without end, as would reports that
// none asks for any more.
bool FilmLink::fits(int64_t now, int64_t asked) const {
  return first_step_ <= next_step_ && next_step_ <= now && asked <= last_reported_ &&
         (reports_.empty() || reports_.front().step >= asked);
}

void FilmLink::checkOrder(const saved::Reader& a) const {
  checkTexels(a, *map_, order_.takes);
  checkPlaces(a, *map_, order_.slid);
  checkTexels(a, *map_, order_.bead_adds);
  checkPlaces(a, *map_, takers_);
  a.require(takers_.size() == order_.takes.size(), "what was taken has no taker");
  for (const SweepOrder& sweep : order_.sweeps) {
    a.require(sweep.swept != nullptr && sweep.first_range % shared::kBladeSegments == 0 &&
                  lies(sweep.first_range, shared::kBladeSegments, order_.sweep_ranges.size()),
              "a blade swept that there is none of");
    for (int i = sweep.first_range; i < sweep.first_range + shared::kBladeSegments; ++i) {
      const shared::SweptRange& range = order_.sweep_ranges[static_cast<size_t>(i)];
      a.require(lies(range.first, range.count, sweep.swept->size()), "a blade swept more than there is");
    }
  }
  std::vector<bool> left(size_t{kRidgePieces}, false);  // the kernel leaves all pieces at once
  for (const shared::RidgeLeave& leave : order_.leaves) {
    a.require(lies(leave.first, leave.count, order_.leave_texels.size()), "a ridge is left nowhere");
    a.require(!left[static_cast<size_t>(leave.segment)], "a ridge is left twice");
    left[static_cast<size_t>(leave.segment)] = true;
  }
  a.require(order_.leave_edges.size() == order_.leaves.size(), "a ridge is left at no edge");
  for (const int texel : order_.leave_edges)
    a.require(texel >= -1 && texel < map_->texelCount(), "a ridge is left at an edge of another pane");
  for (const int texel : order_.leave_texels)
    a.require(texel >= 0 && texel < map_->texelCount() && map_->inside(texel), "a texel is off the pane");
}

// What follows from the order.
void FilmLink::findGathered() {
  gathered_pl_ = 0;
  for (const int texel : touched_) gathered_pl_ += sums_[static_cast<size_t>(texel)];
  for (const shared::FilmTake& take : order_.takes)
    taken_in_[static_cast<size_t>(take.texel)] = static_cast<int32_t>(next_step_);
  for (size_t i = 0; i < order_.bead_adds.size(); ++i) {
    bead_of_[static_cast<size_t>(order_.bead_adds[i].texel)] = static_cast<int32_t>(i);
    gathered_pl_ += order_.bead_adds[i].volume_pl;
  }
  for (const shared::RidgeAdd& add : order_.ridge_adds) gathered_pl_ += add.volume_pl;
  for (const shared::RidgeLeave& leave : order_.leaves) leaving_[static_cast<size_t>(leave.segment)] = true;
}

void FilmLink::writeReports(saved::Writer& a) const {
  const auto count = static_cast<uint32_t>(reports_.size());
  a(count);
  for (size_t i = 0; i < reports_.size(); ++i) {
    const FilmReport& report = reports_[i];
    a(report.step);
    std::vector<uint32_t> row;
    for (const shared::FilmTile& tile : report.tiles)
      row.push_back(static_cast<uint32_t>(tile.event_texel + 1));
    saved::writeRow<uint32_t>(a, row);
    row.clear();
    for (const shared::FilmTile& tile : report.tiles) row.push_back(static_cast<uint32_t>(tile.event_pl));
    saved::writeRow<uint32_t>(a, row);
    for (const auto field : kAskedLater) {
      row.clear();
      for (const shared::FilmTile& tile : report.tiles) row.push_back(tile.*field);
      saved::writeRow<uint32_t>(a, row);
    }
    for (const auto field : kRunOff) {
      row.clear();
      for (const shared::FilmTile& tile : report.tiles) row.push_back(static_cast<uint32_t>(tile.*field));
      saved::writeRow<uint32_t>(a, row);
    }
    a.list(report_takers_[i], report_takers_[i].size());
    a.list(report.taken_pl, report.taken_pl.size());
    a.list(report.thrown, report.thrown.size(),
           [&a](const ThrownOff& thrown) { a(thrown.segment, thrown.texel, thrown.volume_pl); });
  }
}

void FilmLink::readReports(saved::Reader& a) {
  constexpr uint32_t kMostGiven_pl = 2'000'000'000;
  uint32_t count = 0;
  a.within(count, 0u, kMostReports);
  for (uint32_t i = 0; i < count; ++i) {
    FilmReport report;
    a.within(report.step, 0, kMostSavedTicks);
    a.require(report.step == last_reported_ - static_cast<int64_t>(count - 1 - i), "a report is missing");
    report.tiles.resize(tile_watered_.size());
    std::vector<uint32_t> row(report.tiles.size());
    saved::readRow<uint32_t>(a, row);
    for (size_t t = 0; t < row.size(); ++t) {
      a.require(row[t] <= static_cast<uint32_t>(map_->texelCount()) &&
                    (row[t] == 0 || map_->inside(static_cast<int>(row[t] - 1))),
                "a texel is off the pane");
      report.tiles[t].event_texel = static_cast<int>(row[t]) - 1;
    }
    saved::readRow<uint32_t>(a, row);
    for (size_t t = 0; t < row.size(); ++t) {
      a.require(row[t] <= kMostGiven_pl && (row[t] == 0 || report.tiles[t].event_texel >= 0),
                "what a tile gave comes from nowhere");
      report.tiles[t].event_pl = static_cast<int>(row[t]);
    }
    for (const auto field : kAskedLater) {
      saved::readRow<uint32_t>(a, row);
      for (size_t t = 0; t < row.size(); ++t) report.tiles[t].*field = row[t];
    }
    for (const auto field : kRunOff) {
      saved::readRow<uint32_t>(a, row);
      for (size_t t = 0; t < row.size(); ++t) {
        a.require(row[t] <= 0x7fffffffu, "more ran off a tile than can");
        report.tiles[t].*field = static_cast<int>(row[t]);
      }
    }
    std::vector<Taker> takers;
    a.list(takers, kMostInList);
    checkPlaces(a, *map_, takers);
    a.list(report.taken_pl, kMostInList, [&a](int& taken_pl) { a.within(taken_pl, 0, INT32_MAX); });
    a.require(takers.size() == report.taken_pl.size(), "what was taken has no taker");
    a.list(report.thrown, size_t{kRidgePieces}, [&](ThrownOff& thrown) {
      a.within(thrown.segment, 0, kRidgePieces - 1);
      a.within(thrown.texel, -1, map_->texelCount() - 1);
      a.within(thrown.volume_pl, 1, INT32_MAX);
    });
    reports_.push_back(std::move(report));
    report_takers_.push_back(std::move(takers));
  }
}

}  // namespace rg::glass
