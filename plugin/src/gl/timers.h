// What each named stage of a frame costs, on the CPU and on the GPU.
//
// GPU time is the distance between two GL_TIMESTAMP queries, read back frames later and never waited for. On
// software GL timestamps mean nothing; there (or on request) each GPU stage begins and ends with glFinish and
// its GPU time is the steady clock's between the two.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "gl/loader.h"
#include "gl/objects.h"

namespace rg::gl {

// The last kCapacity values and their percentiles.
class Window {
 public:
  static constexpr size_t kCapacity = 1024;
  void add(double value);
  size_t size() const { return std::min(count_, kCapacity); }
  uint64_t total() const { return count_; }
  // The smallest value that at least `share` (0..1) of the window does not exceed (nearest rank); 0 when
  // empty.
  double percentile(double share) const;
  void clear() { count_ = 0; }

 private:
  std::vector<double> values_;
  size_t count_ = 0;  // ever added
};

struct Percentiles {
  double p50 = 0.0, p95 = 0.0, p99 = 0.0;
};

// As rg_stage_stats tells it.
struct StageTimes {
  std::string name;
  bool gpu = false;
  Percentiles cpu_ms, gpu_ms;
  uint64_t samples = 0;
};

enum class TimerKind { kGpu, kFinish };

class Timers {
 public:
  using Stage = size_t;

  // `gpu`: the stage issues GL commands and is timed on the GL thread, with the context current. Add all
  // stages before the first is timed.
  Stage add(std::string_view name, bool gpu);

  // From here on GPU stages have a GPU time. [thread: GL, context current]
  void attach(const Context& context, bool force_finish);
  void detach();  // frees the queries
  void forget();  // the context is lost

  // Takes what the GPU has finished measuring; call once a frame, within a state guard (no QUERY_BUFFER may
  // be bound). [thread: GL]
  void collect();

  TimerKind kind() const { return kind_; }
  size_t stageCount() const { return stages_.size(); }
  StageTimes times(Stage stage) const;  // [thread: any]
  void clear();                         // forgets what was measured so far. [thread: any]

 private:
  friend class ScopedStage;
  using Clock = std::chrono::steady_clock;
  // Several views in each of the few frames a driver queues; when all are in flight, samples are left out
  // rather than waited for.
  static constexpr size_t kRing = 64;
  struct Pair {
    TimestampQuery begin, end;
  };
  struct StageData {
    std::string name;
    bool gpu = false;
    Window cpu_ms, gpu_ms;
    std::vector<Pair> ring;
    size_t oldest = 0, in_flight = 0;
  };

  Clock::time_point begin(Stage stage, bool& stamped);
  void end(Stage stage, Clock::time_point begun, bool stamped);
  void collect(StageData& stage);
  void record(Window& window, double ms);

  std::deque<StageData> stages_;
  const Context* context_ = nullptr;
  std::atomic<TimerKind> kind_ = TimerKind::kGpu;  // asked by update's thread
  mutable std::mutex windows_;  // stages of the CPU's update and of the GL thread end at the same time
};

// Times its own life as one run of the stage. Stages may nest.
class ScopedStage {
 public:
  ScopedStage(Timers& timers, Timers::Stage stage)
      : timers_(timers), stage_(stage), begun_(timers.begin(stage, stamped_)) {}
  ~ScopedStage() { timers_.end(stage_, begun_, stamped_); }
  ScopedStage(const ScopedStage&) = delete;
  ScopedStage& operator=(const ScopedStage&) = delete;

 private:
  Timers& timers_;
  Timers::Stage stage_;
  bool stamped_ = false;
  Timers::Clock::time_point begun_;
};

}  // namespace rg::gl
