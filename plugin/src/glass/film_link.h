// The CPU's end of the film: gathers what ticks give to it and ask of it into one order a step, and says
// how thick the film is. Without a film (none attached, or a pane that has none)
// water meant for it runs off: it is booked as drained.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "glass/film_order.h"
#include "glass/ledger.h"
#include "glass/pane_map.h"
#include "saved/archive.h"

namespace rg::glass {

// Who ran over a texel.
struct Taker {
  uint32_t slot = 0;
  uint32_t life = 0;  // of the slot, see Drop
  int texel = 0;
  static void visit(auto& a, auto& taker) { a(taker.slot, taker.life, taker.texel); }
};

inline constexpr uint32_t kSeal = UINT32_MAX;  // a taker's slot that is no drop's: the seal of a sill

// Texels about a place.
struct Footprint {
  static constexpr int kFarthest = 8;
  std::array<int, (2 * kFarthest + 1) * (2 * kFarthest + 1)> texels;
  size_t count = 0;
  // Of a volume that is shared out among them, to the last picolitre.
  int64_t share(size_t i, int64_t volume_pl) const {
    const auto each = volume_pl / static_cast<int64_t>(count);
    return i == 0 ? volume_pl - each * static_cast<int64_t>(count - 1) : each;
  }
};

class FilmLink {
 public:
  FilmLink(const PaneMap& map, Ledger& ledger);

  bool attached() const { return attached_; }
  void attach();
  void detach();  // what is on the film or under way is booked as drained

  // Gives water to a texel, or evenly to those within a radius (real metres, `metres` real for a grid metre).
  // Places off the pane get none of it.
  void add(int texel, int64_t volume_pl);
  void fetch(int texel) const { __builtin_prefetch(&sums_[static_cast<size_t>(texel)], 1); }  // before add
  // Beads to a texel: they lie there, or join its film where that flows.
  void addBeads(int texel, int64_t volume_pl, int number);
  Footprint within(glm::dvec2 grid_m, glm::dvec2 metres, double radius_m) const;
  void spread(glm::dvec2 grid_m, glm::dvec2 metres, double radius_m, int64_t volume_pl);
  // Asks for a share of what is on a texel; the report brings it. The first to ask in a step gets it.
  void take(int texel, double share, uint32_t slot, uint32_t life);
  // A texel goes behind the sill or comes back from there, in the first tick of a step. It must hold nothing
  // by then: what is on it the seal takes, and that is drained.
  void slide(int texel, bool shown) { order_.slid.push_back({texel, shown}); }
  void strip(int texel) { take(texel, 1.0, kSeal, 0); }
  // A ridge was put down since the last step closed: texels it lies on cannot be hidden in this one.
  bool leaving() const { return !order_.leaves.empty(); }
  void addToRidge(int segment, int64_t volume_pl);
  // A blade sweeps what lies in `ranges` of its list: one for each piece, and as often as a texel may be met.
  void sweep(const std::shared_ptr<const std::vector<shared::SweptTexel>>& swept,
             const std::vector<shared::SweptRange>& ranges, int first_piece, bool backwards);
  // A ridge's water goes to these texels; to none, or when it is so much: off the glass, over the pane's edge
  // beside `edge_texel` (-1: not known where).
  void leave(int segment, const std::vector<int>& texels, int over_edge_pl, int edge_texel);

  // Closes the step's order and queues it for the GPU.
  void close(int64_t step, std::vector<shared::vec4> drive, const shared::FilmStepInfo& info);
  std::vector<FilmOrder> fetch();

  // Reports come in order and wait here for the tick that uses them.
  void deliver(FilmReport&& report);
  bool reported(int64_t step) const { return !attached_ || step < first_step_ || step <= last_reported_; }
  // The report to be used now, with its takers; false: none.
  bool use(int64_t step, FilmReport& report, std::vector<Taker>& takers);

  // Of the film as last used: tiles' means, linear between their middles. Nowhere is it more than the
  // thickest's.
  double thickness_m(int texel) const;
  // The most that is told anywhere on a tile.
  double mostAbout_m(size_t tile) const { return static_cast<double>(most_about_m_[tile]); }
  double thickest_m() const { return static_cast<double>(thickest_m_); }
  bool watered(int texel) const;  // film or beads are in the tile, as last used

  int64_t film_pl() const { return film_pl_; }
  int64_t beads_pl() const { return beads_pl_; }
  int64_t ridge_pl() const { return ridge_pl_; }
  int64_t travelling_pl() const;
  void clear();  // dry, before the next step
  void skipTo(int64_t next_step) {
    next_step_ = next_step;
  }  // before clear(): those between are never asked for

  // The list that a blade sweeps by the first piece of its ridge; null where there is none.
  using SweptBy = std::function<std::shared_ptr<const std::vector<shared::SweptTexel>>(int)>;
  // Whether it can be written: nothing is under way to the GPU, and no blade swept that is no more.
  bool settled(const SweptBy& swept_by) const;
  void write(saved::Writer& a) const;
  void read(saved::Reader& a, const SweptBy& swept_by);  // by one that is not attached
  // Whether what was read fits a pane's clock: `now` is the step that is being gathered, `asked` the one
  // whose report is used next.
  bool fits(int64_t now, int64_t asked) const;
  const std::vector<SlidTexel>& slidInThisStep() const { return order_.slid; }

 private:
  struct Ordered {
    int64_t step, ordered_pl;
    std::vector<Taker> takers;
    std::vector<shared::RidgeLeave> leaves;
    std::vector<int> leave_edges;
    int edgeOf(int segment) const;
  };
  const PaneMap* map_;
  Ledger* ledger_;
  bool attached_ = false;
  int64_t first_step_ = 0, last_reported_ = -1, next_step_ = 0;
  FilmOrder order_;
  std::vector<int32_t> sums_;      // given to a texel in this step
  std::vector<int> touched_;       // texels with a sum
  std::vector<int32_t> bead_of_;   // texel: its place in the order's bead_adds, -1
  std::vector<int32_t> taken_in_;  // the step in which somebody asked for a texel, its low bits
  std::vector<Taker> takers_;
  std::array<bool, kRidgePieces> leaving_{};  // in this step; the first to say where a ridge goes is right
  int64_t gathered_pl_ = 0;
  std::vector<FilmOrder> outbox_;
  std::deque<Ordered> ordered_;     // not yet reported
  std::deque<FilmReport> reports_;  // not yet used
  std::deque<std::vector<Taker>> report_takers_;
  std::vector<float> tile_thickness_m_, most_about_m_, along_rows_m_;
  float thickest_m_ = 0.0f;
  std::vector<bool> tile_watered_;
  void findMostAbout();
  void checkOrder(const saved::Reader& a) const;
  void findGathered();
  void writeReports(saved::Writer& a) const;
  void readReports(saved::Reader& a);
  int64_t film_pl_ = 0, beads_pl_ = 0, ridge_pl_ = 0;
};

}  // namespace rg::glass
