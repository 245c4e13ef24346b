#include "glass/film_gl.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "gl/loader.h"

namespace rg::glass {
namespace {

std::vector<std::string> defines(FilmKernel leaky) {
  std::vector<std::string> all;
  if (leaky != FilmKernel::none) all.emplace_back("RG_LEAKS");
  return all;
}

// Of a program in which some kernel may leak. Which one it is, is told, so that all are compiled once.
void tellLeak(const GladGLContext& gl, const gl::Program& program, FilmKernel leaky) {
  if (leaky == FilmKernel::none) return;
  const GLint place = gl.GetUniformLocation(program.name(), "leaky_kernel");
  if (place >= 0) program.set(place, static_cast<int32_t>(leaky));
}

template <typename T>
void put(unsigned char* to, const T* data, size_t count) {
  if (count > 0) std::memcpy(to, data, count * sizeof(T));
}

// As glassLevel reads them, in rows of whole tiles. Past the grid's edges there is none to ask.
std::vector<uint32_t> stripCodes(const PaneMap& map, const UnevenGlass& glass) {
  const glm::ivec2 size = map.grid().size,
                   strips = map.tileCount() * (shared::kTileSize / glm::ivec2(shared::kStripSize, 1));
  std::vector<uint32_t> codes;
  codes.reserve(static_cast<size_t>(strips.x * strips.y));
  for (int y = 0; y < strips.y; ++y) {
    for (int strip = 0; strip < strips.x; ++strip) {
      uint32_t code = 0;
      for (int k = -1; k <= shared::kStripSize; ++k) {
        const int x = strip * shared::kStripSize + k;
        if (x < 0 || x >= size.x || y >= size.y) continue;
        code |= static_cast<uint32_t>(glass.level(y * size.x + x)) << static_cast<uint32_t>(5 * (k + 1));
      }
      codes.push_back(code);
    }
  }
  return codes;
}

}  // namespace

FilmPrograms::FilmPrograms(const GladGLContext& gl, FilmKernel leaky, bool software) : by_lists(software) {
  const std::vector<std::string> told = defines(leaky);
  const auto make = [&](std::string_view path) { return gl::Program(gl, {path}, told); };
  change = make("glass/film_change.comp");
  sweep = make("glass/film_sweep.comp");
  leave = make("glass/film_leave.comp");
  if (by_lists) {
    wake = make("glass/film_wake.comp");
    flow = make("glass/film_flow.comp");
    dry = make("glass/film_dry.comp");
  } else {
    tile = make("glass/film_tile.comp");
  }
  for (const gl::Program* program : all()) {
    if (*program) tellLeak(gl, *program, leaky);
  }
}

std::array<gl::Program*, 7> FilmPrograms::all() {
  return {&change, &sweep, &leave, &wake, &flow, &dry, &tile};
}

std::shared_ptr<FilmPrograms> makeFilmPrograms(const GladGLContext& gl, FilmKernel leaky) {
  const auto* renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  return std::make_shared<FilmPrograms>(gl, leaky, renderer != nullptr && gl::isSoftwareRenderer(renderer));
}

void abandonFilmPrograms(FilmPrograms& p) {
  for (gl::Program* program : p.all()) program->forget();
}

FilmGl::FilmGl(const GladGLContext& gl, std::shared_ptr<FilmPrograms> programs, const PaneMap& map,
               const UnevenGlass& glass)
    : gl_(gl),
      programs_(std::move(programs)),
      map_(map),
      tiles_(map.tileArea_m2().size()),
      beads_(gl, tiles_ * kTileTexels * sizeof(uint32_t)),
      beads_strips_(gl),
      ridges_(gl, kRidgeBytes),
      states_(gl, tiles_ * kTileStateBytes),
      awake_(gl, sizeof kNoneAwake + 2 * tiles_ * sizeof(int32_t)),
      metric_(gl, std::span<const shared::vec4>(map.nodeMetric())),
      glass_(gl, std::span<const uint32_t>(stripCodes(map, glass))),
      metric_nodes_(gl),
      glass_strips_(gl),
      glass_codes_(gl),
      drive_(gl, map.nodeMetric().size() * sizeof(shared::vec4), 0),
      drive_nodes_(gl),
      ordered_drive_nodes_(gl),
      picture_(gl, GL_R32I, map.grid().size.x, map.grid().size.y),
      beads_picture_(gl, GL_R32UI, map.grid().size.x, map.grid().size.y),
      change_of_(static_cast<size_t>(map.texelCount()), -1),
      thrown_before_pl_(kRidgePieces, 0) {
  metric_nodes_.show(GL_RGBA32F, sizeof(shared::vec4), metric_, 0, metric_.bytes());
  drive_nodes_.show(GL_RGBA32F, sizeof(shared::vec4), drive_, 0, drive_.bytes());
  glass_strips_.show(GL_RGBA32UI, shared::kTileSize / shared::kStripSize * sizeof(uint32_t), glass_, 0,
                     glass_.bytes());
  glass_codes_.show(GL_R32UI, sizeof(uint32_t), glass_, 0, glass_.bytes());
  for (size_t i = 0; i < film_.size(); ++i) {
    film_[i] = gl::Buffer(gl, tiles_ * kTileTexels * sizeof(int32_t));
    film_strips_[i] = gl::BufferTexture(gl);
    film_strips_[i].show(GL_RGBA32I, shared::kStripSize * sizeof(int32_t), film_[i], 0, film_[i].bytes());
  }
  beads_strips_.show(GL_RGBA32UI, shared::kStripSize * sizeof(uint32_t), beads_, 0, beads_.bytes());
  clear();
}

// In a buffer of the film, as in film_buffers.glsl.
size_t FilmGl::place(int texel) const {
  const int columns = map_.grid().size.x;
  return static_cast<size_t>(texel / columns * map_.tileCount().x * shared::kTileSize + texel % columns);
}

// Dry inside, -1 off the pane.
void FilmGl::clear() {
  std::vector<int32_t> dry(tiles_ * kTileTexels, -1);
  for (int i = 0; i < map_.texelCount(); ++i) {
    if (map_.inside(i)) dry[place(i)] = 0;
  }
  for (gl::Buffer& film : film_) film.write(0, std::span<const int32_t>(dry));
  // Not cleared: what a driver (NVIDIA 580) is told to clear it may clear after what is written next.
  const std::vector<unsigned char> zeros(std::max({beads_.bytes(), ridges_.bytes(), states_.bytes()}), 0);
  for (gl::Buffer* buffer : {&beads_, &ridges_, &states_}) buffer->write(0, zeros.data(), buffer->bytes());
  awake_.write(0, std::span<const uint32_t>(kNoneAwake));
  dry_ = true;
  picture_is_old_ = beads_picture_is_old_ = true;
}

// Orders of up to kStepsInBatch steps, where the GPU reads them: a copy of them would be one more thing that
// its kernels wait for.
std::vector<FilmGl::Step> FilmGl::begin(std::span<const FilmOrder> orders) {
  std::vector<Step> steps;
  size_t bytes = 0, report_bytes = 0;
  for (const FilmOrder& order : orders) {
    steps.push_back({this, &order, 0, bytes, report_bytes});
    bytes += UploadLayout(order).bytes;
    report_bytes += ReportLayout(tiles_, order.takes.size()).bytes;
  }
  begun_ = freeBatch(bytes, report_bytes);
  for (Step& step : steps) {
    const FilmOrder& order = *step.order;
    const UploadLayout at(order);
    const std::vector<shared::FilmChange> changes = changesOf(order);
    step.changes = changes.size();
    unsigned char* start = begun_->orders + step.upload_at;
    put(start + at.info, &order.info, 1);
    put(start + at.drive, order.drive.data(), order.drive.size());
    put(start + at.changes, changes.data(), changes.size());
    put(start + at.ranges, order.sweep_ranges.data(), order.sweep_ranges.size());
    put(start + at.leaves, order.leaves.data(), order.leaves.size());
    put(start + at.texels, order.leave_texels.data(), order.leave_texels.size());
  }
  return steps;
}

// False when nothing runs: the pane is dry.
bool FilmGl::wakes(const Step& step) {
  const FilmOrder& order = *step.order;
  if (order.clear) clear();
  if (!order.adds.empty() || !order.bead_adds.empty() || !order.ridge_adds.empty()) {
    dry_ = false;
    watered_step_ = order.step;
  }
  ridged_ |= !order.ridge_adds.empty() || !order.sweeps.empty();
  const bool asleep = dry_ && order.slid.empty();
  begun_->steps.push_back({order.step, order.takes.size(), order.clear, asleep, ridged_, step.report_at});
  return !asleep;
}

void FilmGl::end() {
  begun_->fence = gl::Fence(gl_);
  pending_.push_back(std::move(begun_));
}

// What happens to a texel in a step comes together: what is taken from it, then what it is given. Off the
// glass a texel holds -1: so much less goes to one that is hidden, so much more to one that is shown again.
std::vector<shared::FilmChange> FilmGl::changesOf(const FilmOrder& order) {
  std::vector<shared::FilmChange> changes;
  changes.reserve(order.takes.size() + order.slid.size() + order.adds.size() + order.bead_adds.size() +
                  order.ridge_adds.size());
  const auto of = [&](int texel) -> shared::FilmChange& {
    int& known = change_of_[static_cast<size_t>(texel)];
    if (known < 0) {
      known = static_cast<int>(changes.size());
      changes.push_back({texel, 0, 0, -1, 0, 0});
    }
    return changes[static_cast<size_t>(known)];
  };
  for (const shared::FilmTake& take : order.takes) {
    shared::FilmChange& change = of(take.texel);
    change.share_65536 = take.share_65536;
    change.take = static_cast<int>(&take - order.takes.data());
  }
  for (const SlidTexel& slid : order.slid) of(slid.texel).added_pl += slid.shown ? 1 : -1;
  for (const shared::FilmAdd& add : order.adds) of(add.texel).added_pl += add.volume_pl;
  for (const shared::BeadAdd& add : order.bead_adds) {
    shared::FilmChange& change = of(add.texel);
    change.beads_pl = add.volume_pl;
    change.beads = add.number;
  }
  for (const shared::FilmChange& change : changes) change_of_[static_cast<size_t>(change.texel)] = -1;
  for (const shared::RidgeAdd& add : order.ridge_adds)
    changes.push_back({-1 - add.segment, add.volume_pl, 0, -1, 0, 0});
  return changes;
}

std::unique_ptr<FilmGl::Batch> FilmGl::freeBatch(size_t upload_bytes, size_t report_bytes) {
  std::unique_ptr<Batch> batch;
  if (free_.empty()) {
    batch = std::make_unique<Batch>();
  } else {
    batch = std::move(free_.back());
    free_.pop_back();
  }
  if (batch->upload.bytes() < upload_bytes) {
    constexpr GLbitfield kWritten = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const size_t bytes = upload_bytes + upload_bytes / 2;
    batch->upload = gl::Buffer(gl_, bytes, kWritten);
    batch->orders = static_cast<unsigned char*>(batch->upload.map(0, bytes, kWritten));
  }
  if (batch->report.bytes() < report_bytes) {
    constexpr GLbitfield kRead = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const size_t bytes = report_bytes + report_bytes / 2;
    batch->report = gl::Buffer(gl_, bytes, kRead);
    batch->mapped = static_cast<const unsigned char*>(batch->report.map(0, bytes, kRead));
  }
  batch->steps.clear();
  return batch;
}

const gl::Texture2D& FilmGl::picture() {
  if (std::exchange(picture_is_old_, false)) show(film_[turn_], GL_INT, picture_);
  return picture_;
}

const gl::Texture2D& FilmGl::beadsPicture() {
  if (std::exchange(beads_picture_is_old_, false)) show(beads_, GL_UNSIGNED_INT, beads_picture_);
  return beads_picture_;
}

void FilmGl::show(const gl::Buffer& texels, GLenum type, gl::Texture2D& picture) {
  gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, texels.name());
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, map_.tileCount().x * shared::kTileSize);
  picture.write(0, 0, 0, 0, picture.width(), picture.height(), GL_RED_INTEGER, type, nullptr);
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

GLuint FilmGl::sweptBuffer(const SweepOrder& order) {
  for (const Swept& swept : swept_) {
    if (swept.list == order.swept) return swept.buffer.name();
  }
  // Lists of wipers that are no more are kept by nobody else.
  std::erase_if(swept_, [](const Swept& swept) { return swept.list.use_count() == 1; });
  swept_.push_back({order.swept, gl::Buffer(gl_, std::span<const shared::SweptTexel>(*order.swept))});
  return swept_.back().buffer.name();
}

FilmReport FilmGl::read(const Batch& batch, size_t index) {
  const ReportLayout at(tiles_, batch.steps[index].takes);
  const unsigned char* from = batch.mapped + batch.steps[index].report_at;
  FilmReport report;
  report.step = batch.steps[index].step;
  if (batch.steps[index].asleep) {
    if (batch.steps[index].clear) thrown_before_pl_.assign(kRidgePieces, 0);
    report.tiles.assign(tiles_, shared::FilmTile{-1, 0, 0, 0, 0, 0, 0, 0});
    report.taken_pl.assign(batch.steps[index].takes, 0);
    return report;
  }
  report.tiles.resize(tiles_);
  std::memcpy(report.tiles.data(), from, tiles_ * sizeof(shared::FilmTile));
  report.taken_pl.resize(batch.steps[index].takes);
  if (!report.taken_pl.empty())
    std::memcpy(report.taken_pl.data(), from + at.taken, report.taken_pl.size() * sizeof(int));
  readRidges(batch, index, report);
  const bool empty = std::all_of(report.tiles.begin(), report.tiles.end(), [](const shared::FilmTile& tile) {
    return tile.film_low_pl == 0 && tile.film_high == 0 && tile.beads_pl == 0;
  });
  if (empty && report.ridge_pl == 0 && report.step >= watered_step_) dry_ = true;
  return report;
}

void FilmGl::readRidges(const Batch& batch, size_t index, FilmReport& report) {
  const Batch::Step& step = batch.steps[index];
  if (step.clear) thrown_before_pl_.assign(kRidgePieces, 0);
  if (!step.ridged) return;
  std::array<std::array<uint32_t, kRidgePieces>, 2> told;
  static_assert(sizeof told == kRidgeBytes);
  const ReportLayout at(tiles_, step.takes);
  std::memcpy(told.data(), batch.mapped + step.report_at + at.ridges, kRidgeBytes);
  const auto& [held_pl, thrown_pl] = told;
  for (size_t piece = 0; piece < kRidgePieces; ++piece) {
    report.ridge_pl += static_cast<int32_t>(held_pl[piece]);
    const uint32_t thrown = thrown_pl[piece] - std::exchange(thrown_before_pl_[piece], thrown_pl[piece]);
    if (thrown > 0) report.thrown.push_back({static_cast<int>(piece), -1, static_cast<int>(thrown)});
  }
}

std::vector<FilmReport> FilmGl::collect(bool wait) {
  std::vector<FilmReport> reports;
  if (pending_.empty() || (!wait && !pending_.front()->fence.passed())) return reports;
  std::unique_ptr<Batch> batch = std::move(pending_.front());
  pending_.pop_front();
  batch->fence.wait();
  for (size_t i = 0; i < batch->steps.size(); ++i) reports.push_back(read(*batch, i));
  free_.push_back(std::move(batch));
  return reports;
}

template <typename T>
std::vector<T> FilmGl::readTexels(const gl::Buffer& texels) const {
  std::vector<T> all(tiles_ * kTileTexels), out(static_cast<size_t>(map_.texelCount()));
  texels.read(0, all.data(), all.size() * sizeof(T));
  for (int i = 0; i < map_.texelCount(); ++i) out[static_cast<size_t>(i)] = all[place(i)];
  return out;
}

std::vector<int32_t> FilmGl::readFilm() const { return readTexels<int32_t>(film_[turn_]); }
std::vector<uint32_t> FilmGl::readBeads() const { return readTexels<uint32_t>(beads_); }

std::vector<int32_t> FilmGl::readRidges() const {
  std::vector<int32_t> out(kRidgePieces);
  ridges_.read(0, out.data(), out.size() * sizeof(int32_t));
  return out;
}

FilmState FilmGl::state() const {
  FilmState out{readFilm(), readBeads(), readRidges(), std::vector<uint8_t>(tiles_)};
  std::vector<uint32_t> states(tiles_ * kTileFields);
  states_.read(0, states.data(), states.size() * sizeof(uint32_t));
  for (size_t i = 0; i < tiles_; ++i) {
    const uint32_t stirs = states[i * kTileFields + turn_], awake = states[i * kTileFields + kTileAwake];
    out.tiles[i] =
        static_cast<uint8_t>((stirs != 0 ? FilmState::kStirs : 0) | (awake != 0 ? FilmState::kAwake : 0));
  }
  return out;
}

// Of tiles that are asleep both buffers hold the same film; of the others the next step writes the other one
// wholly. The counters of what was wiped off begin anew: reports tell how far they went on.
void FilmGl::set(const FilmState& state) {
  const std::vector<int32_t> film = inTiles<int32_t>(state.film_pl, -1);
  for (gl::Buffer& buffer : film_) buffer.write(0, std::span<const int32_t>(film));
  beads_.write(0, std::span<const uint32_t>(inTiles<uint32_t>(state.beads, 0)));
  // In one go, see clear().
  std::vector<int32_t> ridges(kRidgeBytes / sizeof(int32_t), 0);
  std::copy(state.ridge_pl.begin(), state.ridge_pl.end(), ridges.begin());
  ridges_.write(0, std::span<const int32_t>(ridges));
  states_.write(0, std::span<const uint32_t>(tileStates(state)));
  awake_.write(0, std::span<const uint32_t>(kNoneAwake));
  thrown_before_pl_.assign(kRidgePieces, 0);
  watered_step_ = -1;
  ridged_ = state.ridgesSum_pl() > 0;
  dry_ = !ridged_ && state.filmSum_pl() == 0 && state.beadsSum_pl() == 0;
  picture_is_old_ = beads_picture_is_old_ = true;
}

template <typename T>
std::vector<T> FilmGl::inTiles(const std::vector<T>& texels, T off) const {
  std::vector<T> all(tiles_ * kTileTexels, off);
  for (int i = 0; i < map_.texelCount(); ++i) all[place(i)] = texels[static_cast<size_t>(i)];
  return all;
}

// As the step that came before left them: of its report only what lies there is asked for again.
std::vector<uint32_t> FilmGl::tileStates(const FilmState& state) const {
  constexpr size_t kFilmLow = kTileLies, kFilmHigh = kTileLies + 1, kBeads = kTileLies + 2;
  std::vector<uint32_t> states(tiles_ * kTileFields, 0);
  const glm::ivec2 size = map_.grid().size;
  for (int i = 0; i < map_.texelCount(); ++i) {
    const int tile = i / size.x / shared::kTileSize * map_.tileCount().x + i % size.x / shared::kTileSize;
    uint32_t* of_tile = &states[static_cast<size_t>(tile) * kTileFields];
    const auto k = static_cast<size_t>(i);
    const auto film_pl = static_cast<uint32_t>(std::max(state.film_pl[k], 0));
    of_tile[kFilmLow] += film_pl & 0xffff;
    of_tile[kFilmHigh] += film_pl >> 16;
    of_tile[kBeads] += state.beads[k] & 0xffffffu;
  }
  for (size_t t = 0; t < tiles_; ++t) {
    states[t * kTileFields + turn_] = (state.tiles[t] & FilmState::kStirs) != 0 ? 1 : 0;
    states[t * kTileFields + kTileAwake] = (state.tiles[t] & FilmState::kAwake) != 0 ? 1 : 0;
  }
  return states;
}

void FilmGl::abandon() {
  for (gl::Buffer& film : film_) film.forget();
  for (gl::BufferTexture& strips : film_strips_) strips.forget();
  for (gl::BufferTexture* nodes :
       {&metric_nodes_, &drive_nodes_, &ordered_drive_nodes_, &glass_strips_, &glass_codes_, &beads_strips_})
    nodes->forget();
  picture_.forget();
  beads_picture_.forget();
  beads_.forget();
  ridges_.forget();
  states_.forget();
  awake_.forget();
  metric_.forget();
  drive_.forget();
  glass_.forget();
  for (Swept& swept : swept_) swept.buffer.forget();
  while (!pending_.empty()) {
    free_.push_back(std::move(pending_.front()));
    pending_.pop_front();
  }
  for (const auto& batch : free_) {
    batch->upload.forget();
    batch->report.forget();
    batch->fence.forget();
  }
  abandonFilmPrograms(*programs_);
}

}  // namespace rg::glass
