#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <optional>

#include "budget.h"
#include "image/png.h"
#include "image/video.h"
#include "progress.h"
#include "report.h"
#include "run.h"
#include "schedule.h"
#include "stage.h"

namespace host {
namespace {

void show(Progress& progress, double time_s, double seconds, uint64_t frames, double wall_s) {
  if (isatty(2) == 0) return;
  const std::optional<double> left_s = progress.left_s(time_s, wall_s);
  std::fprintf(stderr, "\r%6.1f of %.1f s, %llu pictures", time_s, seconds,
               static_cast<unsigned long long>(frames));
  if (left_s) std::fprintf(stderr, ", %.0f s to go", *left_s);
  std::fprintf(stderr, "        ");  // over what the line before had more
}

}  // namespace

int runHeadless(const Options& options) {
  const Scenario scenario = chosenScenario(options);
  std::optional<SavedRun> saved;
  if (!options.restore.empty()) saved = readRun(options.restore, scenario);
  const std::vector<Event> events = schedule(options, scenario.seconds, saved ? saved->time_ns : 0);
  Models models = loadModels(scenario);
  makeOutFolder(options.out);
  if (!options.save.empty()) requireWritable(options.save);
  const auto context = makeHeadlessContext(options.gl_debug);
  Stage stage(options, scenario, std::move(models), *context);
  const Budget budget = options.budget.empty()
                            ? Budget{}
                            : loadBudget(options.budget, scenario.name, stage.plugin().gpuTimer());
  const Target target(*context, options.size_px);
  const Picture picture(*context, options.size_px);
  std::unique_ptr<Video> video;
  if (!options.video.empty())
    video = std::make_unique<Video>(options.video, options.size_px.x, options.size_px.y, options.fps);
  ReferencePass reference(*context, options.size_px);

  const auto begin = std::chrono::steady_clock::now();
  const auto wall_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Report report;
  Progress progress(scenario.seconds);
  if (saved)
    restoreFrom(stage, *saved, options.restore);
  else
    stage.prewarm();
  for (const Event& e : events) {
    if (e.update) stage.update(e.time_ns);
    if (e.save) saveTo(stage, e.time_ns, options.save);
    if (!e.draw) continue;
    const bool single = !e.shot.empty() && options.video.empty();
    stage.draw(e.time_ns, target, picture.framebuffer(), single ? 6 : 1);
    ++report.frames;
    if (!budget.empty()) reference.run();
    if (!e.shot.empty()) writePng(options.out / e.shot, picture.read(), options.size_px.x, options.size_px.y);
    if (video) video->add(picture.read());
    show(progress, static_cast<double>(e.time_ns) * 1e-9, scenario.seconds, report.frames, wall_s());
  }
  if (isatty(2) != 0) std::fprintf(stderr, "\n");
  if (video) video->finish();
  report.size_px = options.size_px;
  report.simulated_s = scenario.seconds;
  report.wall_s = wall_s();
  stage.fillReport(report);
  writeReport(options.out / "report.json", report);
  if (!budget.empty() && !keepsBudget(budget, report.stages, report.gpu_timer, reference.medianMs()))
    return 4;
  return 0;
}

}  // namespace host
