#include "image/decode.h"

#include <png.h>
#include <tiny_gltf.h>

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

/// Width and height in the frame header (ITU-T T.81, B.2.2): the first SOF marker's segment.
void checkJpegSize(File file) {
  std::size_t at = 2;
  while (at + 9 <= file.size()) {
    if (file[at] != 0xff) break;
    const std::uint8_t marker = file[at + 1];
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      checkSize(file[at + 7] * 256 + file[at + 8], file[at + 5] * 256 + file[at + 6]);
      return;
    }
    at += 2U + file[at + 2] * 256U + file[at + 3];
  }
  throw std::runtime_error("JPEG is broken: it has no frame header");
}

Pixels decodeJpeg(File file) {
  checkJpegSize(file);
  tinygltf::Image image;
  std::string error;
  // stb_image, as Debian's tinygltf brings it along; it makes RGBA of 8 bits.
  if (!tinygltf::LoadImageData(&image, 0, &error, nullptr, 0, 0, file.data(), static_cast<int>(file.size()),
                               nullptr)) {
    throw std::runtime_error("JPEG is broken");
  }
  const std::size_t expected_bytes =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4;
  if (image.bits != 8 || image.image.size() != expected_bytes)
    throw std::runtime_error("JPEG is of an unknown kind");
  return {image.width, image.height, std::move(image.image)};
}

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
