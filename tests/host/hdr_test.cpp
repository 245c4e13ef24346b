// Radiance pictures: the same picture however it is coded, and no byte read that is not there.
#include "image/hdr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gltf_files.h"

namespace {

using files::Bytes;
using Pixel = std::array<std::uint8_t, 4>;

Bytes bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

Bytes header(const std::string& size) {
  return bytesOf("#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n" + size + "\n");
}

/// 16 x 2: a run of 10 and six of their own, then a row of one colour.
std::vector<Pixel> picture() {
  std::vector<Pixel> pixels(32, Pixel{10, 20, 30, 130});
  for (std::uint8_t i = 0; i < 6; ++i)
    pixels[10U + i] = {static_cast<std::uint8_t>(40 + i), 3, i, static_cast<std::uint8_t>(120 + i)};
  for (std::size_t i = 16; i < 32; ++i) pixels[i] = {200, 100, 50, 140};
  return pixels;
}

Bytes flat(const std::vector<Pixel>& pixels, const std::string& size) {
  Bytes out = header(size);
  for (const Pixel& p : pixels) out.insert(out.end(), p.begin(), p.end());
  return out;
}

Bytes newCoded(const std::vector<Pixel>& pixels) {
  Bytes out = header("-Y 2 +X 16");
  for (std::size_t row = 0; row < 2; ++row) {
    out.insert(out.end(), {2, 2, 0, 16});
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const auto at = [&](std::size_t x) { return pixels[row * 16 + x][channel]; };
      out.insert(out.end(), {128 + 10, at(0), 6});  // ten alike, then six as they are
      for (std::size_t x = 10; x < 16; ++x) out.push_back(at(x));
    }
  }
  return out;
}

Bytes oldCoded(const std::vector<Pixel>& pixels) {
  Bytes out = header("-Y 2 +X 16");
  const auto put = [&](const Pixel& p) { out.insert(out.end(), p.begin(), p.end()); };
  put(pixels[0]);
  put({1, 1, 1, 9});
  for (std::size_t x = 10; x < 16; ++x) put(pixels[x]);
  put(pixels[16]);
  put({1, 1, 1, 15});
  return out;
}

std::string complaint(const Bytes& bytes) {
  try {
    host::readHdr(bytes, "sky.hdr");
    return "";
  } catch (const host::HdrError& error) {
    return error.what();
  }
}

TEST(Hdr, valuesAreMantissaTimesPowerOfTwo) {
  const host::HdrImage image =
      host::readHdr(flat({{127, 0, 255, 129}, {9, 9, 9, 0}}, "-Y 1 +X 2"), "sky.hdr");
  ASSERT_EQ(image.rgb.size(), 6U);
  EXPECT_FLOAT_EQ(image.rgb[0], 127.5F / 128.0F);
  EXPECT_FLOAT_EQ(image.rgb[1], 0.5F / 128.0F);
  EXPECT_FLOAT_EQ(image.rgb[2], 255.5F / 128.0F);
  EXPECT_EQ(image.rgb[3], 0.0F) << "exponent 0 is black";
}

TEST(Hdr, allCodingsGiveTheSamePicture) {
  const host::HdrImage plain = host::readHdr(flat(picture(), "-Y 2 +X 16"), "sky.hdr");
  EXPECT_EQ(plain.width_px, 16);
  EXPECT_EQ(plain.height_px, 2);
  EXPECT_EQ(host::readHdr(newCoded(picture()), "sky.hdr").rgb, plain.rgb);
  EXPECT_EQ(host::readHdr(oldCoded(picture()), "sky.hdr").rgb, plain.rgb);
}

TEST(Hdr, rowsAndColumnsAreTurnedUpright) {
  // Two wide, three high: the pixel that lies in the top left corner is marked, wherever the file has it.
  const auto marked = [](std::size_t at, const char* size) {
    std::vector<Pixel> pixels(6, Pixel{1, 2, 3, 100});
    pixels[at] = {200, 0, 0, 130};
    return host::readHdr(flat(pixels, size), "sky.hdr");
  };
  for (const auto& [at, size] : std::vector<std::pair<std::size_t, const char*>>{{0, "-Y 3 +X 2"},
                                                                                 {1, "-Y 3 -X 2"},
                                                                                 {4, "+Y 3 +X 2"},
                                                                                 {5, "+Y 3 -X 2"},
                                                                                 {0, "+X 2 -Y 3"},
                                                                                 {3, "-X 2 -Y 3"},
                                                                                 {2, "+X 2 +Y 3"},
                                                                                 {5, "-X 2 +Y 3"}}) {
    const host::HdrImage image = marked(at, size);
    EXPECT_EQ(image.width_px, 2) << size;
    EXPECT_EQ(image.height_px, 3) << size;
    EXPECT_GT(image.rgb[0], 1.0F) << size;
  }
}

TEST(Hdr, brokenFilesAreRefusedInOneLine) {
  Bytes lying = newCoded(picture());
  const std::size_t first_run = header("-Y 2 +X 16").size() + 4;
  lying[first_run] = 255;  // a run of 127 in a row of 16
  Bytes zero = newCoded(picture());
  zero[first_run] = 0;  // a run of nothing would never end
  Bytes short_line = newCoded(picture());
  short_line[first_run - 1] = 15;
  Bytes leading_run = header("-Y 1 +X 4");
  leading_run.insert(leading_run.end(), {1, 1, 1, 4});
  const std::vector<std::pair<Bytes, const char*>> cases = {
      {{}, "is cut off"},
      {bytesOf("P6\n"), "is no Radiance picture"},
      {bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd"), "is not in the format"},
      {bytesOf("#?RADIANCE\n" + std::string(10'000, 'a')), "header line longer"},
      {bytesOf("#?RADIANCE\n" + std::string(1, 'a')), "is cut off"},
      {header("1024 768"), "no sound line of its size"},
      {header("-Y 2 +Y 2"), "no sound line of its size"},
      {header("-Y 0 +X 2"), "is 0 x 2 pixels"},
      {header("-Y -5 +X 2"), "is -5 x 2 pixels"},
      {header("-Y 16384 +X 16384"), "is 16384 x 16384 pixels"},
      {header("-Y 99999 +X 1"), "is 99999 x 1 pixels"},
      {header("-Y 99999999999 +X 1"), "no sound line of its size"},
      {header("-Y 16000 +X 4000"), "is cut off"},
      {lying, "broken scanline"},
      {zero, "broken scanline"},
      {short_line, "scanline of another length"},
      {leading_run, "broken scanline"}};
  for (const auto& [bytes, expected] : cases) {
    const std::string message = complaint(bytes);
    EXPECT_EQ(message.rfind("sky.hdr: ", 0), 0U) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << expected << ": " << message;
  }
}

TEST(Hdr, everyTruncationIsRefused) {
  for (const Bytes& sound : {flat(picture(), "-Y 2 +X 16"), newCoded(picture()), oldCoded(picture())}) {
    for (std::size_t size = 0; size < sound.size(); ++size) {
      EXPECT_NE(complaint({sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
    }
  }
}

TEST(Hdr, randomDamageLoadsOrIsRefused) {
  std::mt19937 random(3);
  for (const Bytes& sound : {flat(picture(), "-Y 2 +X 16"), newCoded(picture()), oldCoded(picture())}) {
    for (int i = 0; i < 3000; ++i) {
      Bytes bytes = sound;
      for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random() % 256);
      const std::string message = complaint(bytes);
      EXPECT_TRUE(message.empty() || message.rfind("sky.hdr: ", 0) == 0) << message;
    }
  }
}

TEST(Hdr, filesThatAreNoneAreRefused) {
  const files::TempFolder folder;
  std::filesystem::create_directories(folder / "dir.hdr");
  const auto says = [](const std::filesystem::path& file) -> std::string {
    try {
      host::loadHdr(file);
      return "";
    } catch (const host::HdrError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(says(folder / "none.hdr"), "none.hdr: no such file");
  EXPECT_EQ(says(folder / "dir.hdr"), "dir.hdr: is not a regular file");
  EXPECT_EQ(says(folder.write("good.hdr", newCoded(picture()))), "");
}

}  // namespace
