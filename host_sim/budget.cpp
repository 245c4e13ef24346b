#include "budget.h"

#include <toml++/toml.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <sstream>

#include "scenario.h"

namespace host {
namespace {

constexpr int kCopies = 16;

}  // namespace

Budget loadBudget(const std::filesystem::path& file, const std::string& scenario, bool gpu_timer) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(file.string() + ": no such budget file");
  toml::table table;
  try {
    table = toml::parse_file(file.string());
  } catch (const toml::parse_error& e) {
    std::ostringstream line;
    line << file.string() << ":" << e.source().begin.line << ": " << e.description();
    throw InputError(line.str());
  }
  const std::string kind = gpu_timer ? "gpu" : "software";
  const toml::table* limits = table[kind][scenario].as_table();
  if (limits == nullptr) throw InputError(file.string() + ": has no [" + kind + "." + scenario + "]");
  Budget budget;
  for (const auto& [key, value] : *limits) {
    const toml::node& node = value;
    const auto limit = node.value<double>();
    if (!limit || !(*limit > 0.0))
      throw InputError(file.string() + ": " + kind + "." + scenario + "." + std::string(key.str()) +
                       " must be a number above 0");
    budget[std::string(key.str())] = *limit;
  }
  return budget;
}

ReferencePass::ReferencePass(const Context& context, glm::ivec2 size_px)
    : gl_(context.gl()), size_px_(size_px), copy_(gl_, {"full.vert"}, {"copy.frag"}) {
  const GLfloat grey[4] = {0.5F, 0.5F, 0.5F, 1.0F};
  gl_.CreateTextures(GL_TEXTURE_2D, 2, textures_);
  for (const GLuint texture : textures_) {
    gl_.TextureStorage2D(texture, 1, GL_RGBA16F, size_px.x, size_px.y);
    gl_.ClearTexImage(texture, 0, GL_RGBA, GL_FLOAT, grey);
  }
  gl_.CreateFramebuffers(1, &framebuffer_);
  gl_.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, textures_[1], 0);
  gl_.CreateVertexArrays(1, &no_vertices_);
}

ReferencePass::~ReferencePass() {
  gl_.DeleteVertexArrays(1, &no_vertices_);
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(2, textures_);
}

void ReferencePass::run() {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, size_px_.x, size_px_.y);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.BindTextureUnit(0, textures_[0]);
  gl_.BindVertexArray(no_vertices_);
  copy_.use();
  gl_.Finish();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kCopies; ++i) gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.Finish();
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  ms_.push_back(took.count() / kCopies);
}

double ReferencePass::medianMs() const {
  if (ms_.empty()) return 0.0;
  std::vector<double> sorted = ms_;
  std::ranges::nth_element(sorted, sorted.begin() + static_cast<long>(sorted.size() / 2));
  return sorted[sorted.size() / 2];
}

bool keepsBudget(const Budget& budget, const std::vector<rg_stage_stats>& stages, bool gpu_timer,
                 double reference_ms) {
  const char* unit = gpu_timer ? "ms" : "x ref";
  if (!gpu_timer) std::printf("reference pass (RGBA16F copy): %.3f ms\n", reference_ms);
  std::printf("%-16s %12s %12s\n", "stage", "measured", "allowed");
  bool kept = true;
  for (const auto& [name, allowed] : budget) {
    const auto stage =
        std::ranges::find_if(stages, [&wanted = name](const rg_stage_stats& s) { return wanted == s.name; });
    if (stage == stages.end() || stage->samples == 0) {
      std::printf("%-16s %12s %9.3f %s  never ran\n", name.c_str(), "-", allowed, unit);
      kept = false;
      continue;
    }
    const double ms = stage->gpu != 0 ? stage->gpu_ms_p50 : stage->cpu_ms_p50;
    const double measured = gpu_timer ? ms : ms / std::max(reference_ms, 1e-6);
    std::printf("%-16s %6.3f %-5s %6.3f %-5s%s\n", name.c_str(), measured, unit, allowed, unit,
                measured > allowed ? "  OVER" : "");
    kept = kept && measured <= allowed;
  }
  return kept;
}

}  // namespace host
