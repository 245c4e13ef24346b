// A display that nobody sees, and a hand on the window that opens there.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct _XDisplay;

namespace testing_window {

// Waits until `ready`, asking every 20 ms; false when `patience` runs out.
bool wait(const std::function<bool()>& ready, std::chrono::seconds patience = std::chrono::seconds(90));

// A program of ours that runs beside the test; killed at the end if it is still there.
class Process {
 public:
  Process(const std::string& program, const std::vector<std::string>& arguments,
          const std::vector<std::string>& environment, int kept_file = -1);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  // Exit code once it has ended; -1 by a signal.
  std::optional<int> ended();

 private:
  pid_t id_ = -1;
  std::optional<int> exit_code_;
};

// Xvfb on a number that it finds free.
class Display {
 public:
  static bool canBeHad();
  Display();
  ~Display();
  const std::string& name() const { return name_; }

  // The window that is seen, by what its title begins with; 0 when there is none.
  unsigned long find(const std::string& title) const;
  std::string title(unsigned long window) const;
  // As a person would: keys by X's names ("c", "Up", "Escape"), the mouse and its left button, size and
  // closing by the window's frame.
  void press(unsigned long window, const char* key, bool shifted = false);
  void hold(unsigned long window, const char* key, bool down);
  void point(unsigned long window, int x_px, int y_px, bool down);
  void resize(unsigned long window, int width_px, int height_px);
  void close(unsigned long window);

 private:
  std::string name_;
  std::unique_ptr<Process> server_;
  _XDisplay* x_ = nullptr;
};

}  // namespace testing_window
