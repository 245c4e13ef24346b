#include "render/draw_list.h"

#include <algorithm>

namespace host {
namespace {

constexpr int kBands = 4;  // of distance: what is near hides most, and is drawn strictly from near to far
constexpr int kBlended = 2 * kBands;

int rankOf(unsigned features, float distance_m) {
  if (features & kBlend) return kBlended;
  const int band = distance_m < 40.0F ? 0 : distance_m < 100.0F ? 1 : distance_m < 250.0F ? 2 : 3;
  return features & kMask ? kBands + band : band;
}

}  // namespace

DrawList::DrawList(glm::dvec3 eye_m, const glm::mat4& clip_from_rel, float least_size, float farthest_m)
    : eye_m_(eye_m), least_size_(least_size), farthest_m_(farthest_m) {
  const glm::mat4 rows = glm::transpose(clip_from_rel);
  planes_ = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] - rows[2]};
}

void DrawList::add(const Instance& instance, unsigned parts) {
  std::vector<glm::mat4> rel_from_body;
  for (glm::dmat4 world_from_body : instance.world_from_body) {
    world_from_body[3] -= glm::dvec4(eye_m_, 0.0);
    rel_from_body.emplace_back(world_from_body);
  }
  for (const GpuDraw& draw : instance.scene->draws) {
    if ((draw.part & parts) == 0) continue;
    DrawItem item{.instance = &instance,
                  .draw = &draw,
                  .rel_from_body = rel_from_body[static_cast<std::size_t>(draw.body)]};
    item.middle = glm::vec3(item.rel_from_body * glm::vec4(draw.middle, 1.0F));
    const glm::mat3 m(item.rel_from_body);
    item.half = glm::abs(m[0]) * draw.half.x + glm::abs(m[1]) * draw.half.y + glm::abs(m[2]) * draw.half.z;
    item.distance_m = glm::length(glm::max(glm::abs(item.middle) - item.half, 0.0F));
    const bool outside = std::any_of(planes_.begin(), planes_.end(), [&](glm::vec4 plane) {
      return glm::dot(glm::vec3(plane), item.middle) + plane.w +
                 glm::dot(glm::abs(glm::vec3(plane)), item.half) <
             0.0F;
    });
    if (outside || glm::length(item.half) < least_size_ * item.distance_m || item.distance_m > farthest_m_)
      continue;
    item.rank = rankOf(item.material().features, item.distance_m);
    items_.push_back(item);
  }
}

void DrawList::sort() {
  std::stable_sort(items_.begin(), items_.end(), [&](const DrawItem& a, const DrawItem& b) {
    if (a.rank != b.rank) return a.rank < b.rank;
    if (a.rank == kBlended) return glm::length(a.middle) > glm::length(b.middle);
    if (a.rank % kBands > 0 && a.draw->material != b.draw->material)
      return a.draw->material < b.draw->material;
    return a.distance_m < b.distance_m;
  });
}

}  // namespace host
