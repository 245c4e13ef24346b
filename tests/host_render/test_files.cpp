// Pictures and videos as files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "image/png.h"
#include "image/video.h"

namespace host {
namespace {

namespace fs = std::filesystem;

struct Files : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("host_files_" + std::to_string(::getpid()));
  Files() { fs::create_directories(folder); }
  ~Files() override { fs::remove_all(folder); }

  std::string failureOf(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return {};
  }
};

std::vector<std::uint8_t> ramp(int width, int height) {
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < width * height * 3; ++i) rgb.push_back(static_cast<std::uint8_t>(i * 7));
  return rgb;
}

TEST_F(Files, pngComesBackAsItWasWritten) {
  const auto rgb = ramp(13, 5);
  writePng(folder / "a.png", rgb, 13, 5);
  const Picture8 read = readPng(folder / "a.png");
  EXPECT_EQ(read.width_px, 13);
  EXPECT_EQ(read.height_px, 5);
  EXPECT_EQ(read.rgb, rgb);
}

TEST_F(Files, pngThatCannotBeWrittenNamesTheFileAndLeavesNothing) {
  const fs::path file = folder / "none" / "a.png";
  EXPECT_NE(failureOf([&] { writePng(file, ramp(4, 4), 4, 4); }).find(file.string()), std::string::npos);
  EXPECT_NE(failureOf([&] { writePng(folder / "b.png", ramp(4, 4), 5, 4); }).find("b.png"),
            std::string::npos);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Files, damagedPngIsRefusedByName) {
  std::ofstream(folder / "a.png") << "no picture";
  EXPECT_NE(failureOf([&] { readPng(folder / "a.png"); }).find("a.png"), std::string::npos);
}

TEST_F(Files, videoHoldsTheFramesGiven) {
  const fs::path file = folder / "a.mp4";
  Video video(file, 64, 48, 30.0);
  for (int i = 0; i < 10; ++i) video.add(ramp(64, 48));
  video.finish();
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(bytes.find("ftyp"), std::string::npos);
  EXPECT_NE(bytes.find("avc1"), std::string::npos);
}

TEST_F(Files, missingFfmpegIsNamed) {
  const std::string why = failureOf([&] { Video(folder / "a.mp4", 64, 48, 30.0, "no_such_program_here"); });
  EXPECT_NE(why.find("no_such_program_here"), std::string::npos);
  EXPECT_NE(why.find("not installed"), std::string::npos);
}

TEST_F(Files, failingFfmpegIsToldAndDoesNotKillTheHost) {
  const std::string why = failureOf([&] {
    Video video(folder / "none" / "a.mp4", 640, 480, 30.0);
    for (int i = 0; i < 50; ++i) video.add(ramp(640, 480));
    video.finish();
  });
  EXPECT_NE(why.find("ffmpeg failed"), std::string::npos);
  EXPECT_NE(why.find("No such file"), std::string::npos);
}

TEST_F(Files, oddSizesAreRefused) {
  EXPECT_NE(failureOf([&] { Video(folder / "a.mp4", 63, 48, 30.0); }).find("even"), std::string::npos);
}

}  // namespace
}  // namespace host
