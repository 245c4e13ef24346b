#include "window/glfw_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <glm/common.hpp>

namespace host {
namespace {

std::string glfwMessage() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

class GlfwWindow final : public Window {
 public:
  GlfwWindow(const std::string& title, glm::ivec2 size, bool debug) {
    if (!glfwInit())
      throw std::runtime_error("no window can be opened (--headless needs none): " + glfwMessage());
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the picture is drawn elsewhere and only copied here
    window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) refuse();
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    try {
      load(debug);
    } catch (...) {
      glfwDestroyWindow(window_);
      glfwTerminate();
      throw;
    }
    listen();
  }
  ~GlfwWindow() override {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  glm::ivec2 sizePx() const override {
    glm::ivec2 size{0};
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
  }
  float textScale() const override {
    float x = 1.0F, y = 1.0F;
    glfwGetWindowContentScale(window_, &x, &y);
    return y;
  }
  bool closed() const override { return glfwWindowShouldClose(window_) != 0; }
  void close() override { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
  bool isDown(int key) const override { return glfwGetKey(window_, key) == GLFW_PRESS; }
  void setTitle(const std::string& title) override { glfwSetWindowTitle(window_, title.c_str()); }
  void show() override {
    glfwSwapBuffers(window_);
    glfwPollEvents();
  }

 private:
  Proc proc(const char* name) const override { return glfwGetProcAddress(name); }

  /// A window without a 4.5 context: tries a plain one, to say what the driver has.
  [[noreturn]] void refuse() {
    const std::string why = glfwMessage();
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    window_ = glfwCreateWindow(64, 64, "", nullptr, nullptr);
    std::string found = "found none by the display (" + why + ")";
    if (window_ != nullptr) {
      glfwMakeContextCurrent(window_);
      using GetString = const GLubyte*(GLAD_API_PTR*)(GLenum);
      const auto get_string = reinterpret_cast<GetString>(glfwGetProcAddress("glGetString"));
      const auto text = [&](GLenum name) {
        return std::string(reinterpret_cast<const char*>(get_string(name)));
      };
      if (get_string) found = "found OpenGL " + text(GL_VERSION) + " by " + text(GL_RENDERER);
      glfwDestroyWindow(window_);
    }
    glfwTerminate();
    throw NoGl45("OpenGL 4.5 is needed; " + found);
  }

  static GlfwWindow& self(GLFWwindow* window) {
    return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
  }

  void listen() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
      const auto& on_key = self(window).events.on_key;
      if (on_key && action != GLFW_REPEAT) on_key(key, action == GLFW_PRESS);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
      if (self(window).events.on_scroll) self(window).events.on_scroll(steps);
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
      const auto& on_button = self(window).events.on_button;
      if (on_button && button == GLFW_MOUSE_BUTTON_LEFT) on_button(action == GLFW_PRESS);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
      self(window).moved({x, y});
    });
  }
  /// `to` is in the window's own units, which are pixels only where the display does not scale.
  void moved(glm::dvec2 to) {
    glm::ivec2 size{1};
    glfwGetWindowSize(window_, &size.x, &size.y);
    const glm::dvec2 to_px = to * glm::dvec2(sizePx()) / glm::dvec2(glm::max(size, glm::ivec2(1)));
    const glm::dvec2 by_px = to_px - cursor_px_;
    cursor_px_ = to_px;
    if (events.on_cursor) events.on_cursor(to_px);
    if (events.on_drag && glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
      events.on_drag(by_px);
  }

  GLFWwindow* window_ = nullptr;
  glm::dvec2 cursor_px_{0.0};
};

}  // namespace

bool hasDisplay() {
  const char* x11 = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  return (x11 && *x11) || (wayland && *wayland);
}

std::unique_ptr<Window> makeWindow(const std::string& title, glm::ivec2 size, bool debug) {
  return std::make_unique<GlfwWindow>(title, size, debug);
}

}  // namespace host
