// A pane as a saved state: told apart by its glass, and only taken where its ledger closes.
#include <stdexcept>

#include "glass/film_state.h"
#include "glass/pane_state.h"
#include "glass/saved_limits.h"
#include "shared/glass_types.glsl"
#include "tick.h"

namespace rg::glass {
namespace {

// What of the last tick is asked for between ticks.
void visitNow(auto& a, auto& now) {
  constexpr double kMost_mps2 = 1e15, kMost_mps = 1e6;
  a.within(now.index, 0, kMostSavedTicks);
  a.within(now.acceleration_mps2, -kMost_mps2, kMost_mps2);
  a.within(now.air_mps, -kMost_mps, kMost_mps);
  a.within(now.temperature_c, -60.0, 60.0);
  a.within(now.humidity, 0.0, 1.0);
  a.within(now.opening_m, 0.0, 10.0);
}

void visitLedger(auto& a, auto& ledger) {
  for (auto* term : {&ledger.caught_pl, &ledger.run_on_pl, &ledger.drained_pl, &ledger.wiped_pl,
                     &ledger.blown_pl, &ledger.evaporated_pl})
    a.within(*term, 0, kMostSaved_pl);
}

void mixIn(saved::Writer& a, const auto& list) {
  for (const auto& item : list) a(item);
}

}  // namespace

// The numbers as the host gave them: what is made of them may differ in its last digits from one processor to
// another.
uint64_t PaneSim::State::fingerprintOf(const PaneInfo& info) {
  saved::Writer a;
  mixIn(a, info.positions_m);
  mixIn(a, info.uvs);
  mixIn(a, info.indices);
  const auto glass = static_cast<int32_t>(info.glass);
  a(glass, info.advancing_rad, info.receding_rad, info.texel_m, info.max_drops, info.film_enabled);
  a(info.unevenness, info.slide_direction, info.sill);
  return saved::fingerprintOf(a.bytes);
}

void PaneSim::write(saved::Writer& a, const FilmState* film) const {
  const std::lock_guard lock(state_->mutex);
  const State& s = *state_;
  if (!s.waiting.empty() || !s.film.settled(State::sweptBy(s)))
    throw std::logic_error(
        "pane '" + s.name +
        "': what it was told has not been done yet; save after the next update and step_gpu");
  const bool has_film = film != nullptr, has_forces = !s.forces.empty();
  const uint64_t slid = s.slid, slid_on_film = s.slid_on_film;
  a(s.fingerprint, s.ticks, s.dropped_ticks, slid, slid_on_film, has_forces);
  visitNow(a, s.now);
  visitLedger(a, s.ledger);
  s.drops.write(a);
  s.craters.write(a);
  s.blades.write(a);
  s.film.write(a);
  a(has_film);
  if (has_film) film->write(a);
}

std::optional<FilmState> PaneSim::read(saved::Reader& a) {
  const std::lock_guard lock(state_->mutex);
  State& s = *state_;
  uint64_t fingerprint = 0, dropped_ticks = 0, slid = 0, slid_on_film = 0;
  int64_t ticks = 0;
  bool has_forces = false, has_film = false;
  PaneTick now;
  Ledger ledger;
  a(fingerprint);
  a.require(fingerprint == s.fingerprint, "its glass was another; set the pane as it was");
  a.within(ticks, 0, kMostSavedTicks);
  a(dropped_ticks);
  const auto texels = static_cast<uint64_t>(s.map.texelCount());
  a.within(slid, uint64_t{0}, texels), a.within(slid_on_film, uint64_t{0}, texels);
  const size_t all = slid + slid_on_film > 0 ? s.slide.texels(s.map) : 0;
  a.require(slid <= all && slid_on_film <= all, "more of it is behind its sill than there is");
  a(has_forces);
  visitNow(a, now);
  visitLedger(a, ledger);
  const int64_t drops_pl = s.drops.read(a);
  s.craters.read(a);
  s.blades.read(a);
  FilmLink link(s.map, s.ledger);
  link.read(a, State::sweptBy(s));
  const int64_t step = ticks / kTicksPerFilmStep + 1;
  a.require(link.fits(step, State::stepUsedBy(step * kTicksPerFilmStep)), "its film is of another time");
  a(has_film);
  a.require(has_film == link.attached(), "its film is missing");
  a.require(!has_film || s.film.attached(), "it has a film, and here there is no GL for one");
  std::optional<FilmState> film;
  if (has_film) {
    film.emplace().read(a, s.map, s.hiddenOnFilm(a, link, slid_on_film));
    a.require(film->filmSum_pl() == link.film_pl() && film->beadsSum_pl() == link.beads_pl() &&
                  film->ridgesSum_pl() == link.ridge_pl(),
              "its film holds other water than was told");
  }
  const int64_t on_glass_pl =
      drops_pl + link.film_pl() + link.beads_pl() + link.ridge_pl() + link.travelling_pl();
  a.require(ledger.run_on_pl <= ledger.caught_pl, "more came from other panes than came at all");
  a.require(ledger.caught_pl == on_glass_pl + ledger.gone_pl(), "its ledger does not close");
  if (!a.commits()) return film;

  s.waiting.clear();
  s.tellOwed();
  s.ticks = ticks;
  s.dropped_ticks = dropped_ticks;
  s.now = now;
  s.ledger = ledger;
  s.slideTo(slid);
  s.takeFilm(std::move(link), slid_on_film);
  s.forces.clear();
  if (has_forces)
    s.forces.make(s.map, now.acceleration_mps2, now.air_mps, now.opening_m * s.slide.direction());
  s.snapshot.reset();
  return film;
}

bool PaneSim::filmAttached() const {
  const std::lock_guard lock(state_->mutex);
  return state_->film.attached();
}

void PaneSim::State::slideTo(size_t gone) {
  std::vector<int> texels;
  for (size_t i = std::min(slid, gone); i < std::max(slid, gone); ++i) texels.push_back(slide.texel(map, i));
  if (!texels.empty()) map.show(texels, gone < slid);
  slid = gone;
}

// Where there is a GPU and the state knew none the film begins dry, as after attaching.
void PaneSim::State::takeFilm(FilmLink&& link, size_t gone_on_film) {
  const bool was_attached = film.attached();
  film = std::move(link);
  slid_on_film = gone_on_film;
  if (!was_attached || film.attached()) return;
  film.attach();
  film.clear();
  for (size_t i = 0; i < slid; ++i) film.slide(slide.texel(map, i), false);
  slid_on_film = slid;
}

// What the link's order hides or shows has not happened yet: gone back from where it ends, the last first.
std::vector<bool> PaneSim::State::hiddenOnFilm(const saved::Reader& a, const FilmLink& link,
                                               size_t gone_on_film) {
  std::vector<bool> hidden(static_cast<size_t>(map.texelCount()), false);
  for (size_t i = 0; i < gone_on_film; ++i) hidden[static_cast<size_t>(slide.texel(map, i))] = true;
  const std::vector<SlidTexel>& slid_now = link.slidInThisStep();
  for (auto it = slid_now.rbegin(); it != slid_now.rend(); ++it) {
    const auto texel = static_cast<size_t>(it->texel);
    a.require(hidden[texel] != it->shown, "a texel is hidden or shown that is so already");
    hidden[texel] = it->shown;
  }
  return hidden;
}

}  // namespace rg::glass
