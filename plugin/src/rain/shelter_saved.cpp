// What shelter knows between ticks, as a saved state: the ways of bodies. Volumes are the host's.
#include "rain/shelter.h"

namespace rg::rain {

uint64_t Shelter::volumesFingerprint() const {
  saved::Writer all;
  for (const auto& [id, volume] : volumes_) {
    all(id, volume->vehicle, volume->active);
    all.list(volume->shape.planes, Convex::kMaxPlanes);
  }
  return saved::fingerprintOf(all.bytes);
}

void Shelter::write(saved::Writer& a) const {
  const uint64_t volumes = volumesFingerprint();
  const auto count = static_cast<uint32_t>(bodies_.size());
  a(volumes, changed_, tests_, count);
  for (const auto& [id, body] : bodies_) a(id, body.known, body.path);
}

void Shelter::read(saved::Reader& a) {
  constexpr uint32_t kMostBodies = 65536;
  uint64_t volumes = 0;
  uint32_t count = 0;
  a(volumes, changed_, tests_);
  a.within(count, 0u, kMostBodies);
  bodies_.clear();
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t id = 0;
    a(id);
    Body& body = bodies_[id];
    a(body.known, body.path);
    a.require(!body.known || body.path.pieces() > 0, "a body's way has no piece");
  }
  a.require(bodies_.size() == count, "a body is told twice");
  changed_ = changed_ || volumes != volumesFingerprint();
  rebuild();
}

}  // namespace rg::rain
