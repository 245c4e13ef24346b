// Records that travel between the glass's CPU and GPU parts. Volumes are whole picolitres (1e-15 m^3), so that sums are exact in any order.
#ifndef RG_SHARED_GLASS_TYPES_GLSL
#define RG_SHARED_GLASS_TYPES_GLSL
#include "shared/compat.glsl"
RG_SHARED_BEGIN

RG_CONST float kPicolitre_m3 = 1.0e-15f;
RG_CONST int kTileSize = 16;      // texels along a tile's side: the grain of what the film works on and reports
RG_CONST int kStripSize = 4;      // texels side by side that are fetched together, and flow by the same fields (placeAcross in glass_film.glsl)
RG_CONST int kBladeSegments = 192; // a blade's ridge is kept in so many pieces along it: about a texel each
RG_CONST int kMaxGlassWipers = 8; // on one pane

// A drop as it is to be drawn. Grid metres: the pane's film grid, x along its columns, y along its rows, cells `texel_m` wide, origin in the
// corner of cell (0, 0); uv = uv_origin + position / metres_per_uv (see PaneGrid). Place it at position + velocity * (time - snapshot's time).
struct GlassDropRecord {
  vec2 position_m;         // middle of the wetted base
  vec2 velocity_mps;       // grid metres per second; 0 when it sticks
  vec2 heading;            // unit, grid axes: along the base
  float base_radius_m;     // of the circle of the base's area, real metres
  float height_m;          // of the cap of this base and volume: a spherical one as wide, stretched along the heading
  float elongation;        // length : width of the base, >= 1
  float corner;            // 0: an ellipse .. 1: a round head and, at the end that its heading leaves, a tail; < 0: at the other end. See capOfDrop()
  uint seed;               // for an outline that is its own
  uint unused;             // arrays' strides are whole vec2
};
RG_SIZE(GlassDropRecord, 48)

// What a tile reports of one film step. Sums of 256 texels may pass 32 bits, so the film's is split: low 16 bits and the rest.
struct FilmTile {
  int event_texel;   // the texel that gave water to the drops, of its film or its beads, or -1
  int event_pl;      // how much
  uint film_low_pl;  // sum of (volume & 0xffff)
  uint film_high;    // sum of (volume >> 16)
  int drained_pl;
  int blown_pl;
  int evaporated_pl;
  uint beads_pl;     // of 256 texels of less than 2^24 each
};
RG_SIZE(FilmTile, 32)

// CPU to GPU, in the order they happened.
struct FilmAdd { int texel; int volume_pl; };             // rain, trails, drops that sink into it
RG_SIZE(FilmAdd, 8)
struct BeadAdd { int texel; int volume_pl; int number; }; // small impacts, what a splash throws about, pearls
RG_SIZE(BeadAdd, 12)
struct FilmTake { int texel; int share_65536; };          // a drop ran over this much of the texel; no texel twice in a step
RG_SIZE(FilmTake, 8)
struct RidgeAdd { int segment; int volume_pl; };          // a drop under a blade; segment = wiper slot * kBladeSegments + piece
RG_SIZE(RidgeAdd, 8)
// These four as the GPU has them: what happens to a texel in a step, in this order: share_65536 of its water is taken, for the step's take of this
// number (-1: none), and added_pl is added to its film, `beads` of beads_pl to its beads. texel < 0: the ridge of segment -1 - texel gets added_pl.
struct FilmChange { int texel; int added_pl; int share_65536; int take; int beads_pl; int beads; };
RG_SIZE(FilmChange, 24)
// The ridge's water goes to `count` texels of a list; where it is over_edge_pl or more, or count is 0: off the glass.
struct RidgeLeave { int segment; int first; int count; int over_edge_pl; };
RG_SIZE(RidgeLeave, 16)
// Static: sorted by piece of the blade and the angle at which it crosses. What it leaves there, and what more when it drags.
struct SweptTexel { int texel; int residual_pl; int smear_pl; int unused; };
RG_SIZE(SweptTexel, 16)
struct SweptRange { int first; int count; };              // of those, what a piece sweeps
RG_SIZE(SweptRange, 8)

RG_SHARED_END
#endif
