// A film by itself on uncoated glass, laid and run by the production kernels without the pane's CPU half.
#pragma once

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "glass/bead_shape.h"
#include "glass/film_gl.h"
#include "glass/water.h"
#include "scene.h"

namespace rg::test {

// A film on a flat pane of whole texels, by itself: no rain, no drops, nothing that dries.
class LoneFilm {
 public:
  LoneFilm(const GladGLContext& gl, glm::ivec2 texels, double texel_m, uint32_t seed = 1)
      : texels_(texels),
        texel_m_(texel_m),
        map_(infoOf(texels, texel_m)),
        film_(gl, glass::makeFilmPrograms(gl), map_, glass::UnevenGlass(map_, seed)) {}

  // Thickness by the place of a texel's middle, metres from the first one's outer corner.
  template <class Thickness>
  void lay(const Thickness& thickness_m) {
    for (int y = 0; y < texels_.y; ++y) {
      for (int x = 0; x < texels_.x; ++x)
        adds_.push_back(
            {at(x, y), static_cast<int>(std::lround(thickness_m(texel_m_ * (glm::dvec2(x, y) + 0.5)) *
                                                    texel_m_ * texel_m_ * 1e15))});
    }
  }

  // Within the next step.
  void add(glm::ivec2 texel, double volume_m3) {
    adds_.push_back({at(texel.x, texel.y), static_cast<int>(std::lround(volume_m3 * 1e15))});
  }

  // `pressing`: acceleration onto the glass, `down`: along it to its lower edge.
  void run(int steps, double pressing_mps2, double down_mps2 = 0.0) {
    run(steps, pressing_mps2, {0.0, -down_mps2, 0.0, 0.0});
  }
  // `drive`: acceleration along x (to the right) and y (up), shear likewise.
  void run(int steps, double pressing_mps2, glm::dvec4 drive) {
    for (int k = 0; k < steps; ++k, ++step_) {
      std::vector<glass::FilmOrder> orders(1);
      glass::FilmOrder& order = orders[0];
      order.step = step_;
      order.adds = std::exchange(adds_, {});
      order.info.columns = map_.grid().size.x;
      order.info.rows = map_.grid().size.y;
      order.info.step = static_cast<uint32_t>(2 * step_);
      order.info.up_y = 1.0f;
      const glass::Surface glass = glass::surfaceOf(glass::Glass::uncoated);
      order.info.pin_m = static_cast<float>(glass.pin_m);
      order.info.front_m = static_cast<float>(glass.front_m);
      order.info.rupture_m = static_cast<float>(breaks ? glass.rupture_m : 0.0);
      order.info.rupture_chance = static_cast<float>(glass.rupture_hz * shared::kDryingSteps / 60.0);
      glass::setBeadShape(order.info, glass);
      shared::setLevelling(order.info, static_cast<float>(pressing_mps2),
                           static_cast<float>(1.0 / (texel_m_ * texel_m_)));
      order.drive.assign(map_.nodes().size(), shared::vec4(drive));
      film_.run(std::move(orders));
      const std::vector<glass::FilmReport> reports = film_.collect(true);
      for (const shared::FilmTile& tile : reports.at(0).tiles) {
        drained_pl += tile.drained_pl;
        blown_pl += tile.blown_pl;
      }
    }
  }

  std::vector<double> thickness_m() const {
    const std::vector<int32_t> film = film_.readFilm();
    std::vector<double> out;
    for (int y = 0; y < texels_.y; ++y) {
      for (int x = 0; x < texels_.x; ++x)
        out.push_back(film[static_cast<size_t>(at(x, y))] * 1e-15 / (texel_m_ * texel_m_));
    }
    return out;
  }
  int64_t volume_pl() const {
    const std::vector<int32_t> film = film_.readFilm();
    return std::accumulate(film.begin(), film.end(), int64_t{0},
                           [](int64_t sum, int32_t volume) { return sum + std::max(volume, 0); });
  }

  int64_t drained_pl = 0, blown_pl = 0;  // so far
  bool breaks = false;                   // thin film breaks up into beads

 private:
  static glass::PaneMap infoOf(glm::ivec2 texels, double texel_m) {
    // Half a texel less than whole ones: texels' middles decide what is glass.
    const Mesh mesh = windscreen((texels.x - 0.5) * texel_m, (texels.y - 0.5) * texel_m, 0.0);
    glass::PaneInfo info = paneInfo(mesh);
    info.texel_m = texel_m;
    return glass::PaneMap(info);
  }
  int at(int x, int y) const { return (y + 1) * map_.grid().size.x + x + 1; }

  glm::ivec2 texels_;
  double texel_m_;
  glass::PaneMap map_;
  glass::FilmGl film_;
  std::vector<shared::FilmAdd> adds_;
  int64_t step_ = 0;
};

}  // namespace rg::test
