#include "image/decode.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <stdexcept>
#include <string>

namespace host {

namespace {

using File = std::span<const std::uint8_t>;

void checkSize(std::int64_t width_px, std::int64_t height_px) {
  const bool sane = width_px > 0 && height_px > 0 && width_px <= kLongestImageSide_px &&
                    height_px <= kLongestImageSide_px && width_px * height_px <= kLargestImage_px;
  if (sane) return;
  throw std::runtime_error("image is " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                           " pixels, at most 16384 a side and 64 million in all are allowed");
}

// ---- PNG

/// libpng's state. Its errors jump back to the setjmp in readPng(), which holds no C++ object with a
/// destructor.
struct PngReader {
  File rest;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<std::uint8_t> rgba;
  std::vector<png_bytep> rows;
  std::array<char, 120> error{};

  explicit PngReader(File file) : rest(file) {}
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void onPngError(png_structp png, png_const_charp message) {
  auto& reader = *static_cast<PngReader*>(png_get_error_ptr(png));
  std::strncpy(reader.error.data(), message, reader.error.size() - 1);
  png_longjmp(png, 1);
}

void onPngWarning(png_structp, png_const_charp) {}

void onPngRead(png_structp png, png_bytep out, std::size_t size) {
  auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
  if (size > reader.rest.size()) png_error(png, "file is cut off");
  std::memcpy(out, reader.rest.data(), size);
  reader.rest = reader.rest.subspan(size);
}

bool readPngHeader(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_read_fn(reader.png, &reader, onPngRead);
  png_set_chunk_malloc_max(reader.png, 8U << 20);
  png_read_info(reader.png, reader.info);
  png_set_expand(reader.png);
  png_set_strip_16(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_add_alpha(reader.png, 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool readPngRows(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_image(reader.png, reader.rows.data());
  return true;
}

Pixels decodePng(File file) {
  PngReader reader(file);
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, onPngError, onPngWarning);
  if (reader.png != nullptr) reader.info = png_create_info_struct(reader.png);
  if (reader.info == nullptr) throw std::runtime_error("PNG reader cannot start");
  png_set_user_limits(reader.png, 0x7fffffffU, 0x7fffffffU);  // checkSize() names the size instead
  if (!readPngHeader(reader)) throw std::runtime_error(std::string("PNG is broken: ") + reader.error.data());
  const std::size_t width_px = png_get_image_width(reader.png, reader.info);
  const std::size_t height_px = png_get_image_height(reader.png, reader.info);
  checkSize(static_cast<std::int64_t>(width_px), static_cast<std::int64_t>(height_px));
  if (png_get_rowbytes(reader.png, reader.info) != width_px * 4)
    throw std::runtime_error("PNG is of an unknown kind");
  reader.rgba.resize(width_px * height_px * 4);
  for (std::size_t y = 0; y < height_px; ++y) reader.rows.push_back(reader.rgba.data() + y * width_px * 4);
  if (!readPngRows(reader)) throw std::runtime_error(std::string("PNG is broken: ") + reader.error.data());
  return {static_cast<int>(width_px), static_cast<int>(height_px), std::move(reader.rgba)};
}

// ---- JPEG

/// libjpeg-turbo. Its own decoder stands up to damaged files, which the one inside tinygltf (stb_image)
/// answers with an assertion.
class JpegDecoder {
 public:
  JpegDecoder() : handle_(tjInitDecompress()) {
    if (handle_ == nullptr) throw std::runtime_error("JPEG reader cannot start");
  }
  ~JpegDecoder() { tjDestroy(handle_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  Pixels decode(File file) {
    Pixels pixels;
    const auto bytes = static_cast<unsigned long>(file.size());
    int subsampling = 0, colour_space = 0;
    check(tjDecompressHeader3(handle_, file.data(), bytes, &pixels.width_px, &pixels.height_px, &subsampling,
                              &colour_space));
    // A file that ends before its frame passes as one with tables only.
    if (pixels.width_px <= 0) throw std::runtime_error("JPEG is broken: it has no frame");
    checkSize(pixels.width_px, pixels.height_px);
    pixels.rgba.resize(static_cast<std::size_t>(pixels.width_px) *
                       static_cast<std::size_t>(pixels.height_px) * 4);
    // Scans without end would take hours: a progressive picture has a dozen.
    check(tjDecompress2(handle_, file.data(), bytes, pixels.rgba.data(), pixels.width_px, 0, pixels.height_px,
                        TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS));
    return pixels;
  }

 private:
  // Warnings count: a file that is cut off decodes to grey with no more than one.
  void check(int failed) {
    if (failed != 0) throw std::runtime_error(std::string("JPEG is broken: ") + tjGetErrorStr2(handle_));
  }

  tjhandle handle_;
};

Pixels decodeJpeg(File file) { return JpegDecoder().decode(file); }

bool startsWith(File file, std::initializer_list<std::uint8_t> bytes) {
  return file.size() >= bytes.size() && std::equal(bytes.begin(), bytes.end(), file.begin());
}

}  // namespace

Pixels decodePixels(File file) {
  if (startsWith(file, {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'})) return decodePng(file);
  if (startsWith(file, {0xff, 0xd8})) return decodeJpeg(file);
  throw std::runtime_error("image is neither PNG nor JPEG");
}

}  // namespace host
