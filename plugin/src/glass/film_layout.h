// Where things lie in the buffers of a film's steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "glass/film_order.h"

namespace rg::glass {

inline constexpr size_t kAlign = 256;     // GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT is at most this
inline constexpr size_t kTileFields = 6;  // TileState in film_buffers.glsl
inline constexpr size_t kTileAwake = 2,
                        kTileLies = 3;  // of those: after how each turn stirs; what lies there
inline constexpr size_t kTileStateBytes = kTileFields * sizeof(int32_t);
inline constexpr std::array<uint32_t, 16> kNoneAwake{
    0, 1, 1, 0, 0, 1, 1, 0,
    0, 1, 1, 0, 0, 1, 1, 0};  // AwakeTiles in film_lists.glsl, of both turns, and those that dry
inline constexpr size_t kTileTexels = size_t{shared::kTileSize} * shared::kTileSize;
inline constexpr size_t kRidgeBytes = 2 * kRidgePieces * sizeof(int32_t);  // and what each has thrown off

inline size_t aligned(size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

// Where the parts of an order lie in the upload, from its start.
struct UploadLayout {
  explicit UploadLayout(const FilmOrder& order) {
    info = next(sizeof(shared::FilmStepInfo));
    drive = next(order.drive.size() * sizeof(shared::vec4));
    // Where there is nothing something is bound all the same.
    const size_t most_changes = order.takes.size() + order.slid.size() + order.adds.size() +
                                order.bead_adds.size() + order.ridge_adds.size();
    changes = next(std::max<size_t>(most_changes, 1) * sizeof(shared::FilmChange));
    ranges = next(order.sweep_ranges.size() * sizeof(shared::SweptRange));
    leaves = next(order.leaves.size() * sizeof(shared::RidgeLeave));
    texels = next(std::max<size_t>(order.leave_texels.size(), 1) * sizeof(int));
  }
  size_t next(size_t part) { return std::exchange(bytes, bytes + aligned(part)); }
  size_t bytes = 0;
  size_t info, drive, changes, ranges, leaves, texels;  // of changes there may be fewer
};

// Where the parts of a report lie, from its start.
struct ReportLayout {
  ReportLayout(size_t tiles, size_t takes)
      : ridges(aligned(tiles * sizeof(shared::FilmTile))),
        taken(ridges + aligned(kRidgeBytes)),
        taken_bytes(aligned(std::max<size_t>(takes, 1) * sizeof(int))),
        bytes(taken + taken_bytes) {}
  size_t ridges, taken, taken_bytes, bytes;
};

}  // namespace rg::glass
