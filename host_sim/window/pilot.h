// What a person's keys and mouse change in the window.
#pragma once

#include <glm/glm.hpp>

#include "simulation.h"
#include "window/glfw_window.h"

namespace host {

struct KeyHelp {
  const char* keys;
  const char* effect;
};

inline constexpr KeyHelp kKeyHelp[] = {
    {"arrows", "take the wheel: accelerate, brake, steer"},
    {"Backspace", "give it back"},
    {"C", "next camera: cockpit, bumper, outside, front, side, free, the car's own"},
    {"W A S D Q E", "move the free camera; drag to look round"},
    {"R, Shift R", "more, less rain"},
    {"N", "what falls: rain, snow, hail in turn"},
    {"V, Shift V", "more, less wind from ahead"},
    {"B, Shift B", "more, less wind from the left"},
    {"0", "weather as the scenario says"},
    {"1 2 I U O", "wipers: slow, fast, intermittent, automatic, off"},
    {"X", "wash"},
    {"M", "wipers as the scenario says"},
    {"P", "pause"},
    {"F1", "this panel, with sliders"},
    {"F2", "picture to the --out folder"},
    {"F5, F9", "save the moment to saved.run in the --out folder (or --save), go back to it"},
    {"Esc", "quit"},
};

// Wind as the car meets it standing: x from ahead, y from the left.
glm::dvec2 windByCar(Simulation& sim);
void setWindByCar(Simulation& sim, glm::dvec2 from_mps);

class Pilot {
 public:
  Pilot(Simulation& sim, Window& window) : sim_(sim), window_(window) {}

  void onKey(int key);
  void look(glm::dvec2 moved_px);
  // Keys that are held, every picture.
  void hold(double seconds);

  bool paused() const { return paused_; }
  // Whether a picture was asked for since the last call.
  bool takePicture();

 private:
  bool shift() const;
  double along(int plus_key, int minus_key) const;
  void takeOver();
  void giveBack();
  void nextCamera();
  void changeRain();
  void nextPrecipitation();
  void changeWind(glm::dvec2 from_mps);
  void moveFree(double seconds);

  Simulation& sim_;
  Window& window_;
  bool paused_ = false, picture_ = false;
};

}  // namespace host
