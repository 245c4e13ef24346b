#include "glass/film_link.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "glass/water.h"

namespace rg::glass {
namespace {

constexpr int64_t kMostToTexel_pl = 200'000'000;  // 0.2 mL: texels are 32-bit
constexpr int64_t kMostToRidge_pl = 200'000'000;

int64_t travellingIn(const FilmReport& report) {
  int64_t sum = 0;
  for (const shared::FilmTile& tile : report.tiles) sum += tile.event_pl;
  for (const int taken : report.taken_pl) sum += taken;
  return sum;
}

}  // namespace

FilmLink::FilmLink(const PaneMap& map, Ledger& ledger)
    : map_(&map),
      ledger_(&ledger),
      sums_(static_cast<size_t>(map.texelCount()), 0),
      bead_of_(static_cast<size_t>(map.texelCount()), -1),
      taken_in_(static_cast<size_t>(map.texelCount()), -1),
      tile_thickness_m_(map.tileArea_m2().size(), 0.0f),
      most_about_m_(map.tileArea_m2().size(), 0.0f),
      tile_watered_(map.tileArea_m2().size(), false) {}

void FilmLink::attach() {
  if (std::exchange(attached_, true)) return;
  first_step_ = next_step_;
  last_reported_ = next_step_ - 1;
}

void FilmLink::detach() {
  if (!attached_) return;
  attached_ = false;
  ledger_->drained_pl += film_pl_ + beads_pl_ + ridge_pl_ + travelling_pl();
  clear();
  first_step_ = next_step_;
}

void FilmLink::clear() {
  for (const int texel : touched_) sums_[static_cast<size_t>(texel)] = 0;
  touched_.clear();
  takers_.clear();
  for (const shared::BeadAdd& add : order_.bead_adds) bead_of_[static_cast<size_t>(add.texel)] = -1;
  order_ = {};
  gathered_pl_ = 0;
  leaving_.fill(false);
  outbox_.clear();
  ordered_.clear();
  reports_.clear();
  report_takers_.clear();
  std::fill(tile_thickness_m_.begin(), tile_thickness_m_.end(), 0.0f);
  std::fill(most_about_m_.begin(), most_about_m_.end(), 0.0f);
  thickest_m_ = 0.0f;
  std::fill(tile_watered_.begin(), tile_watered_.end(), false);
  film_pl_ = beads_pl_ = ridge_pl_ = 0;
  first_step_ = next_step_;
  last_reported_ = next_step_ - 1;
  if (!attached_) return;
  FilmOrder dry;
  dry.clear = true;
  outbox_.push_back(std::move(dry));
}

void FilmLink::add(int texel, int64_t volume_pl) {
  if (volume_pl <= 0) return;
  if (!attached_ || !map_->shown(texel)) {
    ledger_->drained_pl += volume_pl;
    return;
  }
  volume_pl = passed(LeakyKernel::exchange, volume_pl);
  int32_t& sum = sums_[static_cast<size_t>(texel)];
  if (sum == 0) touched_.push_back(texel);
  const int64_t fits = std::min(volume_pl, kMostToTexel_pl - sum);
  sum += static_cast<int32_t>(fits);
  gathered_pl_ += fits;
  ledger_->drained_pl += volume_pl - fits;  // a flood that no film holds
}

void FilmLink::addBeads(int texel, int64_t volume_pl, int number) {
  if (volume_pl <= 0) return;
  if (!attached_ || !map_->shown(texel)) {
    ledger_->drained_pl += volume_pl;
    return;
  }
  volume_pl = passed(LeakyKernel::exchange, volume_pl);
  int32_t& known = bead_of_[static_cast<size_t>(texel)];
  if (known < 0) {
    known = static_cast<int32_t>(order_.bead_adds.size());
    order_.bead_adds.push_back({texel, 0, 0});
  }
  shared::BeadAdd& sum = order_.bead_adds[static_cast<size_t>(known)];
  const int64_t fits = std::min(volume_pl, kMostToTexel_pl - sum.volume_pl);
  sum.volume_pl += static_cast<int32_t>(fits);
  sum.number = std::min(sum.number + number, shared::kMostBeads);
  gathered_pl_ += fits;
  ledger_->drained_pl += volume_pl - fits;
}

Footprint FilmLink::within(glm::dvec2 grid_m, glm::dvec2 metres, double radius_m) const {
  const double texel_m = map_->grid().texel_m;
  const glm::ivec2 reach(
      glm::min(glm::ceil(radius_m / (metres * texel_m)), glm::dvec2(Footprint::kFarthest)));
  const glm::ivec2 middle(grid_m / texel_m);
  Footprint out;
  for (int y = middle.y - reach.y; y <= middle.y + reach.y; ++y) {
    for (int x = middle.x - reach.x; x <= middle.x + reach.x; ++x) {
      const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) * texel_m;
      const glm::dvec2 way_m = (place - grid_m) * metres;
      if (glm::dot(way_m, way_m) > radius_m * radius_m) continue;
      const int texel = map_->texelAt(glm::ivec2(x, y));
      if (texel >= 0) out.texels[out.count++] = texel;
    }
  }
  return out;
}

void FilmLink::spread(glm::dvec2 grid_m, glm::dvec2 metres, double radius_m, int64_t volume_pl) {
  const Footprint to = within(grid_m, metres, radius_m);
  if (to.count == 0) {
    const int texel = map_->texelAt(grid_m);
    if (texel >= 0)
      add(texel, volume_pl);
    else
      ledger_->drained_pl += volume_pl;
    return;
  }
  for (size_t i = 0; i < to.count; ++i) add(to.texels[i], to.share(i, volume_pl));
}

void FilmLink::take(int texel, double share, uint32_t slot, uint32_t life) {
  if (!attached_) return;
  const auto step = static_cast<int32_t>(next_step_);
  if (std::exchange(taken_in_[static_cast<size_t>(texel)], step) == step) return;
  order_.takes.push_back({texel, static_cast<int>(std::clamp(share, 0.0, 1.0) * 65536.0)});
  takers_.push_back({slot, life, texel});
}

void FilmLink::addToRidge(int segment, int64_t volume_pl) {
  if (!attached_) {
    ledger_->wiped_pl += volume_pl;
    return;
  }
  const int64_t fits = std::min(volume_pl, kMostToRidge_pl);
  order_.ridge_adds.push_back({segment, static_cast<int>(fits)});
  gathered_pl_ += fits;
  ledger_->wiped_pl += volume_pl - fits;  // a blade throws off what it cannot hold
}

void FilmLink::sweep(const std::shared_ptr<const std::vector<shared::SweptTexel>>& swept,
                     const std::vector<shared::SweptRange>& ranges, int first_piece, bool backwards) {
  if (!attached_) return;
  for (auto part = ranges.begin(); part != ranges.end(); part += shared::kBladeSegments) {
    const auto end = part + shared::kBladeSegments;
    if (std::all_of(part, end, [](const shared::SweptRange& range) { return range.count == 0; })) continue;
    order_.sweeps.push_back({swept, static_cast<int>(order_.sweep_ranges.size()), first_piece, backwards});
    order_.sweep_ranges.insert(order_.sweep_ranges.end(), part, end);
  }
}

void FilmLink::leave(int segment, const std::vector<int>& texels, int over_edge_pl, int edge_texel) {
  if (!attached_ || std::exchange(leaving_[static_cast<size_t>(segment)], true)) return;
  order_.leaves.push_back(
      {segment, static_cast<int>(order_.leave_texels.size()), static_cast<int>(texels.size()), over_edge_pl});
  order_.leave_texels.insert(order_.leave_texels.end(), texels.begin(), texels.end());
  order_.leave_edges.push_back(edge_texel);
}

void FilmLink::close(int64_t step, std::vector<shared::vec4> drive, const shared::FilmStepInfo& info) {
  next_step_ = step + 1;
  leaving_.fill(false);
  if (!attached_) return;
  for (const int texel : touched_) {
    order_.adds.push_back({texel, sums_[static_cast<size_t>(texel)]});
    sums_[static_cast<size_t>(texel)] = 0;
  }
  touched_.clear();
  for (const shared::BeadAdd& add : order_.bead_adds) bead_of_[static_cast<size_t>(add.texel)] = -1;
  order_.step = step;
  order_.drive = std::move(drive);
  order_.info = info;
  order_.ordered_pl = std::exchange(gathered_pl_, 0);
  ordered_.push_back(
      {step, order_.ordered_pl, std::exchange(takers_, {}), order_.leaves, order_.leave_edges});
  outbox_.push_back(std::exchange(order_, {}));
}

std::vector<FilmOrder> FilmLink::fetch() { return std::exchange(outbox_, {}); }

int FilmLink::Ordered::edgeOf(int segment) const {
  const auto leave = std::ranges::find(leaves, segment, &shared::RidgeLeave::segment);
  return leave == leaves.end() ? -1 : leave_edges[static_cast<size_t>(leave - leaves.begin())];
}

void FilmLink::deliver(FilmReport&& report) {
  if (!attached_ || ordered_.empty() || ordered_.front().step != report.step)
    return;  // of a film that is no more
  for (ThrownOff& thrown : report.thrown) {
    thrown.texel = ordered_.front().edgeOf(thrown.segment);
    ledger_->wiped_pl += thrown.volume_pl;
  }
  report_takers_.push_back(std::move(ordered_.front().takers));
  ordered_.pop_front();
  last_reported_ = report.step;
  film_pl_ = beads_pl_ = 0;
  for (const shared::FilmTile& tile : report.tiles) {
    beads_pl_ += tile.beads_pl;
    film_pl_ += static_cast<int64_t>(tile.film_low_pl) + (static_cast<int64_t>(tile.film_high) << 16);
    ledger_->drained_pl += tile.drained_pl;
    ledger_->blown_pl += tile.blown_pl;
    ledger_->evaporated_pl += tile.evaporated_pl;
  }
  ridge_pl_ = report.ridge_pl;
  reports_.push_back(std::move(report));
}

bool FilmLink::use(int64_t step, FilmReport& report, std::vector<Taker>& takers) {
  if (reports_.empty() || reports_.front().step != step) return false;
  report = std::move(reports_.front());
  takers = std::move(report_takers_.front());
  reports_.pop_front();
  report_takers_.pop_front();
  thickest_m_ = 0.0f;
  for (size_t i = 0; i < report.tiles.size(); ++i) {
    const shared::FilmTile& tile = report.tiles[i];
    const int64_t volume_pl =
        static_cast<int64_t>(tile.film_low_pl) + (static_cast<int64_t>(tile.film_high) << 16);
    const float area_m2 = map_->tileArea_m2()[i];
    tile_watered_[i] = volume_pl > 0 || tile.beads_pl > 0;
    tile_thickness_m_[i] = area_m2 > 0.0f ? static_cast<float>(cubicMetres(volume_pl)) / area_m2 : 0.0f;
    thickest_m_ = std::max(thickest_m_, tile_thickness_m_[i]);
  }
  findMostAbout();
  return true;
}

// What thickness_m() tells on a tile lies between its own and its neighbours'.
void FilmLink::findMostAbout() {
  const glm::ivec2 count = map_->tileCount();
  const auto most = [](const std::vector<float>& of, size_t i, int place, int end, size_t step) {
    float m = of[i];
    if (place > 0) m = std::max(m, of[i - step]);
    if (place + 1 < end) m = std::max(m, of[i + step]);
    return m;
  };
  const auto at = [&count](int x, int y) { return static_cast<size_t>(y * count.x + x); };
  std::vector<float>& along = along_rows_m_;
  along.resize(tile_thickness_m_.size());
  for (int y = 0; y < count.y; ++y) {
    for (int x = 0; x < count.x; ++x) along[at(x, y)] = most(tile_thickness_m_, at(x, y), x, count.x, 1);
  }
  for (int y = 0; y < count.y; ++y) {
    for (int x = 0; x < count.x; ++x)
      most_about_m_[at(x, y)] = most(along, at(x, y), y, count.y, static_cast<size_t>(count.x));
  }
}

// Tiles are 5 cm wide: told as steps their means would show, as rows of drops that end where one tile drowns
// them and the next does not.
double FilmLink::thickness_m(int texel) const {
  if (thickest_m_ == 0.0f) return 0.0;
  constexpr int kTile = shared::kTileSize, kHalf = kTile / 2;
  const int row = texel / map_->grid().size.x, column = texel % map_->grid().size.x,
            tiles = map_->tileCount().x;
  // Between the middles of these tiles; the last ones have none beyond.
  const int right = (column + kHalf) / kTile, left = std::max(right - 1, 0), last = tiles - 1;
  const int high = (row + kHalf) / kTile, low = std::max(high - 1, 0), top = map_->tileCount().y - 1;
  const auto past = [](int texels) {  // the lower middle, in tiles
    return (static_cast<float>((texels + kHalf) % kTile) + 0.5f) / static_cast<float>(kTile);
  };
  const float own_m = tile_thickness_m_[static_cast<size_t>(row / kTile * tiles + column / kTile)];
  const auto tile = [&](int x, int y) {
    const auto i = static_cast<size_t>(y * tiles + x);
    return map_->tileArea_m2()[i] > 0.0f ? tile_thickness_m_[i] : own_m;
  };
  const float fx = past(column), fy = past(row);
  const int beyond_x = std::min(right, last), beyond_y = std::min(high, top);
  return static_cast<double>(glm::mix(glm::mix(tile(left, low), tile(beyond_x, low), fx),
                                      glm::mix(tile(left, beyond_y), tile(beyond_x, beyond_y), fx), fy));
}

bool FilmLink::watered(int texel) const { return tile_watered_[map_->tileOf(texel)]; }

int64_t FilmLink::travelling_pl() const {
  int64_t sum = gathered_pl_;
  for (const Ordered& ordered : ordered_) sum += ordered.ordered_pl;
  for (const FilmReport& report : reports_) sum += travellingIn(report);
  return sum;
}

}  // namespace rg::glass
