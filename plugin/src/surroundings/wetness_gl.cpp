#include "surroundings/wetness_gl.h"

#include "gl/objects.h"
#include "gl/program.h"
#include "rain/region.h"
#include "shared/wet.glsl"

namespace rg::surroundings {
namespace {

glm::vec4 wide(const glm::dvec3& v, double w = 0.0) { return {glm::vec3(v), static_cast<float>(w)}; }

}  // namespace

struct WetnessRenderer::Objects {
  explicit Objects(const gl::Context& context)
      : gl(context.gl),
        program(gl, {"surroundings/wet.vert", "surroundings/wet.frag"}),
        block(gl, sizeof(shared::WetView)),
        shelter(gl, sizeof(shared::RainShelter)),
        no_vertices(gl),
        canvas(gl) {}

  const GladGLContext& gl;
  gl::Program program;
  gl::Buffer block, shelter;
  gl::VertexArray no_vertices;
  rain::Canvas canvas;
  WetnessPicture picture;
  std::unique_ptr<shared::RainShelter> volumes = std::make_unique<shared::RainShelter>();
};

WetnessRenderer::WetnessRenderer(const gl::Context& context) : objects_(std::make_unique<Objects>(context)) {}
WetnessRenderer::~WetnessRenderer() = default;

void WetnessRenderer::take(const WetnessPicture& picture) { objects_->picture = picture; }

void WetnessRenderer::draw(const rain::RainDraw& draw, double strength) {
  Objects& o = *objects_;
  const rain::Cone cone = rain::coneOf(*draw.view);
  if (!(strength > 0.0) || !(o.picture.water_mm > 0.0) || !o.picture.has_volumes || !cone.valid ||
      !rain::Canvas::readsDepth(draw.target))
    return;
  const double after_s = static_cast<double>(draw.time_ns - o.picture.time_ns) * 1e-9;
  rain::setUpShelter(o.picture.volumes, cone.eye_m, after_s, *o.volumes);
  const rain::Rays rays = rain::raysOf(cone, *draw.view);
  // Patches stand still, wherever the host moves its world; their noise repeats.
  const glm::dvec2 place_m =
      glm::mod(glm::dvec2(cone.eye_m - o.picture.origin_m), static_cast<double>(shared::kWetRepeat_m));
  const shared::WetView view{wide(rays.middle), wide(rays.right), wide(rays.up),
                             wide(o.picture.fall_mps, strength), glm::vec4(o.picture.water_mm, place_m, 0.0)};
  o.block.write(0, &view, sizeof view);
  o.shelter.write(0, o.volumes.get(), sizeof *o.volumes);
  o.canvas.begin(draw);
  o.gl.BindVertexArray(o.no_vertices.name());
  o.gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, o.block.name());
  o.gl.BindBufferBase(GL_UNIFORM_BUFFER, 1, o.shelter.name());
  o.program.use();
  o.gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void WetnessRenderer::forget() {
  Objects& o = *objects_;
  o.program.forget();
  o.block.forget();
  o.shelter.forget();
  o.no_vertices.forget();
  o.canvas.forget();
}

}  // namespace rg::surroundings
