"""Where the road runs: centreline, heights and the driven route, as functions of arc length s (metres).

Frame: Blender's world, z up. d is the distance to the left of the centreline, so the right-hand lane lies at d < 0.
"""
import numpy as np

S_FIRST, S_LAST = -200.0, 1960.0
LANE_M = 3.5
ROUTE_FIRST, ROUTE_LAST = 10.0, 1740.0

BRIDGE_S, BRIDGE_HALF_WIDTH, BRIDGE_CLEARANCE = 350.0, 6.0, 5.3
TUNNEL_IN, TUNNEL_OUT = 550.0, 730.0
VILLAGE_IN, VILLAGE_OUT = 105.0, 325.0
FORECOURT_IN, FORECOURT_OUT = 980.0, 1140.0
SLIP_IN, SLIP_OUT, SLIP_LENGTH, SLIP_D = 985.0, 1075.0, 60.0, -15.0
CANOPY_S, CANOPY_D = (1048.0, 1072.0), (-24.5, -8.5)

# Curvature (1/m, left positive) at s, linear between: each bend has easements at both ends, as built roads have.
CURVATURE = [(-200, 0), (10, 0), (60, -1 / 900), (110, 0), (170, 1 / 650), (280, 1 / 650), (330, 0), (395, 0), (440, 1 / 420),
             (510, 1 / 420), (555, 0), (590, -1 / 900), (690, -1 / 900), (740, 0), (780, -1 / 190), (840, -1 / 190),
             (880, 1 / 180), (930, 1 / 180), (965, 0), (1160, 0), (1220, -1 / 450), (1330, -1 / 450), (1400, 0),
             (1450, 1 / 550), (1600, 1 / 550), (1660, 0), (1960, 0)]
# Height of the carriageway (m) at s; smoothed below. Level along the forecourt.
HEIGHT = [(-200, 2.0), (0, 1.2), (110, 0.2), (300, 0.0), (430, 0.4), (560, 2.0), (720, 4.2), (790, 4.0), (930, 1.0), (1190, 1.0),
          (1310, 3.6), (1480, 1.2), (1680, 4.0), (1960, 4.5)]

_S = np.arange(S_FIRST - 50, S_LAST + 51, 1.0)


def _smooth(values, sigma_m):
    reach = int(4 * sigma_m)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma_m) ** 2)
    padded = np.concatenate([np.full(reach, values[0]), values, np.full(reach, values[-1])])
    return np.convolve(padded, kernel / kernel.sum(), mode="valid")


def _table():
    curvature = _smooth(np.interp(_S, *np.array(CURVATURE).T), 6.0)
    heading = np.concatenate([[0.0], np.cumsum(0.5 * (curvature[1:] + curvature[:-1]))])
    heading -= np.interp(0.0, _S, heading)
    middle = 0.5 * (heading[1:] + heading[:-1])
    x = np.concatenate([[0.0], np.cumsum(np.cos(middle))])
    y = np.concatenate([[0.0], np.cumsum(np.sin(middle))])
    x -= np.interp(0.0, _S, x)
    y -= np.interp(0.0, _S, y)
    return x, y, heading, _smooth(np.interp(_S, *np.array(HEIGHT).T), 18.0)


_X, _Y, _HEADING, _Z = _table()


def height(s):
    return np.interp(s, _S, _Z)


def heading(s):
    return np.interp(s, _S, _HEADING)


def point(s, d=0.0, h=0.0):
    """World points at s along, d to the left, h above the carriageway; any broadcastable arrays."""
    s, d, h = np.broadcast_arrays(np.asarray(s, float), np.asarray(d, float), np.asarray(h, float))
    a = heading(s)
    return np.stack([np.interp(s, _S, _X) - d * np.sin(a), np.interp(s, _S, _Y) + d * np.cos(a), height(s) + h], axis=-1)


def frame(s, d=0.0, h=0.0, turn=0.0):
    """Origin and axes (forward, left, up) at a place by the road, turned by `turn` radians about up."""
    a = float(heading(s)) + turn
    axes = np.array([[np.cos(a), np.sin(a), 0.0], [-np.sin(a), np.cos(a), 0.0], [0.0, 0.0, 1.0]])
    return point(s, d, h), axes


def nearest(x, y):
    """(s, d) of world points: the nearest place on the centreline and the signed distance from it."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    flat = np.stack([x.ravel(), y.ravel()], axis=1)
    index = np.empty(len(flat), int)
    for first in range(0, len(flat), 2000):
        part = flat[first:first + 2000]
        index[first:first + 2000] = np.argmin((part[:, :1] - _X) ** 2 + (part[:, 1:] - _Y) ** 2, axis=1)
    a = _HEADING[index]
    dx, dy = flat[:, 0] - _X[index], flat[:, 1] - _Y[index]
    along, across = dx * np.cos(a) + dy * np.sin(a), -dx * np.sin(a) + dy * np.cos(a)
    beyond_end = (index == 0) | (index == len(_S) - 1)
    d = np.where(beyond_end, np.copysign(np.hypot(dx, dy), across), across)
    return (_S[index] + np.where(beyond_end, 0.0, along)).reshape(x.shape), d.reshape(x.shape)


def smoothstep(t):
    """0 to 1 with zero slope and curvature at both ends (quintic)."""
    t = np.clip(t, 0.0, 1.0)
    return t * t * t * (t * (6 * t - 15) + 10)


def slip(s):
    """How far the route has left the road for the forecourt at s: 0 on the road, 1 under the canopy."""
    return smoothstep((s - SLIP_IN) / SLIP_LENGTH) - smoothstep((s - SLIP_OUT) / SLIP_LENGTH)


def forecourt_edge(s):
    """d of the forecourt's outer border; the carriageway's edge where there is none."""
    return -3.9 - 39.3 * (smoothstep((s - 976) / 50) - smoothstep((s - 1080) / 48))


def route_d(s):
    return -LANE_M / 2 + (SLIP_D + LANE_M / 2) * slip(np.asarray(s, float))


def route_points(spacing_m=5.0):
    """The driven line, at equal spacing along itself, and the s of each point."""
    s = np.arange(ROUTE_FIRST, ROUTE_LAST + 0.01, 0.1)
    line = point(s, route_d(s))
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    at = np.linspace(0.0, arc[-1], int(round(arc[-1] / spacing_m)) + 1)
    s_at = np.interp(at, arc, s)
    return point(s_at, route_d(s_at)), s_at


def route_arc(s_wanted):
    """Distance driven along the route when the road's s is reached."""
    s = np.arange(ROUTE_FIRST, ROUTE_LAST + 0.01, 0.1)
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(point(s, route_d(s)), axis=0), axis=1))])
    return float(np.interp(s_wanted, s, arc))
