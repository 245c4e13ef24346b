#include "image/png.h"

#include <png.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace host {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(file.string() + ": " + why);
}

png_image describe(int width_px, int height_px) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = PNG_FORMAT_RGB;
  return image;
}

}  // namespace

void writePng(const std::filesystem::path& file, std::span<const std::uint8_t> rgb, int width_px,
              int height_px) {
  if (width_px <= 0 || height_px <= 0 ||
      rgb.size() != 3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    fail(file, "a picture's size does not fit its pixels");
  }
  // Written beside and renamed, so that a full disk leaves no half picture under the name.
  std::filesystem::path part = file;
  part += ".part";
  png_image image = describe(width_px, height_px);
  if (!png_image_write_to_file(&image, part.c_str(), 0, rgb.data(), 3 * width_px, nullptr)) {
    const std::string why = image.message;
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    fail(file, "cannot be written: " + why);
  }
  std::error_code failed;
  std::filesystem::rename(part, file, failed);
  if (failed) fail(file, "cannot be written: " + failed.message());
}

Picture8 readPng(const std::filesystem::path& file) {
  png_image image = describe(0, 0);
  if (!png_image_begin_read_from_file(&image, file.c_str()))
    fail(file, std::string("cannot be read: ") + image.message);
  image.format = PNG_FORMAT_RGB;
  Picture8 picture;
  picture.width_px = static_cast<int>(image.width);
  picture.height_px = static_cast<int>(image.height);
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, picture.rgb.data(), 3 * picture.width_px, nullptr)) {
    fail(file, std::string("cannot be read: ") + image.message);
  }
  return picture;
}

}  // namespace host
