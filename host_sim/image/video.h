// A video file from pictures, made by the ffmpeg program: H.264, yuv420p, mp4.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace host {

class Video {
 public:
  /// Starts ffmpeg. Throws std::runtime_error when it is missing or the size is odd or not positive.
  Video(std::filesystem::path file, int width_px, int height_px, double frames_per_s,
        const std::string& program = "ffmpeg");
  /// Without finish(): ends ffmpeg and leaves what it made.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// One picture: RGB, 8 bits each, top row first. Throws std::runtime_error with ffmpeg's last words when it
  /// has given up.
  void add(std::span<const std::uint8_t> rgb);
  /// Waits until the file is whole. Throws std::runtime_error when ffmpeg failed.
  void finish();

 private:
  [[noreturn]] void fail();
  int wait();

  std::filesystem::path file_;
  std::size_t frame_bytes_ = 0;
  int pipe_ = -1;
  int errors_ = -1;
  pid_t process_ = -1;
};

}  // namespace host
