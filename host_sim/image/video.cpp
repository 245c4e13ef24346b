#include "image/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace host {
namespace {

/// A pipe whose reader is gone kills the writer by SIGPIPE; within this scope write() answers EPIPE instead.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutSigpipe() {
    const timespec now{};
    while (sigtimedwait(&pipe_, nullptr, &now) == SIGPIPE) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};

std::vector<std::string> arguments(const std::string& program, const std::filesystem::path& file,
                                   int width_px, int height_px, double frames_per_s) {
  char rate[32];
  std::snprintf(rate, sizeof rate, "%.6g", frames_per_s);
  // An absolute path cannot be taken for an option or a protocol.
  return {program,
          "-hide_banner",
          "-loglevel",
          "error",
          "-nostdin",
          "-y",
          "-f",
          "rawvideo",
          "-pixel_format",
          "rgb24",
          "-video_size",
          std::to_string(width_px) + "x" + std::to_string(height_px),
          "-framerate",
          rate,
          "-i",
          "pipe:0",
          "-an",
          "-c:v",
          "libx264",
          "-preset",
          "veryfast",
          "-crf",
          "20",
          "-vf",
          "scale=out_color_matrix=bt709",
          "-colorspace",
          "bt709",
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+faststart",
          std::filesystem::absolute(file).string()};
}

/// A file that is unlinked at once: takes ffmpeg's messages without blocking it, whatever their length.
int messageFile() {
  char name[] = "/tmp/video_messages_XXXXXX";
  const int file = mkostemp(name, O_CLOEXEC);
  if (file >= 0) unlink(name);
  return file;
}

std::string lastWords(int file) {
  char text[2000];
  const ssize_t length = file < 0 ? 0 : pread(file, text, sizeof text, 0);
  std::string words(text, length > 0 ? static_cast<std::size_t>(length) : 0);
  while (!words.empty() && words.back() == '\n') words.pop_back();
  for (char& c : words) c = c == '\n' ? ' ' : c;
  return words;
}

}  // namespace

Video::Video(std::filesystem::path file, int width_px, int height_px, double frames_per_s,
             const std::string& program)
    : file_(std::move(file)) {
  if (width_px <= 0 || height_px <= 0 || width_px % 2 != 0 || height_px % 2 != 0) {
    throw std::runtime_error(file_.string() + ": a video's width and height must be even");
  }
  frame_bytes_ = 3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error(file_.string() + ": no pipe to ffmpeg: " + std::strerror(errno));
  errors_ = messageFile();

  std::vector<std::string> words = arguments(program, file_, width_px, height_px, frames_per_s);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (errors_ >= 0) posix_spawn_file_actions_adddup2(&actions, errors_, STDERR_FILENO);
  const int failed = posix_spawnp(&process_, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (failed == 0) return;
  close(pipe_);
  if (errors_ >= 0) close(errors_);
  const std::string why =
      failed == ENOENT ? "is not installed" : std::string("cannot be started: ") + std::strerror(failed);
  throw std::runtime_error(file_.string() + ": the program " + program + " that makes videos " + why);
}

Video::~Video() {
  if (process_ > 0) wait();
  if (errors_ >= 0) close(errors_);
}

void Video::add(std::span<const std::uint8_t> rgb) {
  if (rgb.size() != frame_bytes_)
    throw std::runtime_error(file_.string() + ": a picture of another size than the video's");
  const WithoutSigpipe quiet;
  while (!rgb.empty()) {
    const ssize_t written = write(pipe_, rgb.data(), rgb.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail();
    rgb = rgb.subspan(static_cast<std::size_t>(written));
  }
}

void Video::finish() {
  if (process_ > 0 && wait() != 0) fail();
}

int Video::wait() {
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

void Video::fail() {
  if (process_ > 0) wait();
  const std::string words = lastWords(errors_);
  throw std::runtime_error(file_.string() + ": ffmpeg failed" + (words.empty() ? "" : ": " + words));
}

}  // namespace host
