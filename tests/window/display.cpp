#include "display.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace testing_window {
namespace {

std::optional<std::filesystem::path> program(const std::string& name) {
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / name;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

// A window may be gone by the time it is asked about.
int ignoreErrors(::Display*, XErrorEvent*) { return 0; }

}  // namespace

bool wait(const std::function<bool()>& ready, std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!ready()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

Process::Process(const std::string& program, const std::vector<std::string>& arguments,
                 const std::vector<std::string>& environment, int kept_file) {
  std::vector<std::string> words{program}, settings(environment);
  words.insert(words.end(), arguments.begin(), arguments.end());
  for (char** e = environ; *e != nullptr; ++e) {
    if (std::strncmp(*e, "DISPLAY=", 8) != 0 && std::strncmp(*e, "WAYLAND_DISPLAY=", 16) != 0)
      settings.emplace_back(*e);
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (kept_file >= 0) posix_spawn_file_actions_adddup2(&actions, kept_file, kept_file);
  const int failed = posix_spawn(&id_, program.c_str(), &actions, nullptr, pointers(words).data(),
                                 pointers(settings).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error(program + ": " + std::strerror(failed));
}

Process::~Process() {
  if (ended()) return;
  kill(id_, SIGTERM);
  if (!wait([this] { return ended().has_value(); }, std::chrono::seconds(5))) {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
}

std::optional<int> Process::ended() {
  int status = 0;
  if (!exit_code_ && waitpid(id_, &status, WNOHANG) == id_)
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return exit_code_;
}

bool Display::canBeHad() { return program("Xvfb").has_value(); }

Display::Display() {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to Xvfb");
  fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  server_ =
      std::make_unique<Process>(program("Xvfb")->string(),
                                std::vector<std::string>{"-displayfd", std::to_string(ends[1]), "-screen",
                                                         "0", "800x600x24", "-nolisten", "tcp"},
                                std::vector<std::string>{}, ends[1]);
  ::close(ends[1]);
  name_.assign(1, ':');
  for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) name_ += c;
  ::close(ends[0]);
  XSetErrorHandler(ignoreErrors);
  x_ = XOpenDisplay(name_.c_str());
  if (x_ == nullptr) throw std::runtime_error("Xvfb does not answer on display " + name_);
}

Display::~Display() {
  if (x_ != nullptr) XCloseDisplay(x_);
}

std::string Display::title(unsigned long window) const {
  char* text = nullptr;
  if (XFetchName(x_, window, &text) == 0 || text == nullptr) return "";
  const std::string title = text;
  XFree(text);
  return title;
}

unsigned long Display::find(const std::string& begins) const {
  ::Window root = 0, parent = 0, *all = nullptr, found = 0;
  unsigned count = 0;
  if (XQueryTree(x_, DefaultRootWindow(x_), &root, &parent, &all, &count) == 0) return 0;
  for (unsigned i = 0; i < count; ++i) {
    XWindowAttributes attributes{};
    if (XGetWindowAttributes(x_, all[i], &attributes) == 0 || attributes.map_state != IsViewable) continue;
    if (title(all[i]).rfind(begins, 0) == 0) found = all[i];
  }
  if (all != nullptr) XFree(all);
  return found;
}

void Display::hold(unsigned long window, const char* key, bool down) {
  XEvent event{};
  event.xkey.type = down ? KeyPress : KeyRelease;
  event.xkey.display = x_;
  event.xkey.window = window;
  event.xkey.root = DefaultRootWindow(x_);
  event.xkey.same_screen = True;
  event.xkey.keycode = XKeysymToKeycode(x_, XStringToKeysym(key));
  XSendEvent(x_, window, True, down ? KeyPressMask : KeyReleaseMask, &event);
  XSync(x_, False);
}

void Display::press(unsigned long window, const char* key, bool shifted) {
  if (shifted) hold(window, "Shift_L", true);
  hold(window, key, true);
  hold(window, key, false);
  if (shifted) hold(window, "Shift_L", false);
}

void Display::point(unsigned long window, int x_px, int y_px, bool down) {
  XEvent event{};
  event.xmotion.type = MotionNotify;
  event.xmotion.display = x_;
  event.xmotion.window = window;
  event.xmotion.root = DefaultRootWindow(x_);
  event.xmotion.x = x_px;
  event.xmotion.y = y_px;
  event.xmotion.same_screen = True;
  XSendEvent(x_, window, True, PointerMotionMask, &event);
  event.xbutton.type = down ? ButtonPress : ButtonRelease;  // laid out as motion this far
  event.xbutton.button = Button1;
  XSendEvent(x_, window, True, down ? ButtonPressMask : ButtonReleaseMask, &event);
  XSync(x_, False);
}

void Display::resize(unsigned long window, int width_px, int height_px) {
  XResizeWindow(x_, window, static_cast<unsigned>(width_px), static_cast<unsigned>(height_px));
  XSync(x_, False);
}

void Display::close(unsigned long window) {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = XInternAtom(x_, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(x_, "WM_DELETE_WINDOW", False));
  XSendEvent(x_, window, False, NoEventMask, &event);
  XSync(x_, False);
}

}  // namespace testing_window
