#include "drawn.h"

#include "gl/objects.h"
#include "gl_fixture.h"
#include "rain/rain_gl.h"
#include "rain/region.h"

namespace oracle {
namespace {

constexpr int kWidth_px = 128, kHeight_px = 72;  // where segments end does not depend on it
// A strip of four vertices is fed back as two triangles, of which the first begins with the segment's ends.
constexpr size_t kFedBack = 6;

// GL's functions take no pointer of ours; these are the draw call's that is under way.
const GladGLContext* true_gl = nullptr;
GLuint ends_buffer = 0;

// Links the program in use once more, so that it gives out its segments' ends.
void askForEnds(const GladGLContext& gl) {
  GLint current = 0, asked = 0;
  gl.GetIntegerv(GL_CURRENT_PROGRAM, &current);
  const auto program = static_cast<GLuint>(current);
  gl.GetProgramiv(program, GL_TRANSFORM_FEEDBACK_VARYINGS, &asked);
  if (asked != 0) return;
  const char* name = "segment_end_m";
  gl.TransformFeedbackVaryings(program, 1, &name, GL_INTERLEAVED_ATTRIBS);
  gl.LinkProgram(program);
}

// In the place of the plugin's glDrawArraysInstanced.
void drawAndFeedBack(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
  askForEnds(*true_gl);
  true_gl->BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, ends_buffer);
  true_gl->BeginTransformFeedback(GL_TRIANGLES);
  true_gl->DrawArraysInstanced(mode, first, count, instances);
  true_gl->EndTransformFeedback();
}

}  // namespace

struct DrawnStreaks::Gpu {
  Gpu(uint32_t capacity_drops, bool read_back)
      : plugins(rg::gl::loadContext(rg::test::GlContext::getProc, nullptr)),
        renderer(*plugins, capacity_drops),
        ends(context.gl, capacity_drops * kFedBack * sizeof(glm::vec3)),
        colour(context.gl, GL_RGBA32F, kWidth_px, kHeight_px),
        target(context.gl, {&colour}) {
    if (read_back) plugins->gl.DrawArraysInstanced = drawAndFeedBack;
  }

  rg::test::GlContext context;
  std::unique_ptr<rg::gl::Context> plugins;  // the same context, as the plugin sees it
  rg::rain::RainRenderer renderer;
  rg::gl::Buffer ends;
  rg::gl::Texture2D colour;
  rg::gl::Framebuffer target;
};

DrawnStreaks::DrawnStreaks(uint32_t capacity_drops, bool read_back)
    : gpu_(std::make_unique<Gpu>(capacity_drops, read_back)) {}
DrawnStreaks::~DrawnStreaks() { gpu_->context.makeCurrent(); }

std::vector<Segment> DrawnStreaks::draw(rg::rain::Upload& upload, const rg::ViewState& view,
                                        int64_t time_ns) {
  Gpu& g = *gpu_;
  g.context.makeCurrent();
  true_gl = &g.context.gl;
  ends_buffer = g.ends.name();
  const uint32_t slot_end = upload.picture.slot_end;
  g.renderer.upload(upload);
  g.colour.zero();
  g.ends.zero();
  rg::rain::RainDraw draw;
  draw.view = &view;
  draw.viewport_px = {0, 0, kWidth_px, kHeight_px};
  draw.time_ns = time_ns;
  draw.target.framebuffer = g.target.name();
  draw.target.width_px = kWidth_px;
  draw.target.height_px = kHeight_px;
  g.renderer.draw(draw);

  std::vector<glm::vec3> ends(slot_end * kFedBack);
  if (!ends.empty()) g.ends.read(0, ends.data(), ends.size() * sizeof(glm::vec3));
  const glm::dvec3 eye = rg::rain::coneOf(view).eye_m;
  std::vector<Segment> segments(slot_end);
  for (size_t slot = 0; slot < slot_end; ++slot) {
    const glm::vec3 from = ends[slot * kFedBack], to = ends[slot * kFedBack + 1];
    if (from != to) segments[slot] = {true, eye + glm::dvec3(from), eye + glm::dvec3(to)};
  }
  return segments;
}

rg::test::Picture DrawnStreaks::picture() const {
  return rg::test::readTexture(gpu_->context.gl, gpu_->colour.name());
}

std::string DrawnStreaks::complaints() { return rg::test::describe(gpu_->context.takeMessages()); }

}  // namespace oracle
