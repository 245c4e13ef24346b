// The panel over the window's picture: what goes on, the keys, and sliders for weather and plugin.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "overlay/imgui_gl.h"
#include "rainglass/rainglass.h"

struct ImGuiContext;

namespace host {

class Stage;

class Overlay {
 public:
  // `text_scale`: how many times larger than usual letters are.
  Overlay(const Context& context, float text_scale);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  // Shows all of it, or hides it. Without being asked, keys and status are shown for the first seconds.
  void toggle();
  // The mouse is on the panel: what it does is the panel's.
  bool wantsMouse() const;
  void moveCursor(glm::dvec2 at_px);
  void pressButton(bool down);
  void scroll(double steps);

  // Over the picture in framebuffer 0. Sliders change `stage`. `seconds` since the last picture, `note` is a
  // line on top, or empty.
  void draw(Stage& stage, glm::ivec2 size_px, double seconds, double fps, const char* note);

 private:
  // What costs a while to ask for is asked for twice a second.
  struct Slow {
    std::vector<rg_stage_stats> stages;
    std::vector<rg_parameter> parameters;
    std::string pane;
    rg_pane_stats water{};
  };
  void refresh(Stage& stage, double seconds);
  void drawStatus(Stage& stage, double fps, const char* note) const;
  void drawKeys() const;
  void drawStages() const;
  void drawWater() const;
  void drawWeather(Stage& stage) const;
  void drawParameters(Stage& stage);

  struct DestroyImgui {
    void operator()(ImGuiContext* context) const;
  };
  std::unique_ptr<ImGuiContext, DestroyImgui> imgui_;
  std::unique_ptr<ImguiGl> painter_;
  enum class Shown { greeting, all, nothing } shown_ = Shown::greeting;
  double greeting_left_s_;
  double slow_age_s_ = 1e9;
  Slow slow_;
};

}  // namespace host
