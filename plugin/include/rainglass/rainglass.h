/* clang-format off */
/* rainglass.h: the whole public interface of Rainglass. C11 (and C++), no other header of ours, GL names as uint32_t.
 *
 * Rainglass gives an OpenGL 4.5 driving simulator falling rain and water on its car's glass.
 *
 * ORDER OF CALLS
 *
 *   api = rg_get_entry(RG_ABI_VERSION)                       the one exported symbol
 *   api->create                                              any thread
 *   api->attach_gl                                           GL thread, context current
 *   api->set_volume, set_vehicle, set_pane, set_wiper ...    any time; stable ids of your choice, 0 is never an id
 *   each frame, one way:
 *     api->update            CPU thread   samples of your world with their times; runs as many fixed ticks as the time says
 *                                         (with threads of its own beside it where parameter glass.threads allows some)
 *     api->step_gpu          GL thread    uploads what is new, runs the film's ticks
 *     api->prepare_captures  GL thread    (optional) your callback draws the scene behind the glass, wide
 *     for each view:
 *       api->draw_world      GL thread    rain into your colour + depth: splashes, drops, and the veil of rain beyond
 *       api->draw_glass      GL thread    the panes, with the world behind them
 *       api->draw_finish     GL thread    the whole picture's glow
 *   api->detach_gl                                           GL thread, context current
 *   api->destroy                                             any thread
 *
 * FRAMES AND UNITS
 *
 *   World    z up, metres, double precision, right-handed. Time is an absolute count of nanoseconds on your clock.
 *   Vehicle  x forward, y left, z up, origin where you like; a pose is worldFromVehicle.
 *   Eye      OpenGL's: x right, y up, looks along -z. `eye_from_world` maps world to eye; matrices are column-major.
 *   Wiper    seen from outside, before the glass; angle counts about `axis` from `rest_direction`:
 *
 *                 blade (blade_m, its middle arm_m from the pivot)
 *                   \                       .
 *                    \  ^ angle_rad
 *                     \ |
 *        axis (.)------+-----> rest_direction
 *                    pivot_m
 *
 *   SI units; rain in mm/h (1 mm/h = 1 kg/(m^2 h)). Vectors are {x, y, z}, quaternions {x, y, z, w}.
 *
 * RULES
 *
 *   Structs begin with `struct_size`: set it with the matching default_* function (or to sizeof, having filled in all). They grow only at the end. Arrays carry a
 *   stride in bytes, so that a host compiled against an older header still walks them right. The fixed structs (rg_pose, rg_wiper_knot,
 *   rg_opening_knot, rg_glass_drop, rg_lamp) never grow.
 *   Pointers in a struct are read during the call only; nothing of yours is kept, except callbacks with their user pointers.
 *   Every function returns an rg_result; negative means: nothing was changed, last_error() tells why. Positive means done, with a remark.
 *   GL: every call on the GL thread leaves your state as it found it (see attach_gl). Preconditions that GL cannot ask or suspend: no
 *   transform feedback active and unpaused, no query of target SAMPLES_PASSED / ANY_SAMPLES_PASSED / PRIMITIVES_* /
 *   TRANSFORM_FEEDBACK_* active, no conditional render in progress. Timestamps are used, never TIME_ELAPSED. What you deleted while it was
 *   bound or in use (a program, a buffer) has lost its name and cannot be bound again: after a call it is unbound.
 *   [thread: any one] a call of this kind may come from any thread, but not at once with another on the same instance of the same kind.
 *   update (and what is marked [thread: as update]) may run at the same time as the GL thread's functions; context_lost beside neither.
 */
/* clang-format on */
#ifndef RAINGLASS_H
#define RAINGLASS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define RG_ABI_MAJOR 1u
#define RG_ABI_MINOR 8u
/* What this header's hosts pass to rg_get_entry. */
#define RG_ABI_VERSION (RG_ABI_MAJOR << 16 | RG_ABI_MINOR)

#if defined(__GNUC__)
#define RG_EXPORT __attribute__((visibility("default")))
#else
#define RG_EXPORT
#endif

/* ---- results ---- */

typedef int32_t rg_result;
enum {
  RG_OK = 0,
  RG_REMARK_THINNED = 1,      /* a buffer is full: drops were thinned uniformly; see rg_rain_stats.thinning */
  RG_REMARK_TIME_DROPPED = 2, /* a stall longer than the catch-up bound: simulated time was left out */
  RG_ERROR_BAD_ARGUMENT = -1, /* NaN, out of range, null, unknown name */
  RG_ERROR_BAD_STRUCT = -2,   /* struct_size or stride fits no version of the struct */
  RG_ERROR_WRONG_ORDER = -3,  /* e.g. drawing before attach_gl, time running backwards without seek */
  RG_ERROR_MISSING_FEATURE = -4, /* laid down in this header, not in this build */
  RG_ERROR_OUT_OF_MEMORY = -5,
  RG_ERROR_GL = -6,         /* the driver refused something */
  RG_ERROR_GL_VERSION = -7, /* the context is not OpenGL 4.5 */
  RG_ERROR_NOT_FOUND = -8,  /* no object of that id */
  RG_ERROR_INTERNAL = -9
};

/* Numbered log messages. The text after the number is for people and may change; the number does not. */
typedef enum rg_log_level { RG_LOG_ERROR = 1, RG_LOG_WARNING = 2, RG_LOG_INFO = 3 } rg_log_level;
typedef void (*rg_log_fn)(void* user, int32_t level, uint32_t message, const char* text);

typedef struct rg_instance rg_instance;

/* ---- creation ---- */

typedef struct rg_create_info {
  uint32_t struct_size;
  uint32_t max_drops; /* capacity for falling drops, 1000 .. 4000000; default 131072. A full buffer thins
                         uniformly and says so */
  uint64_t seed;      /* all randomness is a hash of it; default 1 */
  rg_log_fn log;      /* may be null; called on the thread of the call that logs */
  void* log_user;
} rg_create_info;

typedef void* (*rg_gl_get_proc_fn)(void* user, const char* name);

typedef struct rg_gl_info {
  uint32_t struct_size;
  uint32_t host_resets_state; /* 1: skip saving and restoring GL state; the draw calls return what was touched
                                 (RG_TOUCHED_*) */
  rg_gl_get_proc_fn get_proc; /* required; called during attach_gl only */
  void* get_proc_user;
  uint32_t force_finish_timer; /* 1: time GPU stages with glFinish and the steady clock even where timestamps
                                  work */
  uint32_t reserved;
} rg_gl_info;

enum {
  RG_TOUCHED_PROGRAM = 1u << 0,
  RG_TOUCHED_VERTEX_ARRAY = 1u << 1,
  RG_TOUCHED_BUFFERS = 1u << 2,
  RG_TOUCHED_TEXTURES = 1u << 3,
  RG_TOUCHED_IMAGES = 1u << 4,
  RG_TOUCHED_FRAMEBUFFER = 1u << 5,
  RG_TOUCHED_VIEWPORT = 1u << 6,
  RG_TOUCHED_BLEND = 1u << 7,
  RG_TOUCHED_DEPTH = 1u << 8,
  RG_TOUCHED_RASTER = 1u << 9,
  RG_TOUCHED_PIXEL_STORE = 1u << 10
};

/* ---- the world, as the host tells it
 * -------------------------------------------------------------------------------------------- */

/* Fixed. worldFromBody: where a body is and how it moves. Orientation must be of unit length within 1e-3. */
typedef struct rg_pose {
  double position_m[3];
  double orientation[4];            /* quaternion x, y, z, w; default 0, 0, 0, 1 */
  double velocity_mps[3];           /* of the body's origin, world axes */
  double angular_velocity_radps[3]; /* world axes */
} rg_pose;

/* A vehicle at a sample's time. */
typedef struct rg_vehicle {
  uint32_t struct_size;
  uint32_t id; /* > 0 */
  rg_pose pose;
  uint32_t
      discontinuity; /* 1: it was put here (teleport) since the last sample; nothing is interpolated across */
  uint32_t reserved;
} rg_vehicle;

/* Precipitation and air at a sample's time. */
typedef struct rg_weather {
  uint32_t struct_size;
  uint32_t reserved;
  double rain_mm_h;     /* 0 .. 300; default 0 */
  double snow_mm_h;     /* as water, 0 .. 300; default 0. Beside rain it is sleet; from 0 to +2 deg C flakes
                           melt as they fall: smaller, faster and paler. Parameter precipitation.by_temperature
                           shares rain and snow out anew by temperature and humidity. On panes flakes melt at
                           once, as on heated, wiped glass: each is caught as the drop of its water */
  double wind_mps[3];   /* velocity of the air, world axes, each within +-100; default 0. Gusts swing about it
                           (parameter wind.gust_share); at drops and glass, or at 10 m (wind.roughness_m) */
  double temperature_c; /* -60 .. 60; default 12 */
  double humidity;      /* relative, 0 .. 1; default 0.9 */
  double visibility_m;  /* meteorological range without rain, 1 .. 1e6; default 40000 */
  /* Since minor 1. */
  double hail_mm_h; /* as water, 0 .. 300; default 0. Stones of 5 .. 30 mm bounce once, off the ground and off
                       volumes, and leave nothing on panes */
  double ground_height_m; /* of the ground round the views, world z, within +-1e8: where stones bounce, and
                             where splashes are looked for first; default -1e8, none */
} rg_weather;

/* One eye's picture. The same struct tells update which volumes will be looked into and draw what to draw. */
typedef struct rg_view {
  uint32_t struct_size;
  uint32_t id;                /* > 0; default 1 */
  int32_t viewport_px[4];     /* x, y, width, height in the target */
  double eye_from_world[16];  /* column-major, rigid (no scale); world positions may be large; default:
                                 identity */
  double projection[16];      /* clipFromEye, column-major; may be asymmetric, reversed, infinite; default:
                                 identity, which is refused: set it */
  uint32_t clip_zero_to_one;  /* 1: glClipControl depth mode ZERO_TO_ONE in use for this target's depth */
  uint32_t reversed_depth;    /* 1: nearer is greater (depth test GREATER) */
  double jitter_px[2];        /* sub-pixel jitter already in `projection`; default 0 */
  double exposure_s;          /* streaks are as long as this time makes them, 1e-5 .. 0.25; default 1/60 */
  uint32_t vehicle;           /* the vehicle the eye is inside of, 0 = outside of all */
  uint32_t discontinuity;     /* 1: camera cut: this view shows something else than before */
  double eye_velocity_mps[3]; /* of the eye, world axes */
} rg_view;

/* Fixed. A wiper's angle at a time. Between knots it is linear, so give one at every reversal. */
typedef struct rg_wiper_knot {
  int64_t time_ns;
  uint32_t wiper;
  uint32_t reserved;
  double angle_rad;
} rg_wiper_knot;

/* Fixed. How far a window has slid at a time, since minor 4. Linear between knots; as of the last after it.
 */
typedef struct rg_opening_knot {
  int64_t time_ns;
  uint32_t pane;
  uint32_t reserved;
  double opening_m; /* 0 .. 10 */
} rg_opening_knot;

/* All inputs at one moment. update() interpolates linearly between samples; the state at a tick depends on
 * the samples and never on how time was cut into updates. Give samples at your simulation's own fixed ticks
 * and the whole is reproducible. */
typedef struct rg_sample {
  uint32_t struct_size;
  uint32_t vehicle_count;
  int64_t time_ns;
  const rg_weather* weather;  /* null: as in the sample before */
  const rg_vehicle* vehicles; /* vehicles that are not listed stand still */
  size_t vehicle_stride;      /* default sizeof(rg_vehicle) */
  const rg_view* views; /* every channel's view: the near part of their frusta is filled with rain; null: as
                           in the sample before */
  size_t view_stride;   /* default sizeof(rg_view) */
  uint32_t view_count;
  uint32_t wiper_knot_count;
  const rg_wiper_knot* wiper_knots; /* ascending in time for each wiper, not after time_ns */
  /* Since minor 4. */
  const rg_opening_knot* opening_knots; /* ascending in time for each pane, not after time_ns; those of
                                           unknown panes do nothing */
  uint32_t opening_knot_count;
  uint32_t reserved;
} rg_sample;

/* A convex volume of air that rain does not reach: below a roof, in a tunnel, a car's cabin. Give vertices
 * (their hull is taken) or planes. */
typedef struct rg_volume_info {
  uint32_t struct_size;
  uint32_t vehicle;         /* 0: coordinates are world's; else that vehicle's frame, and it moves with it */
  const char* name;         /* for messages; null allowed; at most 63 bytes are kept */
  const double* vertices_m; /* xyz triples, or null */
  uint32_t vertex_count;    /* 3 .. 256, not all on a line; in a plane they are a sheet, made 1 mm thick */
  uint32_t plane_count;     /* 4 .. 64 */
  const double* planes;     /* nx, ny, nz, d: inside where n . p <= d; unit normals; or null. Must enclose a
                               finite volume */
  uint32_t active;          /* default 1 */
  uint32_t reserved;
} rg_volume_info;

/* What a pane's surface does to water; default_pane_info fills in RG_GLASS_UNCOATED. */
typedef enum rg_glass {
  RG_GLASS_UNCOATED = 0,
  RG_GLASS_DIRTY = 1,
  RG_GLASS_COATED = 2,
  RG_GLASS_NEW_COATING = 3
} rg_glass;

/* A pane: any uv-mapped mesh of a vehicle. Triangles' front (counter-clockwise) faces are the wet, outer
 * side. */
typedef struct rg_pane_info {
  uint32_t struct_size;
  uint32_t vehicle; /* > 0 */
  const char* name;
  const float* positions_m; /* vehicle frame, xyz */
  const float* uvs;        /* without overlap, any scale. One chart whose lengths are a quarter off their mean
                              at most is the pane's own grid. Where it has seams (vertices at one place with
                              several uvs) or is less even, the mesh is laid flat anew, true to length as far
                              as can be: then seams and uvs change nothing. With seams it must not turn by
                              more than a right angle from its mean */
  const uint32_t* indices; /* triangles */
  uint32_t vertex_count;
  uint32_t index_count;
  size_t position_stride; /* bytes, 0 = tight */
  size_t uv_stride;
  int32_t glass;        /* rg_glass */
  uint32_t active;      /* default 1; an inactive pane keeps its water */
  double advancing_deg; /* contact angles, 0 = the preset's */
  double receding_deg;
  double texel_m;        /* size of a film cell; 0.5e-3 .. 20e-3; default 3e-3 */
  uint32_t max_drops;    /* 0 = no drops at all: the film alone; default 20000 */
  uint32_t film_enabled; /* default 1 */
  double opening_m;      /* how far a window has slid, 0 (default) .. 10, until rg_sample.opening_knots say
                            else. Its glass goes straight along slide_direction, and its water with it; what
                            is behind the sill is not rained on, not blown over and not drawn. What goes there
                            the seal strips of its water, which counts as drained, and it comes back dry. The
                            cabin's volume, which keeps rain out of the gap, stays yours. A pane with wipers
                            stays shut */
  /* Since minor 3. */
  double demister; /* how much of the demister's air blows up the inner side from the lower edge: 0 (default)
                      none .. 1 a windscreen's share. See parameters fog.* */
  /* Since minor 4. */
  double slide_direction[3]; /* unit, vehicle frame, within 45 degrees of the glass; 0 (default): down along
                                it, of a level pane backward */
  double sill[4];            /* nx, ny, nz, d, vehicle frame: glass is before the sill where n . p <= d; unit
                                normal, not across slide_direction; 0 (default): the pane's edge farthest
                                along slide_direction, as it lies when shut */
  double mirror; /* 0 (default): glass that is looked through. Above 0 .. 1: a mirror, silvered behind, that
                    reflects so much of the light. You draw the picture that it shows when dry, draw_glass its
                    water over that; what its drops show of the world before it they have from the captures or
                    rg_lighting.environment_cube */
} rg_pane_info;

typedef struct rg_wiper_info {
  uint32_t struct_size;
  uint32_t pane; /* the pane it wipes */
  const char* name;
  double pivot_m[3];        /* vehicle frame */
  double axis[3];           /* unit, out of the glass; default 0, 0, 1 */
  double rest_direction[3]; /* unit, across axis: where the arm points at angle 0; default 1, 0, 0 */
  double arm_m;             /* pivot to the blade's middle, 0.01 .. 5; default 0.5 */
  double blade_m;           /* blade's length, 0.01 .. 5; default 0.6 */
  double blade_angle_rad;   /* from the arm's direction to the blade's */
  double residual_film_m;   /* what a pass leaves; 0 .. 1e-4; default 1e-7 */
  /* Since minor 2. */
  double blade_turn; /* how far the blade turns on its arm for each radian the arm turns, -2 .. 2: 0 (default)
                        rigid, -1 a pantograph, whose blade keeps its direction on the glass. blade_angle_rad
                        is at angle 0 then */
  double wear;       /* 0 (default) a new blade, which leaves residual_film_m everywhere .. 1; a worn one
                        leaves streaks and smears where it runs dry. What streaks is a hash of the wiper's id */
  double lift_m;     /* drops that stand higher on the glass are cut there: the rest stays behind the blade;
                        1e-5 .. 1; default 2e-3 */
} rg_wiper_info;

/* A washer's jet on a pane, since minor 2. What of its cone meets the pane's outer side is caught by it. */
typedef struct rg_wash_info {
  uint32_t struct_size;
  uint32_t pane;
  int64_t time_ns;     /* when it begins; at once when that is past */
  double duration_s;   /* 0.01 .. 60; default 1 */
  double volume_m3;    /* that leaves the nozzle, evenly over that time; 0 .. 1e-3; default 2e-5 (20 mL) */
  double nozzle_m[3];  /* vehicle frame */
  double direction[3]; /* unit, vehicle frame; a jet is so fast that it goes straight; default 1, 0, 0 */
  double fan_rad;      /* whole angle of its cone, 0.01 .. 3; default 0.2 */
} rg_wash_info;

/* How air runs over a pane, since minor 3: what drags water over it. Speeds are shares of the free air's,
 * relative to the vehicle. */
typedef struct rg_airflow {
  uint32_t struct_size;
  uint32_t columns, rows; /* of `ahead`, 0 .. 256 each; 0 (default): there is none */
  double stagnation; /* of a pane that faces the wind: share of the speed missing at its lower edge, 0 .. 1;
                        default 0.65 */
  double outward;    /* and how much of the component against it turns to its sides there, 0 .. 2;
                        default 0.35 */
  double lee;        /* share of the speed behind a pane that faces away, 0 .. 1; default 0.25 */
  double drag_friction; /* C_f of the shear on a film, rho_air C_f U^2 / 2, 0 .. 0.1; default 0.004 */
  const float* ahead;   /* velocity along the glass for air from dead ahead, vehicle frame, xyz each, -5 .. 5;
                           row by row from the pane's lower edge, each from its left seen from inside; copied.
                           Takes the place of the first two for that part of the air which comes from ahead */
} rg_airflow;

/* ---- drawing ---- */

typedef enum rg_color_space { RG_LINEAR_HDR = 0, RG_SRGB = 1 } rg_color_space;

/* Where to draw. Streaks look at `color_texture`, where given, for how dark it is behind them (before the
 * dark less of parameter rain.gain is wanted). The colour behind glass is read from it too, else copied from
 * the framebuffer. */
typedef struct rg_target {
  uint32_t struct_size;
  uint32_t framebuffer;   /* complete, single-sampled in this build, colour attachment 0 drawn */
  uint32_t color_texture; /* GL_TEXTURE_2D attached there as colour 0, or 0. Any other is
                             RG_ERROR_WRONG_ORDER, as for depth_texture */
  uint32_t depth_texture; /* GL_TEXTURE_2D attached there as depth, or 0: the framebuffer's depth buffer is
                             tested, streaks end hard */
  int32_t width_px;
  int32_t height_px;
  int32_t samples;     /* 1 (default); more: missing feature in this build */
  int32_t layer;       /* 0 */
  int32_t color_space; /* rg_color_space of what is in it now: RG_LINEAR_HDR (default) = linear radiance */
  uint32_t reserved;
  double exposure; /* what radiance was multiplied with before it was written; default 1 */
} rg_target;

/* Fixed. A lamp near the drops. A cone with cos_outer -1 is a point lamp. */
typedef struct rg_lamp {
  double position_m[3];
  float direction[3];
  float intensity[3]; /* radiant intensity, same photometric unit as radiance x m^2 */
  float cos_inner;
  float cos_outer;
} rg_lamp;

/* Light that drops are seen by. */
typedef struct rg_lighting {
  uint32_t struct_size;
  uint32_t lamp_count;
  float sky_radiance[3];    /* mean of the upper hemisphere; default 1 */
  float ground_radiance[3]; /* mean of the lower; default 0.2 */
  float sun_direction[3];   /* towards the sun, unit, or 0 */
  float sun_irradiance[3];
  const rg_lamp* lamps;
  uint32_t environment_cube; /* GL_TEXTURE_CUBE_MAP of linear radiance with mips, world axes, or 0 */
  uint32_t reserved;
  /* Since minor 3: so many of `lamps`, from the first, are shown by the drops on panes as the points of light
   * they are, 0 (default) .. lamp_count; the 16 brightest at the eye count. Give small bright ones
   * (headlights, brake lights), which a captured picture of a few hundred pixels would lose, and leave their
   * glowing glass out of the captured scene and the environment. What of them lies in view is in your
   * picture: film and unresolved droplets show it from there. A lamp that something in the depth_texture
   * stands before is hidden; of others leave out those that are. */
  uint32_t lamps_on_glass;
  uint32_t reserved_too;
} rg_lighting;

typedef struct rg_draw {
  uint32_t struct_size;
  uint32_t touched; /* out: RG_TOUCHED_* of this call */
  int64_t time_ns; /* the picture's moment: not before the last tick minus 1 s; drops and blades are placed at
                      it */
  const rg_view* view;
  const rg_target* target;
  const rg_lighting* lighting; /* null: as default_lighting fills it in */
} rg_draw;

/* Scene and sky behind the glass as seen wide from `eye_from_world`: no rain, no panes, no cabin. Called
 * inside prepare_captures only, with GL in the plugin's state, not yours: set all that you draw with
 * (framebuffer, viewport, clip control, tests, masks, program, textures). Programs, vertex arrays, buffers,
 * texture units 0 .. 7, framebuffers, viewport, blend, depth, raster and pixel store are yours again when
 * prepare_captures returns; what else you change stays changed. Call no function of the plugin's for the GL
 * thread. */
typedef void (*rg_capture_fn)(void* user, uint32_t framebuffer, int32_t width_px, int32_t height_px,
                              const double eye_from_world[16], const double projection[16]);
typedef struct rg_capture_info {
  uint32_t struct_size;
  uint32_t max_faces;       /* pictures drawn in this call at most; default 1 */
  rg_capture_fn draw_scene; /* null: glass sees the visible picture instead, less exact */
  void* user;
  const rg_view* view; /* whose eye */
} rg_capture_info;

/* ---- what is asked ---- */

typedef struct rg_rain_stats {
  uint32_t struct_size;
  uint32_t reserved;
  double rate_mm_h;            /* of rain */
  double thinning;             /* share of drops that exist, 1 = all */
  uint64_t live, born, died;   /* drops, flakes and stones */
  uint64_t sheltered_at_birth; /* drops of the field that a volume kept from being born at all */
  uint64_t shelter_tests;      /* drop-against-volume tests done */
  uint64_t uploaded_bytes;
  /* Since minor 1. */
  double snow_mm_h, hail_mm_h;
  uint64_t live_snow;    /* of live: flakes, */
  uint64_t live_melting; /* flakes that melt, */
  uint64_t live_hail;    /* stones that fall, */
  uint64_t live_bounced; /* and that have bounced */
  uint64_t bounced;      /* stones so far */
  /* Since minor 5. */
  double ground_water_mm; /* that lies on open ground, 0 .. 1; the rest has run off. Dries by temperature,
                             humidity and wind (Penman 1948) */
  /* Since minor 6. */
  double splash_thinning; /* share of the splashes that the latest draw_world looked at, each counting
                             for the rest, 1 = all. Alike for all views of one reach: where rain makes
                             more than 262144 of them within it all about, from some 120 mm/h on at 20 m,
                             all are thinned alike */
} rg_rain_stats;

/* The ledger of a pane, mL since it was made or reset. caught = on_glass + drained + wiped + blown +
 * evaporated, within ledger_error. */
typedef struct rg_pane_stats {
  uint32_t struct_size;
  uint32_t drops;
  double area_m2;
  double caught_ml;
  double on_glass_ml; /* summed afresh: film + drops + ridges + in flight */
  double drained_ml;
  double wiped_ml; /* thrown off the glass by blades */
  double blown_ml;
  double evaporated_ml;
  double ledger_error; /* |caught - sum of the others| / max(caught, 1 mL) */
  double film_ml;      /* of on_glass */
  double drops_ml;     /* of on_glass */
  double ridge_ml;     /* of on_glass: carried by blades */
  /* Since minor 3. */
  double dropped_s; /* time that was left out for this pane since it was made or reset: of stalls longer than
                       time.catch_up_s, and while step_gpu did not come for more than 5 s */
  /* Since minor 7. */
  double run_on_ml; /* of caught: ran or was thrown off other panes of its vehicle and came round the pillar
                       (glass.run_off) */
} rg_pane_stats;

typedef struct rg_stage_stats {
  uint32_t struct_size;
  uint32_t gpu; /* 1: has GPU work */
  char name[32];
  double cpu_ms_p50, cpu_ms_p95, cpu_ms_p99;
  double gpu_ms_p50, gpu_ms_p95, gpu_ms_p99;
  uint64_t samples;
} rg_stage_stats;

typedef enum rg_timer_kind { RG_TIMER_GPU = 0, RG_TIMER_FINISH = 1 } rg_timer_kind;
typedef enum rg_hash_kind { RG_HASH_RAIN = 0, RG_HASH_STATE = 1 } rg_hash_kind;

/* A tunable as data, so that a host builds its panel and its config file from it. */
typedef struct rg_parameter {
  uint32_t struct_size;
  uint32_t reserved;
  char name[48]; /* "rain.visibility_factor" */
  char unit[16];
  char group[32];
  char text[160]; /* what it does */
  double minimum, maximum, preset, value;
} rg_parameter;

/* Fixed. A drop placed on a pane: spherical cap on the outer face. The pane's middle is that of its uvs'
 * extent, or of the mesh laid flat (see rg_pane_info.uvs). */
typedef struct rg_glass_drop {
  double u_m;               /* to the right of the pane's middle, seen from inside, looking out */
  double v_m;               /* up the pane from its middle */
  double base_radius_m;     /* 1e-5 .. 0.02 */
  double contact_angle_deg; /* 1 .. 170 */
} rg_glass_drop;

/* How rain looks that is too far off to be told apart as drops (from minor version 1). The pattern repeats in
 * both directions; rows go along the fall, from where drops come to where they go. Red, green and blue hold
 * the normal of what drops show (to the side, along the rows' order, towards the eye; 128 = 0), alpha how
 * much rain there is: only its share of the pattern's mean counts, so that a pattern changes how rain looks
 * and never how much of it there is. */
typedef struct rg_rain_pattern {
  uint32_t struct_size;
  uint32_t width_px;  /* 8 .. 4096 */
  uint32_t height_px; /* 8 .. 4096 */
  uint32_t reserved;
  const uint8_t* rgba;     /* 8 bits each, not all of alpha 0; read during the call */
  size_t row_stride_bytes; /* 0 = tight */
} rg_rain_pattern;

/* ---- the functions ---- */

typedef struct rg_api {
  uint32_t struct_size;
  uint32_t abi_minor;  /* of the plugin */
  const char* version; /* of the plugin, static */

  /* Defaults: fill in *out wholly, struct_size included: what tells no default is 0. Null does nothing.
   * [thread: any] */
  void (*default_create_info)(rg_create_info* out);
  void (*default_gl_info)(rg_gl_info* out);
  void (*default_vehicle)(rg_vehicle* out);
  void (*default_weather)(rg_weather* out);
  void (*default_view)(rg_view* out);
  void (*default_sample)(rg_sample* out);
  void (*default_volume_info)(rg_volume_info* out);
  void (*default_pane_info)(rg_pane_info* out);
  void (*default_wiper_info)(rg_wiper_info* out);
  void (*default_target)(rg_target* out);
  void (*default_lighting)(rg_lighting* out);
  void (*default_draw)(rg_draw* out);
  void (*default_capture_info)(rg_capture_info* out);

  /* Life. [thread: any one] The instance is yours until destroy; destroy(null) does nothing. Destroying an
   * attached instance frees no GL object (there may be no context): detach first. */
  rg_result (*create)(const rg_create_info* info, rg_instance** out);
  void (*destroy)(rg_instance* instance);
  /* Text of this instance's last error on this thread (where it had none, of the last on any; for null, of
   * the last failed create on this thread); valid until this thread's next call. [thread: any] */
  const char* (*last_error)(rg_instance* instance);

  /* GL. [thread: GL, context current] attach_gl makes all GL objects; attach again after detach_gl or
   * context_lost. With host_resets_state 0 every GL call after it leaves the context's state as found, a
   * pending GL error included.
   *
   * It is also where the driver compiles, some 80 programs, all at once where it does that on threads of its
   * own (GL_KHR_parallel_shader_compile, as many as you left it): attach while you load; update may run
   * meanwhile. A program that the driver refuses is told here. Later no call asks for another, whatever comes
   * into view, but for draw_glass into targets of RG_SRGB: the first begins some 40 more, or, where there are
   * no such threads, what is first seen in them is compiled then. On software GL programs are compiled as
   * they are first drawn with. */
  rg_result (*attach_gl)(rg_instance* instance, const rg_gl_info* info);
  rg_result (*detach_gl)(rg_instance* instance);
  /* The context is gone with all that was in it: forget GL names without freeing them. The water on the
   * film's grid is lost with it and is booked as drained. [thread: any one] */
  rg_result (*context_lost)(rg_instance* instance);

  /* Objects. [thread: as update] Adding an id again replaces it; a pane then starts dry and keeps its wipers.
   * A pane takes its wipers along when it is removed. */
  rg_result (*set_volume)(rg_instance* instance, uint32_t id, const rg_volume_info* info);
  rg_result (*remove_volume)(rg_instance* instance, uint32_t id);
  rg_result (*remove_vehicle)(rg_instance* instance, uint32_t id); /* with its volumes, panes and wipers */
  rg_result (*set_pane)(rg_instance* instance, uint32_t id, const rg_pane_info* info);
  rg_result (*remove_pane)(rg_instance* instance, uint32_t id);
  rg_result (*set_wiper)(rg_instance* instance, uint32_t id, const rg_wiper_info* info);
  rg_result (*remove_wiper)(rg_instance* instance, uint32_t id);
  /* Puts drops on a pane, beside what is there; counted as caught. Drops off the pane are refused, all of
   * them. */
  rg_result (*place_drops)(rg_instance* instance, uint32_t pane, const rg_glass_drop* drops, uint32_t count);

  /* Frame. */
  /* Runs ticks up to time_ns. Samples ascend in time, all after those given before (and after seek's time)
   * and not after time_ns. The first update needs a sample, which starts the clock. Times lie within 73 years
   * of 0. [thread: any one, no GL] */
  rg_result (*update)(rg_instance* instance, int64_t time_ns, const rg_sample* samples, uint32_t count,
                      size_t stride);
  rg_result (*step_gpu)(rg_instance* instance);                                      /* [thread: GL] */
  rg_result (*prepare_captures)(rg_instance* instance, const rg_capture_info* info); /* [thread: GL] */
  /* What is rained on looks wet, if you ask for it (parameter wetness.strength). Splashes on what you have
   * drawn, where it looks up and rain reaches it (parameters splashes.*; found by the depth_texture, given
   * with color_texture, or without them at rg_weather.ground_height_m). Falling drops, and behind them the
   * veil of the rain that is too far off to be drops: as much as there is in the open air (outside all
   * volumes) between the eye and what the depth buffer holds, or the clouds. So draw your own haze with the
   * air's visibility alone. Without a depth_texture (and color_texture) nothing is made wet, and the veil is
   * drawn layer by layer, each tested as a whole at its middle. [thread: GL] */
  rg_result (*draw_world)(rg_instance* instance, rg_draw* draw);
  rg_result (*draw_glass)(rg_instance* instance, rg_draw* draw); /* [thread: GL] */
  /* The glow about all that is bright, lamps above all, as the driver's eye would see it were the screen as
   * bright as they, if you ask for it (parameter glow.strength; call it once a picture, last, before your
   * tone curve). Only in RG_LINEAR_HDR: in others nothing is drawn. [thread: GL] */
  rg_result (*draw_finish)(rg_instance* instance, rg_draw* draw);

  /* Time. [thread: as update] */
  rg_result (*reset)(rg_instance* instance); /* as after create: clock, rain, water; objects stay */
  rg_result (*seek)(rg_instance* instance,
                    int64_t time_ns); /* rain as it is at that time (after a wind that changed, gusts too,
                                         other drops of the same rain); water on glass stays */
  rg_result (*prewarm)(rg_instance* instance, double seconds); /* rain that long before the first picture */
  rg_result (*rebase_origin)(
      rg_instance* instance,
      const double shift_m[3]); /* the host's world moved by -shift: p_new = p_old - shift */
  /* Since minor 7; before, both answered RG_ERROR_MISSING_FEATURE. The whole state as bytes that may be kept
   * and sent: the rain, the water on each pane and what wipers carry of it, jets at work, fog, ledgers, the
   * samples not used up, parameters. An instance that restores them goes on, by the samples after that
   * moment, as the one that saved them did: to the bit on the same driver, within 1 % of a pane's volumes on
   * another. They are the same on every machine, and for this version of the plugin alone.
   *
   * Objects are not among them: restore wants the same panes and wipers, set in the same order under the same
   * ids, an instance of the same seed and max_drops and, where the state has films, one that is attached.
   * Volumes may be others: what lies in them or below them is as if they had been set at that moment.
   * Airflows and the rain's pattern stay yours, and the clock is the state's: samples go on after the last
   * one it had.
   *
   * save: *size is the buffer's size, and then the state's; with a buffer that is null that is all it tells.
   * One that is too small is refused, nothing written. restore: what is no such state is refused and changes
   * nothing; whatever the bytes are, they do no harm. save answers RG_ERROR_WRONG_ORDER after remove_wiper,
   * or a set_wiper that changed one, as long as what that blade swept last is still to be done on the film:
   * update once more. Places are as they were: a state saved before rebase_origin lies in the old origin.
   * [thread: as update; attached ones also GL, context current: they wait for the GPU] */
  rg_result (*save)(rg_instance* instance, void* buffer, size_t* size);
  rg_result (*restore)(rg_instance* instance, const void* buffer, size_t size);

  /* Questions. [thread: as update; get_pane_stats and hash also finish what the GPU was asked for and so want
   * the GL thread] */
  rg_result (*get_rain_stats)(rg_instance* instance, rg_rain_stats* out);
  rg_result (*get_pane_stats)(rg_instance* instance, uint32_t pane, rg_pane_stats* out);
  rg_result (*get_stage_count)(rg_instance* instance, uint32_t* out);
  rg_result (*get_stage)(rg_instance* instance, uint32_t index, rg_stage_stats* out);
  rg_result (*get_timer_kind)(rg_instance* instance, int32_t* out);
  rg_result (*get_hash)(rg_instance* instance, int32_t kind, uint64_t* out);

  /* Parameters. [thread: as update] */
  rg_result (*get_parameter_count)(rg_instance* instance, uint32_t* out);
  rg_result (*get_parameter)(rg_instance* instance, uint32_t index, rg_parameter* out);
  rg_result (*set_parameter)(rg_instance* instance, const char* name, double value);

  /* From minor version 1 on: ask abi_minor before you call what follows. */
  void (*default_rain_pattern)(rg_rain_pattern* out); /* [thread: any] */
  /* Replaces the pattern of rain far off, from the next step_gpu on; null: the plugin's own again. [thread:
   * as update] */
  rg_result (*set_rain_pattern)(rg_instance* instance, const rg_rain_pattern* pattern);

  /* From minor version 2 on. */
  void (*default_wash_info)(rg_wash_info* out); /* [thread: any] */
  /* Washes a pane once; at most 8 at a time on each. [thread: as update] */
  rg_result (*wash)(rg_instance* instance, const rg_wash_info* info);

  /* From minor version 3 on. */
  void (*default_airflow)(rg_airflow* out); /* [thread: any] */
  /* How air runs over a pane, from the next tick on; null: as by default. It stays when the pane is set
   * again. [thread: as update] */
  rg_result (*set_airflow)(rg_instance* instance, uint32_t pane, const rg_airflow* airflow);
} rg_api;

/* The table of functions for hosts of a version of this header: pass RG_ABI_VERSION. Null when this library
 * does not speak its major. Its default_* functions fill in structs as that version has them and write
 * nothing behind, however much they have grown since. Of a version newer than the library they fill in what
 * the library knows, which is all it reads; where it knows less than you (abi_minor), set strides of arrays
 * to your own sizeof. Libraries before minor 8 know the bare major alone and answer null.
 *
 * A bare RG_ABI_MAJOR, as hosts of minors 0 to 7 passed it, tells no minor and is taken for minor 0, which
 * can overwrite nothing: what came since then is as by default to such a host, whatever it writes there,
 * until it fills in all of it and sets struct_size to sizeof. A warning in the log says so at create().
 * Static: never freed. [thread: any] */
RG_EXPORT const rg_api* rg_get_entry(uint32_t abi_version);

#ifdef __cplusplus
}
#endif
#endif
