// What a frame may cost, and whether a run kept to it.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <vector>

#include "rainglass/rainglass.h"
#include "render/program.h"
#include "render/target.h"
#include "window/context.h"

namespace host {

// Per stage: GPU (or, for stages of the CPU alone, CPU) median a frame may take: ms on a GPU, multiples of
// the reference pass on software GL.
using Budget = std::map<std::string, double>;

// Reads [gpu.SCENARIO] or [software.SCENARIO]. Throws InputError naming file and key; also when the scenario
// has none.
Budget loadBudget(const std::filesystem::path& file, const std::string& scenario, bool gpu_timer);

// A full-screen RGBA16F copy by a shader, as the plugin's passes are shaders. Each sample is several copies
// between two glFinish, so that it is as long as the stages that are held to it and a busy machine slows both
// alike.
class ReferencePass {
 public:
  ReferencePass(const Context& context, glm::ivec2 size_px);
  ~ReferencePass();
  ReferencePass(const ReferencePass&) = delete;
  ReferencePass& operator=(const ReferencePass&) = delete;
  void run();
  double medianMs() const;  // of one copy

 private:
  const GladGLContext& gl_;
  glm::ivec2 size_px_;
  GLuint textures_[2] = {0, 0};
  GLuint framebuffer_ = 0, no_vertices_ = 0;
  Program copy_;
  std::vector<double> ms_;
};

// Prints a table of stage, measured, allowed to standard output. True when all stages kept to it.
bool keepsBudget(const Budget& budget, const std::vector<rg_stage_stats>& stages, bool gpu_timer,
                 double reference_ms);

}  // namespace host
