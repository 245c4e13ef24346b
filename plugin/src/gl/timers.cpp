#include "gl/timers.h"

#include <algorithm>
#include <cmath>

namespace rg::gl {
namespace {

double milliseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

Percentiles percentiles(const Window& window) {
  return {window.percentile(0.50), window.percentile(0.95), window.percentile(0.99)};
}

// A driver may count no bits for timestamps at all.
bool hasTimestamps(const GladGLContext& gl) {
  GLint bits = 0;
  gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  return bits > 0;
}

}  // namespace

void Window::add(double value) {
  if (values_.empty()) values_.resize(kCapacity);
  values_[count_++ % kCapacity] = value;
}

double Window::percentile(double share) const {
  if (count_ == 0) return 0.0;
  std::vector<double> sorted(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(size()));
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  const auto index =
      static_cast<std::ptrdiff_t>(std::clamp(rank, 1.0, static_cast<double>(sorted.size()))) - 1;
  std::nth_element(sorted.begin(), sorted.begin() + index, sorted.end());
  return sorted[static_cast<size_t>(index)];
}

Timers::Stage Timers::add(std::string_view name, bool gpu) {
  stages_.emplace_back();
  stages_.back().name = name;
  stages_.back().gpu = gpu;
  return stages_.size() - 1;
}

void Timers::attach(const Context& context, bool force_finish) {
  context_ = &context;
  kind_ =
      force_finish || context.software || !hasTimestamps(context.gl) ? TimerKind::kFinish : TimerKind::kGpu;
}

void Timers::detach() {
  for (StageData& stage : stages_) {
    stage.ring.clear();
    stage.oldest = stage.in_flight = 0;
  }
  context_ = nullptr;
}

void Timers::forget() {
  for (StageData& stage : stages_) {
    for (Pair& pair : stage.ring) {
      pair.begin.forget();
      pair.end.forget();
    }
  }
  detach();
}

Timers::Clock::time_point Timers::begin(Stage index, bool& stamped) {
  StageData& stage = stages_[index];
  if (stage.gpu && context_) {
    if (kind_ == TimerKind::kFinish) {
      context_->gl.Finish();
    } else if (stage.in_flight < kRing) {
      while (stage.ring.size() < kRing)
        stage.ring.push_back({TimestampQuery(context_->gl), TimestampQuery(context_->gl)});
      stage.ring[(stage.oldest + stage.in_flight) % kRing].begin.stamp();
      stamped = true;
    }
  }
  return Clock::now();
}

void Timers::end(Stage index, Clock::time_point begun, bool stamped) {
  StageData& stage = stages_[index];
  record(stage.cpu_ms, milliseconds(Clock::now() - begun));
  if (!stage.gpu || !context_) return;
  if (kind_ == TimerKind::kFinish) {
    context_->gl.Finish();
    record(stage.gpu_ms, milliseconds(Clock::now() - begun));
  } else if (stamped) {
    stage.ring[(stage.oldest + stage.in_flight) % kRing].end.stamp();
    ++stage.in_flight;
  }
}

void Timers::collect() {
  if (!context_ || kind_ == TimerKind::kFinish) return;
  for (StageData& stage : stages_) collect(stage);
}

void Timers::collect(StageData& stage) {
  while (stage.in_flight > 0) {
    const Pair& pair = stage.ring[stage.oldest];
    if (!pair.end.ready()) return;
    record(stage.gpu_ms, static_cast<double>(pair.end.ns() - pair.begin.ns()) * 1e-6);
    stage.oldest = (stage.oldest + 1) % kRing;
    --stage.in_flight;
  }
}

void Timers::record(Window& window, double ms) {
  const std::lock_guard lock(windows_);
  window.add(ms);
}

StageTimes Timers::times(Stage index) const {
  const StageData& stage = stages_[index];
  const std::lock_guard lock(windows_);
  return {stage.name, stage.gpu, percentiles(stage.cpu_ms), percentiles(stage.gpu_ms), stage.cpu_ms.total()};
}

void Timers::clear() {
  const std::lock_guard lock(windows_);
  for (StageData& stage : stages_) {
    stage.cpu_ms.clear();
    stage.gpu_ms.clear();
  }
}

}  // namespace rg::gl
