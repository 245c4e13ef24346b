// The plugin as any host has it: its library opened, its table of functions called.
#pragma once

#include <glad/gl.h>

#include <string>

#include "rainglass/rainglass.h"
#include "side.h"

namespace compare {

class RainglassSide : public Side {
 public:
  RainglassSide(const GladGLContext& gl, uint32_t framebuffer, const std::string& library);
  ~RainglassSide() override;
  const char* name() const override { return "rainglass"; }
  void draw(const Moment& moment) override;
  void drawEmpty(const Moment& moment) override;
  // Asked of GL: none but those is given to it.
  double streaksSeen() override { return seen_; }

  // How far drops are seen, as focal length of the plugin's reference picture: more of them the farther.
  void setReference(double px);
  void countStreaks(bool on) { counts_ = on; }

 private:
  void check(rg_result result);
  rg_view viewAt(const Moment& moment) const;

  const GladGLContext& gl_;
  uint32_t framebuffer_, queries_[2] = {};
  bool counts_ = false;
  double seen_ = 0.0;
  void* library_ = nullptr;
  const rg_api* api_ = nullptr;
  rg_instance* instance_ = nullptr;
};

}  // namespace compare
