#include "glass/film_gl.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

namespace rg::glass {
namespace {

constexpr size_t kStepsInBatch = 16;
constexpr size_t kAlign = 256;  // GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT is at most this
constexpr size_t kTileStateBytes = 4 * sizeof(int32_t);  // TileState in film_buffers.glsl
constexpr size_t kRidgeBytes = (kRidgePieces + 1) * sizeof(int32_t);

size_t aligned(size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

// Where the parts of an order lie in the upload, from its start.
struct UploadLayout {
  explicit UploadLayout(const FilmOrder& order) {
    info = next(sizeof(shared::FilmStepInfo));
    drive = next(order.drive.size() * sizeof(shared::vec4));
    takes = next(order.takes.size() * sizeof(shared::FilmTake));
    adds = next(order.adds.size() * sizeof(shared::FilmAdd));
    ridge_adds = next(order.ridge_adds.size() * sizeof(shared::RidgeAdd));
    ranges = next(order.sweep_ranges.size() * sizeof(shared::SweptRange));
    leaves = next(order.leaves.size() * sizeof(shared::RidgeLeave));
    texels = next(order.leave_texels.size() * sizeof(int));
  }
  size_t next(size_t part) { return std::exchange(bytes, bytes + aligned(part)); }
  size_t bytes = 0;
  size_t info, drive, takes, adds, ridge_adds, ranges, leaves, texels;
};

// Where the parts of a report lie, from its start.
struct ReportLayout {
  explicit ReportLayout(size_t tiles)
      : ridges(aligned(tiles * sizeof(shared::FilmTile))),
        taken(ridges + aligned(kRidgeBytes)),
        bytes(taken + aligned(kMostTakes * sizeof(int))) {}
  size_t ridges, taken, bytes;
};

std::vector<std::string> defines(bool leaky) {
  return leaky ? std::vector<std::string>{"RG_LEAK"} : std::vector<std::string>{};
}

template <typename T>
void put(std::vector<unsigned char>& bytes, size_t at, const T* data, size_t count) {
  if (count > 0) std::memcpy(bytes.data() + at, data, count * sizeof(T));
}

}  // namespace

FilmPrograms::FilmPrograms(const GladGLContext& gl, FilmKernel leaky)
    : take(gl, {"glass/film_take.comp"}, defines(leaky == FilmKernel::take)),
      add(gl, {"glass/film_add.comp"}, defines(leaky == FilmKernel::add)),
      ridge(gl, {"glass/ridge_add.comp"}, defines(leaky == FilmKernel::ridge)),
      sweep(gl, {"glass/film_sweep.comp"}, defines(leaky == FilmKernel::sweep)),
      leave(gl, {"glass/film_leave.comp"}, defines(leaky == FilmKernel::leave)),
      wish(gl, {"glass/film_wish.comp"}, {}),
      flow(gl, {"glass/film_flow.comp"}, defines(leaky == FilmKernel::step)) {}

std::shared_ptr<FilmPrograms> makeFilmPrograms(const GladGLContext& gl, FilmKernel leaky) {
  return std::make_shared<FilmPrograms>(gl, leaky);
}

void abandonFilmPrograms(FilmPrograms& p) {
  for (gl::Program* program : {&p.take, &p.add, &p.ridge, &p.sweep, &p.leave, &p.wish, &p.flow})
    program->forget();
}

FilmGl::FilmGl(const GladGLContext& gl, std::shared_ptr<FilmPrograms> programs, const PaneMap& map)
    : gl_(gl),
      programs_(std::move(programs)),
      map_(map),
      tiles_(map.tileArea_m2().size()),
      film_(gl, GL_R32I, map.grid().size.x, map.grid().size.y),
      wishes_(gl, GL_RGBA32I, map.grid().size.x, map.grid().size.y),
      ridges_(gl, kRidgeBytes),
      states_(gl, tiles_ * kTileStateBytes),
      metric_(gl, std::span<const shared::vec4>(map.nodeMetric())) {
  clear();
}

// Dry inside, -1 off the pane.
void FilmGl::clear() {
  std::vector<int32_t> dry;
  std::vector<glm::ivec4> no_wishes;
  for (int i = 0; i < map_.texelCount(); ++i) {
    dry.push_back(map_.inside(i) ? 0 : -1);
    no_wishes.emplace_back(dry.back(), 0, 0, 0);
  }
  const glm::ivec2 size = map_.grid().size;
  film_.write(0, 0, 0, 0, size.x, size.y, GL_RED_INTEGER, GL_INT, dry.data());
  wishes_.write(0, 0, 0, 0, size.x, size.y, GL_RGBA_INTEGER, GL_INT, no_wishes.data());
  ridges_.zero();
  states_.zero();
  dry_ = true;
}

void FilmGl::run(std::vector<FilmOrder>&& orders) {
  for (size_t first = 0; first < orders.size(); first += kStepsInBatch) {
    runBatch(std::span(orders).subspan(first, std::min(kStepsInBatch, orders.size() - first)));
  }
}

void FilmGl::runBatch(std::span<FilmOrder> orders) {
  std::vector<size_t> starts;
  size_t bytes = 0;
  for (const FilmOrder& order : orders) {
    starts.push_back(bytes);
    bytes += UploadLayout(order).bytes;
  }
  std::vector<unsigned char> upload(bytes);
  for (size_t i = 0; i < orders.size(); ++i) {
    const FilmOrder& order = orders[i];
    const UploadLayout at(order);
    put(upload, starts[i] + at.info, &order.info, 1);
    put(upload, starts[i] + at.drive, order.drive.data(), order.drive.size());
    put(upload, starts[i] + at.takes, order.takes.data(), order.takes.size());
    put(upload, starts[i] + at.adds, order.adds.data(), order.adds.size());
    put(upload, starts[i] + at.ridge_adds, order.ridge_adds.data(), order.ridge_adds.size());
    put(upload, starts[i] + at.ranges, order.sweep_ranges.data(), order.sweep_ranges.size());
    put(upload, starts[i] + at.leaves, order.leaves.data(), order.leaves.size());
    put(upload, starts[i] + at.texels, order.leave_texels.data(), order.leave_texels.size());
  }
  std::unique_ptr<Batch> batch = freeBatch(bytes);
  batch->upload.write(0, upload.data(), bytes);
  const ReportLayout report(tiles_);
  for (size_t i = 0; i < orders.size(); ++i) {
    if (orders[i].clear) clear();
    if (!orders[i].adds.empty() || !orders[i].ridge_adds.empty()) {
      dry_ = false;
      watered_step_ = orders[i].step;
    }
    if (!dry_) runStep(orders[i], *batch, starts[i], i * report.bytes);
    batch->steps.push_back({orders[i].step, orders[i].takes.size(), orders[i].clear, dry_});
  }
  gl_.MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  batch->fence = gl::Fence(gl_);
  pending_.push_back(std::move(batch));
}

std::unique_ptr<FilmGl::Batch> FilmGl::freeBatch(size_t upload_bytes) {
  std::unique_ptr<Batch> batch;
  if (free_.empty()) {
    batch = std::make_unique<Batch>();
  } else {
    batch = std::move(free_.back());
    free_.pop_back();
  }
  if (batch->upload.bytes() < upload_bytes) batch->upload = gl::Buffer(gl_, upload_bytes + upload_bytes / 2);
  if (batch->mapped == nullptr) {
    constexpr GLbitfield kRead = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const size_t bytes = ReportLayout(tiles_).bytes * kStepsInBatch;
    batch->report = gl::Buffer(gl_, bytes, kRead);
    batch->mapped = static_cast<const unsigned char*>(batch->report.map(0, bytes, kRead));
  }
  batch->steps.clear();
  return batch;
}

void FilmGl::dispatch(const gl::Program& program, size_t count) {
  program.set(0, static_cast<int32_t>(count));
  program.use();
  gl_.DispatchCompute(static_cast<GLuint>((count + 63) / 64), 1, 1);
  gl_.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void FilmGl::runStep(const FilmOrder& order, const Batch& batch, size_t upload_at, size_t report_at) {
  const UploadLayout at(order);
  const ReportLayout report(tiles_);
  const auto bind = [&](GLuint binding, const gl::Buffer& buffer, size_t offset, size_t bytes) {
    gl_.BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer.name(), static_cast<GLintptr>(offset),
                        static_cast<GLsizeiptr>(bytes));
  };
  const auto orders = [&](size_t part, size_t bytes) { bind(0, batch.upload, upload_at + part, bytes); };
  gl_.BindBufferRange(GL_UNIFORM_BUFFER, 0, batch.upload.name(), static_cast<GLintptr>(upload_at + at.info),
                      sizeof(shared::FilmStepInfo));
  bind(1, ridges_, 0, kRidgeBytes);
  bind(5, states_, 0, tiles_ * kTileStateBytes);
  gl_.BindImageTexture(0, film_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32I);
  gl_.BindImageTexture(1, wishes_.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32I);
  if (!order.takes.empty()) {
    orders(at.takes, order.takes.size() * sizeof(shared::FilmTake));
    bind(2, batch.report, report_at + report.taken, kMostTakes * sizeof(int));
    dispatch(programs_->take, order.takes.size());
  }
  if (!order.adds.empty()) {
    orders(at.adds, order.adds.size() * sizeof(shared::FilmAdd));
    dispatch(programs_->add, order.adds.size());
  }
  if (!order.ridge_adds.empty()) {
    orders(at.ridge_adds, order.ridge_adds.size() * sizeof(shared::RidgeAdd));
    dispatch(programs_->ridge, order.ridge_adds.size());
  }
  for (const SweepOrder& sweep : order.sweeps) {
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, sweptBuffer(sweep));
    // One work group sweeps, an invocation for each piece; so many ranges keep offsets aligned.
    constexpr size_t kRanges = shared::kBladeSegments * sizeof(shared::SweptRange);
    static_assert(kRanges % kAlign == 0);
    bind(2, batch.upload,
         upload_at + at.ranges + static_cast<size_t>(sweep.first_range) * sizeof(shared::SweptRange),
         kRanges);
    programs_->sweep.set(1, sweep.first_piece);
    programs_->sweep.set(2, static_cast<int32_t>(sweep.backwards));
    dispatch(programs_->sweep, 1);
  }
  if (!order.leaves.empty()) {
    orders(at.leaves, order.leaves.size() * sizeof(shared::RidgeLeave));
    bind(2, batch.upload, upload_at + at.texels,
         std::max(sizeof(int), order.leave_texels.size() * sizeof(int)));
    dispatch(programs_->leave, order.leaves.size());
  }
  bind(2, batch.report, report_at, tiles_ * sizeof(shared::FilmTile));
  bind(3, batch.upload, upload_at + at.drive, order.drive.size() * sizeof(shared::vec4));
  gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, metric_.name());
  const auto tiles = glm::uvec2(map_.tileCount());
  programs_->wish.use();
  gl_.DispatchCompute(tiles.x, tiles.y, 1);
  gl_.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  programs_->flow.use();
  gl_.DispatchCompute(tiles.x, tiles.y, 1);
  gl_.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
  gl_.CopyNamedBufferSubData(ridges_.name(), batch.report.name(), 0,
                             static_cast<GLintptr>(report_at + report.ridges), kRidgeBytes);
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
  const ReportLayout at(tiles_);
  const unsigned char* from = batch.mapped + index * at.bytes;
  FilmReport report;
  report.step = batch.steps[index].step;
  if (batch.steps[index].asleep) {
    if (batch.steps[index].clear) wiped_before_ = 0;
    report.tiles.assign(tiles_, shared::FilmTile{-1, 0, 0, 0, 0, 0, 0, 0});
    report.taken_pl.assign(batch.steps[index].takes, 0);
    return report;
  }
  report.tiles.resize(tiles_);
  std::memcpy(report.tiles.data(), from, tiles_ * sizeof(shared::FilmTile));
  report.taken_pl.resize(batch.steps[index].takes);
  if (!report.taken_pl.empty())
    std::memcpy(report.taken_pl.data(), from + at.taken, report.taken_pl.size() * sizeof(int));
  std::vector<int32_t> ridges(kRidgePieces + 1);
  std::memcpy(ridges.data(), from + at.ridges, kRidgeBytes);
  for (size_t i = 0; i < kRidgePieces; ++i) report.ridge_pl += ridges[i];
  const auto wiped = static_cast<uint32_t>(ridges.back());
  if (batch.steps[index].clear) wiped_before_ = 0;
  report.wiped_pl = static_cast<int64_t>(wiped - wiped_before_);  // modulo 2^32
  wiped_before_ = wiped;
  const bool empty = std::all_of(report.tiles.begin(), report.tiles.end(), [](const shared::FilmTile& tile) {
    return tile.film_low_pl == 0 && tile.film_high == 0;
  });
  if (empty && report.ridge_pl == 0 && report.step >= watered_step_) dry_ = true;
  return report;
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

std::vector<int32_t> FilmGl::readFilm() const {
  std::vector<int32_t> out(static_cast<size_t>(map_.texelCount()));
  gl_.GetTextureImage(film().name(), 0, GL_RED_INTEGER, GL_INT,
                      static_cast<GLsizei>(out.size() * sizeof(int32_t)), out.data());
  return out;
}

std::vector<int32_t> FilmGl::readRidges() const {
  std::vector<int32_t> out(kRidgePieces);
  ridges_.read(0, out.data(), out.size() * sizeof(int32_t));
  return out;
}

void FilmGl::abandon() {
  film_.forget();
  wishes_.forget();
  ridges_.forget();
  states_.forget();
  metric_.forget();
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
