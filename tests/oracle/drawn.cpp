#include "drawn.h"

#include <array>

#include "gl/objects.h"
#include "gl_fixture.h"
#include "rain/rain_gl.h"
#include "rain/region.h"

namespace oracle {
namespace {

constexpr int kWidth_px = 128, kHeight_px = 72;  // where segments end does not depend on it
// What is fed back of each corner of a streak's two triangles.
struct Corner {
  glm::vec4 seen;  // RainCorner's
  glm::vec4 told;
};
constexpr std::array<const char*, 2> kFedBack{"streak_seen", "fed_back"};
constexpr size_t kCorners = 6;
// Where among them the streak's corners are.
constexpr std::array<size_t, 4> kPlaces{2, 0, 4, 1};

// GL's functions take no pointer of ours; these are the draw call's that is under way.
const GladGLContext* true_gl = nullptr;
GLuint corners_buffer = 0;
GLuint triangles_query = 0;

// Links the program in use once more, so that it gives out its segments' ends.
void askForEnds(const GladGLContext& gl) {
  GLint current = 0, asked = 0;
  gl.GetIntegerv(GL_CURRENT_PROGRAM, &current);
  const auto program = static_cast<GLuint>(current);
  gl.GetProgramiv(program, GL_TRANSFORM_FEEDBACK_VARYINGS, &asked);
  if (asked != 0) return;
  gl.TransformFeedbackVaryings(program, static_cast<GLsizei>(kFedBack.size()), kFedBack.data(),
                               GL_INTERLEAVED_ATTRIBS);
  gl.LinkProgram(program);
}

// In the place of the plugin's glMultiDrawElementsIndirect.
void drawAndFeedBack(GLenum mode, GLenum type, const void* commands, GLsizei count, GLsizei stride) {
  askForEnds(*true_gl);
  true_gl->BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, corners_buffer);
  true_gl->BeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, triangles_query);
  true_gl->BeginTransformFeedback(GL_TRIANGLES);
  true_gl->MultiDrawElementsIndirect(mode, type, commands, count, stride);
  true_gl->EndTransformFeedback();
  true_gl->EndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
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
        corners(context.gl, capacity_drops * kCorners * sizeof(Corner)),
        colour(context.gl, GL_RGBA32F, kWidth_px, kHeight_px),
        target(context.gl, {&colour}) {
    context.gl.GenQueries(1, &triangles);
    if (read_back) plugins->gl.MultiDrawElementsIndirect = drawAndFeedBack;
  }
  ~Gpu() { context.gl.DeleteQueries(1, &triangles); }
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  std::vector<Corner> fedBack() const {
    GLuint triangles_drawn = 0;
    context.gl.GetQueryObjectuiv(triangles, GL_QUERY_RESULT, &triangles_drawn);
    std::vector<Corner> all(size_t{triangles_drawn} * 3);
    if (!all.empty()) corners.read(0, all.data(), all.size() * sizeof(Corner));
    return all;
  }

  rg::test::GlContext context;
  std::unique_ptr<rg::gl::Context> plugins;  // the same context, as the plugin sees it
  rg::rain::RainRenderer renderer;
  rg::gl::Buffer corners;
  GLuint triangles = 0;
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
  corners_buffer = g.corners.name();
  triangles_query = g.triangles;
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
  const std::vector<Corner> corners = g.fedBack();
  for (size_t i = 0; i < corners.size(); i += kCorners) {
    const auto corner = [&](size_t k) -> const Corner& { return corners[i + kPlaces[k]]; };
    const glm::vec4 ends_px = corner(2).told;
    segments.at(static_cast<size_t>(corner(3).told.x)) = {
        true, placeOf(view, {ends_px.x, ends_px.y}, 1.0f / corner(0).seen.z),
        placeOf(view, {ends_px.z, ends_px.w}, 1.0f / corner(2).seen.z)};
  }
  return segments;
}

rg::test::Picture DrawnStreaks::picture() const {
  return rg::test::readTexture(gpu_->context.gl, gpu_->colour.name());
}

std::string DrawnStreaks::complaints() { return rg::test::describe(gpu_->context.takeMessages()); }

}  // namespace oracle
