// A pane's film and beads on the GPU: whole picolitres, the ridges of its blades, and batches of steps under
// way.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "gl/program.h"
#include "glass/film_layout.h"
#include "glass/film_order.h"
#include "glass/film_state.h"
#include "glass/pane_gl.h"
#include "glass/pane_map.h"
#include "glass/uneven_glass.h"

namespace rg::glass {

class FilmPrograms {
 public:
  // `software`: by lists of tiles, as suits a CPU. Else few kernels, and those wide. What they work out is
  // the same.
  FilmPrograms(const GladGLContext& gl, FilmKernel leaky, bool software);
  std::array<gl::Program*, 7> all();
  bool by_lists;
  gl::Program change, sweep, leave;
  gl::Program wake, flow, dry;  // by lists
  gl::Program tile;             // all of those at once
};

class FilmGl {
 public:
  FilmGl(const GladGLContext& gl, std::shared_ptr<FilmPrograms> programs, const PaneMap& map,
         const UnevenGlass& glass);

  // Puts the steps in the GPU's queue, as batches.
  void run(std::vector<FilmOrder>&& orders);
  // The same of several films, of each the orders in its place: side by side. They share their context.
  static void runTogether(std::span<FilmGl* const> films, std::span<const std::vector<FilmOrder>> orders);
  bool pending() const { return !pending_.empty(); }
  // Reports of the oldest batch once the GPU is done with it; `wait` waits for it. Empty: not yet.
  std::vector<FilmReport> collect(bool wait);

  // The film as it is, R32I, row by row; made when asked for.
  const gl::Texture2D& picture();
  const gl::Texture2D& beadsPicture();  // R32UI, packed as in shared/glass_beads.glsl
  const gl::Buffer& ridges() const { return ridges_; }
  std::vector<int32_t> readFilm() const;
  std::vector<uint32_t> readBeads() const;
  std::vector<int32_t> readRidges() const;
  // With nothing pending. Going on from a state that was set is as going on from it where it was asked for.
  FilmState state() const;
  void set(const FilmState& state);
  void abandon();

 private:
  struct Batch {
    gl::Buffer upload, report;
    unsigned char* orders = nullptr;  // the upload's
    const unsigned char* mapped = nullptr;
    gl::Fence fence;
    struct Step {
      int64_t step;
      size_t takes;
      bool clear;
      bool asleep;       // nothing ran: the pane was dry
      bool ridged;       // it tells of the ridges
      size_t report_at;  // in the batch's
    };
    std::vector<Step> steps;
  };
  struct Swept {
    std::shared_ptr<const std::vector<shared::SweptTexel>> list;
    gl::Buffer buffer;
  };

  // One of those in the batch that is begun.
  struct Step {
    FilmGl* film;
    const FilmOrder* order;
    size_t changes;
    size_t upload_at, report_at;  // in the batch's buffers
  };

  std::vector<Step> begin(std::span<const FilmOrder> orders);
  bool wakes(const Step& step);
  void end();
  // Kernels: false when there is nothing for one to do. film_step_gl.cpp has them, and their order.
  static void step(std::span<const Step> steps);
  static void flowByLists(std::span<const Step> steps);
  static void sweepAndLeave(std::span<const Step> steps);
  bool change(const Step& step);
  void sweep(const Step& step, const SweepOrder& sweep);
  bool leave(const Step& step);
  bool wake(const Step& step);
  bool flow(const Step& step);
  bool dry(const Step& step);
  bool flowOverTiles(const Step& step);
  void tellRidges(const Step& step);
  void turnOver();
  void bind(GLuint binding, const gl::Buffer& buffer, size_t offset, size_t bytes) const;
  void bindState(const Step& step) const;
  void bindFlow(const Step& step);
  void bindDrive(const Step& step);
  void dispatch(const gl::Program& program, size_t count, size_t before = 0) const;
  void dispatchListed(const gl::Program& program, size_t command_at) const;

  void clear();
  std::vector<shared::FilmChange> changesOf(const FilmOrder& order);
  size_t place(int texel) const;
  void show(const gl::Buffer& texels, GLenum type, gl::Texture2D& picture);
  template <typename T>
  std::vector<T> readTexels(const gl::Buffer& texels) const;
  template <typename T>
  std::vector<T> inTiles(const std::vector<T>& texels, T off) const;
  std::vector<uint32_t> tileStates(const FilmState& state) const;
  std::unique_ptr<Batch> freeBatch(size_t upload_bytes, size_t report_bytes);
  FilmReport read(const Batch& batch, size_t index);
  void readRidges(const Batch& batch, size_t index, FilmReport& report);
  GLuint sweptBuffer(const SweepOrder& order);

  const GladGLContext& gl_;
  std::shared_ptr<FilmPrograms> programs_;
  const PaneMap& map_;
  size_t tiles_;
  // A step reads the film in the buffer of its turn and writes it to the other: rows of whole tiles.
  std::array<gl::Buffer, 2> film_;
  std::array<gl::BufferTexture, 2> film_strips_;
  size_t turn_ = 0;
  gl::Buffer beads_;  // lie where they are: one copy will do
  gl::BufferTexture beads_strips_;
  gl::Buffer ridges_, states_, awake_, metric_, glass_;
  gl::BufferTexture metric_nodes_, glass_strips_, glass_codes_;
  // What drives the film in a step, brought to the GPU's own memory: every tile asks for it.
  gl::Buffer drive_;
  gl::BufferTexture drive_nodes_, ordered_drive_nodes_;
  gl::Texture2D picture_, beads_picture_;
  bool picture_is_old_ = true, beads_picture_is_old_ = true;
  std::vector<int> change_of_;  // texel: its place among a step's changes, -1 between steps
  std::vector<Swept> swept_;
  std::unique_ptr<Batch> begun_;
  std::deque<std::unique_ptr<Batch>> pending_;
  std::vector<std::unique_ptr<Batch>> free_;
  std::vector<uint32_t> thrown_before_pl_;  // by each piece, as last read
  bool ridged_ = false;                     // a blade had something to do with it
  bool dry_ = true;            // no water on it or in a ridge, as of the last report after it was given some
  int64_t watered_step_ = -1;  // the last that gave it some
};

}  // namespace rg::glass
