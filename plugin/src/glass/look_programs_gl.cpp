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
constexpr std::array<Source, 15> kSources{
    {{"glass/look_cells.comp", "", kRidges},
     {"glass/look_kinds.comp", "", kPlain},
     {"glass/look_sort.comp", "", kPlain},
     {"glass/look_list.comp", "", kPlain},
     {"glass/look_water.vert", "glass/look_water.frag", kEverywhere},
     {"glass/look_crater.vert", "glass/look_crater.frag", kPlain},
     {"glass/look_pane.vert", "glass/look_pane.frag",
      kInside | kCoarse | kFilm | kBeads | kRidges | kMirror | kApart | kSoft | kLit},
     {"glass/look_pane.vert", "glass/look_fog.frag", kLit},
     {"glass/look_place.comp", "", kMirror | kLamps | kLit},
     {"glass/look_pick.comp", "", kPlain},
     {"glass/look_drop.vert", "glass/look_drop.frag", kMirror | kLamps | kLit},
     {"glass/look_small.vert", "glass/look_small.frag", kPlain},
     {"glass/look_pane.vert", "glass/look_unsharp.frag", kPlain},
     {"glass/look_lamps.comp", "", kPlain},
     {"glass/look_screen.vert", "glass/look_halve.frag", kPlain}}};

struct Name {
  LookVariant variant;
  const char* define;
};
constexpr std::array<Name, 12> kNames{{{kInside, "INSIDE"},
                                       {kCoarse, "COARSE"},
                                       {kEnvironment, "ENVIRONMENT"},
                                       {kLamps, "LAMPS"},
                                       {kEncoded, "ENCODED"},
                                       {kFilm, "FILM"},
                                       {kBeads, "BEADS"},
                                       {kMirror, "MIRROR"},
                                       {kRidges, "RIDGES"},
                                       {kEverywhere, "EVERYWHERE"},
                                       {kApart, "APART"},
                                       {kSoft, "SOFT"}}};

gl::Program make(const GladGLContext& gl, const Source& source, uint32_t variant) {
  std::vector<std::string> defines;
  for (const Name& name : kNames) {
    if ((variant & name.variant) != 0) defines.emplace_back(name.define);
  }
  if (source.second.empty()) return gl::Program(gl, {source.first}, defines);
  return gl::Program(gl, {source.first, source.second}, defines);
}

// What of a variant a stage asks for. Only film has texels that may be few, and film seen from inside shows
// the picture alone.
uint32_t askedOf(LookStage stage, uint32_t variant) {
  uint32_t asked = variant & kSources[static_cast<size_t>(stage)].asks;
  if (stage != LookStage::pane) return asked;
  if ((asked & kFilm) == 0 || (asked & kInside) == 0) asked &= ~(kCoarse | kSoft);
  if ((asked & kInside) != 0 && (asked & kBeads) == 0) asked &= ~uint32_t{kEnvironment};
  return asked;
}

}  // namespace

LookPrograms::LookPrograms(const GladGLContext& gl) : gl_(&gl) { makeAll(kPlain); }

// In the order in which they may be waited for.
void LookPrograms::makeAll(uint32_t encoded) {
  using enum LookStage;
  for (const LookStage stage :
       {cells, kinds, sort, list, water, craters, pick, small_drops, unsharp, hide, halve})
    made(stage, kPlain);
  made(cells, kRidges);
  for (const uint32_t around : {kEnvironment, kPlain}) {
    const uint32_t lit = encoded | around;
    for (const uint32_t coarse : {kPlain, kCoarse}) made(pane, lit | kInside | coarse | kFilm);
    for (const uint32_t ridges : {kPlain, kRidges}) {
      for (const uint32_t coarse : {kPlain, kCoarse})
        made(pane, lit | kInside | coarse | kFilm | kBeads | ridges);
      for (const uint32_t coarse : {kPlain, kCoarse})
        made(pane, lit | kInside | coarse | kFilm | kSoft | ridges);
      for (const uint32_t mirror : {kPlain, kMirror}) made(pane, lit | kFilm | kBeads | mirror | ridges);
    }
    for (const uint32_t apart : {kPlain, kApart}) made(pane, lit | kInside | kBeads | apart);
    for (const uint32_t lamps : {kPlain, kLamps}) {
      for (const uint32_t mirror : {kPlain, kMirror}) {
        for (const LookStage stage : {place, drops}) made(stage, lit | lamps | mirror);
      }
    }
    made(fog, lit);
  }
}

const gl::Program& LookPrograms::made(LookStage stage, uint32_t variant) {
  const uint32_t asked = askedOf(stage, variant);
  auto known = programs_.find({stage, asked});
  if (known == programs_.end())
    known =
        programs_.emplace(std::pair(stage, asked), make(*gl_, kSources[static_cast<size_t>(stage)], asked))
            .first;
  return known->second;
}

const gl::Program& LookPrograms::use(LookStage stage, uint32_t variant) {
  const uint32_t asked = askedOf(stage, variant);
  const bool side_by_side = gl::buildingOf(*gl_) == gl::Building::side_by_side;
  if ((asked & kEncoded) != 0 && side_by_side && !programs_.contains({stage, asked})) makeAll(kEncoded);
  const gl::Program& program = made(stage, asked);
  program.use();
  return program;
}

void LookPrograms::forget() {
  for (auto& [key, program] : programs_) program.forget();
}

}  // namespace rg::glass
