"""The village: houses, pavements, street lamps, walls and parked cars."""
import numpy as np

import road_route as route
import road_terrain as terrain
from road_mesh import Mesh, lamp, local, place
from road_textures import tile_uv

_WORLD = (np.zeros(3), np.eye(3))
_PAVEMENT = (4.0, 6.1)
# name: walls, roof, width along the street, depth, eaves, rise of the roof, columns of windows
_HOUSES = {"white": ("plaster_white", "roof_red", 11.0, 9.0, 5.6, 4.0, 4), "ochre": ("plaster_ochre", "roof_red", 9.5, 9.5, 5.4, 4.6, 3),
           "brick": ("brick", "roof_slate", 12.0, 8.5, 5.2, 3.6, 4), "cottage": ("plaster_rose", "roof_slate", 10.0, 8.0, 3.1, 4.2, 3),
           "barn": ("wood", "roof_red", 17.0, 10.0, 4.8, 5.2, 0)}
# s, d, house, gable towards the street
PLOTS = [(124, 17, "cottage", 0), (143, 18, "white", 0), (166, 17, "ochre", 1), (188, 19, "brick", 0), (212, 17, "white", 1),
         (236, 18, "ochre", 0), (261, 18, "cottage", 0), (288, 19, "brick", 0), (313, 25, "barn", 1),
         (116, -24, "barn", 0), (141, -17, "ochre", 0), (164, -18, "brick", 1), (187, -17, "white", 0), (210, -18, "cottage", 0),
         (238, -19, "white", 0), (263, -17, "ochre", 1), (286, -18, "cottage", 0), (309, -18, "white", 0),
         (180, 48, "brick", 0), (228, 52, "white", 1), (200, -50, "ochre", 1), (256, -48, "brick", 0), (1235, 46, "barn", 0), (1262, 52, "white", 1),
         (-95, -58, "barn", 1), (-70, -62, "brick", 0), (1520, -64, "barn", 0), (1540, -84, "ochre", 1), (915, 70, "white", 0)]


def _shell(mesh, walls, roof, w, depth, eaves, rise):
    """Walls with gables, and a roof with eaves; the street front looks along -y."""
    x, y = w / 2, depth / 2
    tile_m = 1.3 if walls == "brick" else 3.0
    mesh.box(_WORLD, (-x, -y, 0.35), (x, y, eaves), walls, tile_m, skip="zZ")
    mesh.box(_WORLD, (-x - 0.04, -y - 0.04, -1.5), (x + 0.04, y + 0.04, 0.4), "concrete_dark", 3.0, skip="z")
    for side in (-1, 1):
        gable = np.array([(side * x, -side * y, eaves), (side * x, side * y, eaves), (side * x, 0, eaves + rise)])
        order = [(0, 1, 2)]
        mesh.add(gable, order, walls, gable[:, 1:] / tile_m)
        _roof_slope(mesh, roof, x + 0.45, y, eaves, rise, side)


def _roof_slope(mesh, roof, x, y, eaves, rise, side):
    over, slope = 0.55, rise / y
    foot = np.array([0, side * -(y + over), eaves - over * slope])
    ridge = np.array([0, 0, eaves + rise + 0.02])
    a, b = foot + [-side * x, 0, 0.16], foot + [side * x, 0, 0.16]
    c, d = ridge + [side * x, 0, 0.16], ridge + [-side * x, 0, 0.16]
    length = np.linalg.norm(ridge - foot) / 2.4
    mesh.quad([a, b, c, d], roof, (0, 0, 2 * x / 2.4, length))
    drop = np.array([0, 0, -0.18])
    mesh.quad([b + drop, a + drop, d + drop, c + drop], "wood", (0, 0, 3, 1))
    mesh.quad([a + drop, b + drop, b, a], "steel_dark")
    for p, q in ((b, c), (d, a)):
        mesh.quad([p + drop, q + drop, q, p], "wood", (0, 0, 3, 0.2))


def _opening(mesh, centre, along, width, z0, z1, tile):
    """A window or door in front of a wall, with a sill. along: unit vector to the right as seen from outside."""
    centre, along = np.asarray(centre, float), np.asarray(along, float)
    out = np.array([along[1], -along[0], 0.0])
    left, right = centre - along * width / 2 + out * 0.03, centre + along * width / 2 + out * 0.03
    up = np.array([0, 0, 1.0])
    mesh.quad([left + up * z0, right + up * z0, right + up * z1, left + up * z1], "details", tile_uv(tile))
    if tile not in ("door", "garage"):
        frame = (centre + up * z0, np.array([along, -out, up]))
        mesh.box(frame, (-width / 2 - 0.1, -0.14, -0.08), (width / 2 + 0.1, 0, 0.0), "concrete", 1.0, skip="Y")


def _windows(mesh, w, depth, eaves, rise, columns, rng):
    floors = [1.0] if eaves < 4 else [1.0, 3.6]
    sides = [((0, -depth / 2), (1, 0, 0), w, columns), ((0, depth / 2), (-1, 0, 0), w, columns),
             ((w / 2, 0), (0, 1, 0), depth, 2), ((-w / 2, 0), (0, -1, 0), depth, 2)]
    for k, (centre, along, length, count) in enumerate(sides):
        for floor in floors:
            for column in range(count):
                offset = ((column + 0.5) / count - 0.5) * (length - 0.6)
                at = np.array([*centre, 0.0]) + np.array(along) * offset
                if k == 0 and floor == 1.0 and column == count // 2:
                    _opening(mesh, at, along, 1.1, 0.1, 2.25, "door")
                    continue
                tile = rng.choice(["window", "curtain", "curtain", "lit"], p=[0.42, 0.2, 0.2, 0.18])
                _opening(mesh, at, along, 1.15, floor, floor + 1.35, tile)
        if k >= 2:
            _opening(mesh, (*centre, 0.0), along, 0.9, eaves + 0.35 * rise - 0.4, eaves + 0.35 * rise + 0.7, "curtain")


def _house(name, variant):
    walls, roof, w, depth, eaves, rise, columns = _HOUSES[name]
    mesh, rng = Mesh(), np.random.default_rng([len(name), variant, int(w * 10)])
    _shell(mesh, walls, roof, w, depth, eaves, rise)
    if columns:
        _windows(mesh, w, depth, eaves, rise, columns, rng)
        mesh.box(_WORLD, (w * 0.22, 0.4, eaves + rise * 0.5), (w * 0.22 + 0.7, 1.1, eaves + rise + 1.0), "brick", 1.5, skip="z")
    else:
        _opening(mesh, (0, -depth / 2, 0), (1, 0, 0), 4.2, 0.0, 3.8, "garage")
    return mesh.data(f"house_{name}_{variant}")


def _houses():
    data = {}
    for k, (s, d, name, gable) in enumerate(PLOTS):
        key = (name, k % 2)
        if key not in data:
            data[key] = _house(*key)
        turn = (0.0 if d > 0 else np.pi) + (np.pi / 2 if gable else 0.0)
        frame = (terrain.at(s, d) - [0, 0, 0.15], route.frame(s, turn=turn)[1])
        place(f"house_{k}", data[key], frame)


def _pavements(chunks):
    for side in (-1, 1):
        for first in np.arange(route.VILLAGE_IN, route.VILLAGE_OUT, 20.0):
            s = np.linspace(first, first + 20, 9)
            near, far = _PAVEMENT
            d = side * np.array([near, near + 0.02, near + 0.16, near + 0.16, far, far + 0.05])
            h = np.array([-0.1, 0.11, 0.13, 0.13, 0.16, -0.25])
            rise = np.clip(np.minimum(s - route.VILLAGE_IN, route.VILLAGE_OUT - s) / 2.5, 0, 1)[:, None]
            grid = route.point(s[:, None], d[None], np.where(h > 0, h * rise - 0.12 * (1 - rise), h))
            u = np.array([0, 0.1, 0.17, 0.0, 0.9, 1.1])
            uv = np.stack(np.broadcast_arrays(s[:, None] / 2.0, u[None]), axis=-1)
            chunks.at(first).grid(grid[:, :3], "kerb", uv[:, :3], side < 0)
            chunks.at(first).grid(grid[:, 3:], "paving", uv[:, 3:], side < 0)


def _street_plots():
    """Houses that stand at the street: (s, d, half their depth towards it)."""
    for s, d, name, gable in PLOTS:
        if abs(d) < 30 and route.VILLAGE_IN < s < route.VILLAGE_OUT:
            yield s, d, _HOUSES[name][2 if gable else 3] / 2, _HOUSES[name][3 if gable else 2] / 2


def _on_ground(chunks, s0, s1, d0, d1, material, tile_m, lift=0.06):
    """A patch laid over the ground between two stations and two distances; its sides go down into the ground."""
    low, high = sorted((d0, d1))
    s, d = np.meshgrid([s0 - 0.08, s0, s1, s1 + 0.08], np.linspace(low, high, 5), indexing="ij")
    grid = terrain.at(s, d)
    grid[..., 2] += np.array([-0.15, lift, lift, -0.15])[:, None]
    chunks.at(s0).grid(grid, material, np.stack([s, d], axis=-1) / tile_m)


def _gardens(chunks):
    """From the pavement a path to each door and a drive beside the house."""
    for s, d, deep, wide in _street_plots():
        side = np.sign(d)
        _on_ground(chunks, s - 0.8, s + 0.8, side * _PAVEMENT[1], d - side * (deep - 0.1), "paving", 2.4)
        _on_ground(chunks, s + wide + 0.7, s + wide + 3.7, side * _PAVEMENT[1], d, "gravel", 3.0)


def _boundaries(chunks):
    """Low walls or fences along the pavement, open at doors and drives."""
    for side in (-1, 1):
        gaps = [(s, 2.6) for s, d, *_ in _street_plots() if d * side > 0]
        gaps += [(s + wide + 2.2, 3.6) for s, d, _, wide in _street_plots() if d * side > 0]
        for first in np.arange(route.VILLAGE_IN + 2, route.VILLAGE_OUT - 4, 4.0):
            style = int(first // 22 + side) % 3
            if style == 2 or any(abs(first + 2 - at) < reach for at, reach in gaps):
                continue
            (_wall if style else _fence)(chunks.at(first), route.frame(first + 2, side * 6.5))


def _wall(mesh, frame):
    mesh.box(frame, (-2.02, -0.14, -0.5), (2.02, 0.14, 0.85), "plaster_grey", 2.0, skip="z")
    mesh.box(frame, (-2.05, -0.2, 0.85), (2.05, 0.2, 0.95), "concrete", 2.0, skip="z")


def _fence(mesh, frame):
    for x in np.arange(-1.92, 2.0, 0.32):
        mesh.box(frame, (x - 0.05, -0.02, 0.05), (x + 0.05, 0.02, 1.0), "white", skip="zxX")
    for z in (0.28, 0.78):
        mesh.box(frame, (-2.0, -0.03, z), (2.0, 0.03, z + 0.08), "wood", skip="xX")


def _lamp_post():
    mesh = Mesh()
    mesh.tube([(0, 0, -0.3), (0, 0, 1.2), (0, 0, 1.25), (0, 0, 7.2)], [0.10, 0.10, 0.07, 0.05], 7, "steel")
    a = np.linspace(0, np.pi / 2, 5)
    mesh.tube(np.stack([0 * a, -1.6 * (1 - np.cos(a)), 7.2 + 0.7 * np.sin(a)], axis=1), 0.04, 6, "steel")
    mesh.box(_WORLD, (-0.16, -2.2, 7.82), (0.16, -1.45, 7.96), "steel_dark", skip="z")
    mesh.quad([(-0.13, -1.5, 7.81), (0.13, -1.5, 7.81), (0.13, -2.15, 7.81), (-0.13, -2.15, 7.81)], "lamp_warm")
    return mesh.data("lamp_post")


def _street_lamps():
    data = _lamp_post()
    for k, s in enumerate(np.arange(112, 330, 26.0)):
        side = 1 if k % 2 else -1
        d = side * 5.7
        frame = route.frame(s, d, 0.1, 0.0 if side > 0 else np.pi)
        place(f"lamp_post_{k}", data, frame)
        lamp(f"street_light_{k}", (local(frame, [(0, -1.8, 7.7)])[0], frame[1]), 2500.0, 30.0, (1.0, 0.80, 0.52), 150.0)


def _car(paint):
    """A parked saloon: one outline drawn across, narrower above the waist."""
    mesh = Mesh()
    outline = np.array([(-2.15, 0.35), (-2.2, 0.75), (-2.0, 0.95), (-1.1, 1.0), (-0.45, 1.42), (0.75, 1.45), (1.55, 1.0), (2.1, 0.95),
                        (2.2, 0.6), (2.12, 0.3)])
    half = np.where(outline[:, 1] > 1.2, 0.62, np.where(outline[:, 1] > 0.9, 0.82, 0.86))
    ring = [np.stack([outline[:, 0], k * half, outline[:, 1]], axis=1) for k in (1, -1)]
    for k in range(len(outline) - 1):
        glass = k in (3, 5)
        mesh.quad([ring[1][k], ring[1][k + 1], ring[0][k + 1], ring[0][k]], "car_glass" if glass else paint)
    mesh.quad([ring[0][0], ring[0][-1], ring[1][-1], ring[1][0]], "black")
    for side, sign in ((0, 1), (1, -1)):
        _car_side(mesh, ring[side], sign, paint)
    for x in (-1.35, 1.35):
        for y in (-0.88, 0.70):
            a = np.linspace(0, 2 * np.pi, 13)[:-1]
            disc = np.stack([x + 0.32 * np.cos(a), 0 * a + (y + 0.18 if y > 0 else y), 0.32 + 0.32 * np.sin(a)], axis=1)
            mesh.add(disc, [list(range(12))[::-1] if y > 0 else list(range(12))], "tyre", disc[:, [0, 2]])
            inner = disc + [0, 0.18 if y < 0 else -0.18, 0]
            mesh.add(inner, [list(range(12)) if y > 0 else list(range(12))[::-1]], "tyre", inner[:, [0, 2]])
            mesh.tube([(x, y, 0.32), (x, y + 0.18, 0.32)], 0.32, 12, "tyre")
    for y in (-0.62, 0.62):
        mesh.box(_WORLD, (2.1, y - 0.2, 0.62), (2.22, y + 0.2, 0.76), "tail_red")
    return mesh.data("parked_" + paint)


def _car_side(mesh, ring, sign, paint):
    lower, upper = [0, 1, 2, 3, 6, 7, 8, 9], [3, 4, 5, 6]
    for part, material in ((lower, paint), (upper, "car_glass")):
        order = part if sign > 0 else part[::-1]
        mesh.add(ring[part], [[part.index(k) for k in order]], material, ring[part][:, [0, 2]])


def _parked_cars():
    """On drives in the village, and in front of the shop."""
    drives = [(s + wide + 2.2, np.sign(d) * (abs(d) - 3.5)) for s, d, _, wide in _street_plots()]
    places = [(*drives[k], k) for k in (1, 3, 6, 10, 12, 14)] + [(1050.1, -28.6, 2), (1055.3, -28.6, 0), (1065.7, -28.7, 1)]
    data = [_car(name) for name in ("car_blue", "car_red", "car_silver")]
    for k, (s, d, paint) in enumerate(places):
        h = 0.0 if s > 1000 else float(terrain.at(s, d)[2] - route.height(s)) + 0.07
        place(f"parked_{k}", data[paint % 3], route.frame(s, d, h, np.pi / 2 + (0.0 if k % 2 else np.pi)))


def build(ground):
    _pavements(ground)
    _gardens(ground)
    _boundaries(ground)
    _houses()
    _street_lamps()
    _parked_cars()
