"""The car's form: every large surface as a function, so that panels, glass, trim and shelter agree where they meet.

A compact hatchback: wheelbase 2.64 m, 4.28 m long, 1.84 m wide, 1.47 m high. Arrays of points in, points out.
"""
import numpy as np

WHEELBASE_M, TRACK_M, TYRE_RADIUS_M, ARCH_RADIUS_M = 2.64, 1.56, 0.318, 0.375
NOSE_X, TAIL_X = 3.50, -0.78
MIDDLE_X = 0.5 * (NOSE_X + TAIL_X)
HALF_LENGTH, HALF_WIDTH = 0.5 * (NOSE_X - TAIL_X), 0.92
FRONT_SHAPE, REAR_SHAPE = 3.7, 5.0  # superellipse exponents of the plan outline
SILL_Z = 0.17

EYE = np.array([0.97, 0.37, 1.21])

# Windscreen: 0.8 m along a slope of 30 degrees, middle of its lower edge here; the sides lie 0.13 m further back,
# which is a bow of 65 mm along the normal.
SCREEN_FOOT = np.array([2.08, 0.0, 0.99])
SCREEN_SLOPE_RAD, SCREEN_HEIGHT_M = np.radians(30.0), 0.80
SCREEN_HALF_FOOT, SCREEN_HALF_TOP, SCREEN_BOW_X, SCREEN_BULGE = 0.75, 0.61, 0.13, 0.008

# Rear window in the tailgate.
REAR_FOOT, REAR_TOP = np.array([-0.715, 0.0, 1.02]), np.array([-0.455, 0.0, 1.385])
REAR_HALF_FOOT, REAR_HALF_TOP, REAR_BOW_X = 0.62, 0.53, 0.085


def smooth(x, lo, hi):
    t = np.clip((x - lo) / (hi - lo), 0, 1)
    return t * t * (3 - 2 * t)


def interp(x, table):
    """Monotone-ish smooth interpolation: a cubic Hermite through (x, value) with central slopes."""
    xs, ys = np.array(sorted(table)).T
    slopes = np.gradient(ys, xs)
    x = np.clip(x, xs[0], xs[-1])
    k = np.clip(np.searchsorted(xs, x) - 1, 0, len(xs) - 2)
    h = xs[k + 1] - xs[k]
    t = (x - xs[k]) / h
    return ((2 * t**3 - 3 * t**2 + 1) * ys[k] + (t**3 - 2 * t**2 + t) * h * slopes[k]
            + (3 * t**2 - 2 * t**3) * ys[k + 1] + (t**3 - t**2) * h * slopes[k + 1])


# --- the plan outline as a curve of arc length s: 0 at the nose, positive to the left, +-RING at the tail ---

def _outline():
    phi = np.linspace(0, np.pi, 6001)
    c, s = np.cos(phi), np.sin(phi)
    n = np.where(c > 0, FRONT_SHAPE, REAR_SHAPE)
    r = (np.abs(c / HALF_LENGTH)**n + np.abs(s / HALF_WIDTH)**n)**(-1 / n)
    x, y = MIDDLE_X + r * c, r * s
    return np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))]), x, y


_S, _X, _Y = _outline()
RING = _S[-1]


def outline(s):
    """Plan outline at arc length s (any real; it closes after 2 RING): x, y."""
    s = (np.asarray(s, float) + RING) % (2 * RING) - RING
    return np.interp(np.abs(s), _S, _X), np.sign(s) * np.interp(np.abs(s), _S, _Y)


def s_of_x(x):
    """Arc length on the left side where the outline (not yet drawn in by height) has this x."""
    return np.interp(-np.asarray(x, float), -_X, _S)


def s_of_nose_y(y):
    half = len(_S) // 2
    return np.sign(y) * np.interp(np.abs(y), _Y[:half], _S[:half])


def s_of_tail_y(y):
    """Arc length at the tail, running past RING to the right side."""
    half = len(_S) // 2
    return RING - np.sign(y) * (RING - np.interp(-np.abs(y), -_Y[half:], _S[half:]))


def belt_z(x):
    """Upper edge of the lower body: bonnet edge, belt line, tail."""
    return interp(x, [(-0.80, 0.985), (-0.4, 0.995), (0.3, 0.985), (1.2, 0.962), (1.95, 0.940), (2.3, 0.920), (2.7, 0.884),
                      (3.1, 0.822), (3.35, 0.755), (3.52, 0.70)])


def side(p):
    """The lower body all round: (s, z) -> point. Right-handed seen from outside (s runs nose -> left -> tail)."""
    s, z = np.asarray(p, float).T
    x, y = outline(s)
    top = belt_z(x)
    below = np.maximum(top - z, 0.0)
    along = np.abs(y) / HALF_WIDTH  # 1 on the flanks, 0 at nose and tail
    inset = 0.30 * (z - 0.60)**2 + 0.055 * np.clip(1 - below / 0.13, 0, 2)**2  # tumble and shoulder
    inset += 0.9 * np.maximum(0.36 - z, 0)**2
    inset += 0.010 * np.exp(-((below - 0.185) / 0.045)**2)                     # hollow under the shoulder line
    inset += 0.012 * smooth(z, 0.46, 0.40) * smooth(z, 0.27, 0.33) * smooth(x, 0.2, 0.5) * smooth(x, 2.5, 2.2)
    for axle in (0.0, WHEELBASE_M):                                            # flared arches
        d = np.hypot(x - axle, z - TYRE_RADIUS_M)
        inset -= 0.016 * smooth(d, 0.56, 0.39) * smooth(np.abs(y), 0.5, 0.8)
    nose = smooth(x, 3.1, 3.45) * (1 - along**4)
    inset_x = inset + nose * (0.05 * smooth(z, 0.45, 0.72) + 0.03 * smooth(z, 0.36, 0.2))
    tail = smooth(x, -0.5, -0.75) * (1 - along**4)
    behind = interp(z, [(0.17, 0.055), (0.30, 0.012), (0.45, 0.0), (0.575, 0.0), (0.63, 0.020), (0.72, 0.034), (0.86, 0.044), (0.985, 0.066), (1.05, 0.08)])
    inset_x = (1 - tail) * inset_x + tail * behind
    fx, fy = 1 - inset_x / HALF_LENGTH, 1 - inset / HALF_WIDTH
    return np.stack([MIDDLE_X + (x - MIDDLE_X) * fx, y * fy, z], -1)


def side_at(x, z):
    """Parameters (s, z) on the left flank where the finished surface has these x and z."""
    x, z = np.broadcast_arrays(np.asarray(x, float), np.asarray(z, float))
    goal = x.copy()
    for _ in range(12):
        s = s_of_x(goal)
        goal = goal + (x - side(np.stack([s, z], -1).reshape(-1, 2))[:, 0].reshape(x.shape))
    return np.stack([s_of_x(goal), z], -1)


def belt_at(x):
    """Parameters (s, z) of the point on the left belt line whose finished surface has this x."""
    s = np.interp(-np.asarray(x, float), -_BELT[:, 0], _BELT_S)
    return np.stack([s, belt_z(outline(s)[0])], -1)


def belt_point(x):
    """Point on the belt line (left) with this outline x."""
    s = s_of_x(x)
    return side(np.stack([s, belt_z(x)], -1))


# --- bonnet: z over (x, y), meeting the lower body along its upper edge ---

_BELT_S = np.linspace(0, RING, 3000)
_BELT = side(np.stack([_BELT_S, belt_z(outline(_BELT_S)[0])], -1))


def bonnet_half(x):
    """Half width of the opening between the wings' upper edges at x."""
    return np.interp(-np.asarray(x, float), -_BELT[:, 0], _BELT[:, 1])


def bonnet(p):
    """(x, y) -> point. Right-handed seen from outside."""
    x, y = np.asarray(p, float).T
    edge_z = np.interp(-x, -_BELT[:, 0], _BELT[:, 2])
    half = np.maximum(bonnet_half(x), 1e-3)
    crown = 0.074 * (1 - smooth(x, 2.75, 3.46)) + 0.016 * smooth(x, 3.46, 3.2)
    t = np.clip(np.abs(y) / half, 0, 1)
    ridge = 0.010 * np.exp(-((t - 0.60) / 0.09)**2) * smooth(x, 3.4, 2.9)
    return np.stack([x, y, edge_z + crown * (1 - t**2.4) + ridge], -1)


# --- glasshouse ---

def glasshouse(p):
    """Flank above the belt, left: (x, z) -> point. Left-handed seen from outside."""
    x, z = np.asarray(p, float).T
    over = z - belt_z(x)
    foot = belt_point(x)[:, 1] - 0.010
    y = foot - 0.30 * over - 0.32 * np.maximum(over, 0)**2 - 0.05 * np.maximum(-x - 0.2, 0)
    return np.stack([x, y, z], -1)


def screen(p, half_extra=0.0):
    """Windscreen: u in -1..1 (left positive), v in 0..1 (up) -> point. Right-handed seen from outside."""
    u, v = np.asarray(p, float).T
    half = SCREEN_HALF_FOOT + (SCREEN_HALF_TOP - SCREEN_HALF_FOOT) * v + half_extra
    c, s = np.cos(SCREEN_SLOPE_RAD), np.sin(SCREEN_SLOPE_RAD)
    bulge = SCREEN_BULGE * 4 * v * (1 - v)
    x = SCREEN_FOOT[0] - SCREEN_HEIGHT_M * v * c - SCREEN_BOW_X * u * u + bulge * s
    z = SCREEN_FOOT[2] + SCREEN_HEIGHT_M * v * s + bulge * c
    return np.stack([x, u * half, z], -1)


def rear_screen(p):
    """Rear window: u in -1..1 (left positive), v in 0..1 (up) -> point. Left-handed seen from outside."""
    u, v = np.asarray(p, float).T
    half = REAR_HALF_FOOT + (REAR_HALF_TOP - REAR_HALF_FOOT) * v
    base = REAR_FOOT + (REAR_TOP - REAR_FOOT) * v[:, None]
    slope = REAR_TOP - REAR_FOOT
    normal = np.array([-slope[2], 0, slope[0]]) / np.hypot(slope[0], slope[2])
    p = base + 0.012 * (4 * v * (1 - v))[:, None] * normal
    return np.stack([p[:, 0] + REAR_BOW_X * u * u, u * half, p[:, 2]], -1)


def roof(p):
    """(x, y) -> point. Right-handed seen from outside."""
    x, y = np.asarray(p, float).T
    top = interp(x, [(-0.60, 1.385), (-0.46, 1.408), (-0.1, 1.447), (0.45, 1.468), (0.9, 1.460), (1.2, 1.432), (1.39, 1.396)])
    return np.stack([x, y, top - 0.035 * (np.abs(y) / 0.58)**2.6], -1)


ROOF_HALF = 0.575

# Outline of the flank's glasshouse (x, z), left: up the A-pillar, along the roof, down the C-pillar.
PILLAR_A = [(1.985, 0.945), (1.87, 1.010), (1.60, 1.165), (1.36, 1.295), (1.18, 1.372)]
ROOF_RAIL = [(1.0, 1.402), (0.5, 1.425), (0.0, 1.412), (-0.30, 1.380)]
PILLAR_C = [(-0.44, 1.335), (-0.53, 1.245), (-0.66, 1.02)]
