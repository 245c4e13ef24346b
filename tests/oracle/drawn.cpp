#include "drawn.h"

#include <algorithm>
#include <array>

#include "gl/objects.h"
#include "gl_fixture.h"
#include "rain/rain_gl.h"
#include "rain/region.h"

namespace oracle {
namespace {

constexpr int kWidth_px = 128, kHeight_px = 72;  // where segments end does not depend on it
constexpr const char* kFedBack = "fed_back";     // what is told beside a RainCorner
// What is fed back of a streak: a line's two corners, or those of a rectangle's two triangles, the streak's
// first two before the others.
enum Shape { kThinLine, kLine, kRectangle };
constexpr size_t kCorners[] = {2, 2, 6};

// GL's functions take no pointer of ours; these are the draw call's that is under way.
const GladGLContext* true_gl = nullptr;
GLuint corners_buffers[3] = {};
GLuint primitives_queries[3] = {};

// Links the program in use once more, so that it gives out its segments' ends.
void askForEnds(const GladGLContext& gl) {
  GLint current = 0, asked = 0;
  gl.GetIntegerv(GL_CURRENT_PROGRAM, &current);
  const auto program = static_cast<GLuint>(current);
  gl.GetProgramiv(program, GL_TRANSFORM_FEEDBACK_VARYINGS, &asked);
  if (asked != 0) return;
  gl.TransformFeedbackVaryings(program, 1, &kFedBack, GL_INTERLEAVED_ATTRIBS);
  gl.LinkProgram(program);
}

template <class F>
void feedBack(Shape shape, GLenum mode, F&& draw) {
  askForEnds(*true_gl);
  true_gl->BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, corners_buffers[shape]);
  true_gl->BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, primitives_queries[shape]);
  true_gl->BeginTransformFeedback(mode);
  draw();
  true_gl->EndTransformFeedback();
  true_gl->EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
}

// In the place of those of the plugin. Commands of thin lines lead the buffer.
void drawLines(GLenum mode, const void* commands, GLsizei count, GLsizei stride) {
  feedBack(commands == nullptr ? kThinLine : kLine, mode,
           [&] { true_gl->MultiDrawArraysIndirect(mode, commands, count, stride); });
}
void drawRectangles(GLenum mode, GLenum type, const void* commands, GLsizei count, GLsizei stride) {
  feedBack(kRectangle, mode,
           [&] { true_gl->MultiDrawElementsIndirect(mode, type, commands, count, stride); });
}

// Where a point of the picture lies that far along the view.
glm::dvec3 placeOf(const rg::ViewState& view, const glm::vec2& px, float depth_m) {
  const glm::dmat4& p = view.clipFromEye;
  const double depth = static_cast<double>(depth_m);
  const glm::dvec2 ndc = glm::dvec2(px) * 2.0 / glm::dvec2(kWidth_px, kHeight_px);
  const glm::dvec3 seen((ndc.x + p[2][0]) / p[0][0] * depth, (ndc.y + p[2][1]) / p[1][1] * depth, -depth);
  return rg::rain::coneOf(view).eye_m + glm::transpose(glm::dmat3(view.eyeFromWorld)) * seen;
}

}  // namespace

struct DrawnStreaks::Gpu {
  Gpu(uint32_t capacity_drops, bool read_back)
      : plugins(rg::gl::loadContext(rg::test::GlContext::getProc, nullptr)),
        renderer(*plugins, capacity_drops),
        thin_lines(context.gl, capacity_drops * kCorners[kThinLine] * sizeof(glm::vec4)),
        lines(context.gl, capacity_drops * kCorners[kLine] * sizeof(glm::vec4)),
        rectangles(context.gl, capacity_drops * kCorners[kRectangle] * sizeof(glm::vec4)),
        colour(context.gl, GL_RGBA32F, kWidth_px, kHeight_px),
        target(context.gl, {&colour}) {
    context.gl.GenQueries(3, primitives);
    if (!read_back) return;
    plugins->gl.MultiDrawArraysIndirect = drawLines;
    plugins->gl.MultiDrawElementsIndirect = drawRectangles;
  }
  ~Gpu() { context.gl.DeleteQueries(3, primitives); }
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  // Of each streak the first two corners' words.
  std::vector<std::array<glm::vec4, 2>> fedBack() const {
    std::vector<std::array<glm::vec4, 2>> streaks;
    const rg::gl::Buffer* buffers[] = {&thin_lines, &lines, &rectangles};
    for (const Shape shape : {kThinLine, kLine, kRectangle}) {
      GLuint count = 0;
      context.gl.GetQueryObjectuiv(primitives[shape], GL_QUERY_RESULT, &count);
      std::vector<glm::vec4> all(size_t{count} * (shape == kRectangle ? 3 : 2));
      if (!all.empty()) buffers[shape]->read(0, all.data(), all.size() * sizeof(glm::vec4));
      for (size_t i = 0; i < all.size(); i += kCorners[shape]) streaks.push_back({all[i], all[i + 1]});
    }
    return streaks;
  }

  rg::test::GlContext context;
  std::unique_ptr<rg::gl::Context> plugins;  // the same context, as the plugin sees it
  rg::rain::RainRenderer renderer;
  rg::gl::Buffer thin_lines, lines, rectangles;
  GLuint primitives[3] = {};
  rg::gl::Texture2D colour;
  rg::gl::Framebuffer target;
};

DrawnStreaks::DrawnStreaks(uint32_t capacity_drops, bool read_back)
    : gpu_(std::make_unique<Gpu>(capacity_drops, read_back)), read_back_(read_back) {}
DrawnStreaks::~DrawnStreaks() { gpu_->context.makeCurrent(); }

std::vector<Segment> DrawnStreaks::draw(rg::rain::Upload& upload, const rg::ViewState& view,
                                        int64_t time_ns) {
  Gpu& g = *gpu_;
  g.context.makeCurrent();
  true_gl = &g.context.gl;
  corners_buffers[kThinLine] = g.thin_lines.name();
  corners_buffers[kLine] = g.lines.name();
  corners_buffers[kRectangle] = g.rectangles.name();
  std::copy_n(g.primitives, 3, primitives_queries);
  const uint32_t slot_end = upload.picture.slot_end;
  g.renderer.upload(upload);
  g.colour.zero();
  rg::rain::RainDraw draw;
  draw.view = &view;
  draw.viewport_px = {0, 0, kWidth_px, kHeight_px};
  draw.time_ns = time_ns;
  draw.target.framebuffer = g.target.name();
  draw.target.width_px = kWidth_px;
  draw.target.height_px = kHeight_px;
  g.renderer.draw(draw);

  std::vector<Segment> segments(slot_end);
  if (!read_back_) return segments;
  for (const auto& [ends_px, slot_depths] : g.fedBack()) {
    segments.at(static_cast<size_t>(slot_depths.x)) = {true,
                                                       placeOf(view, {ends_px.x, ends_px.y}, slot_depths.y),
                                                       placeOf(view, {ends_px.z, ends_px.w}, slot_depths.z)};
  }
  return segments;
}

rg::test::Picture DrawnStreaks::picture() const {
  return rg::test::readTexture(gpu_->context.gl, gpu_->colour.name());
}

std::string DrawnStreaks::complaints() { return rg::test::describe(gpu_->context.takeMessages()); }

}  // namespace oracle
