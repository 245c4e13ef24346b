// OpenSceneGraph's precipitation effect in its own viewer, embedded in the context that is current.
#pragma once

#include <cstdint>
#include <memory>

#include "side.h"

namespace compare {

class OsgSide : public Side {
 public:
  explicit OsgSide(uint32_t framebuffer);
  ~OsgSide() override;
  const char* name() const override { return "osg"; }
  void draw(const Moment& moment) override;
  void drawEmpty(const Moment& moment) override;
  double streaksSeen() override;

  void setDensity(double per_m3);
  void setParticleSize(double m);

 private:
  struct Viewer;
  std::unique_ptr<Viewer> rain_, empty_;
};

}  // namespace compare
