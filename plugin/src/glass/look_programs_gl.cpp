#include "glass/look_programs_gl.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace rg::glass {
namespace {

struct Source {
  std::string_view first, second;  // second: none of a compute shader
  uint32_t asks;                   // for these variants
};

constexpr uint32_t kLit = kEnvironment | kEncoded;

// By LookStage.
constexpr std::array<Source, 13> kSources{
    {{"glass/look_cells.comp", "", kRidges},
     {"glass/look_kinds.comp", "", kPlain},
     {"glass/look_sort.comp", "", kPlain},
     {"glass/look_list.comp", "", kPlain},
     {"glass/look_water.vert", "glass/look_water.frag", kEverywhere},
     {"glass/look_crater.vert", "glass/look_crater.frag", kPlain},
     {"glass/look_pane.vert", "glass/look_pane.frag",
      kInside | kCoarse | kFilm | kBeads | kRidges | kMirror | kApart | kLit},
     {"glass/look_pane.vert", "glass/look_fog.frag", kLit},
     {"glass/look_place.comp", "", kMirror | kLamps | kLit},
     {"glass/look_pick.comp", "", kPlain},
     {"glass/look_drop.vert", "glass/look_drop.frag", kMirror | kLamps | kLit},
     {"glass/look_small.vert", "glass/look_small.frag", kPlain},
     {"glass/look_pane.vert", "glass/look_unsharp.frag", kPlain}}};

struct Name {
  LookVariant variant;
  const char* define;
};
constexpr std::array<Name, 11> kNames{{{kInside, "INSIDE"},
                                       {kCoarse, "COARSE"},
                                       {kEnvironment, "ENVIRONMENT"},
                                       {kLamps, "LAMPS"},
                                       {kEncoded, "ENCODED"},
                                       {kFilm, "FILM"},
                                       {kBeads, "BEADS"},
                                       {kMirror, "MIRROR"},
                                       {kRidges, "RIDGES"},
                                       {kEverywhere, "EVERYWHERE"},
                                       {kApart, "APART"}}};

gl::Program make(const GladGLContext& gl, const Source& source, uint32_t variant) {
  std::vector<std::string> defines;
  for (const Name& name : kNames) {
    if ((variant & name.variant) != 0) defines.emplace_back(name.define);
  }
  if (source.second.empty()) return gl::Program(gl, {source.first}, defines);
  return gl::Program(gl, {source.first, source.second}, defines);
}

}  // namespace

const gl::Program& LookPrograms::use(LookStage stage, uint32_t variant) {
  const Source& source = kSources[static_cast<size_t>(stage)];
  const uint32_t asked = variant & source.asks;
  auto known = programs_.find({stage, asked});
  if (known == programs_.end())
    known = programs_.emplace(std::pair(stage, asked), make(*gl_, source, asked)).first;
  known->second.use();
  return known->second;
}

void LookPrograms::forget() {
  for (auto& [key, program] : programs_) program.forget();
}

}  // namespace rg::glass
