// A flat pane as the simulation would hand it over, made by hand: what a test draws drops and film on.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "gl/objects.h"
#include "glass/look_gl.h"
#include "glass/pane_map.h"
#include "picture.h"
#include "shared/glass_types.glsl"

namespace rg::test {

// A pane of `size_m` about the vehicle's origin: u to the right seen from inside, v up the pane, outward =
// forward and up.
class FlatPane {
 public:
  // `mirrored`: the grid's u runs to the left.
  FlatPane(const GladGLContext& gl, double angle_from_horizontal_rad, double size_m, int texels,
           bool mirrored = false);

  void putDrops(std::span<const shared::GlassDropRecord> drops);
  // Thickness in m at a place (u, v) from the pane's middle.
  void putFilm(const std::function<double(double u_m, double v_m)>& thickness_m);
  // In each texel so many beads whose bases cover this share of the glass.
  void putBeads(const std::function<int(double u_m, double v_m)>& number, double share, double contact_rad);
  // Cuts its mesh into pieces, as the simulation's are.
  void cutIntoPieces();
  // A spherical cap at (u, v) from the pane's middle, round.
  shared::GlassDropRecord cap(double u_m, double v_m, double base_radius_m, double contact_rad) const;

  struct Axes {
    explicit Axes(double angle_from_horizontal_rad);
    glm::dvec3 up, outward;
  };

  glass::LookPane pane;
  glm::dvec3 right{0.0}, up{0.0}, outward{0.0};

 private:
  const GladGLContext& gl_;
  double size_m_;
  double across_;  // +1: u runs to the right
  int texels_;
  glass::PaneMesh mesh_;
  gl::Buffer vertices_, indices_, pieces_, drops_;
  gl::Texture2D position_, metric_, film_, beads_;
  gl::Texture2DArray frame_;
};

// Draws panes over a picture (or over black) into a linear target, and hands back what is then in it.
struct Scene {
  glass::LookView view;
  glass::LookLight light;
  glm::ivec2 size_px{0};
  std::vector<glm::vec4> picture;  // rows from the bottom; empty: black
  float depth = -1.0f;             // that the target's depth holds; < 0: the farthest
  std::vector<float> depths;       // or of each pixel; the look may read it then
};
Picture draw(const GladGLContext& gl, glass::GlassLook& look, const Scene& scene,
             std::span<const glass::LookPane> panes);

// The eye of the path-traced pictures: at (-0.65, 0, 0), looking along x, z up.
glass::LookView forwardView(glm::ivec2 size_px, double horizontal_fov_rad,
                            const glm::dvec3& eye_m = {-0.65, 0.0, 0.0});

// 8-bit PPM in sRGB.
void writeSrgb(const std::string& path, const Picture& picture);

}  // namespace rg::test
