// The kernels of a film's step, one after another: of all panes at once, so that a GPU works on them side by
// side and waits once for each kernel, not once for each pane and kernel.
#include "glass/film_gl.h"

namespace rg::glass {
namespace {

constexpr size_t kStepsInBatch = 16;
constexpr GLbitfield kFilmBarrier = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT;

}  // namespace

void FilmGl::run(std::vector<FilmOrder>&& orders) {
  FilmGl* self = this;
  runTogether(std::span(&self, 1), std::span(&orders, 1));
}

void FilmGl::runTogether(std::span<FilmGl* const> films, std::span<const std::vector<FilmOrder>> orders) {
  size_t most = 0;
  for (const std::vector<FilmOrder>& of_film : orders) most = std::max(most, of_film.size());
  for (size_t first = 0; first < most; first += kStepsInBatch) {
    std::vector<std::vector<Step>> batches;
    for (size_t i = 0; i < films.size(); ++i) {
      const std::span<const FilmOrder> all(orders[i]);
      const auto part = all.subspan(std::min(first, all.size()));
      if (!part.empty()) batches.push_back(films[i]->begin(part.first(std::min(kStepsInBatch, part.size()))));
    }
    for (size_t k = 0; k < kStepsInBatch; ++k) {
      std::vector<Step> steps;
      for (const std::vector<Step>& batch : batches) {
        if (k < batch.size() && batch[k].film->wakes(batch[k])) steps.push_back(batch[k]);
      }
      if (!steps.empty()) step(steps);
    }
    if (batches.empty()) continue;
    const GladGLContext& gl = batches.front().front().film->gl_;
    gl.MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT |
                     GL_BUFFER_UPDATE_BARRIER_BIT);
    for (const std::vector<Step>& batch : batches) batch.front().film->end();
  }
}

namespace {

// Each film's kernel; whoever needs what it did waits for them all.
template <typename Steps, typename Kernel>
void each(const GladGLContext& gl, const Steps& steps, GLbitfield barrier, const Kernel& kernel) {
  bool ran = false;
  for (const auto& s : steps) ran = (s.film->*kernel)(s) || ran;
  if (ran) gl.MemoryBarrier(barrier);
}

}  // namespace

// Each film's step; of none there are two. What a GPU pays for a kernel that waits for another is much more
// than for groups that find nothing to do.
void FilmGl::step(std::span<const Step> steps) {
  const GladGLContext& gl = steps.front().film->gl_;
  each(gl, steps, kFilmBarrier, &FilmGl::change);
  sweepAndLeave(steps);
  if (steps.front().film->programs_->by_lists)
    flowByLists(steps);
  else
    each(gl, steps, kFilmBarrier | GL_BUFFER_UPDATE_BARRIER_BIT, &FilmGl::flowOverTiles);
  for (const Step& s : steps) s.film->turnOver();
}

void FilmGl::flowByLists(std::span<const Step> steps) {
  const GladGLContext& gl = steps.front().film->gl_;
  each(gl, steps, kFilmBarrier | GL_COMMAND_BARRIER_BIT, &FilmGl::wake);
  each(gl, steps, kFilmBarrier, &FilmGl::flow);
  each(gl, steps, kFilmBarrier | GL_BUFFER_UPDATE_BARRIER_BIT, &FilmGl::dry);
  for (const Step& s : steps) s.film->tellRidges(s);
}

void FilmGl::sweepAndLeave(std::span<const Step> steps) {
  const GladGLContext& gl = steps.front().film->gl_;
  size_t most_sweeps = 0;
  for (const Step& s : steps) most_sweeps = std::max(most_sweeps, s.order->sweeps.size());
  for (size_t k = 0; k < most_sweeps; ++k) {  // blades may meet on a texel: one after the other
    for (const Step& s : steps) {
      if (k < s.order->sweeps.size()) s.film->sweep(s, s.order->sweeps[k]);
    }
    gl.MemoryBarrier(kFilmBarrier);
  }
  each(gl, steps, kFilmBarrier, &FilmGl::leave);
}

void FilmGl::bind(GLuint binding, const gl::Buffer& buffer, size_t offset, size_t bytes) const {
  gl_.BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer.name(), static_cast<GLintptr>(offset),
                      static_cast<GLsizeiptr>(bytes));
}

void FilmGl::bindState(const Step& step) const {
  gl_.BindBufferRange(GL_UNIFORM_BUFFER, 0, begun_->upload.name(),
                      static_cast<GLintptr>(step.upload_at + UploadLayout(*step.order).info),
                      sizeof(shared::FilmStepInfo));
  bind(1, ridges_, 0, kRidgeBytes);
  bind(3, film_[turn_], 0, film_[turn_].bytes());
  bind(5, states_, 0, tiles_ * kTileStateBytes);
  bind(6, beads_, 0, beads_.bytes());
}

// Groups of 64: for `before` invocations, and for `count`.
void FilmGl::dispatch(const gl::Program& program, size_t count, size_t before) const {
  program.set(0, static_cast<int32_t>(count));
  program.set(1, static_cast<int32_t>(turn_));
  program.use();
  gl_.DispatchCompute(static_cast<GLuint>((before + 63) / 64 + (count + 63) / 64), 1, 1);
}

// A group for each tile, and a row of which one tells of the ridges.
bool FilmGl::flowOverTiles(const Step& step) {
  const ReportLayout report(tiles_, step.order->takes.size());
  bindState(step);
  bind(0, metric_, 0, metric_.bytes());
  bind(2, begun_->report, step.report_at, report.taken);
  bind(3, film_[1 - turn_], 0, film_[1 - turn_].bytes());
  bind(4, drive_, 0, drive_.bytes());
  bind(7, film_[turn_], 0, film_[turn_].bytes());
  gl_.BindImageTexture(4, glass_codes_.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32UI);
  programs_->tile.set(2, static_cast<int32_t>(report.ridges / sizeof(int)));
  programs_->tile.set(1, static_cast<int32_t>(turn_));
  programs_->tile.use();
  gl_.DispatchCompute(static_cast<GLuint>(map_.tileCount().x),
                      static_cast<GLuint>(map_.tileCount().y + (ridged_ ? 1 : 0)), 1);
  return true;
}

// On a GPU it brings what drives the film besides.
bool FilmGl::change(const Step& step) {
  const size_t nodes = programs_->by_lists ? 0 : step.order->drive.size();
  if (step.changes + nodes == 0) return false;
  const ReportLayout report(tiles_, step.order->takes.size());
  bindState(step);
  bindDrive(step);
  bind(0, begun_->upload, step.upload_at + UploadLayout(*step.order).changes,
       std::max<size_t>(step.changes, 1) * sizeof(shared::FilmChange));
  bind(2, begun_->report, step.report_at + report.taken, report.taken_bytes);
  programs_->change.set(2, static_cast<int32_t>(nodes));
  dispatch(programs_->change, step.changes, nodes);
  return true;
}

// One work group sweeps, an invocation for each piece; so many ranges keep offsets aligned.
void FilmGl::sweep(const Step& step, const SweepOrder& sweep) {
  constexpr size_t kRanges = shared::kBladeSegments * sizeof(shared::SweptRange);
  static_assert(kRanges % kAlign == 0);
  bindState(step);
  gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, sweptBuffer(sweep));
  bind(2, begun_->upload,
       step.upload_at + UploadLayout(*step.order).ranges +
           static_cast<size_t>(sweep.first_range) * sizeof(shared::SweptRange),
       kRanges);
  programs_->sweep.set(2, sweep.first_piece);
  programs_->sweep.set(3, static_cast<int32_t>(sweep.backwards));
  dispatch(programs_->sweep, 1);
}

bool FilmGl::leave(const Step& step) {
  const FilmOrder& order = *step.order;
  if (order.leaves.empty()) return false;
  const UploadLayout at(order);
  bindState(step);
  bind(0, begun_->upload, step.upload_at + at.leaves, order.leaves.size() * sizeof(shared::RidgeLeave));
  bind(2, begun_->upload, step.upload_at + at.texels,
       std::max(sizeof(int), order.leave_texels.size() * sizeof(int)));
  dispatch(programs_->leave, order.leaves.size());
  return true;
}

// Finds the tiles to be looked at: lists of them, and the commands that the two below are dispatched with.
bool FilmGl::wake(const Step& step) {
  bindFlow(step);
  dispatch(programs_->wake, tiles_);
  return true;
}

bool FilmGl::flow(const Step& step) {
  bindDrive(step);
  bindFlow(step);
  bind(3, film_[1 - turn_], 0, film_[1 - turn_].bytes());
  dispatchListed(programs_->flow, 0);
  return true;
}

// As the flow left it; of tiles that sleep both copies are the same.
bool FilmGl::dry(const Step& step) {
  bindFlow(step);
  gl_.BindImageTexture(0, film_strips_[1 - turn_].name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32I);
  bind(3, film_[1 - turn_], 0, film_[1 - turn_].bytes());
  bind(7, film_[turn_], 0, film_[turn_].bytes());
  programs_->dry.set(0, static_cast<int32_t>(tiles_));
  dispatchListed(programs_->dry, sizeof kNoneAwake / 2);
  return true;
}

void FilmGl::tellRidges(const Step& step) {
  const ReportLayout report(tiles_, step.order->takes.size());
  if (ridged_)
    gl_.CopyNamedBufferSubData(ridges_.name(), begun_->report.name(), 0,
                               static_cast<GLintptr>(step.report_at + report.ridges), kRidgeBytes);
}

void FilmGl::turnOver() {
  turn_ = 1 - turn_;
  picture_is_old_ = beads_picture_is_old_ = true;
}

// As ordered, and where it is brought.
void FilmGl::bindDrive(const Step& step) {
  ordered_drive_nodes_.show(GL_RGBA32F, sizeof(shared::vec4), begun_->upload,
                            step.upload_at + UploadLayout(*step.order).drive,
                            step.order->drive.size() * sizeof(shared::vec4));
  gl_.BindImageTexture(2, ordered_drive_nodes_.name(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
  gl_.BindImageTexture(3, drive_nodes_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
}

void FilmGl::bindFlow(const Step& step) {
  bindState(step);
  bind(2, begun_->report, step.report_at, tiles_ * sizeof(shared::FilmTile));
  bind(4, awake_, 0, awake_.bytes());
  const auto image = [&](GLuint unit, const gl::BufferTexture& texture, GLenum format) {
    gl_.BindImageTexture(unit, texture.name(), 0, GL_FALSE, 0, GL_READ_ONLY, format);
  };
  image(0, film_strips_[turn_], GL_RGBA32I);
  image(1, metric_nodes_, GL_RGBA32F);
  image(3, beads_strips_, GL_RGBA32UI);
  image(4, glass_strips_, GL_RGBA32UI);
}

// Over the tiles that the kernel `wake` listed in this turn; `command_at`: in the turns' commands.
void FilmGl::dispatchListed(const gl::Program& program, size_t command_at) const {
  program.set(1, static_cast<int32_t>(turn_));
  program.use();
  gl_.BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, awake_.name());
  gl_.DispatchComputeIndirect(static_cast<GLintptr>(turn_ * sizeof kNoneAwake / 4 + command_at));
}

}  // namespace rg::glass
