// A window to drive in.
#pragma once

#include <functional>
#include <glm/vec2.hpp>

#include "window/context.h"

namespace host {

/// What a person does in the window. Keys are GLFW's (GLFW_KEY_...), given as `key`; `pressed` is false when
/// it is let go.
struct WindowEvents {
  std::function<void(int key, bool pressed)> on_key;
  std::function<void(glm::dvec2 at_px)> on_cursor;   ///< from the picture's upper left corner
  std::function<void(bool pressed)> on_button;       ///< the mouse's left one
  std::function<void(glm::dvec2 moved_px)> on_drag;  ///< the mouse was moved with its left button held
  std::function<void(double steps)> on_scroll;
};

class Window : public Context {
 public:
  WindowEvents events;

  /// Size of what is drawn to, in pixels: not the window's size where the display scales.
  virtual glm::ivec2 sizePx() const = 0;
  /// How many times larger than usual text is to be, as the display asks.
  virtual float textScale() const = 0;
  virtual bool closed() const = 0;
  virtual void close() = 0;
  virtual bool isDown(int key) const = 0;
  virtual void setTitle(const std::string& title) = 0;
  /// Shows what was drawn into framebuffer 0, then calls `events` for what happened since.
  virtual void show() = 0;
};

/// Whether a display is there that a window could open on.
bool hasDisplay();

/// `debug` has the driver check and tell errors. Throws NoGl45, or std::runtime_error when no window can be
/// had at all.
std::unique_ptr<Window> makeWindow(const std::string& title, glm::ivec2 size, bool debug);

}  // namespace host
