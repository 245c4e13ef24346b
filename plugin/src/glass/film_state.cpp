#include "glass/film_state.h"

#include <algorithm>

#include "glass/film_order.h"
#include "shared/glass_beads.glsl"

namespace rg::glass {
namespace {

constexpr uint32_t kMostOnTexel_pl = 2'000'000'000;  // 2 mL: as far as 32 bits have room for more
constexpr uint32_t kMostInRidge_pl = 2'000'000'000;

}  // namespace

int64_t FilmState::filmSum_pl() const {
  int64_t sum = 0;
  for (const int32_t volume_pl : film_pl) sum += std::max(volume_pl, 0);
  return sum;
}

int64_t FilmState::beadsSum_pl() const {
  int64_t sum = 0;
  for (const uint32_t code : beads) sum += shared::beadsOf(code).volume_pl;
  return sum;
}

int64_t FilmState::ridgesSum_pl() const {
  int64_t sum = 0;
  for (const int32_t volume_pl : ridge_pl) sum += volume_pl;
  return sum;
}

void FilmState::write(saved::Writer& a) const {
  std::vector<uint32_t> row;
  for (const int32_t volume_pl : film_pl) row.push_back(static_cast<uint32_t>(volume_pl + 1));
  saved::writeRow<uint32_t>(a, row);
  saved::writeRow<uint32_t>(a, beads);
  row.assign(ridge_pl.begin(), ridge_pl.end());
  saved::writeRow<uint32_t>(a, row);
  saved::writeRow<uint8_t>(a, tiles);
}

void FilmState::read(saved::Reader& a, const PaneMap& map, const std::vector<bool>& hidden) {
  const auto texels = static_cast<size_t>(map.texelCount());
  std::vector<uint32_t> row(texels);
  saved::readRow<uint32_t>(a, row);
  for (size_t i = 0; i < texels; ++i) {
    const bool is_glass = map.inside(static_cast<int>(i)) && !hidden[i];
    a.require((row[i] > 0) == is_glass && row[i] <= kMostOnTexel_pl,
              "a texel of film is none of this pane's");
    film_pl.push_back(static_cast<int32_t>(row[i]) - 1);
  }
  beads.resize(texels);
  saved::readRow<uint32_t>(a, beads);
  for (size_t i = 0; i < texels; ++i) {
    const shared::Beads b = shared::beadsOf(beads[i]);
    a.require((b.volume_pl == 0) == (b.number == 0) && b.number <= shared::kMostBeads,
              "beads are of no volume or of no number");
    a.require(b.number == 0 || film_pl[i] >= 0, "beads lie off the pane");
  }
  row.resize(kRidgePieces);
  saved::readRow<uint32_t>(a, row);
  for (const uint32_t volume_pl : row) a.require(volume_pl <= kMostInRidge_pl, "a ridge holds too much");
  ridge_pl.assign(row.begin(), row.end());
  tiles.resize(map.tileArea_m2().size());
  saved::readRow<uint8_t>(a, tiles);
  for (const uint8_t tile : tiles) a.require(tile <= (kStirs | kAwake), "a tile is in no known state");
}

}  // namespace rg::glass
