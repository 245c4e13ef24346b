#include "glass/look_capture_gl.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

namespace rg::glass {
namespace {

constexpr int kNever = 1 << 20;
constexpr double kNear_m = 0.2;
constexpr double kFar_m = 5000.0;
constexpr double kForwardWeight = 3.0;

// Directions and upward vectors of GL's six faces, whose rows run downwards.
constexpr std::array<glm::dvec3, 6> kLook{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
constexpr std::array<glm::dvec3, 6> kUp{
    {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}}};

// A quarter of the circle each way. Depth runs from one end of its range at the near plane to the other at
// the far.
glm::dmat4 clipFromFace(DepthUse depth) {
  double near_ndc = depth.zero_to_one ? 0.0 : -1.0, far_ndc = 1.0;
  if (depth.reversed) std::swap(near_ndc, far_ndc);
  const double fall = (near_ndc - far_ndc) / (1.0 / kNear_m - 1.0 / kFar_m);  // ndc = rest + fall / distance
  const double rest = far_ndc - fall / kFar_m;
  glm::dmat4 clip(0.0);
  clip[0][0] = clip[1][1] = 1.0;
  clip[2] = glm::dvec4(0.0, 0.0, -rest, -1.0);
  clip[3][2] = fall;
  return clip;
}

}  // namespace

glm::dmat4 faceFromWorld(int face, const glm::dvec3& eye_world_m) {
  const auto k = static_cast<size_t>(face);
  // The rotation alone, then the shift: the eye may be far from the origin.
  return glm::translate(glm::lookAt(glm::dvec3(0.0), kLook[k], kUp[k]), -eye_world_m);
}

void LookCapture::allocate(int size_px) {
  if (cube_ && cube_.width() == size_px) return;
  cube_ = gl::TextureCube(*gl_, GL_RGBA16F, size_px, gl::fullMipLevels(size_px, size_px));
  depth_ = gl::Texture2D(*gl_, GL_DEPTH_COMPONENT32F, size_px, size_px);
  for (int face = 0; face < 6; ++face) {
    gl::Framebuffer& target = faces_[static_cast<size_t>(face)];
    target = gl::Framebuffer(*gl_);
    target.attachColorLayer(0, cube_.name(), 0, face);
    target.attachDepth(depth_.name());
    target.drawColors(1);
    target.requireComplete("a face of the captured surroundings");
  }
  age_.fill(kNever);
}

int LookCapture::mostWanted(const glm::dvec3& forward) const {
  int best = 0;
  double best_score = -1.0;
  for (int face = 0; face < 6; ++face) {
    const auto k = static_cast<size_t>(face);
    const double score = age_[k] * (1.0 + kForwardWeight * std::max(glm::dot(forward, kLook[k]), 0.0));
    if (score > best_score) {
      best_score = score;
      best = face;
    }
  }
  return best;
}

void LookCapture::renew(const glm::dmat4& eyeFromWorld, int size_px, int max_faces, const DrawScene& draw,
                        DepthUse depth) {
  allocate(size_px);
  const glm::dmat4 worldFromEye = glm::inverse(eyeFromWorld);
  const glm::dvec3 eye(worldFromEye[3]);
  const glm::dvec3 forward(-worldFromEye[2]);
  for (int n = 0; n < std::clamp(max_faces, 0, 6); ++n) {
    const int face = mostWanted(forward);
    draw(faces_[static_cast<size_t>(face)].name(), size_px, faceFromWorld(face, eye), clipFromFace(depth));
    for (int& age : age_) age = std::min(age + 1, kNever);
    age_[static_cast<size_t>(face)] = 0;
  }
  if (cube() != 0) cube_.generateMipmaps();
}

uint32_t LookCapture::cube() const {
  const bool whole = cube_ && std::all_of(age_.begin(), age_.end(), [](int age) { return age < kNever; });
  return whole ? cube_.name() : 0;
}

void LookCapture::drop() { age_.fill(kNever); }

void LookCapture::forget() {
  cube_.forget();
  depth_.forget();
  for (gl::Framebuffer& face : faces_) face.forget();
}

}  // namespace rg::glass
