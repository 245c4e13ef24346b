// Pictures as PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace host {

/// RGB, 8 bits each, top row first, rows tight.
struct Picture8 {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;
};

/// Throws std::runtime_error that names the file when it cannot be written; nothing half-written stays.
void writePng(const std::filesystem::path& file, std::span<const std::uint8_t> rgb, int width_px,
              int height_px);
/// Reads any PNG as RGB, alpha dropped. Throws std::runtime_error that names the file.
Picture8 readPng(const std::filesystem::path& file);

}  // namespace host
