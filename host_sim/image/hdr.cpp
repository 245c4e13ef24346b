// The format: Ward, "Real pixels", Graphics Gems II (1991), II.8, and Radiance's file format notes (filefmts,
// "Picture File Format").
#include "image/hdr.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "image/decode.h"

namespace host {

namespace {

using Pixel = std::array<std::uint8_t, 4>;  // red, green, blue mantissas and their common exponent

constexpr std::uintmax_t kLargestFile_bytes = 512U << 20;
constexpr std::size_t kLongestLine_bytes = 4096;
constexpr std::size_t kMostLines = 1000;

struct Reader {
  std::span<const std::uint8_t> rest;
  const std::string& name;

  [[noreturn]] void fail(const std::string& what) const { throw HdrError(name + ": " + what); }

  std::uint8_t byte() {
    if (rest.empty()) fail("is cut off");
    const std::uint8_t value = rest.front();
    rest = rest.subspan(1);
    return value;
  }

  std::string line() {
    std::string text;
    for (std::uint8_t c = byte(); c != '\n'; c = byte()) {
      if (text.size() == kLongestLine_bytes) fail("has a header line longer than 4096 bytes");
      text.push_back(static_cast<char>(c));
    }
    return text;
  }

  Pixel pixel() {
    Pixel p{};
    for (std::uint8_t& channel : p) channel = byte();
    return p;
  }
};

void readHeader(Reader& reader) {
  const std::string magic = reader.line();
  if (magic.rfind("#?", 0) != 0) reader.fail("is no Radiance picture");
  for (std::size_t i = 0; i < kMostLines; ++i) {
    const std::string line = reader.line();
    if (line.empty()) return;
    if (line.rfind("FORMAT=", 0) == 0 && line != "FORMAT=32-bit_rle_rgbe")
      reader.fail("is not in the format 32-bit_rle_rgbe");
  }
  reader.fail("has a header of more than 1000 lines");
}

/// How the file's scanlines lie: "-Y 512 +X 1024" means rows from the top, columns from the left.
struct Order {
  int scanlines = 0;
  int length = 0;
  bool along_y = false;  ///< scanlines are columns
  bool flip_x = false;
  bool flip_y = false;
};

Order readOrder(Reader& reader) {
  const std::string line = reader.line();
  std::array<char, 2> sign{};
  std::array<char, 2> axis{};
  std::array<int, 2> size{};
  // %6d: no overflow; larger ones do not fit the limit anyway.
  const int found = std::sscanf(line.c_str(), "%c%c %6d %c%c %6d", &sign[0], &axis[0], &size[0], &sign[1],
                                &axis[1], &size[1]);
  const auto isSign = [](char c) { return c == '+' || c == '-'; };
  const bool is_axes = (axis[0] == 'Y' && axis[1] == 'X') || (axis[0] == 'X' && axis[1] == 'Y');
  if (found != 6 || !isSign(sign[0]) || !isSign(sign[1]) || !is_axes)
    reader.fail("has no sound line of its size");
  const bool fits = size[0] > 0 && size[1] > 0 && size[0] <= kLongestImageSide_px &&
                    size[1] <= kLongestImageSide_px &&
                    static_cast<std::int64_t>(size[0]) * size[1] <= kLargestImage_px;
  if (!fits) {
    reader.fail("is " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
                " pixels, at most 16384 a side and 64 million in all are allowed");
  }
  const bool along_y = axis[0] == 'X';
  const char x_sign = along_y ? sign[0] : sign[1];
  const char y_sign = along_y ? sign[1] : sign[0];
  return {size[0], size[1], along_y, x_sign == '-', y_sign == '+'};
}

/// A channel's run-length code: above 128, that many less 128 of one value; else that many values.
void readNewScanline(Reader& reader, std::vector<Pixel>& line) {
  for (std::size_t channel = 0; channel < 4; ++channel) {
    std::size_t at = 0;
    while (at < line.size()) {
      const std::uint8_t code = reader.byte();
      const bool is_run = code > 128;
      const std::size_t count = is_run ? code - 128U : code;
      if (count == 0 || count > line.size() - at) reader.fail("has a broken scanline");
      const std::uint8_t run = is_run ? reader.byte() : std::uint8_t{0};
      for (std::size_t i = 0; i < count; ++i) line[at++][channel] = is_run ? run : reader.byte();
    }
  }
}

/// Flat pixels, where (1, 1, 1, n) repeats the one before n times; in a row of them each counts 256 times
/// more.
void readOldScanline(Reader& reader, std::vector<Pixel>& line, Pixel first) {
  std::size_t at = 0;
  unsigned shift = 0;
  for (Pixel p = first;; p = reader.pixel()) {
    if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
      const std::size_t count = shift <= 16 ? static_cast<std::size_t>(p[3]) << shift : line.size() + 1;
      if (at == 0 || count > line.size() - at) reader.fail("has a broken scanline");
      for (std::size_t i = 0; i < count; ++i, ++at) line[at] = line[at - 1];
      shift += 8;
    } else {
      line[at++] = p;
      shift = 0;
    }
    if (at == line.size()) return;
  }
}

void readScanline(Reader& reader, std::vector<Pixel>& line) {
  const Pixel first = reader.pixel();
  const std::size_t coded_length = first[2] * 256U + first[3];
  const bool is_new =
      line.size() >= 8 && line.size() < 32768 && first[0] == 2 && first[1] == 2 && first[2] < 128;
  if (!is_new) {
    readOldScanline(reader, line, first);
    return;
  }
  if (coded_length != line.size()) reader.fail("has a scanline of another length");
  readNewScanline(reader, line);
}

void store(const Pixel& from, float* to) {
  // Half a unit is added to each mantissa, as Radiance does; an exponent of 0 is black.
  const float scale = from[3] == 0 ? 0.0F : std::ldexp(1.0F, static_cast<int>(from[3]) - (128 + 8));
  for (std::size_t i = 0; i < 3; ++i) to[i] = (static_cast<float>(from[i]) + 0.5F) * scale;
}

}  // namespace

HdrImage readHdr(std::span<const std::uint8_t> bytes, const std::string& name) {
  Reader reader{bytes, name};
  readHeader(reader);
  const Order order = readOrder(reader);
  // A run of 127 needs 2 bytes a channel and old runs 4 bytes a scanline: a file cannot hold more than this,
  // and is not trusted to.
  if (reader.rest.size() < static_cast<std::size_t>(order.scanlines) * 4) reader.fail("is cut off");
  HdrImage image;
  image.width_px = order.along_y ? order.scanlines : order.length;
  image.height_px = order.along_y ? order.length : order.scanlines;
  image.rgb.resize(static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px) * 3);
  std::vector<Pixel> line(static_cast<std::size_t>(order.length));
  for (int s = 0; s < order.scanlines; ++s) {
    readScanline(reader, line);
    for (int i = 0; i < order.length; ++i) {
      const int x = order.along_y ? s : i;
      const int y = order.along_y ? i : s;
      const int column = order.flip_x ? image.width_px - 1 - x : x;
      const int row = order.flip_y ? image.height_px - 1 - y : y;
      const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
                      static_cast<std::size_t>(column);
      store(line[static_cast<std::size_t>(i)], image.rgb.data() + 3 * at);
    }
  }
  return image;
}

HdrImage loadHdr(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  try {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) throw HdrError(name + ": no such file");
    if (!std::filesystem::is_regular_file(file, error)) throw HdrError(name + ": is not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error || size > kLargestFile_bytes)
      throw HdrError(name + ": cannot be read or is larger than 512 MiB");
    std::vector<std::uint8_t> bytes(size);
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
      throw HdrError(name + ": cannot be read");
    }
    return readHdr(bytes, name);
  } catch (const std::bad_alloc&) {
    throw HdrError(name + ": needs more memory than there is");
  }
}

}  // namespace host
