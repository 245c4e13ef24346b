// Draws lists of a scene's parts: picks each draw's program, its lamps and its shelters.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "render/draw_list.h"
#include "render/environment.h"
#include "render/frame_block.h"
#include "render/program.h"

namespace host {

/// A shelter's measured sky, placed.
struct PlacedGrid {
  const GpuGrid* grid = nullptr;
  glm::dmat4 box_from_world{1.0};
  const Instance* owner = nullptr;
};

/// Textures that all draws of a frame share.
struct FrameTextures {
  GLuint mirrored = 0;  ///< the environment as rough surfaces mirror it, cube
  GLuint shadow = 0;
  GLuint mirror_picture = 0;  ///< what stands on wet ground, seen from below, with mips; 0: none
};

struct Painted {
  std::uint64_t triangles = 0, draws = 0;
};

class Painter {
 public:
  explicit Painter(const GladGLContext& gl);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Takes what is common to the draws to come.
  void setFrame(const FrameBlock& frame, glm::dvec3 eye_m, std::span<const LampNow> lamps,
                std::span<const PlacedGrid> grids, const FrameTextures& textures);
  Painted paint(const DrawList& list);
  /// Whether lamps' meshes glow; told anew before each frame's draws.
  void showLamps(bool shown) { lamps_shown_ = shown; }

 private:
  struct LampAt {
    glm::vec3 place;
    float reach_m;
  };
  const Program& program(unsigned features);
  unsigned featuresOf(const DrawItem& item, bool sheltered) const;
  using Grids = std::vector<const PlacedGrid*>;
  using Lamps = std::vector<GLint>;
  Grids gridsOf(const DrawItem& item) const;
  Lamps lampsOf(const DrawItem& item) const;
  bool underCar(const DrawItem& item) const;
  void paintDepth(const DrawList& list);
  Grids airOf(const DrawItem& item) const;
  void setAir(const Program& program, const Grids& air) const;
  std::size_t alike(std::span<const DrawItem> items, const Grids& air) const;
  void setState(const DrawItem& item, const Grids& grids, const Lamps& lamps, const Grids& air);
  void setMaterial(const Program& program, const DrawItem& item, unsigned features) const;
  void setLamps(const Program& program, const Lamps& lamps) const;
  void setGrids(const Program& program, const Grids& grids) const;

  const GladGLContext& gl_;
  Program depth_;
  std::map<unsigned, std::unique_ptr<Program>> programs_;
  GLuint frame_buffer_ = 0;
  FrameBlock frame_;
  glm::dvec3 eye_m_{0.0};
  std::vector<LampAt> lamps_;
  std::span<const PlacedGrid> grids_;
  bool lamps_shown_ = true;
};

}  // namespace host
