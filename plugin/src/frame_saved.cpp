// The whole instance as a saved state: a header that tells what it is, and its parts one after another, each
// with its name and length. What a host sets, volumes, panes and wipers, is not in it: panes are known again
// by what their glass is made of.
#include <algorithm>
#include <map>
#include <stdexcept>

#include "frame.h"
#include "glass/film_order.h"
#include "glass/film_state.h"
#include "glass/saved_limits.h"
#include "saved/archive.h"
#include "saved/inputs.h"

namespace rg {
namespace {

using saved::Reader;
using saved::Writer;

constexpr std::string_view kMagic = "RGSAVED\n";
constexpr uint32_t kFormat = 2;  // of all that follows; raised whenever any part is written otherwise
constexpr size_t kLongestName = 64;
constexpr uint32_t kMostPanes = 65536;

// What the numbers in it mean: another build may have others.
constexpr std::array<int64_t, 8> kBuild = {kTickHz,
                                           rain::kClasses,
                                           glass::kRegions,
                                           glass::kRidgePieces,
                                           glass::kTicksPerFilmStep,
                                           glass::kReportLatency_ticks,
                                           shared::kTileSize,
                                           glass::Fog::kCells.x* glass::Fog::kCells.y};

struct Header {
  std::string version = RG_VERSION;
  std::array<int64_t, kBuild.size()> build = kBuild;
  uint64_t body_bytes = 0, checksum = 0;

  template <class Archive>
  static void visit(Archive& a, auto& header) {
    a.text(header.version, kLongestName);
    a(header.build, header.body_bytes, header.checksum);
  }
};

// The body, looked at as far as it can be without knowing what it means.
std::span<const unsigned char> bodyOf(std::span<const unsigned char> bytes) {
  Reader a(bytes, false);
  for (const char c : kMagic) {
    uint8_t byte = 0;
    a(byte);
    a.require(byte == static_cast<uint8_t>(c), "this is no saved state");
  }
  uint32_t format = 0;
  Header header;
  a(format);
  if (format != kFormat)
    a.refuse("its format is " + std::to_string(format) + ", this version reads " + std::to_string(kFormat));
  a(header);
  if (header.version != RG_VERSION || header.build != kBuild)
    a.refuse("another version of the plugin saved it (" + header.version + ", this is " RG_VERSION ")");
  a.require(header.body_bytes >= a.left(), "it is longer than it says");
  const auto body = a.part(header.body_bytes);
  a.require(saved::fingerprintOf(body) == header.checksum, "its checksum is wrong");
  return body;
}

template <class Write>
void writePart(Writer& a, const std::string& name, Write&& write) {
  Writer part;
  write(part);
  const uint64_t bytes = part.bytes.size();
  a.text(name, kLongestName);
  a(bytes);
  a.bytes.insert(a.bytes.end(), part.bytes.begin(), part.bytes.end());
}

// `shown`: the part's name in messages.
template <class Read>
void readPart(Reader& a, const std::string& name, const std::string& shown, Read&& read) {
  std::string found;
  uint64_t bytes = 0;
  a.enter(shown);
  a.text(found, kLongestName);
  a.require(found == name, "this part is missing");
  a(bytes);
  Reader part(a.part(bytes), a.commits());
  part.enter(shown);
  read(part);
  part.require(part.left() == 0, "it is longer than it says");
}

template <class Part>
void take(Reader& a, Part& into) {
  Part part;
  a(part);
  if (a.commits()) into = std::move(part);
}

// Not of the state, but of the machine that it runs on.
bool isOfTheMachine(const SettingInfo& info) { return info.value == &Settings::glass_threads; }

void writeSettings(Writer& a, const Settings& settings) {
  for (const SettingInfo& info : kSettings) {
    if (isOfTheMachine(info)) continue;
    a.text(info.name, kLongestName);
    a(settings.*info.value);
  }
}

void readSettings(Reader& a, Settings& into) {
  Settings settings = into;
  for (const SettingInfo& info : kSettings) {
    if (isOfTheMachine(info)) continue;
    std::string name;
    a.text(name, kLongestName);
    if (name != info.name) a.refuse("\"" + std::string(info.name) + "\" is missing");
    a.within(settings.*info.value, info.minimum, info.maximum);
  }
  if (a.commits()) into = settings;
}

void visitWash(auto& a, auto& wash) {
  constexpr int64_t kMost_pl = INT64_C(2'000'000'000'000);
  a(wash.pane, wash.info.nozzle_m);
  a.within(wash.info.direction, -1.1, 1.1);
  a.within(wash.info.fan_rad, 0.001, 3.1);
  a.within(wash.begin_ns, -2 * kLatestTime_ns, 2 * kLatestTime_ns - 1);
  a.within(wash.end_ns, -2 * kLatestTime_ns, 2 * kLatestTime_ns - 1);
  a.within(wash.volume_pl, 0, kMost_pl);
  a.within(wash.given_pl, 0, kMost_pl);
}

void visitPane(auto& a, auto& p) {
  constexpr int64_t kMostTicks = INT64_C(1) << 40;
  a.within(p.wet_share, 0.0, 1.0);
  a.within(p.tick, 0, kMostTicks);
  a(p.left_out_ticks);
}

std::string called(uint32_t id, const std::string& name) {
  return "pane " + std::to_string(id) + (name.empty() ? "" : " '" + name + "'");
}

}  // namespace

std::vector<unsigned char> Frame::save() {
  const std::lock_guard lock(sim_);
  finishGlass();
  Writer body;
  try {
    writeParts(body, filmStates());
  } catch (const std::logic_error& e) {
    refuse(e.what(), RG_ERROR_WRONG_ORDER);
  }
  Writer out;
  Header header;
  header.body_bytes = body.bytes.size();
  header.checksum = saved::fingerprintOf(body.bytes);
  for (const char c : kMagic) out.bytes.push_back(static_cast<unsigned char>(c));
  out(kFormat, std::as_const(header));
  out.bytes.insert(out.bytes.end(), body.bytes.begin(), body.bytes.end());
  return std::move(out.bytes);
}

void Frame::writeParts(Writer& body, const FilmStates& films) const {
  const bool has_films = !films.empty();
  writePart(body, "clock",
            [&](Writer& a) { a(has_films, started_, next_tick_, prewarm_ticks_, glass_moment_); });
  writePart(body, "parameters", [&](Writer& a) { writeSettings(a, settings_); });
  writePart(body, "timeline", [&](Writer& a) { timeline_.write(a); });
  writePart(body, "rain", [&](Writer& a) { field_.write(a); });
  writePart(body, "beyond", [&](Writer& a) { a(beyond_); });
  writePart(body, "splashes", [&](Writer& a) { a(splashes_); });
  writePart(body, "wetness", [&](Writer& a) { a(wetness_); });
  writePart(body, "washers", [&](Writer& a) {
    a.list(washes_, washes_.size(), [&a](const WashObject& wash) { visitWash(a, wash); });
  });
  writePart(body, "panes", [&](Writer& a) {
    const auto count = static_cast<uint32_t>(panes_.size());
    a(count);
    for (const auto& [id, p] : panes_) {
      a(id);
      a.text(p.sim->name(), kLongestName);
    }
  });
  for (const auto& [id, object] : panes_) {
    const auto film = films.find(id);
    writePart(body, "pane", [&, &p = object](Writer& a) {  // clang captures no bindings before 16
      visitPane(a, p);
      p.fog->write(a);
      p.sim->write(a, film != films.end() ? &film->second : nullptr);
    });
  }
  writePart(body, "pillars", [&](Writer& a) {
    const auto count = static_cast<uint32_t>(pillars_.size());
    a(count);
    for (const auto& [between, pillar] : pillars_) {
      a.both(between);
      pillar->write(a);
    }
  });
}

// First all of it is looked at, and nothing changed; then it is taken.
void Frame::restore(std::span<const unsigned char> bytes) {
  const std::lock_guard lock(sim_);
  const auto body = bodyOf(bytes);
  finishGlass();
  FilmStates films;
  for (const bool commits : {false, true}) {
    Reader a(body, commits);
    films = readParts(a);
  }
  setFilms(films);
  finishGlass();
  glass_fall_mps_ = 0.0;  // asked anew
  tellSettings();
  field_.publishAll(upload_);
  publishBeyond();
  publishSplashes();
  publishWetness();
}

Frame::FilmStates Frame::readParts(Reader& body) {
  const auto part = [&body](const std::string& name, auto&& read) { readPart(body, name, name, read); };
  int64_t glass_moment = 0;
  part("clock", [&](Reader& a) { glass_moment = readClock(a); });
  part("parameters", [this](Reader& a) { readSettings(a, settings_); });
  part("timeline", [this](Reader& a) { timeline_.read(a); });
  part("rain", [this](Reader& a) { field_.read(a); });
  part("beyond", [this](Reader& a) { take(a, beyond_); });
  part("splashes", [this](Reader& a) { take(a, splashes_); });
  part("wetness", [this](Reader& a) { take(a, wetness_); });
  part("washers", [this](Reader& a) { readWashes(a); });
  part("panes", [this](Reader& a) { checkPanes(a); });
  FilmStates films;
  for (auto& [id, p] : panes_) {
    readPart(body, "pane", called(id, p.sim->name()), [&, &object = p, id = id](Reader& a) {
      PaneObject read;
      visitPane(a, read);
      object.fog->read(a);
      if (auto film = object.sim->read(a)) films.emplace(id, std::move(*film));
      if (!a.commits()) return;
      object.wet_share = read.wet_share;
      object.tick = read.tick;
      object.left_out_ticks = read.left_out_ticks;
    });
  }
  // After the panes: where those are others, they say so themselves.
  part("pillars", [&](Reader& a) { readPillars(a, glass_moment); });
  body.require(body.left() == 0, "it is longer than it says");
  return films;
}

int64_t Frame::readClock(Reader& a) {
  constexpr int64_t kMostPrewarm = 600 * kTickHz;
  bool has_films = false, started = false;
  int64_t next_tick = 0, prewarm_ticks = 0, glass_moment = 0;
  a(has_films, started);
  a.within(next_tick, -kLatestTick, kLatestTick);
  a.within(prewarm_ticks, 0, kMostPrewarm);
  a.within(glass_moment, int64_t{0}, glass::kMostSavedTicks);
  if (has_films && !gl_)
    refuse("saved state: there is water on the panes' films, which live on the GPU; attach_gl first",
           RG_ERROR_WRONG_ORDER);
  if (!a.commits()) return glass_moment;
  started_ = started;
  next_tick_ = next_tick;
  prewarm_ticks_ = prewarm_ticks;
  return glass_moment_ = glass_moment;
}

void Frame::readWashes(Reader& a) {
  std::vector<WashObject> washes;
  std::map<uint32_t, uint32_t> on_pane;
  a.list(washes, panes_.size() * glass::kMostWashings, [&](WashObject& wash) {
    visitWash(a, wash);
    const auto on = panes_.find(wash.pane);
    a.require(on != panes_.end(), "a pane is washed that is not there");
    // Before its jet is made, which takes a look at all of the pane.
    a.require(++on_pane[wash.pane] <= glass::kMostWashings, "more jets wash a pane than can");
    a.require(wash.begin_ns < wash.end_ns && wash.given_pl <= wash.volume_pl, "a jet ends before it begins");
    wash.jet = std::make_shared<const glass::Jet>(wash.info, on->second.sim->map(), on->second.sim->name());
  });
  if (a.commits()) washes_ = std::move(washes);
}

void Frame::readPillars(Reader& a, int64_t glass_moment) {
  uint32_t count = 0;
  a(count);
  a.require(count == pillars_.size(), "the panes stood elsewhere");
  for (auto& [between, pillar] : pillars_) {
    std::pair<uint32_t, uint32_t> found;
    a.both(found);
    a.require(found == between, "the panes stood elsewhere");
    pillar->read(a, glass_moment);
  }
}

// The same panes, by their ids; what each is made of tells its own part.
void Frame::checkPanes(Reader& a) const {
  uint32_t count = 0;
  std::vector<uint32_t> ids;
  a.within(count, 0u, kMostPanes);
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t id = 0;
    std::string name;
    a(id);
    a.text(name, kLongestName);
    if (!panes_.contains(id)) a.refuse(called(id, name) + " is not set here; set it first, as it was");
    a.require(ids.empty() || ids.back() < id, "ids do not ascend");
    ids.push_back(id);
  }
  for (const auto& [id, p] : panes_) {
    if (std::ranges::find(ids, id) == ids.end())
      a.refuse(called(id, p.sim->name()) + " was not there when it was saved; remove it first");
  }
}

}  // namespace rg
