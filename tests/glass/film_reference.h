// The film on the CPU: the law of shared/glass_film.glsl with plain loops around it, one texel after the
// other. What the GPU is held against.
#pragma once

#include <algorithm>
#include <vector>

#include "glass/film_order.h"
#include "glass/pane_map.h"
#include "glass/uneven_glass.h"
#include "shared/glass_wiper.glsl"

namespace rg::test {

class FilmReference {
 public:
  FilmReference(const glass::PaneMap& map, const glass::UnevenGlass& glass)
      : map_(map),
        glass_(glass),
        columns_(map.grid().size.x),
        rows_(map.grid().size.y),
        ridge_(glass::kRidgePieces, 0) {
    for (int i = 0; i < map.texelCount(); ++i) film.push_back(map.inside(i) ? 0 : -1);
    beads.assign(film.size(), 0);
  }

  std::vector<int32_t> film;
  std::vector<uint32_t> beads;  // packed

  glass::FilmReport run(const glass::FilmOrder& order) {
    glass::FilmReport report;
    report.step = order.step;
    for (const shared::FilmTake& take : order.takes) {
      const int taken = shared::shareOf(at(take.texel), take.share_65536);
      at(take.texel) -= taken;
      const shared::Beads lying = beadsAt(take.texel);
      const int taken_beads = shared::shareOf(lying.volume_pl, take.share_65536);
      lay(take.texel, shared::withoutPart(lying, taken_beads));
      report.taken_pl.push_back(taken + taken_beads);
    }
    for (const shared::FilmAdd& add : order.adds) at(add.texel) += add.volume_pl;
    for (const shared::BeadAdd& add : order.bead_adds)
      lay(add.texel, shared::joinedBy(beadsAt(add.texel), add.volume_pl, add.number, at(add.texel)));
    for (const shared::RidgeAdd& add : order.ridge_adds) ridge(add.segment) += add.volume_pl;
    for (const glass::SweepOrder& sweep : order.sweeps) this->sweep(sweep, order);
    for (const shared::RidgeLeave& leave : order.leaves) {
      if (const int volume_pl = this->leave(leave, order); volume_pl > 0)
        report.thrown.push_back({leave.segment, -1, volume_pl});
    }
    std::ranges::sort(report.thrown, {}, &glass::ThrownOff::segment);
    step(order, report);
    for (const int32_t volume : ridge_) report.ridge_pl += volume;
    return report;
  }

 private:
  int32_t& at(int texel) { return film[static_cast<size_t>(texel)]; }
  shared::Beads beadsAt(int texel) const { return shared::beadsOf(beads[static_cast<size_t>(texel)]); }
  void lay(int texel, const shared::Beads& lying) {
    beads[static_cast<size_t>(texel)] = shared::packedBeads(lying);
  }
  int32_t& ridge(int segment) { return ridge_[static_cast<size_t>(segment)]; }

  void sweep(const glass::SweepOrder& sweep, const glass::FilmOrder& order) {
    for (int piece = 0; piece < shared::kBladeSegments; ++piece) {
      const shared::SweptRange range = order.sweep_ranges[static_cast<size_t>(sweep.first_range + piece)];
      for (int k = 0; k < range.count; ++k) {
        const int i = range.first + (sweep.backwards ? range.count - 1 - k : k);
        const shared::SweptTexel& entry = (*sweep.swept)[static_cast<size_t>(i)];
        int32_t& carried = ridge(sweep.first_piece + piece);
        const int water = at(entry.texel) + beadsAt(entry.texel).volume_pl;
        const int left = shared::leftBehind_pl(water, entry, carried);
        carried += water - left;
        at(entry.texel) = left;
        lay(entry.texel, shared::noBeads());
      }
    }
    for (int k = 0; k < shared::kLevellings; ++k) {
      const std::vector<int32_t> before = ridge_;
      for (int piece = 0; piece + 1 < shared::kBladeSegments; ++piece) {
        const auto here = static_cast<size_t>(sweep.first_piece + piece);
        const int flow = shared::levelledAlong_pl(before[here], before[here + 1]);
        ridge_[here] -= flow;
        ridge_[here + 1] += flow;
      }
    }
  }

  int leave(const shared::RidgeLeave& leave, const glass::FilmOrder& order) {
    const int volume = std::exchange(ridge(leave.segment), 0);
    if (leave.count == 0 || volume >= leave.over_edge_pl) return volume;
    const int each = volume / leave.count;
    for (int k = 0; k < leave.count; ++k) {
      at(order.leave_texels[static_cast<size_t>(leave.first + k)]) +=
          k == 0 ? volume - each * (leave.count - 1) : each;
    }
    return 0;
  }

  shared::vec4 field(const std::vector<shared::vec4>& nodes, int x, int y) const {
    const int across = map_.nodeCount().x;
    const size_t n = static_cast<size_t>(y / shared::kTileSize * across + x / shared::kTileSize),
                 m = n + static_cast<size_t>(across);
    return shared::betweenNodes(nodes[n], nodes[n + 1], nodes[m], nodes[m + 1],
                                {shared::placeAcross(x), shared::placeUp(y)});
  }

  void step(const glass::FilmOrder& order, glass::FilmReport& report) {
    report.tiles.assign(map_.tileArea_m2().size(), shared::FilmTile{-1, 0, 0, 0, 0, 0, 0, 0});
    std::vector<shared::FilmCell> cells(film.size());
    for (int i = 0; i < map_.texelCount(); ++i) {
      const int x = i % columns_, y = i / columns_;
      cells[static_cast<size_t>(i)] =
          shared::filmCell(at(i), around(i), glass_.level(i), field(order.drive, x, y),
                           field(map_.nodeMetric(), x, y), order.info);
    }
    const int tiles_across = map_.tileCount().x;
    std::vector<shared::FilmTexel> settled(film.size());
    for (int i = 0; i < map_.texelCount(); ++i) {
      if (cells[static_cast<size_t>(i)].volume_pl < 0) continue;
      const int x = i % columns_, y = i / columns_;
      shared::FilmTile& tile =
          report.tiles[static_cast<size_t>(y / shared::kTileSize * tiles_across + x / shared::kTileSize)];
      const shared::vec4 metric = field(map_.nodeMetric(), x, y);
      shared::FilmTexel& now = settled[static_cast<size_t>(i)];
      now = shared::settled(flowed(i, cells, order.info, tile), beadsAt(i), metric, order.info);
      put(i, now);
      if (now.gone_pl > tile.event_pl) {
        tile.event_pl = now.gone_pl;  // what may go: what does comes below
        tile.event_texel = i;
      }
    }
    for (shared::FilmTile& tile : report.tiles) {
      if (tile.event_texel < 0) continue;
      const shared::FilmTexel& gives = settled[static_cast<size_t>(tile.event_texel)];
      tile.event_pl = shared::offered_pl(gives.gone_pl, gives.beads);
      put(tile.event_texel, shared::without(gives, tile.event_pl));
    }
    dry(order.info, report);
    for (int i = 0; i < map_.texelCount(); ++i) {
      shared::FilmTile& tile = report.tiles[static_cast<size_t>(
          i / columns_ / shared::kTileSize * tiles_across + i % columns_ / shared::kTileSize)];
      tile.film_low_pl += static_cast<uint32_t>(std::max(at(i), 0)) & 0xffffu;
      tile.film_high += static_cast<uint32_t>(std::max(at(i), 0)) >> 16u;
      tile.beads_pl += static_cast<uint32_t>(beadsAt(i).volume_pl);
    }
  }

  // What lies on the pane's rim has no film, and asks nothing.
  shared::FilmAround around(int i) {
    if (at(i) < 0) return {};
    return shared::filmAround(at(i), at(i - 1), at(i + 1), at(i - columns_), at(i + columns_));
  }

  void dry(const shared::FilmStepInfo& info, glass::FilmReport& report) {
    for (int i = 0; i < map_.texelCount(); ++i) {
      const int x = i % columns_, y = i / columns_;
      const auto tile =
          static_cast<size_t>(y / shared::kTileSize * map_.tileCount().x + x / shared::kTileSize);
      if (!shared::driesNow(static_cast<uint32_t>(tile), info)) continue;
      const shared::FilmTexel now =
          shared::dried(at(i), beadsAt(i), static_cast<uint32_t>(i), field(map_.nodeMetric(), x, y), info);
      report.tiles[tile].evaporated_pl += now.gone_pl;
      put(i, now);
    }
  }

  void put(int i, const shared::FilmTexel& texel) {
    at(i) = texel.film_pl;
    lay(i, texel.beads);
  }

  int flowed(int i, const std::vector<shared::FilmCell>& cells, const shared::FilmStepInfo& info,
             shared::FilmTile& tile) const {
    const shared::FilmCell& me = cells[static_cast<size_t>(i)];
    int volume = me.volume_pl;
    const auto face = [&](int step, bool along_x, glm::vec2 outward) {
      const shared::FilmCell& other = cells[static_cast<size_t>(i + step)];
      const shared::FilmCell& low = step < 0 ? other : me;
      const shared::FilmCell& high = step < 0 ? me : other;
      const auto between = [&](int low_pl, int low_both_pl, int high_pl, int high_both_pl) {
        return shared::flowBetween_pl(low, low_pl, low_both_pl, high, high_pl, high_both_pl, info);
      };
      const int flow = along_x ? between(low.x_pl, low.x_both_pl, high.x_pl, high.x_both_pl)
                               : between(low.y_pl, low.y_both_pl, high.y_pl, high.y_both_pl);
      const int out = step < 0 ? -flow : flow;
      volume -= out;
      if (other.volume_pl < 0)
        (glm::dot(outward, glm::vec2(info.up_x, info.up_y)) > 0.5f ? tile.blown_pl : tile.drained_pl) += out;
    };
    face(-1, true, {-1, 0});
    face(1, true, {1, 0});
    face(-columns_, false, {0, -1});
    face(columns_, false, {0, 1});
    return volume;
  }

  const glass::PaneMap& map_;
  const glass::UnevenGlass& glass_;
  int columns_, rows_;
  std::vector<int32_t> ridge_;
};

}  // namespace rg::test
