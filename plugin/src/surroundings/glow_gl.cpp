#include "surroundings/glow_gl.h"

#include <algorithm>
#include <cmath>

#include "gl/canvases.h"
#include "gl/program.h"
#include "surroundings/glare.h"

namespace rg::surroundings {
namespace {

constexpr int kMostLevels = 10;  // texels of 1024 px

// Sides of the half picture that halve evenly down to the last level, so that no pixel's light is lost there.
// The picture goes on beyond its borders as in a mirror: what is spread beside it comes back.
int padded(int side_px, int levels) {
  const int unit = 1 << (levels - 1);
  return ((side_px + 1) / 2 + unit - 1) / unit * unit;
}

// Levels whose texels are a half of the picture or less.
int levelsFor(const glm::ivec4& viewport_px) {
  int levels = 0;
  while (levels < kMostLevels && std::min(viewport_px.z, viewport_px.w) >> (levels + 2) > 0) ++levels;
  return levels;
}

}  // namespace

struct GlowRenderer::Objects {
  explicit Objects(const gl::Context& context)
      : gl(context.gl),
        gather_levels(gl, {"glass/look_screen.vert", "surroundings/glow_gather.frag"}),
        spread_light(gl, {"glass/look_screen.vert", "surroundings/glow_spread.frag"}),
        lay(gl, {"glass/look_screen.vert", "surroundings/glow_lay.frag"}),
        copies(gl, false),
        pyramids(gl, true),
        level(gl),
        no_vertices(gl),
        nearest(gl, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE),
        smooth(gl, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE),
        mirrored(gl, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_MIRRORED_REPEAT),
        canvas(gl) {}

  const GladGLContext& gl;
  gl::Program gather_levels, spread_light, lay;
  gl::Canvases copies, pyramids;
  gl::Framebuffer level;
  gl::VertexArray no_vertices;
  gl::Sampler nearest, smooth, mirrored;
  rain::Canvas canvas;

  void gather(const rain::RainDraw& draw, gl::Texture2D& pyramid);
  void spread(const gl::Texture2D& pyramid, std::span<const float> shares);
  void drawTo(const gl::Texture2D& pyramid, int at_level);
};

void GlowRenderer::Objects::drawTo(const gl::Texture2D& pyramid, int at_level) {
  level.attachColor(0, pyramid.name(), at_level);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, level.name());
  gl.ViewportIndexedf(0, 0.0f, 0.0f, static_cast<float>(std::max(pyramid.width() >> at_level, 1)),
                      static_cast<float>(std::max(pyramid.height() >> at_level, 1)));
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

// The picture, half as large, and its ever smaller levels. Of a viewport that leaves the target what is
// beside it is dark.
void GlowRenderer::Objects::gather(const rain::RainDraw& draw, gl::Texture2D& pyramid) {
  glm::ivec2 corner(draw.viewport_px);
  const glm::ivec2 size(draw.viewport_px.z, draw.viewport_px.w);
  glm::ivec2 low = glm::max(corner, 0);
  glm::ivec2 high = glm::min(corner + size, glm::ivec2(draw.target.width_px, draw.target.height_px));
  GLuint picture = draw.target.color_texture;
  if (picture == 0) {
    const gl::Canvas& copy = copies.ofSize(size.x, size.y);
    gl.BlitNamedFramebuffer(draw.target.framebuffer, copy.framebuffer.name(), low.x, low.y, high.x, high.y,
                            low.x - corner.x, low.y - corner.y, high.x - corner.x, high.y - corner.y,
                            GL_COLOR_BUFFER_BIT, GL_NEAREST);
    picture = copy.texture.name();
    low -= corner;
    high -= corner;
    corner = {0, 0};
  }
  gather_levels.set(0, glm::ivec4(corner, size));
  gather_levels.set(1, glm::ivec4(low, high));
  gather_levels.use();
  gl.BindTextureUnit(3, picture);
  gl.BindSampler(3, nearest.name());
  gl.Disablei(GL_BLEND, 0);
  drawTo(pyramid, 0);
  pyramid.generateMipmaps();
}

// Each level becomes its share of the light with the coarser ones' over it.
void GlowRenderer::Objects::spread(const gl::Texture2D& pyramid, std::span<const float> shares) {
  gl.Enablei(GL_BLEND, 0);
  gl.BlendEquationSeparatei(0, GL_FUNC_ADD, GL_FUNC_ADD);
  gl.BlendFuncSeparatei(0, GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_ONE);
  gl.BindTextureUnit(3, pyramid.name());
  gl.BindSampler(3, mirrored.name());
  spread_light.use();
  float coarser = shares.back();  // nothing has weighted the last level yet
  for (int k = static_cast<int>(shares.size()) - 2; k >= 0; --k) {
    gl.TextureParameteri(pyramid.name(), GL_TEXTURE_BASE_LEVEL, k + 1);  // no level is read while it is
    gl.TextureParameteri(pyramid.name(), GL_TEXTURE_MAX_LEVEL, k + 1);   // written
    spread_light.set(0, glm::vec2(coarser, shares[static_cast<size_t>(k)]));
    drawTo(pyramid, k);
    coarser = 1.0f;
  }
  gl.TextureParameteri(pyramid.name(), GL_TEXTURE_BASE_LEVEL, 0);
  gl.TextureParameteri(pyramid.name(), GL_TEXTURE_MAX_LEVEL, 1000);  // GL's own
}

GlowRenderer::GlowRenderer(const gl::Context& context) : objects_(std::make_unique<Objects>(context)) {}
GlowRenderer::~GlowRenderer() = default;

void GlowRenderer::draw(const rain::RainDraw& draw, double strength) {
  Objects& o = *objects_;
  const glm::ivec4& v = draw.viewport_px;
  const int levels = levelsFor(v);
  const bool beside =
      v.x >= draw.target.width_px || v.y >= draw.target.height_px || v.x + v.z <= 0 || v.y + v.w <= 0;
  if (!(strength > 0.0) || draw.target.srgb || levels < 2 || beside) return;
  std::vector<float> shares = glareShares(0.5 * std::abs(draw.view->clipFromEye[1][1]) * v.w, levels);
  float all = 0.0f;
  for (float& share : shares) all += share *= static_cast<float>(strength);
  if (all > 1.0f) {  // more than all of it cannot go astray
    for (float& share : shares) share /= all;
    all = 1.0f;
  }
  gl::Texture2D& pyramid = o.pyramids.ofSize(padded(v.z, levels), padded(v.w, levels)).texture;
  o.gl.Disablei(GL_SCISSOR_TEST, 0);
  o.gl.Disable(GL_DEPTH_TEST);
  o.gl.Disable(GL_CULL_FACE);
  o.gl.BindVertexArray(o.no_vertices.name());
  o.gather(draw, pyramid);
  o.spread(pyramid, shares);

  rain::RainDraw plain = draw;
  plain.target.depth_texture = 0;
  o.canvas.begin(plain);
  o.gl.Disable(GL_DEPTH_TEST);
  o.lay.set(0, glm::vec4(v.x, v.y, 2 * pyramid.width(), 2 * pyramid.height()));
  o.lay.set(1, all);
  o.lay.use();
  o.gl.BindSampler(3, o.smooth.name());
  o.gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void GlowRenderer::forget() {
  Objects& o = *objects_;
  for (gl::Program* program : {&o.gather_levels, &o.spread_light, &o.lay}) program->forget();
  o.copies.forget();
  o.pyramids.forget();
  o.level.forget();
  o.no_vertices.forget();
  o.nearest.forget();
  o.smooth.forget();
  o.mirrored.forget();
  o.canvas.forget();
}

}  // namespace rg::surroundings
