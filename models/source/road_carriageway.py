"""The carriageway and what stands along it: markings, guard rails, posts, signs, wires."""
import numpy as np

import road_route as route
import road_terrain as terrain
from road_mesh import Mesh, local, place
from road_textures import tile_uv

EDGE_M = 4.1
_RAIL = np.array([(0.00, 0.44), (0.07, 0.50), (0.07, 0.55), (0.00, 0.60), (0.07, 0.65), (0.07, 0.70), (0.00, 0.76)])
# Guard rails: first and last s, distance of the rail from the centreline.
RAILS = [(-120, 92, -4.9), (-40, 60, 4.9), (330, 372, -4.9), (330, 372, 4.9), (455, 546, -4.9), (455, 546, 4.9), (734, 860, 4.9),
         (734, 800, -4.9), (860, 968, -4.9), (1190, 1370, 4.9), (1430, 1600, -4.9)]


def _ribbon(chunks, first, last, d_right, d_left, material, tile, lift, step=5.0):
    """A strip of surface along the road, between two distances left of the centreline."""
    s = np.linspace(first, last, max(int(np.ceil((last - first) / step)), 1) + 1)
    grid = route.point(s[:, None], np.array([d_right, d_left])[None], lift)
    uv = np.stack(np.broadcast_arrays(np.array([d_right, d_left])[None] / tile[0], s[:, None] / tile[1]), axis=-1)
    chunks.at(first).grid(grid, material, uv)


def _surface(chunks):
    for first in np.arange(route.S_FIRST, route.S_LAST, 20.0):
        for right, left in ((-EDGE_M, 0.0), (0.0, EDGE_M)):
            _ribbon(chunks, first, first + 20, right, left, "asphalt", (route.LANE_M, 7.0), 0.0)


def _markings(chunks):
    for first in np.arange(route.S_FIRST, route.S_LAST, 12.0):
        _ribbon(chunks, first, first + 4, -0.06, 0.06, "paint", (1.0, 1.0), 0.008)
    for first in np.arange(route.S_FIRST, route.S_LAST, 20.0):
        for side in (-1, 1):
            d = side * 3.42
            beside_forecourt = side < 0 and route.FORECOURT_IN - 1 < first < route.FORECOURT_OUT
            if beside_forecourt:
                for dash in (0.0, 5.0, 10.0, 15.0):
                    _ribbon(chunks, first + dash, first + dash + 2.5, d - 0.06, d + 0.06, "paint", (1.0, 1.0), 0.008)
            else:
                _ribbon(chunks, first, first + 20, d - 0.06, d + 0.06, "paint", (1.0, 1.0), 0.008)


def _repairs(chunks):
    """What years have left on the road: dark and pale patches, sealed seams, manholes in the village, a crossing for walkers."""
    rng = np.random.default_rng(31)
    for s in np.arange(-60, 1800, 37.0):
        if route.TUNNEL_IN - 12 < s < route.TUNNEL_OUT + 2:
            continue
        lane, wide = rng.choice([-1.75, 1.75]), rng.uniform(0.45, 1.3)
        d, first, long = lane + rng.uniform(-0.3, 0.3), s + rng.uniform(0, 20), rng.uniform(1.5, 9.0)
        material = "asphalt_patch" if rng.random() < 0.6 else "asphalt_old"
        _ribbon(chunks, first, first + long, d - wide, d + wide, material, (route.LANE_M, 7.0), 0.004)
    for s, d in ((131, -1.6), (178, 1.4), (222, -1.5), (268, 1.7), (304, -1.6)):
        a = np.linspace(0, 2 * np.pi, 15)[:-1]
        disc = np.stack([0.36 * np.cos(a), 0.36 * np.sin(a), 0 * a + 0.006], axis=1)
        chunks.at(s).add(local(route.frame(s, d), disc), [list(range(14))], "steel_dark", disc[:, :2])
    for d in np.arange(-3.0, 3.1, 1.0):
        _ribbon(chunks, 198.0, 201.5, d - 0.25, d + 0.25, "paint", (1.0, 1.0), 0.009)


def _shoulders(chunks):
    """Gravel between asphalt and grass, where there is no pavement, tunnel or forecourt."""
    for first in np.arange(route.S_FIRST, route.S_LAST, 20.0):
        for side in (-1, 1):
            built = (route.VILLAGE_IN - 15 < first < route.VILLAGE_OUT or route.TUNNEL_IN - 10 < first < route.TUNNEL_OUT
                     or side < 0 and route.FORECOURT_IN - 15 < first < route.FORECOURT_OUT + 5)
            if built:
                continue
            s = np.linspace(first, first + 20, 5)
            d = side * np.array([EDGE_M - 0.05, EDGE_M + 0.65 + 0.0])
            grid = route.point(s[:, None], d[None], np.array([-0.005, -0.03])[None])
            uv = np.stack(np.broadcast_arrays(d[None] / 2.5, s[:, None] / 2.5), axis=-1)
            chunks.at(first).grid(grid, "gravel", uv, side < 0)


def _rail(chunks, first, last, d):
    """A guard rail that bends down into the ground at both ends."""
    s = np.linspace(first, last, int((last - first) / 4) + 1)
    sink = np.clip(np.minimum(s - first, last - s) / 12.0, 0, 1) * 0.75 - 0.75
    facing = -np.sign(d)
    for a in range(len(s) - 1):
        two = slice(a, a + 2)
        grid = route.point(s[two, None], d + facing * _RAIL[None, :, 0], _RAIL[None, :, 1] + sink[two, None])
        uv = np.zeros((2, len(_RAIL), 2))
        chunks.at(s[a]).grid(grid, "steel", uv, flip=facing > 0)
        frame = route.frame(s[a], d - facing * 0.06, sink[a])
        chunks.at(s[a]).box(frame, (-0.03, -0.05, -0.6), (0.03, 0.05, 0.74), "steel", skip="z")


def _marker_posts(chunks):
    """White posts with a black band and reflector every 50 m."""
    for s in np.arange(route.S_FIRST + 25, route.S_LAST, 50.0):
        indoors = route.TUNNEL_IN - 2 < s < route.TUNNEL_OUT + 2 or route.VILLAGE_IN < s < route.VILLAGE_OUT
        for d in (-5.35, 5.35):
            if indoors or (d < 0 and route.FORECOURT_IN < s < route.FORECOURT_OUT):
                continue
            frame, mesh = route.frame(s, d, -0.2), chunks.at(s)
            mesh.box(frame, (-0.05, -0.06, 0), (0.05, 0.06, 0.90), "white", skip="zZ")
            mesh.box(frame, (-0.052, -0.062, 0.90), (0.052, 0.062, 1.10), "black", skip="zZ")
            mesh.box(frame, (-0.05, -0.06, 1.10), (0.05, 0.06, 1.20), "white", skip="z")
            mesh.quad(local(frame, [(-0.056, 0.03, 0.93), (-0.056, -0.03, 0.93), (-0.056, -0.03, 1.07), (-0.056, 0.03, 1.07)]), "white")


def _panel(mesh, frame, corners, tile, back="steel"):
    """A flat sign, its picture towards -x of the frame. corners: (y, z) in order from the picture's lower left."""
    u0, v0, u1, v1 = tile_uv(tile, 0.0)
    corners = np.asarray(corners, float)
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    uv = np.stack([u1 - (corners[:, 0] - low[0]) / size[0] * (u1 - u0), v0 + (corners[:, 1] - low[1]) / size[1] * (v1 - v0)], axis=1)
    points = np.concatenate([np.full((len(corners), 1), -0.05), corners], axis=1)
    order = list(range(len(corners)))
    mesh.add(local(frame, points), [order], "details", uv)
    mesh.add(local(frame, points + [0.02, 0, 0]), [order[::-1]], back, uv)


def _sign(chunks, s, d, tile, shape="square", width=0.9, tall=None, low=1.7, towards=0.0, posts=(0.0,)):
    """A traffic sign on posts at (s, d); it faces traffic that goes along +s, or along -s with towards = pi."""
    ground = terrain.at(s, d)[2] - float(route.height(s))
    frame, mesh = route.frame(s, d, ground, towards), chunks.at(s)
    tall = tall or width
    for y in posts:
        mesh.tube(local(frame, [(0, y, -0.3), (0, y, low + 0.9 * tall)]), 0.035, 5, "steel")
    half, middle = width / 2, low + tall / 2
    if shape == "round":
        a = np.linspace(0, 2 * np.pi, 17)[:-1]
        corners = np.stack([-half * np.cos(a), middle + half * np.sin(a)], axis=1)[::-1]
    elif shape == "triangle":
        corners = [(half, low), (-half, low), (0, low + tall)]
    else:
        corners = [(half, low), (-half, low), (-half, low + tall), (half, low + tall)]
    _panel(mesh, frame, _counter_clockwise(corners), tile)


def _counter_clockwise(corners):
    """Order seen from -x, where +y is to the left."""
    c = np.asarray(corners, float)
    area = np.sum(c[:, 0] * np.roll(c[:, 1], -1) - np.roll(c[:, 0], -1) * c[:, 1])
    return c[::-1] if area > 0 else c


def _signs(chunks):
    pi = np.pi
    _sign(chunks, 96, -6.6, "name", width=2.2, tall=1.1, posts=(-0.8, 0.8))
    _sign(chunks, 334, 6.8, "name", width=2.2, tall=1.1, posts=(-0.8, 0.8), towards=pi)
    _sign(chunks, 101, -6.0, "speed", "round", width=0.75, low=2.0)
    _sign(chunks, 329, 6.4, "speed", "round", width=0.75, low=2.0, towards=pi)
    _sign(chunks, 462, -6.4, "tunnel", width=1.2, low=1.8)
    _sign(chunks, 815, 6.4, "tunnel", width=1.2, low=1.8, towards=pi)
    _sign(chunks, 742, -6.4, "bend", "triangle", width=1.0, tall=0.9, low=1.8)
    _sign(chunks, 985, 6.4, "bend", "triangle", width=1.0, tall=0.9, low=1.8, towards=pi)
    _sign(chunks, 1180, -6.4, "bend", "triangle", width=1.0, tall=0.9, low=1.8)
    for s, d in ((806, 6.2), (824, 6.2), (842, 6.2), (893, -6.2), (911, -6.2), (929, -6.2)):
        _sign(chunks, s, d, "chevron", width=0.8, low=0.9, towards=0.25 if d > 0 else -0.25)


def _pole():
    mesh = Mesh()
    mesh.tube([(0, 0, -1), (0, 0, 4), (0, 0, 8.6)], [0.16, 0.14, 0.10], 6, "wood", 2.0)
    mesh.box((np.zeros(3), np.eye(3)), (-0.06, -1.0, 8.0), (0.06, 1.0, 8.14), "wood")
    for y in (-0.9, 0.9):
        mesh.tube([(0, y, 8.1), (0, y, 8.35)], 0.05, 5, "white")
    return mesh.data("utility_pole")


def _wires(chunks, first, last, d, spacing=42.0):
    """Utility poles with two sagging wires."""
    data = _pole()
    stations = np.arange(first, last + 1, spacing)
    tops = []
    for s in stations:
        frame = (terrain.at(s, d), route.frame(s)[1])
        place(f"pole_{s:.0f}", data, frame)
        tops.append(local(frame, [(0, -0.9, 8.35), (0, 0.9, 8.35)]))
    t = np.linspace(0, 1, 7)[:, None]
    for k, s in enumerate(stations[:-1]):
        for a, b in zip(tops[k], tops[k + 1]):
            chunks.at(s).tube(a + (b - a) * t - np.array([0, 0, 1.0]) * 4 * 0.7 * t * (1 - t), 0.018, 3, "black")


# Timber fences along meadows: first and last s, d.
FENCES = [(372, 448, 11.5), (380, 440, -10.5), (985, 1140, 10.5), (1150, 1270, -9.0), (1330, 1440, 10.5), (1620, 1760, -9.5), (-120, -10, 12.5)]


def _fence(chunks, first, last, d):
    for s in np.arange(first, last, 3.2):
        ends = terrain.at(np.array([s, s + 3.2]), d)
        side = route.frame(s)[1][1]
        frame = (ends[0], np.array([(ends[1] - ends[0]) / 3.2, side, [0, 0, 1.0]]))
        mesh = chunks.at(s)
        mesh.box(frame, (-0.06, -0.06, -0.4), (0.06, 0.06, 1.15), "wood", 1.0, skip="z")
        for z in (0.45, 0.9):
            mesh.box(frame, (0.0, -0.09, z), (3.2, -0.05, z + 0.12), "wood", 1.0, skip="xX")


def _hay_bales():
    mesh, a = Mesh(), np.linspace(0, 2 * np.pi, 15)
    mesh.tube([(0, -0.6, 0.72), (0, 0.6, 0.72)], 0.75, 14, "hay", 1.5)
    for y in (-0.6, 0.6):
        disc = np.stack([0.75 * np.cos(a[:-1]), 0 * a[:-1] + y, 0.72 + 0.75 * np.sin(a[:-1])], axis=1)
        mesh.add(disc, [list(range(14)) if y < 0 else list(range(14))[::-1]], "hay", disc[:, [0, 2]] / 1.5)
    data, rng = mesh.data("hay_bale"), np.random.default_rng(8)
    for k, (s, d) in enumerate([(1160, -30), (1172, -42), (1186, -27), (1204, -48), (1216, -33), (1350, 34), (1362, 46), (1378, 30), (-30, -34), (-52, -26)]):
        place(f"hay_bale_{k}", data, (terrain.at(s, d), route.frame(s, turn=rng.uniform(0, 6.28))[1]))


def build(ground, furniture):
    _surface(ground)
    _markings(ground)
    _repairs(ground)
    _shoulders(ground)
    for first, last, d in RAILS:
        _rail(furniture, first, last, d)
    for first, last, d in FENCES:
        _fence(furniture, first, last, d)
    _hay_bales()
    _marker_posts(furniture)
    _signs(furniture)
    _wires(furniture, -170, 90, 13.5)
    _wires(furniture, 1180, 1930, -13.0)
